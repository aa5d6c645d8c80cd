"""The exercise ``symplectic_euler_step``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_09_energy_and_motion.shared import (
    ANGULAR_MOMENTUM,
    I_BODY,
)
from course.exercises.definitions.turning import (
    drawn_vectors,
    inertias,
    rotation_matrices,
    transposed,
)
from course.exercises.slips import slip


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.ndarray) and value.ndim == 0 else value


def _moving(
    rng: np.random.Generator, shape: tuple[int, ...], **fixed: Any
) -> dict[str, Any]:
    drawn = {
        "x": drawn_vectors(rng, shape),
        "R": rotation_matrices(rng, shape),
        "p": drawn_vectors(rng, shape, 3.0),
        "L": drawn_vectors(rng, shape, 2.0),
        "mass": _plain(np.round(rng.uniform(1.5, 4.0, shape), 1)),
        "I_body": inertias(rng, shape),
        "force": drawn_vectors(rng, shape, 4.0),
        "torque": drawn_vectors(rng, shape, 2.0),
        "h": 0.3,
    }
    return {**drawn, **fixed}


AT_THE_ORIGIN = {
    "x": np.zeros(3),
    "R": np.eye(3),
    "p": np.array([1.0, 0.0, 0.0]),
    "L": np.array([0.0, 0.0, 6.0]),
    "mass": 2.0,
    "I_body": np.diag([1.0, 2.0, 3.0]),
    "force": np.array([0.0, 0.0, -20.0]),
    "torque": np.zeros(3),
    "h": 0.1,
}

SYMPLECTIC_EULER_STEP = Exercise(
    name="symplectic_euler_step",
    rows=(14, 22),
    points=3,
    minutes=16,
    task="Return x, R, p and L one step on: momenta first, then place and orientation with the new momenta.",
    arguments=(
        Value("x", "(..., 3)", "m", "position of the centre of mass"),
        Value("R", "(..., 3, 3)", "", "rotation, columns the body's axes in the world"),
        Value("p", "(..., 3)", "kg m/s", "momentum"),
        ANGULAR_MOMENTUM,
        Value("mass", "(...)", "kg"),
        I_BODY,
        Value("force", "(..., 3)", "N", "at the start of the step"),
        Value(
            "torque",
            "(..., 3)",
            "N m",
            "at the start of the step, about the centre of mass",
        ),
        Value("h", "scalar", "s", "the step"),
    ),
    results=(
        Value("x", "(..., 3)", "m"),
        Value("R", "(..., 3, 3)", ""),
        Value("p", "(..., 3)", "kg m/s"),
        Value("L", "(..., 3)", "kg m²/s"),
    ),
    reference=formulas.symplectic_euler_step,
    cases=lambda rng: [
        Case("a spinning body falls", AT_THE_ORIGIN),
        Case("with a force and a torque", _moving(rng, ())),
        Case("with a force and a torque, again", _moving(rng, ())),
        Case(
            "nothing acts",
            _moving(rng, (), force=np.zeros(3), torque=np.zeros(3)),
            "edge",
        ),
        Case(
            "neither moving nor turning, nothing acts",
            _moving(
                rng,
                (),
                p=np.zeros(3),
                L=np.zeros(3),
                force=np.zeros(3),
                torque=np.zeros(3),
            ),
            "edge",
        ),
        Case("a step back in time", _moving(rng, (), h=-0.2), "edge"),
        Case("five bodies", _moving(rng, (5,)), "batch"),
        Case(
            "three bodies, as many as a vector has components",
            _moving(rng, (3,)),
            "batch",
        ),
        Case("a 2 by 4 batch", _moving(rng, (2, 4)), "batch"),
    ],  # fmt: skip
    properties=(
        Property(
            "rotation",
            lambda given, answer: answer[1] @ transposed(answer[1]) - np.eye(3),
            "Your R is no rotation any more: its columns are not unit vectors at right angles.",
        ),
    ),
    mistakes=(
        Mistake(
            "explicit Euler",
            slip(
                formulas.symplectic_euler_step,
                "p, L = ",
                "p_new, L_new = ",
                "R, p, L",
                "R, p_new, L_new",
            ),
            "You move and turn with the momenta from before the step: that is explicit Euler. Here the *new* momenta "
            "move the body; on a spring this one line decides whether it gains energy without end.",
        ),
        Mistake(
            "moved with the old momentum",
            slip(
                formulas.symplectic_euler_step,
                "p, L = ",
                "p_new, L = ",
                "R, p, L",
                "R, p_new, L",
            ),
            "The turn uses the new L, but the position still the old p. Take p' in x' = x + h p'/m.",
        ),
        Mistake(
            "turned with the old momentum",
            slip(
                formulas.symplectic_euler_step,
                "p, L = ",
                "p, L_new = ",
                "R, p, L",
                "R, p, L_new",
            ),
            "The position uses the new p, but the turn still the old L. Take L' in omega' = I^-1 L'.",
        ),
        Mistake(
            "body-frame inertia",
            slip(
                formulas.symplectic_euler_step,
                "R @ I_body @ np.swapaxes(R, -1, -2)",
                "I_body",
            ),
            "omega = I_body^-1 L mixes axes: L is in world axes, I_body in those of the body. Turn the inertia "
            "first, R I_body R'.",
        ),
        Mistake(
            "omega in body axes",
            slip(
                formulas.symplectic_euler_step,
                "np.linalg.solve(I, L[..., None])",
                "np.linalg.solve(I_body, np.swapaxes(R, -1, -2) @ L[..., None])",
            ),
            "Your omega = I_body^-1 R' L is right, but in body axes, and the turn is about a world axis. Bring it "
            "back with R.",
        ),
        Mistake(
            "mass forgotten",
            slip(formulas.symplectic_euler_step, " / np.asarray(mass)[..., None]", ""),
            "x' = x + h p' adds a momentum to a position. The velocity is p'/m.",
        ),
        Mistake(
            "step forgotten in the momenta",
            slip(
                formulas.symplectic_euler_step,
                "p + h * force, L + h * torque",
                "p + force, L + torque",
            ),
            "You add the whole force and torque, as if the step were one second. Momentum changes by force times "
            "time, h F.",
        ),
        Mistake(
            "torque forgotten",
            slip(formulas.symplectic_euler_step, "L + h * torque", "L"),
            "L stays as it was. It changes by h times the torque, as p does by h times the force.",
        ),
        Mistake(
            "force forgotten",
            slip(formulas.symplectic_euler_step, "p + h * force", "p"),
            "p stays as it was. It changes by h times the force.",
        ),
        Mistake(
            "turned by a second's worth",
            slip(formulas.symplectic_euler_step, "(h * omega)", "(omega)"),
            "You turn by omega, the angle of one second. In a step the body turns by the rotation vector h omega.",
        ),
        Mistake(
            "turned backwards",
            slip(formulas.symplectic_euler_step, "(h * omega)", "(-h * omega)"),
            "Your body turns backwards: the rotation vector is h omega', not its opposite.",
        ),
        Mistake(
            "momenta returned first",
            slip(
                formulas.symplectic_euler_step,
                "x + h * p / np.asarray(mass)[..., None], turn @ R, p, L",
                "p, L, x + h * p / np.asarray(mass)[..., None], turn @ R",
            ),
            "The numbers are right, but p and L come first. Return x, R, p, L in this order.",
        ),
        Mistake(
            "returned in another order",
            slip(formulas.symplectic_euler_step, "turn @ R, p, L", "p, turn @ R, L"),
            "The numbers are right, but p stands where R should. Return x, R, p, L in this order.",
        ),
        Mistake(
            "order of the turns",
            slip(formulas.symplectic_euler_step, "turn @ R", "R @ turn"),
            "turn @ R and R @ turn are different. omega is in world axes, so the turn comes after R, on its left.",
        ),
        Mistake(
            "added, not turned",
            slip(
                formulas.symplectic_euler_step,
                "turn @ R",
                "R + h * np.cross(omega[..., None], R, axis=-2)",
            ),
            "You add h omega x R to R. That is explicit Euler on nine numbers: its columns get longer as they turn. "
            "Use the rotation matrix of the rotation vector h omega.",
        ),
        Mistake(
            "not turned",
            slip(formulas.symplectic_euler_step, "turn @ R", "R"),
            "R stays as it was. The body turns by the rotation vector h omega'.",
        ),
        Mistake(
            "one batch axis short",
            slip(formulas.symplectic_euler_step, "np.asarray(mass)[..., None]", "mass"),
            "Right for one body, not for a batch: mass has shape (...) and p (..., 3), so mass needs one more axis, "
            "np.asarray(mass)[..., None].",
        ),
    ),
    hints=(
        "Four lines in this order: p', L', x', R'. Each line uses the newest values there are, but R inside the "
        "inertia is still the old one.",
        "omega' is I^-1 L' with the inertia of the exercise before last. Rotation.from_rotvec(theta).as_matrix() is "
        "the rotation matrix of a rotation vector; it multiplies R from the left.",
        "p, L = p + h * force, L + h * torque\n"
        "omega = np.linalg.solve(____, L[..., None])[..., 0]\n"
        "turn = Rotation.from_rotvec(____).as_matrix()\n"
        "return x + h * ____, turn @ R, p, L",
    ),
)
