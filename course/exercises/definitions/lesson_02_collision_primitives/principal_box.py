"""The exercise ``principal_box``: inputs, properties of a right answer, and planted mistakes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.turning import rotation_matrices
from course.exercises.slips import slip

_CENTER = "middle + axes @ (0.5 * (lower + upper))"


def _cloud(rng: np.random.Generator, count: int) -> dict[str, Array]:
    """Points with three unlike spreads, turned, and more of them toward one end."""
    along = rng.uniform(0.0, 1.0, (count, 3)) ** 2 * [3.0, 1.6, 0.7]
    turn, place = rotation_matrices(rng, ()), rng.uniform(2.0, 4.0, 3)
    return {"points": np.round(along @ turn.T + place, 3)}


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    grid = np.stack(np.meshgrid([0.0, 1.0], [0.0, 1.0], [0.0, 1.0]), axis=-1)
    return [
        Case("corners of a box of 6 by 4 by 2 m", {"points": grid.reshape(-1, 3) * [6.0, 4.0, 2.0]}),
        Case("forty points", _cloud(rng, 40)),
        Case("nine points", _cloud(rng, 9)),
        Case("twenty points", _cloud(rng, 20)),
    ]  # fmt: skip


def _axes_of(answer: Any) -> Array:
    rotation = np.asarray(answer[1], dtype=float)
    if rotation.shape != (3, 3):
        raise ValueError("another shape")
    return rotation


def _off_diagonal(given: Mapping[str, Any], answer: Any) -> Array:
    """Products of the covariance in the box's axes, over its largest moment."""
    axes, covariance = _axes_of(answer), np.cov(given["points"].T)
    turned = axes.T @ covariance @ axes
    return np.asarray((turned - np.diag(np.diagonal(turned))) / np.trace(covariance))


def _sides(given: Mapping[str, Any], answer: Any) -> Array:
    """How far the points fall short of the box's sides, or reach beyond, (2, 3) [m]."""
    center, axes, half = answer[0], _axes_of(answer), answer[2]
    along = (given["points"] - center) @ axes
    return np.stack([along.max(axis=0) - half, -along.min(axis=0) - half])


PROPERTIES = (
    Property("axes of length 1, square to each other",
             lambda given, answer: _axes_of(answer).T @ _axes_of(answer) - np.eye(3),
             "The columns of the rotation are not of length 1 and square to each other.", 1e-9),
    Property("right-handed", lambda given, answer: np.linalg.det(_axes_of(answer)) - 1.0,
             "The axes are left-handed, det R = -1: turn one or all of them round.", 1e-9),
    Property("principal axes", _off_diagonal,
             "The covariance is not diagonal in these axes: they are not its eigenvectors, as columns.", 1e-7),
    Property("the points fit", _sides,
             "A side of the box is not where the farthest point along its axis is.", 1e-9),
)  # fmt: skip


def _slip(name: str, message: str, *edits: str) -> Mistake:
    return Mistake(name, slip(formulas.principal_box, *edits), message)


PRINCIPAL_BOX = Exercise(
    name="principal_box",
    rows=(4,),
    points=3,
    minutes=12,
    level="stretch",
    task="Return the box around points along the principal axes of their covariance, which differ in spread.",
    arguments=(Value("points", "(n, 3)", "m", "not all in a plane"),),
    results=(
        Value("center", "(3,)", "m", "of the box"),
        Value("rotation", "(3, 3)", "", "columns: the box's axes, right-handed"),
        Value("half_extents", "(3,)", "m", "half the sides along these axes"),
    ),
    reference=formulas.principal_box,
    cases=_cases,
    judged_by="properties",
    sample=lambda points: (np.zeros(3), np.eye(3), np.zeros(3)),
    properties=PROPERTIES,
    mistakes=(
        _slip(
            "rows for columns",
            "The axes are the rows of your rotation: eigh gives its eigenvectors as columns, and so does a rotation "
            "its axes.",
            "return " + _CENTER + ", axes,",
            "return " + _CENTER + ", axes.T,",
        ),
        _slip(
            "middle of the points",
            "The centre is the mean of the points. Where they crowd toward one end, the middle of the *box* is "
            "elsewhere: halfway between the lowest and the highest place along each axis.",
            _CENTER,
            "middle",
        ),
        _slip(
            "not turned back",
            "The middle of the places is told in the box's axes. Turn it back with the rotation before you add it.",
            "axes @ (0.5 * (lower + upper))",
            "0.5 * (lower + upper)",
        ),
        _slip(
            "whole sides",
            "These are whole sides; asked are the halves.",
            "0.5 * (upper - lower)",
            "(upper - lower)",
        ),
        _slip(
            "spread",
            "You return the standard deviations along the axes. Most points lie within twice of that, but the box "
            "must hold all.",
            "0.5 * (upper - lower)",
            "np.std(along, axis=0)",
        ),
        _slip(
            "spread, of a sample",
            "You return the roots of the eigenvalues, the standard deviations along the axes. Most points lie within "
            "twice of that, but the box must hold all.",
            "0.5 * (upper - lower)",
            "np.std(along, axis=0, ddof=1)",
        ),
        _slip(
            "along the world's axes",
            "You lay the points out along the world's axes, not along those found.",
            "(points - middle) @ axes",
            "points - middle",
        ),
        _slip(
            "moments about the origin",
            "You take the moments about the origin. Far from it their largest axis points to the middle of the cloud, "
            "whatever its shape: subtract the mean first.",
            "np.cov(points.T)",
            "points.T @ points",
        ),
        _slip(
            "handedness",
            "Nobody makes the axes right-handed: eigh may give three left-handed ones, and a mirror is no rotation. "
            "Where det R = -1 turn all three round.",
            "axes * np.sign(np.linalg.det(axes))",
            "-axes * np.sign(np.linalg.det(axes))",
        ),
    ),
    hints=(
        "Four steps: the mean; the covariance of the points and its eigenvectors; the places of the points along "
        "these; the box from the least and the largest places.",
        "np.cov(points.T) is the covariance (3, 3). np.linalg.eigh gives eigenvalues and, second, eigenvectors as "
        "columns. Where their determinant is -1, turn all three round.",
        "axes = np.linalg.eigh(____)[1]\n"
        "axes = axes * np.sign(np.linalg.det(axes))\n"
        "along = (points - middle) @ ____\n"
        "lower, upper = np.min(along, axis=0), np.max(along, axis=0)\n"
        "return middle + axes @ (____), axes, 0.5 * (upper - lower)",
    ),
)
