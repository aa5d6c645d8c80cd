"""The exercise ``world_inertia``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_09_energy_and_motion.shared import I_BODY
from course.exercises.definitions.turning import (
    inertias,
    rotation_matrices,
    transposed,
)
from course.exercises.slips import slip


def _oriented(rng: np.random.Generator, shape: tuple[int, ...]) -> dict[str, Any]:
    return {"R": rotation_matrices(rng, shape), "I_body": inertias(rng, shape)}


QUARTER_TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])

WORLD_INERTIA = Exercise(
    name="world_inertia",
    rows=(14, 22),
    points=1,
    minutes=6,
    task="Return the inertia in world axes, R I_body R'.",
    arguments=(
        Value("R", "(..., 3, 3)", "", "rotation, columns the body's axes in the world"),
        I_BODY,
    ),
    results=(Value("I", "(..., 3, 3)", "kg m²", "inertia in world axes"),),
    reference=formulas.world_inertia,
    cases=lambda rng: [
        Case(
            "a quarter turn about z",
            {"R": QUARTER_TURN, "I_body": np.diag([1.0, 2.0, 3.0])},
        ),
        Case("turned about a slanted axis", _oriented(rng, ())),
        Case("not turned", {"R": np.eye(3), "I_body": inertias(rng, ())}, "edge"),
        Case("four bodies", _oriented(rng, (4,)), "batch"),
        Case(
            "three bodies, as many as a vector has components",
            _oriented(rng, (3,)),
            "batch",
        ),
        Case("a 2 by 3 batch", _oriented(rng, (2, 3)), "batch"),
    ],
    properties=(
        Property(
            "symmetric",
            lambda given, answer: answer - transposed(answer),
            "Your matrix is not symmetric. An inertia is, in whatever axes.",
        ),
        Property(
            "same moments",
            lambda given, answer: (
                np.trace(answer, axis1=-2, axis2=-1)
                - np.trace(given["I_body"], axis1=-2, axis2=-1)
            ),
            "The sum of the diagonal changes. Turning a body changes no principal moment, so it keeps their sum.",
        ),
    ),
    mistakes=(
        Mistake(
            "body axes",
            slip(
                formulas.world_inertia, "R @ I_body @ np.swapaxes(R, -1, -2)", "I_body"
            ),
            "This is the inertia in body axes: R is missing or cancels. Right only while the body is not turned.",
        ),
        Mistake(
            "the other way round",
            slip(
                formulas.world_inertia,
                "R @ I_body @ np.swapaxes(R, -1, -2)",
                "np.swapaxes(R, -1, -2) @ I_body @ R",
            ),
            "R' I R turns the other way. Read from right to left: R' takes a world vector to body axes, I acts "
            "there, R brings it back.",
        ),
        Mistake(
            "the other way round, with .T",
            slip(
                formulas.world_inertia,
                "R @ I_body @ np.swapaxes(R, -1, -2)",
                "R.T @ I_body @ R",
            ),
            "R' I R turns the other way: the transposed R belongs on the right, where the world vector comes in. And "
            "for a batch .T reverses *all* axes; np.swapaxes(R, -1, -2) swaps the last two.",
        ),
        Mistake(
            "one side only",
            slip(formulas.world_inertia, " @ np.swapaxes(R, -1, -2)", ""),
            "Only one rotation. A matrix is turned on both sides: its input comes in world axes (R' first) and its "
            "output must go back to them (R last).",
        ),
        Mistake(
            "not transposed",
            slip(formulas.world_inertia, "np.swapaxes(R, -1, -2)", "R"),
            "The right-hand R must be transposed: R' takes a world vector to body axes.",
        ),
        Mistake(
            ".T of a batch",
            slip(formulas.world_inertia, "np.swapaxes(R, -1, -2)", "R.T"),
            "Right for one body, not for a batch: .T reverses *all* axes. np.swapaxes(R, -1, -2) swaps the last "
            "two.",
        ),
        Mistake(
            "products of entries",
            slip(formulas.world_inertia, "R @ I_body @", "R * I_body *"),
            "* multiplies entry by entry. The product of matrices is @.",
        ),
    ),
    hints=(
        "Take a world vector omega through it: I omega must be R (I_body (R' omega)).",
        "Three matrices multiplied with @. The transpose over a batch is np.swapaxes(R, -1, -2).",
        "return R @ ____ @ np.swapaxes(____, -1, -2)",
    ),
)
