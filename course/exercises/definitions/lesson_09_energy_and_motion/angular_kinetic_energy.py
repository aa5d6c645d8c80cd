"""The exercise ``angular_kinetic_energy``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_09_energy_and_motion.shared import (
    energy_mistakes,
)
from course.exercises.definitions.turning import drawn_vectors, inertias, times
from course.exercises.slips import slip


def _of_a_turn(rng: np.random.Generator, shape: tuple[int, ...]) -> dict[str, Any]:
    omega = drawn_vectors(rng, shape)
    return {"L": times(inertias(rng, shape), omega).round(6), "omega": omega}


ANGULAR_KINETIC_ENERGY = Exercise(
    name="angular_kinetic_energy",
    rows=(14,),
    points=1,
    minutes=3,
    task="Return L.omega/2, the kinetic energy of turning about the centre of mass.",
    arguments=(
        Value("L", "(..., 3)", "kg m²/s", "angular momentum about the centre of mass"),
        Value("omega", "(..., 3)", "rad/s", "angular velocity"),
    ),
    results=(Value("energy", "(...)", "J"),),
    reference=formulas.angular_kinetic_energy,
    cases=lambda rng: [
        Case(
            "the case by hand",
            {"L": np.array([1.0, 4.0, 0.0]), "omega": np.array([1.0, 2.0, 0.0])},
        ),
        Case("off the axes", _of_a_turn(rng, ())),
        Case("not turning", {"L": np.zeros(3), "omega": np.zeros(3)}, "edge"),
        Case(
            "three bodies, as many as a vector has components",
            _of_a_turn(rng, (3,)),
            "batch",
        ),
        Case("five bodies", _of_a_turn(rng, (5,)), "batch"),
        Case("a 2 by 4 batch", _of_a_turn(rng, (2, 4)), "batch"),
    ],
    mistakes=(
        *energy_mistakes(formulas.angular_kinetic_energy, "L", "omega"),
        Mistake(
            "lengths",
            slip(
                formulas.angular_kinetic_energy,
                "np.sum(L * omega, axis=-1)",
                "np.linalg.norm(L, axis=-1) * np.linalg.norm(omega, axis=-1)",
            ),
            "|L||omega|/2 is right only where L points along omega. In general it does not: the dot "
            "product takes the cosine of the angle between them into account.",
        ),
        Mistake(
            "omega twice",
            slip(formulas.angular_kinetic_energy, "L * omega", "omega * omega"),
            "omega.omega/2 has no inertia in it. The inertia sits in L = I omega: use L once and omega once.",
        ),
        Mistake(
            "L twice",
            slip(formulas.angular_kinetic_energy, "L * omega", "L * L"),
            "L.L/2 holds the inertia twice and is no energy (look at the units). Use L once and omega once.",
        ),
        Mistake(
            "cross product",
            slip(
                formulas.angular_kinetic_energy,
                "np.sum(L * omega, axis=-1)",
                "np.cross(L, omega)",
            ),
            "This is a cross product, a vector. The energy is a number: half the dot product. (You will need L x "
            "omega soon, for another purpose.)",
        ),
    ),
    hints=(
        "It is the function before this one with other letters.",
        "Half the dot product of L and omega over the last axis. Their lengths alone would not do: in "
        "general they point in different directions.",
        "return 0.5 * np.sum(____ * ____, axis=-1)",
    ),
)
