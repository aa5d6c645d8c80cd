"""The exercise ``point_velocity``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_12_impulse_and_spin.shared import (
    drawn_vector,
)
from course.exercises.slips import slip


def _points(rng: np.random.Generator) -> Sequence[Case]:
    def drawn(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        return {
            "velocity": drawn_vector(rng, shape),
            "angular_velocity": drawn_vector(rng, shape, 2.0),
            "arm": drawn_vector(rng, shape),
        }

    wheel = {
        "velocity": [2.0, 0.0, 0.0],
        "angular_velocity": [0.0, 2.0, 0.0],
        "arm": [0.0, 0.0, 1.0],
    }
    along = {**drawn(), "arm": np.zeros(3)}
    return [
        Case(
            "the top of a rolling wheel",
            {name: np.array(value) for name, value in wheel.items()},
        ),
        Case("in all directions", drawn()),
        Case("in all directions again", drawn()),
        Case("the centre of mass itself", along, "edge"),
        Case(
            "a body that does not turn",
            {**drawn(), "angular_velocity": np.zeros(3)},
            "edge",
        ),
        Case("three points, as many as a vector has components", drawn((3,)), "batch"),
        Case("five points", drawn((5,)), "batch"),
        Case(
            "many points of one body",
            {**drawn(), "arm": drawn_vector(rng, (4,))},
            "batch",
        ),
    ]


POINT_VELOCITY = Exercise(
    name="point_velocity",
    rows=(22,),
    points=1,
    minutes=3,
    task="Return the velocity of the point at the end of the arm: v + omega x r.",
    arguments=(
        Value("velocity", "(..., 3)", "m/s", "v of the centre of mass"),
        Value("angular_velocity", "(..., 3)", "rad/s", "omega"),
        Value("arm", "(..., 3)", "m", "r, from the centre of mass to the point"),
    ),
    results=(Value("velocity", "(..., 3)", "m/s", "of the point"),),
    reference=formulas.point_velocity,
    cases=_points,
    mistakes=(
        Mistake(
            "r x omega",
            slip(
                formulas.point_velocity,
                "angular_velocity, arm",
                "arm, angular_velocity",
            ),
            "You took r x omega. The cross product changes its sign with the order: it is omega x r. Try the wheel: "
            "rolling to +x, it turns about +y, and its top runs ahead.",
        ),
        Mistake(
            "minus",
            slip(formulas.point_velocity, "return velocity", "return -velocity"),
            "The velocity of the centre has the wrong sign: the point moves with the centre *and* round it.",
        ),
        Mistake(
            "only turning",
            slip(formulas.point_velocity, "velocity + ", ""),
            "This is the motion round the centre only. Add the velocity of the centre.",
        ),
        Mistake(
            "only moving",
            slip(formulas.point_velocity, " + np.cross(angular_velocity, arm)", ""),
            "This is the velocity of the centre. A point away from it also moves round it.",
        ),
        Mistake(
            "entry by entry",
            slip(
                formulas.point_velocity,
                "np.cross(angular_velocity, arm)",
                "angular_velocity * arm",
            ),
            "`*` multiplies entry by entry. The cross product is np.cross(a, b); it takes batches as they are.",
        ),
        Mistake(
            "v x r",
            slip(
                formulas.point_velocity,
                "np.cross(angular_velocity, arm)",
                "np.cross(velocity, arm)",
            ),
            "You crossed the velocity with the arm. What turns the arm is the angular velocity.",
        ),
        Mistake(
            "dot product",
            slip(
                formulas.point_velocity,
                "np.cross(angular_velocity, arm)",
                "np.sum(angular_velocity * arm, axis=-1, keepdims=True)",
            ),
            "You took the dot product of omega and r. A point moves *across* its arm: take the cross product.",
        ),
        Mistake(
            "a sign inside the cross product",
            slip(
                formulas.point_velocity,
                "np.cross(angular_velocity, arm)",
                "[1, -1, 1] * np.cross(angular_velocity, arm)",
            ),
            "One entry of your cross product has the wrong sign, the middle one: it is a_z b_x - a_x b_z. "
            "np.cross does it for you.",
        ),
    ),
    hints=(
        "It stands under On the slide.",
        "The point moves with the centre, and round it: add the cross product of the angular velocity and the arm, in "
        "this order. np.cross works on the last axis.",
        "return velocity + np.cross(____, ____)",
    ),
)
