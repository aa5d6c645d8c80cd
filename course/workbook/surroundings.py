"""What an answer takes from its notebook, earlier answers that are not right yet among it, put into its verdict."""

from __future__ import annotations

import dis
import inspect
from dataclasses import replace
from typing import Any

from course.exercises.definition import Exercise, Lesson
from course.exercises.verdict import Verdict
from course.workbook.judging import judge_here
from course.workbook.lending import is_lent


def with_surroundings(
    verdict: Verdict,
    unfinished: tuple[str, ...],
    borrowed: tuple[str, ...],
    facts: tuple[tuple[str, ...], tuple[str, ...]],
) -> Verdict:
    """A failed answer's verdict with what it takes from its notebook and what its source shows, before and after.

    Of one that borrows variables nothing is said of properties: it was not the answer's own number. Of one that calls
    an answer that is not right yet, nothing is said of what came: it may be the other's.
    """
    before, after = facts
    came = () if unfinished else verdict.reason
    reason = (*unfinished, *before, *came, *after)
    own = not borrowed or verdict.mistake is not None
    return replace(verdict, reason=reason, violated=verdict.violated if own else ())


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
