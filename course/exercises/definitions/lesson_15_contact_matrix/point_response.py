"""The exercise ``point_response``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.turning import (
    drawn_vectors,
    inverse_moments,
    rotation_matrices,
    turned_inertia,
)
from course.exercises.slips import slip

UP = np.array([0.0, 0.0, 1.0])


# point_response


def _responses(rng: np.random.Generator) -> Sequence[Case]:
    def push(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        inverse = inverse_moments(rng, shape)[..., None] * np.eye(3)
        inverse = np.round(turned_inertia(rotation_matrices(rng, shape), inverse), 3)
        return {
            "mass": np.round(rng.uniform(1.5, 5.0, shape), 1) if shape else float(np.round(rng.uniform(1.5, 5.0), 1)),
            "inverse_inertia": 0.5 * (inverse + np.swapaxes(inverse, -1, -2)),
            "arm": drawn_vectors(rng, shape), "push_arm": drawn_vectors(rng, shape), "push": drawn_vectors(rng, shape),
        }  # fmt: skip

    corner = {
        "mass": 4.0, "inverse_inertia": np.diag([2.0, 1.0, 0.8]), "arm": np.array([-0.5, -0.3, -0.7]),
        "push_arm": np.array([0.5, 0.3, -0.7]), "push": UP,
    }  # fmt: skip
    along = drawn_vectors(rng, ())
    return [
        Case("pushed up at one corner, asked at the opposite one", corner),
        Case("off the axes", push()),
        Case("off the axes again", push()),
        Case(
            "pushed toward the centre",
            {**push(), "push_arm": -0.5 * along, "push": along},
            "edge",
        ),
        Case(
            "a fixed body",
            {**push(), "mass": np.inf, "inverse_inertia": np.zeros((3, 3))},
            "edge",
        ),
        Case("three bodies, as many as a vector has components", push((3,)), "batch"),
        Case("a 2 by 4 batch", push((2, 4)), "batch"),
        Case(
            "four points of one body",
            {**push(), "arm": drawn_vectors(rng, (4,))},
            "batch",
        ),
    ]


POINT_RESPONSE = Exercise(
    name="point_response",
    rows=(22, 24),
    points=2,
    minutes=9,
    task="Return the acceleration that a push at one point of a body gives another of its points.",
    arguments=(
        Value("mass", "(...)", "kg", "infinity for a fixed body"),
        Value("inverse_inertia", "(..., 3, 3)", "1/(kg m²)", "I^-1 in world axes, zero for a fixed body"),
        Value("arm", "(..., 3)", "m", "r_i, from the centre of mass to the point that answers"),
        Value("push_arm", "(..., 3)", "m", "r_j, from the centre of mass to the point that is pushed"),
        Value("push", "(..., 3)", "N", "force on the body"),
    ),
    results=(Value("p_ddot", "(..., 3)", "m/s²", "acceleration of the point that answers"),),
    reference=formulas.point_response,
    cases=_responses,
    mistakes=(
        Mistake("arms swapped",
                slip(
                    formulas.point_response,
                    "push_arm, push",
                    "arm, push",
                    "omega_dot, arm",
                    "omega_dot, push_arm",
                ),
                "The arms have changed places: the torque is made "
                "where the body is pushed, with r_j; the turning is felt where it answers, at r_i."),
        Mistake("arm of the push twice",
                slip(formulas.point_response, "omega_dot, arm", "omega_dot, push_arm"),
                "You use the arm of the push for the "
                "answer too. That is how the pushed point itself moves: r_A in the table is that of i, not j."),
        Mistake("arm of the answer twice", slip(formulas.point_response, "push_arm, push", "arm, push"),
                "You use the arm of the answering point "
                "for the torque too. The torque is made by the arm of the push."),
        Mistake("a cross product turned round",
                slip(formulas.point_response, "omega_dot, arm", "arm, omega_dot"),
                "One of the two cross products is turned "
                "round. The torque is r_j x F, and what it does to the point omega_dot x r_i."),
        Mistake("x r left out", slip(formulas.point_response, "np.cross(omega_dot, arm)", "omega_dot"),
                "You add omega_dot as it is, in rad/s^2. Crossed with the arm "
                "of the point that answers it becomes an acceleration."),
        Mistake("no turning", slip(formulas.point_response, " + np.cross(omega_dot, arm)", ""),
                "This is how the centre is accelerated. A push off the centre "
                "turns the body as well."),
        Mistake("only turning", slip(formulas.point_response, "push / np.asarray(mass)[..., None] + ", ""),
                "The push also accelerates the body as a whole, by F/m."),
        Mistake("mass forgotten", slip(formulas.point_response, " / np.asarray(mass)[..., None]", ""),
                "The force is added as it is, in N: divide it by the mass."),
        Mistake("mass without an axis", slip(formulas.point_response, "np.asarray(mass)[..., None]", "mass"),
                "Right for one mass. A batch of masses needs one more "
                "axis before it divides vectors: np.asarray(mass)[..., None]."),
        Mistake("inertia left out",
                slip(
                    formulas.point_response,
                    'np.einsum("...ij,...j->...i", inverse_inertia, np.cross(push_arm, push))',
                    "np.cross(push_arm, push)",
                ),
                "The torque is used as if it "
                "were omega_dot: it has to go through I^-1."),
        Mistake("inertia for its inverse",
                slip(formulas.point_response, "inverse_inertia, np", "np.linalg.pinv(inverse_inertia), np"),
                "You use I where its inverse belongs. What is given is I^-1 already: multiply by it."),
        Mistake("diagonal alone",
                slip(
                    formulas.point_response,
                    'np.einsum("...ij,...j->...i", inverse_inertia, np.cross(push_arm, push))',
                    'np.einsum("...ii->...i", inverse_inertia) * np.cross(push_arm, push)',
                ),
                "You use the diagonal "
                "of I^-1 alone. In general that is right only while the body's axes lie along those of the world."),
        Mistake("matrix product with @",
                slip(
                    formulas.point_response,
                    'np.einsum("...ij,...j->...i", inverse_inertia, np.cross(push_arm, push))',
                    "inverse_inertia @ np.cross(push_arm, push)",
                ),
                "Right for one body. In a batch, @ takes "
                'the last two axes of both sides for matrices: np.einsum("...ij,...j->...i", matrix, vector).'),
    ),
    hints=(
        "See Derive, step 2: two parts, the motion of the centre and the turning about it.",
        "F/m, with an axis more on the mass; the torque r_j x F through I^-1 gives omega_dot; omega_dot x r_i.",
        'omega_dot = np.einsum("...ij,...j->...i", inverse_inertia, np.cross(____, push))\n'
        "return push / np.asarray(mass)[..., None] + np.cross(____, ____)",
    ),
)  # fmt: skip
