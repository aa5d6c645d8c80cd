"""The exercise ``meeting_time``, the last step of the derivation: inputs and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

_FORMULA = "(-b - sp.sqrt(b**2 - a * c)) / a"


def _points(rng: np.random.Generator) -> Sequence[Case]:
    """Spheres that meet ahead: a two roots above 0, and a speed that is not 1."""
    first = rng.uniform(0.2, 2.0, 8)
    second = first + rng.uniform(0.3, 2.0, 8)
    a = rng.uniform(1.5, 6.0, 8)
    drawn = {"a": a, "b": -0.5 * a * (first + second), "c": a * first * second}
    return [
        Case("the numbers worked by hand", {"a": 4.0, "b": -8.0, "c": 14.56}),
        Case("eight drawn points", drawn, "batch"),
    ]


MEETING_TIME = Exercise(
    name="meeting_time",
    kind="expression",
    rows=(12,),
    points=2,
    minutes=4,
    task="Give the time at which two spheres first touch, in a = v.v, b = m.v and c = m.m - r^2.",
    arguments=(
        Value("a", "scalar", "m²/s²", "v.v, the speed squared"),
        Value("b", "scalar", "m²/s", "m.v, below 0 where they approach at the start"),
        Value("c", "scalar", "m²", "m.m - r^2, above 0 where they are apart"),
    ),
    results=(
        Value("meeting_time", "(...)", "s", "the first time at which they touch"),
    ),
    reference=formulas.meeting_time,
    cases=_points,
    mistakes=(
        Mistake(
            "the later root",
            slip(formulas.meeting_time, "-b - sp.sqrt", "-b + sp.sqrt"),
            "That is the later root: the moment at which they part again, on the far side. They first touch at the "
            "smaller one.",
        ),
        Mistake(
            "school formula halved",
            slip(
                formulas.meeting_time,
                _FORMULA,
                "(-b - sp.sqrt(b**2 - 4 * a * c)) / (2 * a)",
            ),
            "That solves a t^2 + b t + c = 0. Here the middle term is 2 b t: put 2 b in place of b and the factors "
            "2 and 4 go away.",
        ),
        Mistake(
            "sign of b",
            slip(formulas.meeting_time, "-b - sp.sqrt", "b - sp.sqrt"),
            "The sign of b is lost: for spheres that approach, b is below 0, and your time comes out below 0.",
        ),
        Mistake(
            "sign of b in front, the later root behind",
            slip(formulas.meeting_time, "-b - sp.sqrt", "b + sp.sqrt"),
            "Both signs in front are turned: that is minus the first root.",
        ),
        Mistake(
            "plus under the root",
            slip(formulas.meeting_time, "b**2 - a * c", "b**2 + a * c"),
            "Under the root the product a c is taken off, not added.",
        ),
        Mistake(
            "not divided",
            slip(formulas.meeting_time, _FORMULA, "-b - sp.sqrt(b**2 - a * c)"),
            "The division by a is missing: that is right for a speed of 1 m/s only.",
        ),
        Mistake(
            "divided by 2 a",
            slip(formulas.meeting_time, ") / a", ") / (2 * a)"),
            "Half of it: the 2 of the school formula belongs to a middle term b t. Here it is 2 b t.",
        ),
        Mistake(
            "divided by the speed",
            slip(formulas.meeting_time, ") / a", ") / sp.sqrt(a)"),
            "You divide by the root of a. Check the units: b has m^2/s, and a has m^2/s^2.",
        ),
        Mistake(
            "nearest approach",
            slip(formulas.meeting_time, _FORMULA, "-b / a"),
            "-b/a is the time at which the centres are nearest to each other. They touch before that.",
        ),
    ),  # fmt: skip
    hints=(
        "a t^2 + 2 b t + c = 0 is a quadratic equation. Which of its two roots comes first?",
        "Complete the square: (a t + b)^2 = b^2 - a c. Take the root, with the sign that gives the smaller t, and "
        "solve for t.",
        "meeting_time = (-b - sp.sqrt(____)) / ____",
    ),
)
