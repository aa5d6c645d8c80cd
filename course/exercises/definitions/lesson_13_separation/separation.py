"""The exercise ``separation``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_13_separation.shared import (
    NORMAL,
    POINT_A,
    POINT_B,
    UP,
    draw,
)
from course.exercises.definitions.vectors import unit_vector
from course.exercises.slips import slip


def _gaps(rng: np.random.Generator) -> Sequence[Case]:
    def pair(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        return {
            "p_a": draw(rng, shape),
            "p_b": draw(rng, shape),
            "n": unit_vector(rng, shape),
        }

    n = unit_vector(rng)
    p = draw(rng)
    across = np.round(np.cross(n, unit_vector(rng)), 2)
    return [
        Case(
            "a lamp over a table",
            {
                "p_a": np.array([0.2, 0.0, 1.0]),
                "p_b": np.array([0.0, 0.5, 0.7]),
                "n": UP,
            },
        ),
        Case("off the axes", pair()),
        Case(
            "penetrating",
            {"p_a": p - 0.2 * n + across - (across @ n) * n, "p_b": p, "n": n},
        ),
        Case("touching", {"p_a": p, "p_b": p, "n": n}, "edge"),
        Case("three pairs, as many as a vector has components", pair((3,)), "batch"),
        Case("a 2 by 4 batch", pair((2, 4)), "batch"),
        Case(
            "many points over one plane",
            {"p_a": draw(rng, (5,)), "p_b": draw(rng), "n": unit_vector(rng)},
            "batch",
        ),
    ]


SEPARATION = Exercise(
    name="separation",
    rows=(19,),
    points=1,
    minutes=3,
    task="Return d = (p_A - p_B).N, for one pair of points and for a batch.",
    arguments=(POINT_A, POINT_B, NORMAL),
    results=(
        Value("d", "(...)", "m", "above 0 apart, 0 touching, below 0 penetrating"),
    ),
    reference=formulas.separation,
    cases=_gaps,
    mistakes=(
        Mistake(
            "turned round",
            slip(formulas.separation, "np.sum", "-np.sum"),
            "The sign is reversed. N points out of B toward A, so p_A - p_B lies along +N while they are apart.",
        ),
        Mistake(
            "distance",
            slip(
                formulas.separation,
                "np.sum((p_a - p_b) * n, axis=-1)",
                "np.linalg.norm(p_a - p_b, axis=-1)",
            ),
            "You return the distance of the two points. What lies across N does not count, and a distance can never "
            "say that the bodies penetrate: project on N.",
        ),
        Mistake(
            "size",
            slip(
                formulas.separation,
                "np.sum((p_a - p_b) * n, axis=-1)",
                "np.abs(np.sum((p_a - p_b) * n, axis=-1))",
            ),
            "The size is right and the sign is lost, and with it the difference between a gap and a penetration.",
        ),
        Mistake(
            "no sum",
            slip(
                formulas.separation,
                "np.sum((p_a - p_b) * n, axis=-1)",
                "(p_a - p_b) * n",
            ),
            "You multiply component by component and stop there. A dot product adds the three products up: "
            "np.sum(..., axis=-1).",
        ),
        Mistake(
            "sum over everything",
            slip(formulas.separation, ", axis=-1", ""),
            "Right for one pair. For a batch you add all pairs up into one number: sum over the last axis only.",
        ),
        Mistake(
            "a vector",
            slip(
                formulas.separation,
                "np.sum((p_a - p_b) * n, axis=-1)",
                "np.sum((p_a - p_b) * n, axis=-1)[..., None] * n",
            ),
            "You return the vector d N. What is asked for is the number d, one for each pair.",
        ),
        Mistake(
            "only A",
            slip(formulas.separation, "(p_a - p_b)", "p_a"),
            "p_B is missing: this is how far p_A is from the origin along N, not from B.",
        ),
        Mistake(
            "projected on B",
            slip(formulas.separation, "* n", "* p_b"),
            "You project on p_B, which is a place. The direction to project on is N.",
        ),
    ),
    hints=(
        "The formula stands under On the slide: a difference of two points, and a dot product.",
        "Subtract p_B from p_A, multiply by N component by component, and add up over the last axis.",
        "return np.sum((____ - ____) * n, axis=____)",
    ),
)
