"""The exercise ``apply_impulse``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_12_impulse_and_spin.shared import (
    drawn_inverse_inertia,
    drawn_number,
    drawn_vector,
    unit_vector,
)
from course.exercises.slips import slip


def _pushes(rng: np.random.Generator) -> Sequence[Case]:
    def drawn(shape: tuple[int, ...] = (), **fixed: Any) -> dict[str, Any]:
        push = {
            "velocity": drawn_vector(rng, shape),
            "angular_velocity": drawn_vector(rng, shape, 2.0),
            "inverse_mass": drawn_number(rng, shape, 0.3, 0.8),
            "inverse_inertia": drawn_inverse_inertia(rng, shape),
            "arm": drawn_vector(rng, shape),
            "normal": unit_vector(rng, shape),
            "impulse": drawn_number(rng, shape, 0.5, 3.0),
        }
        return push | fixed

    rod = {
        "velocity": np.array([0.0, 0.0, -1.0]),
        "angular_velocity": np.zeros(3),
        "inverse_mass": 1.0,
        "inverse_inertia": np.diag([100.0, 12.0, 12.0]),
        "arm": np.array([0.5, 0.0, 0.0]),
        "normal": np.array([0.0, 0.0, 1.0]),
        "impulse": 0.5,
    }
    central = drawn()
    central["arm"] = 0.5 * central["normal"]
    mixed = drawn((4,))
    mixed["impulse"] = mixed["impulse"] * np.array([1.0, -1.0, 0.0, 1.0])
    return [
        Case("the level rod on its end", rod),
        Case("off the axes", drawn()),
        Case("off the axes again", drawn()),
        Case("body 2's share: a negative impulse", drawn(impulse=-1.5), "edge"),
        Case("no impulse", drawn(impulse=0.0), "edge"),
        Case("an arm along the normal", central, "edge"),
        Case(
            "a fixed body",
            drawn(inverse_mass=0.0, inverse_inertia=np.zeros((3, 3))),
            "edge",
        ),
        Case("three bodies, as many as a vector has components", drawn((3,)), "batch"),
        Case("five bodies", drawn((5,)), "batch"),
        Case("a 2 by 4 batch", drawn((2, 4)), "batch"),
        Case("four bodies, one pushed the other way, one not at all", mixed, "batch"),
    ]


APPLY_IMPULSE = Exercise(
    name="apply_impulse",
    rows=(15, 16, 22),
    points=2,
    minutes=7,
    task="Return the velocity and the angular velocity of a body after an impulse p_hat n at the end of its arm.",
    arguments=(
        Value("velocity", "(..., 3)", "m/s", "v of the centre of mass before"),
        Value("angular_velocity", "(..., 3)", "rad/s", "omega before"),
        Value("inverse_mass", "(...)", "1/kg", "1/m; 0 for a fixed body"),
        Value(
            "inverse_inertia",
            "(..., 3, 3)",
            "1/(kg m²)",
            "I^-1 about the centre, world axes; zeros if fixed",
        ),
        Value("arm", "(..., 3)", "m", "r, from the centre of mass to the contact"),
        Value("normal", "(..., 3)", "", "unit vector n"),
        Value("impulse", "(...)", "N s", "p_hat; for body 2 it is given with a minus"),
    ),
    results=(
        Value("velocity", "(..., 3)", "m/s"),
        Value("angular_velocity", "(..., 3)", "rad/s"),
    ),
    reference=formulas.apply_impulse,
    cases=_pushes,
    mistakes=(
        Mistake(
            "n x r",
            slip(formulas.apply_impulse, "arm, push", "push, arm"),
            "The spin has the wrong sign: you took n x r. The torque of a push is r x n, arm first.",
        ),
        Mistake(
            "inverse inertia forgotten",
            slip(
                formulas.apply_impulse,
                "(inverse_inertia @ np.cross(arm, push)[..., None])[..., 0]",
                "np.cross(arm, push)",
            ),
            "You add r x n p_hat to omega. That is the change of angular momentum L; omega changes by I^-1 times it.",
        ),
        Mistake(
            "inverse undone",
            slip(
                formulas.apply_impulse,
                "(inverse_inertia @ np.cross(arm, push)[..., None])[..., 0]",
                "np.linalg.solve(inverse_inertia, np.cross(arm, push)[..., None])[..., 0]",
            ),
            "You divide by the matrix that is already inverted. The argument is I^-1: multiply by it.",
        ),
        Mistake(
            "only the diagonal",
            slip(
                formulas.apply_impulse,
                "(inverse_inertia @ np.cross(arm, push)[..., None])[..., 0]",
                "np.diagonal(inverse_inertia, axis1=-2, axis2=-1) * np.cross(arm, push)",
            ),
            "You use only the diagonal of the inverse inertia. A body that has turned has in general a "
            "full matrix in world axes: a push can spin it about an axis it was not pushed about.",
        ),
        Mistake(
            "arm not crossed",
            slip(formulas.apply_impulse, "np.cross(arm, push)", "push"),
            "You multiply I^-1 by the push itself. What turns a body is the torque, r x the push.",
        ),
        Mistake(
            "entry by entry",
            slip(formulas.apply_impulse, "np.cross(arm, push)", "(arm * push)"),
            "Your torque is r times n, entry by entry. The cross product is np.cross.",
        ),
        Mistake(
            "impulse missing in the torque",
            slip(formulas.apply_impulse, "arm, push", "arm, normal"),
            "Your spin does not know how strong the push was: r x n is the torque of 1 N s. Take the impulse into it.",
        ),
        Mistake(
            "the arm for the torque",
            slip(
                formulas.apply_impulse,
                "np.cross(arm, push)",
                "(np.asarray(impulse)[..., None] * arm)",
            ),
            "You multiply I^-1 by the arm. What turns a body is the torque r x p_hat n: how far the push is out of the "
            "centre, not how far the point is.",
        ),
        Mistake(
            "the bare arm",
            slip(formulas.apply_impulse, "np.cross(arm, push)", "arm"),
            "You multiply I^-1 by the bare arm, which knows neither the direction of the push nor its strength. What "
            "turns a body is the torque, the cross product of the arm and the push.",
        ),
        Mistake(
            "inverse mass forgotten",
            slip(
                formulas.apply_impulse,
                "np.asarray(inverse_mass)[..., None] * push",
                "push",
            ),
            "You add p_hat n to the velocity. That is the change of momentum; the velocity changes by it times 1/m.",
        ),
        Mistake(
            "divided by the inverse mass",
            slip(
                formulas.apply_impulse,
                "np.asarray(inverse_mass)[..., None] * push",
                "push / np.asarray(inverse_mass)[..., None]",
            ),
            "You divide by the inverse mass, and so multiply by the mass. The argument is 1/m already.",
        ),
        Mistake(
            "sign",
            slip(
                formulas.apply_impulse,
                "velocity + moved, angular_velocity + turned",
                "velocity - moved, angular_velocity - turned",
            ),
            "Both changes have the wrong sign: the impulse acts along +n. The minus of body 2 comes with its p_hat.",
        ),
        Mistake(
            "the pair turned round",
            slip(
                formulas.apply_impulse,
                "velocity + moved, angular_velocity + turned",
                "angular_velocity + turned, velocity + moved",
            ),
            "Both are right, but in the wrong order: return the velocity first, then the angular velocity.",
        ),
        Mistake(
            "velocity of the point",
            slip(
                formulas.apply_impulse,
                "velocity + moved,",
                "velocity + moved + np.cross(angular_velocity + turned, arm),",
            ),
            "The spin is right, but your velocity is that of the contact point. What is asked for is that of the "
            "centre of mass: v + p_hat n / m, wherever the push acts.",
        ),
        Mistake(
            "one batch axis short",
            slip(
                formulas.apply_impulse,
                "np.asarray(impulse)[..., None]",
                "impulse",
                "np.asarray(inverse_mass)[..., None]",
                "inverse_mass",
            ),
            "Right for one body, not for a batch: impulse and inverse_mass have shape (...), normal has (..., 3). Give "
            "them one more axis, np.asarray(impulse)[..., None] * normal.",
        ),
        Mistake(
            "matrix times vector in a batch",
            slip(
                formulas.apply_impulse,
                "(inverse_inertia @ np.cross(arm, push)[..., None])[..., 0]",
                "inverse_inertia @ np.cross(arm, push)",
            ),
            "Right for one body. In a batch `matrix @ vector` takes the vectors for a matrix: write "
            "(matrix @ vector[..., None])[..., 0].",
        ),
    ),  # fmt: skip
    hints=(
        "The table at the start of the derivation has both changes: one of v, one of omega.",
        "The push is the vector p_hat n. It changes v by the push times 1/m, and omega by I^-1 times the torque, which "
        "is the cross product of the arm and the push, in this order.",
        "push = np.asarray(impulse)[..., None] * normal\n"
        "moved = np.asarray(inverse_mass)[..., None] * ____\n"
        "turned = (inverse_inertia @ np.cross(____, ____)[..., None])[..., 0]\n"
        "return velocity + moved, angular_velocity + turned",
    ),
)
