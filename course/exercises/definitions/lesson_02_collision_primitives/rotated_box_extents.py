"""The exercise ``rotated_box_extents``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.turning import rotation_matrices
from course.exercises.slips import slip

_FORMULA = "np.sum(np.abs(rotation) * half_extents[..., None, :], axis=-1)"


def _drawn(rng: np.random.Generator, shape: tuple[int, ...]) -> dict[str, Any]:
    """Sides that are unlike, turned about no axis of the world."""
    e = rng.uniform(0.1, 0.4, (*shape, 3)) + rng.permutation([0.0, 0.7, 1.6])
    return {"half_extents": e.round(2), "rotation": rotation_matrices(rng, shape)}


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    rod, c, s = np.array([3.0, 2.0, 1.0]), 0.8, 0.6
    about_z = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    quarter = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    size = rng.uniform(0.5, 2.0, 3).round(2)
    return [
        Case("turned about z", {"half_extents": rod, "rotation": about_z}),
        Case("turned in space", _drawn(rng, ())),
        Case("not turned", {"half_extents": size, "rotation": np.eye(3)}, "edge"),
        Case("axes change places", {"half_extents": size * [1, 2, 3], "rotation": quarter}, "edge"),
        Case("three boxes", _drawn(rng, (3,)), "batch"),
        Case("five boxes", _drawn(rng, (5,)), "batch"),
        Case("a 2 by 4 batch", _drawn(rng, (2, 4)), "batch"),
    ]  # fmt: skip


def _slip(name: str, new: str, message: str) -> Mistake:
    return Mistake(name, slip(formulas.rotated_box_extents, _FORMULA, new), message)


ROTATED_BOX_EXTENTS = Exercise(
    name="rotated_box_extents",
    rows=(4,),
    points=2,
    minutes=6,
    task="Return the half extents, along the world's axes, of the upright box around a turned box.",
    arguments=(
        Value("half_extents", "(..., 3)", "m", "half the sides of the turned box"),
        Value("rotation", "(..., 3, 3)", "", "columns: the axes of the turned box"),
    ),
    results=(Value("extents", "(..., 3)", "m", "half extents of the upright box"),),
    reference=formulas.rotated_box_extents,
    cases=_cases,
    mistakes=(
        _slip(
            "one corner",
            "np.sum(rotation * half_extents[..., None, :], axis=-1)",
            "That is where one corner lands, the one with three plus signs. Other corners reach farther: each term "
            "may be taken with the sign that makes it large.",
        ),
        _slip(
            "size of one corner's place",
            "np.abs(np.sum(rotation * half_extents[..., None, :], axis=-1))",
            "You take sizes after adding up, so it is one corner or the one across. The three signs can be chosen one "
            "by one: take the size of each term.",
        ),
        _slip(
            "rows for columns",
            "np.sum(np.abs(np.swapaxes(rotation, -1, -2)) * half_extents[..., None, :], axis=-1)",
            "You multiply by the transposed matrix: right for turns about one axis only. Column j of R is the box's "
            "axis j, so row i holds what the three axes reach along the world's axis i.",
        ),
        _slip(
            "extent of the row",
            "np.sum(np.abs(rotation) * half_extents[..., :, None], axis=-1)",
            "Each *row* is multiplied by one extent. Extent j belongs to column j, the box's own axis j: it must "
            "stand along the last axis.",
        ),
        _slip(
            "root of squares",
            "np.sqrt(np.sum((rotation * half_extents[..., None, :]) ** 2, axis=-1))",
            "The root of the sum of squares bounds an ellipsoid that lies inside the box. At the box's farthest corner "
            "the three terms add up.",
        ),
        _slip(
            "largest term",
            "np.max(np.abs(rotation) * half_extents[..., None, :], axis=-1)",
            "That is how far the middle of a face reaches. The corner lies off the centre along all three axes of the "
            "box: add the three terms.",
        ),
        _slip(
            "squared entries",
            "np.sum(rotation ** 2 * half_extents[..., None, :], axis=-1)",
            "The squares of the entries are not their sizes: a step of length e along a box axis moves the place by "
            "e times the cosine.",
        ),
        _slip(
            "whole sides",
            "2 * np.sum(np.abs(rotation) * half_extents[..., None, :], axis=-1)",
            "Twice too large: these are whole sides. Asked are the halves.",
        ),
        _slip(
            "ball around it",
            "np.linalg.norm(half_extents, axis=-1)[..., None] + 0 * half_extents",
            "That is the radius of the ball around the box: right at no turn, safe at all. R does not occur in it.",
        ),
        _slip(
            "not turned",
            "half_extents + 0 * rotation[..., 0]",
            "That is the box before the turn. What does each axis of the turned box reach along x?",
        ),
    ),
    hints=(
        "Along x the corner lands at R_11 (±e_1) + R_12 (±e_2) + R_13 (±e_3). Which signs make that largest?",
        "Each term counts by its size. For the world's axis i it is row i of R, entry by entry in size, times the "
        "three extents, added up. To let three numbers stand in a row for each matrix: half_extents[..., None, :].",
        "return np.sum(np.abs(____) * half_extents[..., None, :], axis=____)",
    ),
)
