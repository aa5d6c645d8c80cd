"""The exercise ``k_dop``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_02_collision_primitives.shared import (
    POINTS,
    cloud,
)
from course.exercises.definitions.vectors import unit_vector
from course.exercises.slips import slip

_ALONG = "points @ directions.T"
_RETURNED = "np.min(along, axis=-2), np.max(along, axis=-2)"


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    triangle = np.array([[1.0, 1, 0], [4, 2, 0], [2, 5, 0]])
    by_hand = np.array([[1.0, 0.0, 0.0], [0.6, 0.8, 0.0]])

    def drawn(shape: tuple[int, ...], points: int, directions: int) -> dict[str, np.ndarray]:  # fmt: skip
        return {"points": cloud(rng, shape, points), "directions": unit_vector(rng, (directions,))}  # fmt: skip

    return [
        Case("a triangle, two directions", {"points": triangle, "directions": by_hand}),
        Case("nine points, seven directions", drawn((), 9, 7)),
        Case("a single point", drawn((), 1, 4), "edge"),
        Case("three directions", drawn((), 5, 3)),
        Case("three sets", drawn((3,), 4, 5), "batch"),
        Case("four sets of three", drawn((4,), 3, 3), "batch"),
        Case("a 2 by 3 batch", drawn((2, 3), 6, 13), "batch"),
    ]


def _slip(name: str, message: str, *edits: str) -> Mistake:
    return Mistake(name, slip(formulas.k_dop, *edits), message)


K_DOP = Exercise(
    name="k_dop",
    rows=(5,),
    points=2,
    minutes=5,
    task="Return the intervals of the k-DOP around each set of points: the least and the largest place along each "
    "direction.",
    arguments=(
        POINTS,
        Value("directions", "(h, 3)", "", "unit vectors, one for two sides"),
    ),
    results=(
        Value("lower", "(..., h)", "m", "least place along each direction"),
        Value("upper", "(..., h)", "m", "largest place along each direction"),
    ),
    reference=formulas.k_dop,
    cases=_cases,
    properties=(
        Property(
            "lower <= upper",
            lambda given, answer: np.minimum(answer[1] - answer[0], 0.0),
            "Some lower end lies above its upper one.",
        ),
    ),
    mistakes=(
        _slip(
            "order",
            "The ends are right, in the other order: first lower, then upper.",
            _RETURNED,
            "np.max(along, axis=-2), np.min(along, axis=-2)",
        ),
        _slip(
            "as wide both ways",
            "You take the lower end for minus the upper one. The points need not lie evenly about the origin: find "
            "the least place as you find the largest.",
            "np.min(along, axis=-2), ",
            "-np.max(along, axis=-2), ",
        ),
        _slip(
            "sign of the lower end",
            "The lower end's sign is reversed: you give how far the points reach *against* the direction, and not the "
            "place, which lies below 0 there.",
            "np.min(along, axis=-2), ",
            "-np.min(along, axis=-2), ",
        ),
        _slip(
            "from the middle",
            "You measure from the middle of the points. The places are measured from the origin, or nobody knows "
            "where the k-DOP stands.",
            _ALONG,
            "(points - np.mean(points, axis=-2, keepdims=True)) @ directions.T",
        ),
        _slip(
            "sizes",
            "You compare the sizes of the places. A place below 0 is a place as well.",
            _ALONG,
            f"np.abs({_ALONG})",
        ),
        _slip(
            "numbers of the points",
            "np.argmin and np.argmax give *which* point is at the end, a number of the list. Asked is its place along "
            "the direction: np.min and np.max.",
            _RETURNED,
            "np.argmin(along, axis=-2), np.argmax(along, axis=-2)",
        ),
        _slip(
            "over the directions",
            "You take the least and the largest of each *point*'s places, over the directions. Each direction has its "
            "own interval: go over the points, axis=-2 of (..., n, h).",
            _RETURNED,
            "np.min(along, axis=-1), np.max(along, axis=-1)",
        ),
        _slip(
            "one array",
            "Asked are two results, each of shape (..., h): `return lower, upper`. Neither one end alone nor both in "
            "one array.",
            f"return {_RETURNED}",
            f"return np.stack([{_RETURNED}])",
        ),
        _slip(
            "all numbers at once",
            "You take the least and the largest of all places at once. Each direction has its own interval: go over "
            "the points, axis=-2.",
            _RETURNED,
            "np.min(along), np.max(along)",
        ),
        _slip(
            "rows for columns",
            "Each row of directions is one direction. points @ M lays the points out along M's columns: turn rows "
            "into columns first.",
            _ALONG,
            "points @ directions",
        ),
        _slip(
            "largest size both ways",
            "You take the largest size of a place for both ends, minus and plus. The points need not lie evenly about "
            "the origin: find the least and the largest place, with their signs.",
            _RETURNED,
            "-np.max(np.abs(along), axis=-2), np.max(np.abs(along), axis=-2)",
        ),
        _slip(
            "width",
            "The second number is the width. Asked is the place of the upper end.",
            "np.max(along, axis=-2)",
            "np.max(along, axis=-2) - np.min(along, axis=-2)",
        ),
        _slip(
            "box",
            "That is the support of the box around the points: the corners of the box, and not the points, are laid "
            "out on the directions. A k-DOP touches the points on every side.",
            _RETURNED,
            "(np.minimum(np.min(points, axis=-2)[..., None, :] * directions, np.max(points, axis=-2)[..., None, :] "
            "* directions)).sum(axis=-1), (np.maximum(np.min(points, axis=-2)[..., None, :] * directions, "
            "np.max(points, axis=-2)[..., None, :] * directions)).sum(axis=-1)",
        ),
    ),
    hints=(
        "One direction first: the places of all points along it, as in `support`; but here you want the two ends and "
        "not the point.",
        "points @ M multiplies each set of points (n, 3) by a matrix (3, h) and gives (n, h): the place of each point "
        "along each direction, if the directions are M's columns: directions.T. Then the least and the largest over "
        "the points.",
        "along = points @ ____\n"
        "return np.min(along, axis=____), np.max(along, axis=____)",
    ),
)
