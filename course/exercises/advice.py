"""Slips that need no planting: how an answer fails shows them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course.exercises.answer import Outcome
from course.exercises.comparison import Difference
from course.exercises.definition import Case, Exercise


def general_advice(
    exercise: Exercise,
    cases: Sequence[Case],
    outcomes: Sequence[Outcome],
    wrongs: Sequence[Difference | None],
) -> tuple[str, ...]:
    """Slips that need no planting: only in batches, constant, only at edges."""
    wrong_kinds = {c.kind for c, w in zip(cases, wrongs, strict=True) if w is not None}
    advice = []
    if (
        all(o.kind == "value" for o in outcomes)
        and len(outcomes) > 1
        and _constant(outcomes)
    ):
        return ("It gives the same for every input: does it use its arguments?",)
    if any(
        _says(
            o,
            "float' object is not subscriptable",
            "int' object is not subscriptable",
            "invalid index to scalar",
        )
        for o in outcomes
    ):
        advice.append(
            "A plain number has no axes to index: np.asarray(s)[..., None] serves numbers and arrays alike."
        )
    elif any(
        _says(
            o,
            "operand type(s) for &",
            "operand type(s) for |",
            "'bitwise_and' not supported",
            "'bitwise_or' not supported",
        )
        for o in outcomes
    ):
        advice.append(
            "& and | were given numbers, not conditions. They bind more tightly than <, so each comparison needs "
            "brackets: (a < 0) & (b < 0)."
        )
    elif any(map(asks_a_batch_one_question, outcomes)):
        advice.append(
            "`if`, `and`, `or`, `not`, a < b < c, min() and max() ask one question, a batch has many answers: "
            "np.where(condition, this, that), &, |, ~, np.minimum and np.maximum answer each element for itself."
        )
    elif any(
        "'...' ellipsis" in o.text for o in outcomes
    ):  # einsum, of letters fewer than axes
        advice.append(
            'In np.einsum put ... before the letters, for the axes of the batch: "...ij,...j->...i" is matrix times '
            "vector for one and for many."
        )
    elif wrong_kinds == {"batch"} and exercise.kind == "function":
        advice.append(
            "Right for one, wrong for many at once. A batch has its axes in front of the one's own: look for a line "
            "that takes them for the vector's, or mixes the members."
        )
    elif wrong_kinds == {"edge"}:
        advice.append(
            "Right in the ordinary cases, wrong at an edge: read what the task says of this case."
        )
    if any(v.dtype in (np.float16, np.float32) for o in outcomes for v in o.values):
        advice.append(
            "Your numbers are of single or half precision, right to 7 or 3 digits: leave them as float64."
        )
    return tuple(advice)


def asks_a_batch_one_question(outcome: Outcome) -> bool:
    """Whether an answer stopped at an ``if``, ``and`` or ``min`` on a batch."""
    return "truth value of an array" in outcome.text


def _says(outcome: Outcome, *words: str) -> bool:
    """Whether the answer raised an error with one of these words in it."""
    return outcome.kind == "raised" and any(w in outcome.text for w in words)


def _constant(outcomes: Sequence[Outcome]) -> bool:
    values = [o.values[0] for o in outcomes]
    return (
        all(v.size > 0 for v in values)
        and len({v.dtype.kind for v in values}) == 1
        and all(bool((v == values[0].flat[0]).all()) for v in values)
    )
