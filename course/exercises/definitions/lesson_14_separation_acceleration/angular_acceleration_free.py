"""The exercise ``angular_acceleration_free``: inputs, comparison, planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_14_separation_acceleration.shared import (
    ZERO,
    apply,
    draw,
)
from course.exercises.slips import slip


def _turning_bodies(rng: np.random.Generator) -> Sequence[Case]:
    def turning(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        axes = np.linalg.qr(rng.normal(size=(*shape, 3, 3)))[0]
        # The largest stays below the sum of the others, as for any real body: I_x + I_y
        # - I_z = 2 sum m z^2.
        moments = np.round(
            rng.uniform([1.0, 1.6, 2.1], [1.4, 2.0, 2.5], (*shape, 3)), 2
        )
        inverse = np.round(
            (axes / moments[..., None, :]) @ np.swapaxes(axes, -1, -2), 3
        )
        inverse = 0.5 * (inverse + np.swapaxes(inverse, -1, -2))
        momentum = draw(rng, shape)
        return {"inverse_inertia": inverse, "angular_momentum": momentum,
                "angular_velocity": apply(inverse, momentum), "torque": draw(rng, shape)}  # fmt: skip

    plain = {
        "inverse_inertia": np.diag([0.5, 0.25, 0.2]), "angular_momentum": np.array([2.0, 4.0, 5.0]),
        "angular_velocity": np.array([1.0, 1.0, 1.0]), "torque": np.array([0.0, 3.0, 0.0]),
    }  # fmt: skip
    ball = {**turning(), "inverse_inertia": 0.5 * np.eye(3)}
    return [
        Case("moments 2, 4 and 5, axes along x, y and z", plain),
        Case("axes turned", turning()),
        Case("axes turned again", turning()),
        Case("no torque", {**turning(), "torque": ZERO}, "edge"),
        Case(
            "a ball: L along omega",
            {**ball, "angular_velocity": 0.5 * ball["angular_momentum"]},
            "edge",
        ),
        Case(
            "three bodies, as many as a vector has components", turning((3,)), "batch"
        ),
        Case("a 2 by 4 batch", turning((2, 4)), "batch"),
    ]


ANGULAR_ACCELERATION_FREE = Exercise(
    name="angular_acceleration_free",
    rows=(23,),
    points=2,
    minutes=7,
    level="stretch",  # lesson 09 asks for the same in other words
    task="Return omega_dot without contact forces, I^-1 (tau + L x omega), for one body and for a batch.",
    arguments=(
        Value("inverse_inertia", "(..., 3, 3)", "1/(kg m²)", "I^-1 in world axes"),
        Value(
            "angular_momentum",
            "(..., 3)",
            "kg m²/s",
            "L about the centre of mass, world axes",
        ),
        Value("angular_velocity", "(..., 3)", "rad/s", "omega = I^-1 L"),
        Value("torque", "(..., 3)", "N m", "external torque about the centre of mass"),
    ),
    results=(Value("omega_dot", "(..., 3)", "rad/s²", "angular acceleration"),),
    reference=formulas.angular_acceleration_free,
    cases=_turning_bodies,
    mistakes=(
        Mistake(
            "L x omega forgotten",
            slip(formulas.angular_acceleration_free, "torque + gyroscopic", "torque"),
            "L x omega is missing. Without a torque L stays, but the body turns under it, so its inertia in world axes "
            "changes and omega with it.",
        ),
        Mistake(
            "omega x L",
            slip(
                formulas.angular_acceleration_free,
                "angular_momentum, angular_velocity",
                "angular_velocity, angular_momentum",
            ),
            "The cross product is the wrong way round: it is L x omega, as it comes to the side of the torque "
            "with a minus.",
        ),
        Mistake(
            "as printed",
            slip(
                formulas.angular_acceleration_free,
                "torque + gyroscopic",
                "torque + angular_momentum",
            ),
            "You have I^-1 L where I^-1 (L x omega) belongs. I^-1 L is omega itself, in rad/s, not an acceleration.",
        ),
        Mistake(
            "not through the inverse inertia",
            slip(
                formulas.angular_acceleration_free,
                "torque + gyroscopic)",
                "torque) + gyroscopic",
            ),
            "L x omega is a torque like tau, in N m: it must go through I^-1 as well.",
        ),
        Mistake(
            "torque forgotten",
            slip(
                formulas.angular_acceleration_free, "torque + gyroscopic", "gyroscopic"
            ),
            "The external torque is missing: it acts without any contact, so it belongs to b.",
        ),
        Mistake(
            "inertia for its inverse",
            slip(
                formulas.angular_acceleration_free,
                'np.einsum("...ij,...j->...i", inverse_inertia, torque + gyroscopic)',
                "np.linalg.solve(inverse_inertia, (torque + gyroscopic)[..., None])[..., 0]",
            ),
            "You divide by I^-1, which multiplies by I. What is given is the inverse already: multiply by it.",
        ),
        Mistake(
            "matrix product with @",
            slip(
                formulas.angular_acceleration_free,
                'np.einsum("...ij,...j->...i", inverse_inertia, torque + gyroscopic)',
                "inverse_inertia @ (torque + gyroscopic)",
            ),
            "Right for one body. In a batch, @ takes the last two axes of both sides for matrices, and your vectors "
            'have one: np.einsum("...ij,...j->...i", matrix, vector) does it for any batch.',
        ),
        Mistake(
            "product with *",
            slip(
                formulas.angular_acceleration_free,
                'np.einsum("...ij,...j->...i", inverse_inertia, torque + gyroscopic)',
                "inverse_inertia * (torque + gyroscopic)",
            ),
            "With * each entry of the matrix is multiplied by itself alone, and a matrix comes out. Matrix times "
            'vector also adds up: np.einsum("...ij,...j->...i", matrix, vector).',
        ),
        Mistake(
            "diagonal alone",
            slip(
                formulas.angular_acceleration_free,
                'np.einsum("...ij,...j->...i", inverse_inertia, torque + gyroscopic)',
                'np.einsum("...ii->...i", inverse_inertia) * (torque + gyroscopic)',
            ),
            "You use the diagonal of I^-1 alone. In general that is right only while the body's axes lie along "
            "those of the world: multiply by the whole matrix.",
        ),
    ),
    hints=(
        "See Derive, step 3. The torque and L x omega are added first and go through I^-1 together.",
        "Add tau and L x omega, then multiply the matrix I^-1 by the sum. For a batch np.einsum names the axes: "
        '"...ij,...j->...i" is matrix times vector.',
        'gyroscopic = np.cross(____, ____)\nreturn np.einsum("...ij,...j->...i", ____, torque + gyroscopic)',
    ),
)
