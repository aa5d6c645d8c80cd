"""Run an answer over the cases and record the results, as plain arrays and text.

This is the only module that calls a student's code: in the notebook's kernel for
``check``, in a separate limited process for the grader. It knows nothing of references
or verdicts.
"""

from __future__ import annotations

import contextlib
import inspect
import io
import linecache
import textwrap
import traceback
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np

from course.exercises.expressions import evaluator
from course.exercises.question import Question
from course.exercises.source import is_blank

#: "unattempted" is a ``...`` that was returned: ``answer_to`` makes a blank answer of it.
OutcomeKind = Literal["value", "none", "raised", "unreadable", "unattempted", "wrote"]
PRINTED_LIMIT = 400
FLOOD_LIMIT = 1_000_000
TEXT_LIMIT = 1_000
SIZE_LIMIT = 1_000_000


@dataclass(frozen=True)
class Outcome:
    """The result of one call: the returned arrays, or in ``text`` why there are none.

    ``given`` are the arguments as they were after the call, so that ``verdict`` sees
    whether they were modified. It is empty where the call raised.
    """

    kind: OutcomeKind
    values: tuple[np.ndarray, ...] = ()
    text: str = ""
    printed: str = ""
    given: Mapping[str, Any] = field(default_factory=dict, repr=False, compare=False)


@dataclass(frozen=True)
class Answer:
    """What came of an answer: an outcome for each case; or none, because it is ``blank`` or, in words, at ``fault``."""

    outcomes: tuple[Outcome, ...] = ()
    blank: bool = False
    fault: str = ""


class OutputFlood(BaseException):
    """An answer that prints endlessly.

    Not an ``Exception``, or ``except Exception`` in a loop would swallow it.
    """


class Printed(io.TextIOBase):
    """Keeps the first characters printed, counts the rest, and stops a flood."""

    def __init__(self) -> None:
        super().__init__()
        self.text = ""
        self.count = 0

    def write(self, text: str) -> int:
        self.count += len(text)
        if len(self.text) < PRINTED_LIMIT:
            self.text = (self.text + text)[:PRINTED_LIMIT]
        if self.count > FLOOD_LIMIT:
            raise OutputFlood(
                f"it printed more than {FLOOD_LIMIT:,} characters: a loop without end?"
            )
        return len(text)


def answer_to(
    question: Question,
    value: Any,
    cases: Iterable[Mapping[str, Any]] | None = None,
) -> Answer:
    """Call what a student wrote on the question's cases.

    Whether an answer that was run is blank is decided here and nowhere after. ``cases`` are the
    question's own, for a caller that wants to see which one is next.
    """
    if is_stub(value):
        return Answer(blank=True)
    try:
        function = as_function(value, question.kind, question.name, question.arguments)
    except Exception as error:  # an object of a student's may raise anything
        return Answer(fault=str(error)[:TEXT_LIMIT])
    asked = question.cases if cases is None else cases
    outcomes = call_all(function, asked, question.results)
    if any(outcome.kind == "unattempted" for outcome in outcomes):
        return Answer(blank=True)
    return Answer(tuple(outcomes))


def call(
    function: Callable[..., Any], arguments: Mapping[str, Any], result_count: int
) -> Outcome:
    """Call ``function`` on copies of the arguments, by position; record the result."""
    given = {name: _copy(value) for name, value in arguments.items()}
    printed = Printed()
    try:
        with (
            warnings.catch_warnings(),
            contextlib.redirect_stdout(printed),
            contextlib.redirect_stderr(printed),
        ):
            warnings.simplefilter("ignore")
            returned = function(*given.values())
            outcome = _as_arrays(
                returned, result_count
            )  # may run an object's own __array__ or __len__
    except KeyboardInterrupt:
        raise
    except (
        BaseException
    ) as error:  # SystemExit too: an answer that exits is an answer that raised
        return Outcome("raised", text=describe(error), printed=printed.text)
    return replace(outcome, printed=printed.text, given=given)


def call_all(
    function: Callable[..., Any], cases: Iterable[Mapping[str, Any]], result_count: int
) -> list[Outcome]:
    """Call ``function`` on every case; NumPy's global random state is restored
    afterwards.
    """
    state = np.random.get_state()
    try:
        with np.errstate(all="ignore"):
            return [call(function, arguments, result_count) for arguments in cases]
    finally:
        np.random.set_state(state)


def as_function(
    answer: Any, kind: str, name: str, arguments: Sequence[str]
) -> Callable[..., Any]:
    """The answer as a function of arrays; an expression becomes a function that
    evaluates it.

    Raises ``TypeError`` or ``ValueError``, in words meant for the student, where the
    answer is neither, or takes other arguments.
    """
    if kind == "expression":
        return evaluator(answer, arguments)
    if not callable(answer):
        raise TypeError(
            f"expected a function; got {_kind(answer)} (pass {name}, not {name}(...))"
        )
    try:
        signature = inspect.signature(answer)
    except ValueError:  # a built-in without a readable signature: calling it will show
        return answer
    try:
        signature.bind(*arguments)
    except TypeError:
        wanted, taken = ", ".join(arguments), ", ".join(signature.parameters)
        raise TypeError(
            f"expected a function that takes {name}({wanted}); yours takes ({taken})"
        ) from None
    if sorted(signature.parameters) == sorted(arguments) and list(
        signature.parameters
    ) != list(arguments):
        wanted, taken = ", ".join(arguments), ", ".join(signature.parameters)
        raise TypeError(
            f"expected the arguments in the order {name}({wanted}); yours takes ({taken})"
        )
    return answer


def is_stub(answer: Any, source: str | None = None) -> bool:
    """Whether the answer is the lesson's blank: ``...``, or a function blank by
    ``is_blank``.
    """
    if answer is Ellipsis:
        return True
    if not callable(answer):
        return False
    try:
        source = textwrap.dedent(
            source if source is not None else inspect.getsource(answer)
        )
    except (OSError, TypeError):
        return False
    return is_blank(source, getattr(answer, "__name__", ""))


def describe(error: BaseException) -> str:
    """An exception in one or two lines: type, message, the student's last own line."""
    words = type(error).__name__
    try:
        said = str(error)[:TEXT_LIMIT]
    except Exception:  # a student's exception may fail to print itself
        said = ""
    words += f": {said}" if said else ""
    own = [
        f
        for f in traceback.extract_tb(error.__traceback__)
        if _is_notebook_frame(f.filename)
    ]
    if own:
        line = (
            own[-1].line
            or linecache.getline(own[-1].filename, own[-1].lineno or 0).strip()
        )
        if line:
            words += f"\n  in the line:  {line[:TEXT_LIMIT]}"
    return words


def _is_notebook_frame(filename: str) -> bool:
    return "ipykernel" in filename or filename.startswith(("<ipython", "<cell"))


def _as_arrays(returned: Any, count: int) -> Outcome:
    if returned is None:
        return Outcome("none")
    if returned is Ellipsis:
        return Outcome("unattempted")
    parts: Sequence[Any] = (returned,)
    if count > 1:
        if not isinstance(returned, (tuple, list)):
            return Outcome(
                "unreadable",
                text=f"expected {count} results, as in `return a, b`; got one {_kind(returned)}",
            )
        if len(returned) != count:
            return Outcome(
                "unreadable", text=f"expected {count} results; got {len(returned)}"
            )
        parts = returned
    arrays = []
    for part in parts:
        if part is None or part is Ellipsis:
            return Outcome("none" if part is None else "unattempted")
        if isinstance(part, np.ndarray) and part.size > SIZE_LIMIT:
            return Outcome(
                "unreadable", text=_too_many(part.size)
            )  # before a copy is made of it
        try:
            array = np.array(part)
        except (ValueError, TypeError):
            return Outcome(
                "unreadable",
                text=f"expected numbers in an array; got a ragged {_kind(part)}",
            )
        if array.dtype.kind not in "biufcU":
            return Outcome("unreadable", text=f"expected numbers; got {_content(part)}")
        if array.size > SIZE_LIMIT:
            return Outcome("unreadable", text=_too_many(array.size))
        arrays.append(array)
    return Outcome("value", tuple(arrays))


def _content(part: Any) -> str:
    """What is in the place of numbers: of an array of objects, the first that is none."""
    if not isinstance(part, (np.ndarray, list, tuple)):
        return _described(part)
    inside = np.array(part, dtype=object).ravel()
    odd = [x for x in inside if not isinstance(x, (int, float, complex, np.number))]
    odd.sort(key=lambda x: not getattr(x, "free_symbols", None))
    return f"{_kind(part)} with {_described(odd[0])} in it" if odd else _kind(part)


def _described(value: Any) -> str:
    """The kind of a value; of a SymPy expression also its symbols, by which the notebook's variable is found.

    A cvxpy expression is told where its numbers are.
    """
    if type(value).__module__.startswith("cvxpy."):
        return f"a cvxpy {_kind(value)}, whose numbers are in its .value"
    symbols = getattr(value, "free_symbols", None)
    if not isinstance(symbols, set) or not symbols:
        return _kind(value)
    return f"a SymPy expression in {', '.join(sorted(map(str, symbols)))}"


def _too_many(size: int) -> str:
    return f"expected at most {SIZE_LIMIT:,} numbers; got {size:,}"


def _kind(value: Any) -> str:
    return type(value).__name__


def _copy(value: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(_copy(part) for part in value)
    return np.array(value) if isinstance(value, np.ndarray) else value
