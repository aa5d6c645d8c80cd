"""The exercise ``momentum_after``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_10_impulse.shared import NORMAL
from course.exercises.definitions.vectors import unit_vector
from course.exercises.slips import slip

MOMENTUM_AFTER = Exercise(
    name="momentum_after",
    rows=(15, 16),
    points=1,
    minutes=7,
    task="Return p1' = p1 + p_hat n and p2' = p2 - p_hat n, for one pair and for a batch.",
    arguments=(
        Value("momentum_1", "(..., 3)", "kg m/s", "p1 before"),
        Value("momentum_2", "(..., 3)", "kg m/s", "p2 before"),
        Value("impulse", "(...)", "N s", "p_hat"),
        NORMAL,
    ),
    results=(
        Value("momentum_1", "(..., 3)", "kg m/s"),
        Value("momentum_2", "(..., 3)", "kg m/s"),
    ),
    reference=formulas.momentum_after,
    cases=lambda rng: [
        Case(
            "one pair along x",
            dict(
                momentum_1=np.array([-6.0, 0.0, 0.0]),
                momentum_2=np.array([1.0, 0.0, 0.0]),
                impulse=4.0,
                normal=np.array([1.0, 0.0, 0.0]),
            ),
        ),
        Case("off the axes", _momenta(rng, ())),
        Case("no impulse", {**_momenta(rng, ()), "impulse": 0.0}, "edge"),
        Case(
            "three pairs, as many as a vector has components",
            _momenta(rng, (3,)),
            "batch",
        ),
        Case("five pairs", _momenta(rng, (5,)), "batch"),
        Case("a 2 by 4 batch", _momenta(rng, (2, 4)), "batch"),
    ],  # fmt: skip
    properties=(
        Property(
            "momentum",
            lambda given, answer: (
                answer[0] + answer[1] - given["momentum_1"] - given["momentum_2"]
            ),
            "The sum of the momenta changes: what one body gains the other must lose.",
        ),
    ),
    mistakes=(
        Mistake(
            "both plus",
            slip(formulas.momentum_after, "momentum_2 - change", "momentum_2 + change"),
            "Both bodies gain. What pushes body 1 along +n pushes body 2 along -n: p2' = p2 - p_hat n.",
        ),
        Mistake(
            "swapped",
            slip(
                formulas.momentum_after,
                "momentum_1 + change, momentum_2 - change",
                "momentum_1 - change, momentum_2 + change",
            ),
            "The signs are swapped: you push the bodies into each other. n points out of body 2 toward body 1, so "
            "body 1 gets +p_hat n.",
        ),
        Mistake(
            "the pair turned round",
            slip(
                formulas.momentum_after,
                "momentum_1 + change, momentum_2 - change",
                "momentum_2 - change, momentum_1 + change",
            ),
            "Both momenta are right, but in the wrong order: return that of body 1 first.",
        ),
        Mistake(
            "no direction",
            slip(formulas.momentum_after, " * normal", ""),
            "You add the number p_hat to every component. It acts along n: add p_hat n.",
        ),
        Mistake(
            "one batch axis short",
            slip(formulas.momentum_after, "np.asarray(impulse)[..., None]", "impulse"),
            "Right for one pair, not for a batch: impulse has shape (...) and normal (..., 3), so impulse needs one "
            "more axis, impulse[..., None] * normal. (np.asarray(impulse)[..., None] serves plain numbers too.)",
        ),
    ),  # fmt: skip
    hints=(
        "Look at the two formulas for momentum under On the slide: each changes by the same vector, with opposite "
        "signs.",
        "The vector is the number p_hat times the unit vector n. In a batch the number needs one more axis before it "
        "multiplies: np.asarray(impulse)[..., None].",
        "change = np.asarray(impulse)[..., None] * ____\nreturn momentum_1 + change, momentum_2 ____ change",
    ),
)


def _momenta(rng: np.random.Generator, shape: tuple[int, ...]) -> dict[str, Any]:
    number = (
        rng.uniform(0.5, 4.0, shape).round(3)
        if shape
        else round(rng.uniform(0.5, 4.0), 3)
    )
    return {
        "momentum_1": rng.normal(size=(*shape, 3)).round(3),
        "momentum_2": rng.normal(size=(*shape, 3)).round(3),
        "impulse": number if shape else float(number),
        "normal": unit_vector(rng, shape),
    }
