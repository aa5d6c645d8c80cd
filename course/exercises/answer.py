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

from course.exercises.source import is_blank

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


def evaluator(expression: Any, symbols: Sequence[str]) -> Callable[..., Any]:
    """A function of arrays, in the order of ``symbols``, that evaluates a SymPy
    expression.

    Raises ``TypeError`` or ``ValueError``, in words meant for the student, where the
    answer is not an expression in these symbols.
    """
    import sympy

    if isinstance(expression, (list, tuple, set, dict, sympy.FiniteSet)):
        entry = "its entry, as in solve(...)[0]"
        if isinstance(expression, dict):
            entry = "that of the unknown you want, as in solve(...)[p]"
        raise TypeError(
            f"expected one expression; got a {type(expression).__name__} of {len(expression)}. "
            f"sympy.solve returns several: take {entry}"
        )
    if isinstance(
        expression,
        (sympy.core.relational.Relational, sympy.logic.boolalg.BooleanAtom, bool),
    ):
        raise TypeError(
            "expected an expression; got an equation. Give its right-hand side alone"
        )
    if callable(expression) and not isinstance(expression, sympy.Basic):
        raise TypeError("expected an expression in SymPy's symbols; got a function")
    came = _kind(expression)
    try:
        expression = (
            None if isinstance(expression, np.ndarray) else sympy.sympify(expression)
        )
    except (sympy.SympifyError, TypeError, AttributeError):
        expression = None
    if not isinstance(expression, sympy.Expr) or expression.is_Matrix:
        raise TypeError(f"expected a SymPy expression; got {came}")
    _require_known(expression, symbols)
    expression = expression.replace(sympy.Piecewise, _without_endless_branches)
    by_name = {str(s): s for s in expression.free_symbols}
    try:
        points = [by_name.get(s, sympy.Symbol(s)) for s in symbols]
        compiled = _compiled(points, expression)
    except Exception:  # each of SymPy's printers has its own kind
        words = "an integral, a derivative or a sum is still to be worked out, as .doit() does"
        raise ValueError(
            f"expected an expression that can be evaluated; perhaps {words}"
        ) from None

    def evaluate(*points: Any) -> np.ndarray:
        shape = np.broadcast_shapes(*(np.shape(p) for p in points))
        return np.broadcast_to(np.asarray(compiled(*points), dtype=float), shape).copy()

    return evaluate


def _compiled(points: Sequence[Any], expression: Any) -> Callable[..., Any]:
    """``sympy.lambdify`` for NumPy, without what its own ``from numpy import *`` loads first: a tenth of a second of
    packages that no formula uses.
    """
    import sympy
    from sympy.printing.numpy import NumPyPrinter

    settings = {"fully_qualified_modules": False, "inline": True}
    printer = NumPyPrinter({**settings, "allow_unknown_functions": True})
    names = {**vars(np.linalg), **vars(np), "numpy": np}
    return sympy.lambdify(points, expression, [names], printer)


def _without_endless_branches(*branches: Any) -> Any:
    """A Piecewise with NaN for its branches that have no finite value or are an infinite sum still to be done.

    SymPy gives a geometric series so: its sum where that converges, the sum itself as
    it stands elsewhere. All branches are evaluated, and one of the latter has no end.
    """
    import sympy

    kept = [(sympy.nan if v.has(sympy.oo, -sympy.oo) else v, c) for v, c in branches]
    return sympy.Piecewise(*kept, evaluate=False)


def _require_known(expression: Any, symbols: Sequence[str]) -> None:
    """Refuse an expression with other symbols or undefined functions, or divided by
    zero.
    """
    import sympy

    others = expression.free_symbols | expression.atoms(
        sympy.core.function.AppliedUndef
    )
    foreign = sorted({str(s) for s in others} - set(symbols))
    if foreign:
        raise ValueError(
            f"expected an expression in {', '.join(symbols)}; yours also contains {', '.join(foreign)}"
        )
    endless = (sympy.oo, -sympy.oo)
    if expression.has(sympy.nan, sympy.zoo) or expression.subs(
        {p: 1 for p in expression.atoms(sympy.Piecewise)}
    ).has(*endless):
        raise ValueError(
            f"expected a finite expression; got {expression}: is something divided by zero?"
        )


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
