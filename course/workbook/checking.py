"""``check``, ``use`` and ``predict``: a student's answer, judged at once."""

from __future__ import annotations

import contextlib
import copy
import dis
import functools
import inspect
import threading
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from course.arrays import written
from course.exercises.answer import as_function, call_all, is_stub
from course.exercises.definition import (
    Exercise,
    Lesson,
    Prediction,
    find_exercise,
    find_prediction,
)
from course.exercises.message import Message, Part, verdict_message
from course.exercises.verdict import Verdict, judge
from course.workbook import recording
from course.workbook.facts import borrowed_variables, facts_told
from course.workbook.notebook import display_message, in_notebook
from course.workbook.numbers import show
from course.workbook.repairing import look_for_repair

MARK = "__from_use__"
#: Seconds until a check says that the answer is still running; the longest right one
#: takes a fifth of a second.
RUNS_ON = 10
_lent: list[Any] = []  # reference expressions that use() has returned


def check(answer: Any, name: str | None = None) -> None:
    """Judge a function you wrote (or a SymPy expression) and show the verdict.

    An expression needs the exercise's ``name``. Raises ``ValueError`` when no exercise
    has this name, and for functions that are not your own.
    """
    name = _name_of(answer, name)
    lesson, exercise = find_exercise(name)
    _refuse_borrowed(answer)
    verdict = judge_here(exercise, answer)
    if not verdict.passed and verdict.state != "not attempted":
        verdict = replace(
            verdict,
            reason=(*_unfinished_before(lesson, exercise, answer), *verdict.reason),
        )
        verdict = _with_facts(exercise, answer, verdict)
    passed_before = recording.state().passed
    recording.record("check", name, state=verdict.state)
    if (
        not verdict.passed
        and verdict.state != "not attempted"
        and verdict.mistake is None
    ):
        recording.record_unrecognised(
            name, _source(answer), str(verdict_message(exercise, verdict))
        )
    passed = recording.state().passed
    if verdict.passed:
        following = whats_next(lesson, exercise, passed_before, passed)
        after = (Part("next", following),)
    else:
        taken = recording.state().hints.get(name, 0)
        advice = (
            "the first of three hints"
            if taken == 0
            else "the next hint"
            if taken < 3
            else "the reference"
        )
        after = (Part("stuck?", f"hint({name!r}) gives {advice}"),)
    display_message(verdict_message(exercise, verdict, after=after))
    if in_notebook() and not borrowed_variables(answer):
        told = look_for_repair(exercise, answer, verdict)
        if told is not None:
            display_message(told)


def whats_next(
    lesson: Lesson, exercise: Exercise, before: frozenset[str], passed: frozenset[str]
) -> str:
    """What to do after an exercise has passed; ``before`` are those that had passed before this check.

    That the last core exercise was done is news once: neither at a second check of it, nor at a stretch one's.
    """
    following = recording.next_exercise(lesson, exercise.name, passed)
    if following is not None:
        left = recording.minutes_left(lesson, passed)
        return (
            f"{following.name}; about {left} minutes of exercises left in this lesson"
        )
    if exercise.level == "core" and exercise.name not in before:
        return "that was the last core exercise of this lesson"
    return "all core exercises of this lesson have passed"


def judge_here(exercise: Exercise, answer: Any) -> Verdict:
    """Judge an answer in this process, on the cases that every notebook uses."""
    if is_stub(answer):
        return Verdict(exercise.name, "not attempted")
    cases = exercise.draw()
    try:
        function = as_function(
            answer, exercise.kind, exercise.name, [a.name for a in exercise.arguments]
        )
    except (TypeError, ValueError) as error:
        return Verdict(exercise.name, "error", reason=(str(error),))
    try:
        with _told_if_it_runs_on(exercise.name):
            outcomes = call_all(
                function, [c.arguments for c in cases], len(exercise.results)
            )
    except KeyboardInterrupt:
        told = "Stopped by hand: it was still running. Look for a loop that never ends."
        display_message(Message("error", f"{exercise.name}: {told}", ()))
        raise
    return judge(exercise, cases, outcomes)


@contextlib.contextmanager
def _told_if_it_runs_on(name: str) -> Iterator[None]:
    """After some seconds, say that the answer is still running: a busy cell alone says
    nothing.
    """
    way = Part(
        "stop it", "with the square button in the toolbar (interrupt the kernel)"
    )
    look = Part("look for", "a loop that never ends")
    message = Message(
        "error", f"{name}: still running after {RUNS_ON} seconds", (way, look)
    )
    timer = threading.Timer(RUNS_ON, display_message, (message,))
    timer.daemon = True
    if in_notebook():
        timer.start()
    try:
        yield
    finally:
        timer.cancel()


def _unfinished_before(
    lesson: Lesson, exercise: Exercise, answer: Any
) -> tuple[str, ...]:
    """A line for each earlier exercise that the answer calls and that is not right."""
    if not inspect.isfunction(answer):
        return ()
    called = {
        step.argval
        for step in dis.get_instructions(answer)
        if step.opname == "LOAD_GLOBAL"
    }
    earlier = lesson.exercises[: lesson.exercises.index(exercise)]
    own = [
        (e, answer.__globals__[e.name])
        for e in earlier
        if e.name in called and e.name in answer.__globals__
    ]
    return tuple(
        f"It calls your {e.name}, which does not pass its own check yet: fix that first."
        for e, function in own
        if not _is_lent(function) and not judge_here(e, function).passed
    )


def _with_facts(exercise: Exercise, answer: Any, verdict: Verdict) -> Verdict:
    """The verdict with what its source tells.

    Of an answer that takes the notebook's variables no property is told: it was not the answer's own number.
    """
    reason = verdict.reason
    if borrowed_variables(answer) and verdict.mistake is None:
        lacking = {p.message for p in exercise.properties}
        reason = tuple(r for r in reason if r not in lacking)
    before, after = facts_told(exercise, answer, verdict)
    return replace(verdict, reason=(*before, *reason, *after))


def use(answer: Any, name: str | None = None, *, symbols: Sequence[Any] = ()) -> Any:
    """Your function (or expression) if it passes its check, otherwise the reference.

    A line says which. The rest of the lesson runs on what this returns. ``check``
    refuses it, as it refuses functions of ``course``; ``use`` returns it unchanged, so
    that ``f = use(f)`` can be run twice. For an expression give its ``name`` and the
    ``symbols`` it is written in, in the exercise's order, so that the reference can be
    written in the same ones.
    """
    name = _name_of(answer, name)
    _, exercise = find_exercise(name)
    lent = _is_lent(answer)
    if not lent:
        _refuse_borrowed(answer)
    yours = (
        getattr(answer, MARK, "reference") == "yours"
        if lent
        else judge_here(exercise, answer).passed
    )
    print(
        f"{name}: {'yours' if yours else 'the reference for now, until yours passes its check'}"
    )
    if lent or (yours and exercise.kind == "expression"):
        return answer
    if exercise.kind == "expression":
        if len(symbols) != len(exercise.arguments):
            wanted = ", ".join(a.name for a in exercise.arguments)
            raise ValueError(
                f"symbols: expected those for {wanted}, in this order; got {len(symbols)} of them"
            )
        # A copy: SymPy caches what it built, and a student's equal expression would be
        # the very same object.
        _lent.append(copy.copy(exercise.reference(*symbols)))
        return _lent[-1]
    chosen = answer if yours else exercise.reference

    @functools.wraps(chosen)
    def used(*args: Any, **kwargs: Any) -> Any:
        return chosen(*args, **kwargs)

    setattr(used, MARK, "yours" if yours else "reference")
    used.__name__ = name
    return used


def predict(name: str, answer: Any = None) -> None:
    """Commit to an answer, then see the outcome. Nothing is shown before an answer is
    given.

    Where the lesson answers a question only later, the answer is recorded, and
    ``predict(name)`` shows the outcome there. An answer that is neither a number nor a
    choice is rejected with what is expected. Raises ``ValueError`` for an unknown name.
    """
    _, prediction = find_prediction(name)
    if answer is Ellipsis or (answer is None and recording.predicted(name) is None):
        choices = tuple(Part(key, text) for key, text in prediction.choices.items())
        way = f"put {_wanted(prediction)} where the ... stands, then run the cell again"
        first = f"commit first: predict({name!r}, ...) with {_wanted(prediction)}"
        ask = Part("answer", way if answer is Ellipsis else first)
        display_message(
            Message(
                "not attempted",
                f"Your prediction: {prediction.question}",
                (*choices, ask),
            )
        )
        return
    try:
        given = (
            recording.predicted(name) if answer is None else _given(prediction, answer)
        )
    except ValueError as error:
        display_message(Message("not attempted", f"Not an answer yet: {error}", ()))
        return
    if answer is not None:
        recording.record("predict", name, answer=given)
        if prediction.later:
            said = _said(prediction, given) + _unit(prediction)
            noted = Part("answer", f"in the section {prediction.later}")
            display_message(
                Message("not attempted", f"Noted: you said {said}", (noted,))
            )
            return
    display_message(_outcome_message(prediction, given))


def _outcome_message(prediction: Prediction, given: Any) -> Message:
    """How a prediction turned out."""
    outcome, unit = prediction.outcome(), _unit(prediction)
    right = _close(prediction, given, outcome)
    parts = [
        Part("you said", _said(prediction, given) + unit),
        Part("it is", _said(prediction, outcome) + unit),
    ]
    if not right:
        tempting = next(
            (
                text
                for key, text in prediction.wrong.items()
                if _close(prediction, given, key)
            ),
            "",
        )
        parts += [Part("tempting", tempting)] if tempting else []
    parts.append(Part("why", prediction.explanation))
    headline = "As you predicted" if right else "Not what you predicted"
    return Message("passed" if right else "wrong", headline, tuple(parts))


def _unit(prediction: Prediction) -> str:
    return f" {prediction.unit}" if prediction.unit else ""


def _wanted(prediction: Prediction) -> str:
    if prediction.choices:
        return " or ".join(f'"{key}"' for key in prediction.choices)
    return f"a number in {prediction.unit}" if prediction.unit else "a number"


def _given(prediction: Prediction, answer: Any) -> Any:
    if prediction.choices:
        if not isinstance(answer, str) or answer not in prediction.choices:
            raise ValueError(f"expected {_wanted(prediction)}; got {written(answer)}")
        return answer
    try:
        number = float(answer)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(
            f"expected {_wanted(prediction)}; got {written(answer)}"
        ) from None
    if np.isnan(number):  # infinity is an answer: never, forever
        raise ValueError(f"expected {_wanted(prediction)}; got {written(answer)}")
    return number


def _close(prediction: Prediction, given: Any, outcome: Any) -> bool:
    if prediction.choices:
        return bool(given == outcome)
    return (
        abs(given - float(outcome))
        <= prediction.tolerance * abs(float(outcome)) + 1e-12
    )


def _said(prediction: Prediction, value: Any) -> str:
    if prediction.choices:
        return f"{value}: {prediction.choices[value]}"
    return (
        "0"
        if abs(float(value)) < 1e-12
        else str(show(float(value), 4 if abs(float(value)) < 1e4 else 8))
    )


def _name_of(answer: Any, name: str | None) -> str:
    if name is None:
        name = getattr(answer, "__name__", None)
    if not isinstance(name, str):
        raise ValueError(
            'name: expected the exercise\'s name for an expression, as in check(p_hat, "p_hat"); got none'
        )
    return name


def _is_lent(answer: Any) -> bool:
    return hasattr(answer, MARK) or any(answer is lent for lent in _lent)


def _refuse_borrowed(answer: Any) -> None:
    module = getattr(answer, "__module__", "") or ""
    if _is_lent(answer):
        raise ValueError(
            "answer: expected a function or an expression of your own; got what use() returned"
        )
    if module == "course" or module.startswith("course."):
        raise ValueError(
            f"answer: expected a function of your own; got one of {module}"
        )


def _source(answer: Any) -> str:
    try:
        return inspect.getsource(answer)
    except (OSError, TypeError):
        return str(answer)[:2000]
