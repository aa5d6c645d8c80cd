"""Hints in three tiers, then the reference."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Callable
from typing import Any

from course.exercises.definition import find_exercise
from course.exercises.message import Message, Part
from course.workbook import progress
from course.workbook.notebook import display_message

TIERS = ("where to look", "the formula in words", "the line with a hole in it")


def hint(name_or_function: str | Callable[..., Any]) -> None:
    """Show the next hint for an exercise: where to look, the formula in words, a line with a hole, the reference.

    Each call goes one tier further and shows the tiers before it again; opening the reference is recorded.
    Raises ``ValueError`` for an unknown name.
    """
    name = name_or_function if isinstance(name_or_function, str) else getattr(name_or_function, "__name__", None)
    if not isinstance(name, str):
        words = 'expected an exercise\'s name or function, as in hint("p_hat")'
        raise ValueError(f"name: {words}; got {name_or_function!r}")
    _, exercise = find_exercise(name)
    tier = min(progress.state().hints.get(name, 0) + 1, 4)
    progress.record("hint", name, tier=tier)
    if tier <= 3:
        parts = [Part(TIERS[i], exercise.hints[i], "code" if i == 2 else "text") for i in range(tier)]
        more = Part("next", f"hint({name!r}) once more for {TIERS[tier] if tier < 3 else 'the reference itself'}")
        display_message(Message("not attempted", f"Hint {tier} of 3: {name}", (*parts, more)))
        return
    source = textwrap.dedent(inspect.getsource(exercise.reference))
    display_message(Message("not attempted", f"The reference: {name}", (Part("code", source, "code"),)))
