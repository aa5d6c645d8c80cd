"""What an answer takes from its notebook: variables, and earlier answers that are not right yet."""

from __future__ import annotations

import dis
import inspect
from dataclasses import replace
from typing import Any

import numpy as np

from course.exercises.definition import Exercise, Lesson
from course.exercises.verdict import Verdict
from course.workbook.judging import judge_here
from course.workbook.lending import is_lent


def with_surroundings(
    verdict: Verdict, unfinished: tuple[str, ...], borrowed: tuple[str, ...]
) -> Verdict:
    """A failed answer's verdict with what it takes from its notebook said first.

    Of one that borrows variables nothing is said of properties: it was not the answer's own number.
    """
    reason = (*unfinished, *verdict.reason)
    if not borrowed or verdict.mistake is not None:
        return replace(verdict, reason=reason)
    kind = (
        "variables of the notebook"
        if len(borrowed) > 1
        else "a variable of the notebook"
    )
    words = f"It takes {', '.join(borrowed)}, {kind} and no argument: another cell can change what it gives."
    return replace(verdict, reason=(words, *reason), violated=())


def unfinished_before(
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
        if not is_lent(function) and not judge_here(e, function).passed
    )


def borrowed_variables(answer: Any) -> tuple[str, ...]:
    """The notebook's variables (numbers, arrays, symbols; no functions, classes, modules) that a function reads."""
    if not inspect.isfunction(answer):
        return ()
    codes, names = [answer.__code__], dict[str, None]()
    while codes:
        code = codes.pop()
        codes += [c for c in code.co_consts if inspect.iscode(c)]
        steps = dis.get_instructions(code)
        names.update((s.argval, None) for s in steps if s.opname == "LOAD_GLOBAL")
    values = {n: answer.__globals__[n] for n in names if n in answer.__globals__}
    return tuple(n for n, v in values.items() if _is_data(v))


def _is_data(value: Any) -> bool:
    """Whether it is a value and no constant that is imported: SymPy's symbols are callable too."""
    if inspect.ismodule(value) or inspect.isclass(value) or value is None:
        return False
    if isinstance(value, float) and value in (np.pi, 2 * np.pi, np.inf):
        return False
    return not callable(value) or hasattr(value, "free_symbols")
