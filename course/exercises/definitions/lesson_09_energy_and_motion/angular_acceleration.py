"""The exercise ``angular_acceleration``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_09_energy_and_motion.shared import (
    ANGULAR_MOMENTUM,
)
from course.exercises.definitions.turning import (
    drawn_vectors,
    inertias,
    rotation_matrices,
    turned_inertia,
)
from course.exercises.slips import slip


def _spinning(
    rng: np.random.Generator, shape: tuple[int, ...], **fixed: Any
) -> dict[str, Any]:
    drawn = {
        "I": turned_inertia(rotation_matrices(rng, shape), inertias(rng, shape)).round(
            3
        ),
        "L": drawn_vectors(rng, shape, 2.0),
        "torque": drawn_vectors(rng, shape),
    }
    return {**drawn, **fixed}


ANGULAR_ACCELERATION = Exercise(
    name="angular_acceleration",
    rows=(14, 23),
    points=2,
    minutes=12,
    task="Return omega_dot = I^-1 (torque + L x omega), with omega = I^-1 L.",
    arguments=(
        Value("I", "(..., 3, 3)", "kg m²", "inertia, world axes"),
        ANGULAR_MOMENTUM,
        Value(
            "torque", "(..., 3)", "N m", "torque about the centre of mass, world axes"
        ),
    ),
    results=(Value("omega_dot", "(..., 3)", "rad/s²"),),
    reference=formulas.angular_acceleration,
    cases=lambda rng: [
        Case(
            "the case by hand, no torque",
            {
                "I": np.diag([1.0, 2.0, 3.0]),
                "L": np.array([1.0, 4.0, 0.0]),
                "torque": np.zeros(3),
            },
        ),
        Case("turned, with a torque", _spinning(rng, ())),
        Case("turned, no torque", _spinning(rng, (), torque=np.zeros(3))),
        Case(
            "about a principal axis, no torque",
            {
                "I": np.diag([1.0, 2.0, 3.0]),
                "L": np.array([0.0, 4.0, 0.0]),
                "torque": np.zeros(3),
            },
            "edge",
        ),
        Case("at rest, with a torque", _spinning(rng, (), L=np.zeros(3)), "edge"),
        Case("five bodies", _spinning(rng, (5,)), "batch"),
        Case(
            "three bodies, as many as a vector has components",
            _spinning(rng, (3,)),
            "batch",
        ),
        Case("a 2 by 4 batch", _spinning(rng, (2, 4)), "batch"),
    ],  # fmt: skip
    mistakes=(
        Mistake(
            "I alpha",
            slip(
                formulas.angular_acceleration, "(torque + np.cross(L, omega))", "torque"
            ),
            "This is N = I alpha as the slide prints it. I turns with the body, so torque = d(I omega)/dt holds one "
            "term more: without torque omega would never change, and the handle would never turn over.",
        ),
        Mistake(
            "omega x L",
            slip(
                formulas.angular_acceleration,
                "np.cross(L, omega)",
                "np.cross(omega, L)",
            ),
            "The cross product is the wrong way round: torque = I omega_dot + omega x L, and brought to the other "
            "side it is L x omega.",
        ),
        Mistake(
            "L in place of L x omega",
            slip(formulas.angular_acceleration, "np.cross(L, omega)", "L"),
            "This is I^-1 (torque + L), as a slide prints it. L is no torque (look at the units): it is L x omega.",
        ),
        Mistake(
            "inverse on the torque only",
            slip(
                formulas.angular_acceleration,
                "np.linalg.solve(I, (torque + np.cross(L, omega))[..., None])[..., 0]",
                "np.linalg.solve(I, torque[..., None])[..., 0] + np.cross(L, omega)",
            ),
            "I^-1 acts on the torque only. It belongs before the bracket: I^-1 (torque + L x omega).",
        ),
        Mistake(
            "torque forgotten",
            slip(formulas.angular_acceleration, "torque + ", ""),
            "The torque is missing: add it to L x omega before you apply I^-1.",
        ),
        Mistake(
            "I in place of its inverse",
            slip(formulas.angular_acceleration, "np.linalg.solve(I, (", "(I @ ("),
            "You multiply by I at the end where you must divide: I omega_dot is the bracket, and np.linalg.solve(I, "
            "...) gives omega_dot.",
        ),
        Mistake(
            "the bracket alone",
            slip(
                formulas.angular_acceleration,
                "np.linalg.solve(I, (torque + np.cross(L, omega))[..., None])[..., 0]",
                "torque + np.cross(L, omega)",
            ),
            "This is the bracket, torque + L x omega, in N m. It equals I omega_dot: I^-1 must still be applied.",
        ),
        Mistake(
            "omega from I L",
            slip(
                formulas.angular_acceleration,
                "np.linalg.solve(I, L[..., None])[..., 0]",
                "(I @ L[..., None])[..., 0]",
            ),
            "You take omega = I L. It is L = I omega, so omega comes from L by solving, as omega_dot does from the "
            "bracket.",
        ),
        Mistake(
            "omega from the diagonal",
            slip(
                formulas.angular_acceleration,
                "np.linalg.solve(I, L[..., None])[..., 0]",
                "L / np.diagonal(I, axis1=-2, axis2=-1)",
            ),
            "For omega you divide L by the diagonal of I. In world axes I has entries off its diagonal: solve for "
            "omega as you do for omega_dot.",
        ),
        Mistake(
            "diagonal only",
            slip(
                formulas.angular_acceleration,
                "np.linalg.solve(I, L[..., None])[..., 0]",
                "L / np.diagonal(I, axis1=-2, axis2=-1)",
                "np.linalg.solve(I, (torque + np.cross(L, omega))[..., None])[..., 0]",
                "(torque + np.cross(L, omega)) / np.diagonal(I, axis1=-2, axis2=-1)",
            ),
            "You divide by the diagonal of I. In world axes I has entries off its diagonal, and dividing by a matrix "
            "is np.linalg.solve.",
        ),
        Mistake(
            "solve without a column",
            slip(
                formulas.angular_acceleration,
                "np.linalg.solve(I, L[..., None])[..., 0]",
                "np.linalg.solve(I, L)",
                "(torque + np.cross(L, omega))[..., None])[..., 0]",
                "torque + np.cross(L, omega))",
            ),
            "Right for one body, not for a batch: np.linalg.solve takes a batch of vectors for one matrix. Make each "
            "a column and take it back: np.linalg.solve(I, x[..., None])[..., 0].",
        ),
    ),
    hints=(
        "First omega from L, then the cross product, then the bracket, then I^-1 once more.",
        "np.linalg.solve(I, x[..., None])[..., 0] is I^-1 x for one body and for a batch. np.cross(a, b) works on "
        "the last axis.",
        "omega = np.linalg.solve(I, L[..., None])[..., 0]\n"
        "return np.linalg.solve(I, (____ + np.cross(____, ____))[..., None])[..., 0]",
    ),
)
