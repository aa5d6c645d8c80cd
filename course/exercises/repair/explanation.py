"""A repair in words: kind and line of what makes an answer right."""

from __future__ import annotations

from course.exercises.message import Part
from course.exercises.repair.search import Repair
from course.exercises.repair.wording import in_words

ORDINALS = ("first", "second")


def repair_parts(repair: Repair) -> tuple[Part, ...]:
    """Kind and line of each step, other lines where it would do as well, and what was tried.

    The change itself is left to ``hint``.
    """
    parts: list[Part] = []
    alone = len(repair.steps) == 1
    for which, step in zip(ORDINALS, repair.steps, strict=False):
        label = "look at" if alone else which
        where = "in the lines" if "\n" in step.line else "in the line"
        parts.append(Part(label, in_words(step.kind)))
        parts.append(Part(where, step.line, "code"))
    parts += [Part("or in", line, "code") for line in repair.elsewhere]
    both = "With this one change" if alone else "With these two changes"
    tried = f"{both} it passes every case, and two other sets of drawn cases."
    parts.append(Part("tried", tried))
    if repair.halved:
        half = "half its time: memory cannot be limited on this system, only watched"
        parts.append(Part("note", f"The search had {half}."))
    return tuple(parts)


def cause_in_a_line(repair: Repair) -> str:
    """The kinds of a repair's steps, as a table of marks has them and the grader's page counts them."""
    few = (
        "one change makes it right"
        if len(repair.steps) == 1
        else "two changes make it right"
    )
    return f"{few}: {', then '.join(step.kind for step in repair.steps)}"
