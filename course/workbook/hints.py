"""Hints in three tiers, then the reference."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from course.exercises.definition import Exercise, find_exercise
from course.exercises.formula_source import expression, source_of
from course.exercises.message import Message, Part
from course.workbook import recording
from course.workbook.notebook import display_message
from course.workbook.repairing import change_parts

TIERS = ("where to look", "the formula in words", "the line with a hole in it")


def hint(name_or_function: str | Callable[..., Any]) -> None:
    """Show the next hint: where to look, the formula in words, a line with a hole, the
    code.

    Each call goes one tier further and shows the earlier tiers again (the first call
    after a restart only shows what was seen before); opening the reference is recorded.
    Raises ``ValueError`` for an unknown name.
    """
    name = (
        name_or_function
        if isinstance(name_or_function, str)
        else getattr(name_or_function, "__name__", None)
    )
    if not isinstance(name, str):
        words = 'expected an exercise\'s name or function, as in hint("p_hat")'
        raise ValueError(f"name: {words}; got {name_or_function!r}")
    _, exercise = find_exercise(name)
    taken = recording.state().hints.get(name, 0)
    # In a new kernel the first call only repeats what was seen before: running a whole
    # notebook opens nothing new.
    tier = (
        taken
        if taken and not recording.hinted_in_this_session(name)
        else min(taken + 1, 4)
    )
    recording.record("hint", name, tier=tier)
    shown = range(1, min(tier, 3) + 1)
    parts = [
        Part(TIERS[t - 1], exercise.hints[t - 1], "code" if t == 3 else "prose")
        for t in shown
    ]
    parts += change_parts(name)
    if tier <= 3:
        more = TIERS[tier] if tier < 3 else "the reference itself"
        parts.append(Part("next", f"hint({name!r}) once more for {more}"))
        display_message(
            Message("not attempted", f"Hint {tier} of 3: {name}", tuple(parts))
        )
        return
    parts.append(Part("the reference", answer_source(exercise), "code"))
    display_message(Message("not attempted", f"The reference: {name}", tuple(parts)))


def answer_source(exercise: Exercise) -> str:
    """The formula as a student would write it, with its equation and source above the
    lines.
    """
    if exercise.kind == "expression":
        return f"{exercise.name} = {expression(exercise.reference)}"
    return source_of(exercise.reference).rstrip()
