"""The exercise ``linear_kinetic_energy``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_09_energy_and_motion.shared import (
    energy_mistakes,
)
from course.exercises.definitions.turning import drawn_vectors
from course.exercises.slips import slip


def _of_a_point(rng: np.random.Generator, shape: tuple[int, ...]) -> dict[str, Any]:
    velocity = drawn_vectors(rng, shape)
    mass = rng.uniform(1.5, 4.0, shape).round(1)
    return {"p": (mass[..., None] * velocity).round(6), "v": velocity}


LINEAR_KINETIC_ENERGY = Exercise(
    name="linear_kinetic_energy",
    rows=(14,),
    points=1,
    minutes=3,
    task="Return p.v/2, the kinetic energy of the motion of the centre of mass.",
    arguments=(
        Value("p", "(..., 3)", "kg m/s", "momentum"),
        Value("v", "(..., 3)", "m/s", "velocity of the centre of mass"),
    ),
    results=(Value("energy", "(...)", "J"),),
    reference=formulas.linear_kinetic_energy,
    cases=lambda rng: [
        Case(
            "2 kg at 3 m/s along x",
            {"p": np.array([6.0, 0.0, 0.0]), "v": np.array([3.0, 0.0, 0.0])},
        ),
        Case("off the axes", _of_a_point(rng, ())),
        Case("at rest", {"p": np.zeros(3), "v": np.zeros(3)}, "edge"),
        Case(
            "three bodies, as many as a vector has components",
            _of_a_point(rng, (3,)),
            "batch",
        ),
        Case("five bodies", _of_a_point(rng, (5,)), "batch"),
        Case("a 2 by 4 batch", _of_a_point(rng, (2, 4)), "batch"),
    ],
    mistakes=(
        *energy_mistakes(formulas.linear_kinetic_energy, "p", "v"),
        Mistake(
            "velocity twice",
            slip(formulas.linear_kinetic_energy, "p * v", "v * v"),
            "v.v/2 has no mass in it: it is the energy of one kilogram. The mass sits in p = m v: use p once and v "
            "once.",
        ),
        Mistake(
            "momentum twice",
            slip(formulas.linear_kinetic_energy, "p * v", "p * p"),
            "p.p/2 holds the mass twice, in kg J. p.p/(2 m) would be right; with v at hand, take p.v/2.",
        ),
    ),
    hints=(
        "Read the formula under On the slide: a number for each body, from two vectors.",
        "A dot product over a batch is np.sum(a * b, axis=-1). Then the half.",
        "return 0.5 * np.sum(____ * ____, axis=-1)",
    ),
)
