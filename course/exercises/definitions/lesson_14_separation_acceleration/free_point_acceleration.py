"""The exercise ``free_point_acceleration``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_14_separation_acceleration.shared import (
    ZERO,
    draw,
)
from course.exercises.slips import slip


def _points(rng: np.random.Generator) -> Sequence[Case]:
    def point(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        names = ("acceleration", "angular_acceleration", "angular_velocity", "arm")
        return {name: draw(rng, shape) for name in names}

    falling = {
        "acceleration": np.array([0.0, 0.0, -9.81]), "angular_acceleration": np.array([0.0, 1.0, 0.0]),
        "angular_velocity": np.array([2.0, 0.0, 0.0]), "arm": np.array([0.1, 0.5, -0.3]),
    }  # fmt: skip
    spin = draw(rng)
    return [
        Case("a corner of a falling box", falling),
        Case("off the axes", point()),
        Case("off the axes again", point()),
        Case(
            "the arm lies along omega",
            {**point(), "angular_velocity": spin, "arm": 0.5 * spin},
            "edge",
        ),
        Case(
            "nothing turns",
            {**point(), "angular_velocity": ZERO, "angular_acceleration": ZERO},
            "edge",
        ),
        Case("three points", point((3,)), "batch"),
        Case("a 2 by 4 batch", point((2, 4)), "batch"),
        Case("five points of one body", {**point(), "arm": draw(rng, (5,))}, "batch"),
    ]


FREE_POINT_ACCELERATION = Exercise(
    name="free_point_acceleration",
    rows=(23, 24),
    points=2,
    minutes=6,
    task="Return p_ddot = v_dot + omega_dot x r + omega x (omega x r), for one point and for a batch.",
    arguments=(
        Value("acceleration", "(..., 3)", "m/s²", "v_dot, of the centre of mass"),
        Value("angular_acceleration", "(..., 3)", "rad/s²", "omega_dot"),
        Value("angular_velocity", "(..., 3)", "rad/s", "omega"),
        Value("arm", "(..., 3)", "m", "r, from the centre of mass to the point"),
    ),
    results=(Value("p_ddot", "(..., 3)", "m/s²", "acceleration of the point"),),
    reference=formulas.free_point_acceleration,
    cases=_points,
    mistakes=(
        Mistake(
            "x r left out",
            slip(
                formulas.free_point_acceleration,
                "np.cross(angular_acceleration, arm)",
                "angular_acceleration",
            ),
            "omega_dot is added as it is, as in the slide's table, where I^-1 tau lacks its x r. It is in rad/s^2: "
            "crossed with the arm it becomes an acceleration.",
        ),
        Mistake(
            "no centripetal term",
            slip(formulas.free_point_acceleration, " + inward", ""),
            "The last term is missing or zero. It is omega x (omega x r); with the brackets the other way, "
            "(omega x omega) x r is always zero.",
        ),
        Mistake(
            "no omega_dot",
            slip(
                formulas.free_point_acceleration,
                "np.cross(angular_acceleration, arm) + ",
                "",
            ),
            "omega_dot x r is missing: the turning itself may speed up or change its axis.",
        ),
        Mistake(
            "outward",
            slip(formulas.free_point_acceleration, "+ inward", "- inward"),
            "The last term has the wrong sign. A point on a circle is accelerated toward the middle: "
            "omega x (omega x r) points inward by itself.",
        ),
        Mistake(
            "order of omega_dot x r",
            slip(
                formulas.free_point_acceleration,
                "angular_acceleration, arm",
                "arm, angular_acceleration",
            ),
            "omega_dot x r is the wrong way round: a cross product changes its sign with the order.",
        ),
        Mistake(
            "omega x r once",
            slip(
                formulas.free_point_acceleration,
                "np.cross(angular_velocity, np.cross(angular_velocity, arm))",
                "np.cross(angular_velocity, arm)",
            ),
            "The last term is a velocity: omega x r. Differentiated once more it is omega x (omega x r).",
        ),
        Mistake(
            "omega squared times r",
            slip(
                formulas.free_point_acceleration,
                "np.cross(angular_velocity, np.cross(angular_velocity, arm))",
                "-np.sum(angular_velocity**2, axis=-1)[..., None] * arm",
            ),
            "You have -|omega|^2 r, which is omega x (omega x r) only for an arm at right angles to omega. A point on "
            "the axis is not accelerated at all.",
        ),
        Mistake(
            "factor 2",
            slip(formulas.free_point_acceleration, "+ inward", "+ 2 * inward"),
            "The last term is taken twice. The arm is fixed to the body: differentiate omega x r, and it comes once.",
        ),
        Mistake(
            "with the velocity",
            slip(
                formulas.free_point_acceleration,
                "+ inward",
                "+ inward + np.cross(angular_velocity, arm)",
            ),
            "omega x r itself is added too. That is the velocity of the point, in m/s.",
        ),
    ),
    hints=(
        "See Derive, step 2: the velocity v + omega x r, differentiated by the product rule.",
        "Three terms: the centre's acceleration, omega_dot x r, and omega x (omega x r). np.cross inside np.cross.",
        "inward = np.cross(angular_velocity, ____)\nreturn acceleration + np.cross(____, arm) + inward",
    ),
)
