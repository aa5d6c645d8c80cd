"""The exercise ``support``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_02_collision_primitives.shared import (
    DIRECTION,
    POINTS,
    drawn,
)
from course.exercises.slips import slip

_ALONG = "np.sum(points * direction[..., None, :], axis=-1)"
_BEST = "np.argmax(along, axis=-1)[..., None, None]"
_TAKEN = "np.take_along_axis(points, best, axis=-2)[..., 0, :]"
_TIED = "(along == np.max(along, axis=-1, keepdims=True))[..., None]"


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    triangle = np.array([[1.0, 1, 0], [4, 2, 0], [2, 5, 0]])
    alone = drawn(rng, (), 2)
    return [
        Case("a triangle", {"points": triangle, "direction": np.array([0.6, 0.8, 0.0])}),
        Case("the same, against x", {"points": triangle, "direction": np.array([-2.0, 0.0, 0.0])}),
        Case("eight points", drawn(rng, (), 8)),
        Case("a long direction", {**(x := drawn(rng, (), 9)), "direction": 1e3 * x["direction"]}),
        Case("a single point", {"points": alone["points"][:1], "direction": alone["direction"]}, "edge"),
        Case("every place below 0", _below(rng), "edge"),
        Case("a box along x, where four points are as far", _box_along_x(rng), "edge"),
        Case("three sets of five", drawn(rng, (3,), 5), "batch"),
        Case("three sets of three", drawn(rng, (3,), 3), "batch"),
        Case("a 2 by 4 batch", drawn(rng, (2, 4), 7), "batch"),
    ]  # fmt: skip


def _below(rng: np.random.Generator) -> dict[str, Any]:
    """Points that all lie against the direction: their places are below 0."""
    case = drawn(rng, (), 6)
    against = -20.0 * np.sign(case["direction"])
    return {"points": case["points"] + against, "direction": case["direction"]}


def _box_along_x(rng: np.random.Generator) -> dict[str, Any]:
    """The corners of a box along the axes, asked along x: exact numbers, so that four are as far."""
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1.0)])
    corners = np.array([4.0, -3.0, 2.0]) + signs * rng.permutation([0.5, 1.0, 1.5])
    return {"points": corners, "direction": np.array([2.0, 0.0, 0.0])}


def _off_the_points(given: Mapping[str, Any], answer: Any) -> Array:
    """How far the answer is from the nearest point of its set [m]."""
    away = np.linalg.norm(given["points"] - np.asarray(answer)[..., None, :], axis=-1)
    return np.asarray(np.min(away, axis=-1))


def _short_of_the_farthest(given: Mapping[str, Any], answer: Any) -> Array:
    """By how much the farthest point of the set is ahead of the answer [m]."""
    d = given["direction"] / np.linalg.norm(given["direction"], axis=-1, keepdims=True)
    most = np.max(np.sum(given["points"] * d[..., None, :], axis=-1), axis=-1)
    return np.asarray(most - np.sum(np.asarray(answer) * d, axis=-1))


#: Judged by what holds of every right answer: of several that are as far, any one will do.
PROPERTIES = (
    Property("a point of the set", _off_the_points, "Your answer is none of the points of the set."),
    Property("the farthest", _short_of_the_farthest, "Its place along the direction is not the largest of the set."),
)  # fmt: skip


def _corner(points: Any, direction: Any) -> Any:
    """The corner of the box around the points that is farthest along the direction."""
    d = np.asarray(direction)
    low, high = np.min(points, axis=-2), np.max(points, axis=-2)
    return np.where(d > 0, high, low)


SUPPORT = Exercise(
    name="support",
    rows=(3, 6),
    points=1,
    minutes=8,
    task="Return the point of each set that lies farthest along a direction.",
    arguments=(POINTS, DIRECTION),
    results=(Value("farthest", "(..., 3)", "m", "one of the points of each set"),),
    reference=formulas.support,
    cases=_cases,
    judged_by="properties",
    sample=lambda points, direction: 0.0 * direction,
    properties=PROPERTIES,
    mistakes=(
        Mistake(
            "against",
            slip(formulas.support, "np.argmax", "np.argmin"),
            "That is the point farthest *against* the direction: the least place along it instead of the largest.",
        ),
        Mistake(
            "either way",
            slip(formulas.support, _ALONG, f"np.abs({_ALONG})"),
            "You compare the sizes of the places. Where the points lie against the direction, all places are below 0, "
            "and the largest size is the point farthest back.",
        ),
        Mistake(
            "farthest from the origin",
            slip(formulas.support, "direction[..., None, :]", "points"),
            "That is the point farthest from the origin, whatever the direction. The place along d is x.d.",
        ),
        Mistake(
            "corner of the box",
            _corner,
            "You choose each coordinate by itself: that is a corner of the AABB, and not a point of the set. One "
            "point has to be farthest, with all of its coordinates.",
        ),
        Mistake(
            "largest coordinates",
            lambda points, direction: np.max(points, axis=-2),
            "You take the largest of each coordinate by itself: that is a corner of the AABB, and not a point of the "
            "set. The direction does not occur in it.",
        ),
        Mistake(
            "one direction for all sets",
            slip(formulas.support, "direction[..., None, :]", "direction"),
            "Right for one set. In a batch each set has its own direction, and all points of a set need it: write "
            "direction[..., None, :], with an axis for the points.",
        ),
        Mistake(
            "matrix product",
            slip(formulas.support, _ALONG, "points @ direction"),
            "Right for one set. In a batch @ takes the directions for the columns of a matrix: every set is asked "
            "along all of them. Write np.sum(points * direction[..., None, :], axis=-1).",
        ),
        Mistake(
            "axis at the end",
            slip(formulas.support, "direction[..., None, :]", "direction[..., None]"),
            "direction[..., None] stands the direction up as a column: each *point* is multiplied by one of its "
            "numbers. The new axis belongs before the coordinates: direction[..., None, :].",
        ),
        Mistake(
            "farthest from the tip",
            slip(
                formulas.support,
                _ALONG,
                "np.linalg.norm(points - direction[..., None, :], axis=-1)",
            ),
            "You measure how far the points are from the tip of d, as if d were a place. A direction is none: the "
            "place along d is the dot product x.d.",
        ),
        Mistake(
            "nearest to the tip",
            slip(
                formulas.support,
                _ALONG,
                "-np.linalg.norm(points - direction[..., None, :], axis=-1)",
            ),
            "You take the point nearest to the tip of d, as if d were a place. A direction is none: the place along d "
            "is the dot product x.d, and the largest is asked.",
        ),
        Mistake(
            "number of the point",
            lambda points, direction: np.argmax(
                np.sum(points * np.asarray(direction)[..., None, :], axis=-1), axis=-1
            ),
            "That is the number of the farthest point in its set. Asked is the point: take it out of points with this "
            "number, as the cell above does.",
        ),
        Mistake(
            "place of the point",
            lambda points, direction: np.max(
                np.sum(points * np.asarray(direction)[..., None, :], axis=-1), axis=-1
            ),
            "That is the place of the farthest point, a number. Asked is the point: find which one it is, and take it "
            "out of points.",
        ),
        Mistake(
            "axis left over",
            slip(formulas.support, _TAKEN, "np.take_along_axis(points, best, axis=-2)"),
            "These are the right points, each still as a table of one row. Take the row out of it, as the cell above "
            "does in the end.",
        ),
        Mistake(
            "place times direction",
            lambda points, direction: (
                np.asarray(direction)
                * np.max(
                    np.sum(points * np.asarray(direction)[..., None, :], axis=-1),
                    axis=-1,
                )[..., None]
            ),
            "You multiply the largest place by the direction: that lies on the line through the origin, and is no "
            "point of the set. Return the point whose place is largest.",
        ),
        Mistake(
            "sum of all that are as far",
            slip(formulas.support, _TAKEN, f"np.sum(points * {_TIED}, axis=-2)"),
            "Right where one point alone is farthest. If several are equally far, you add them up: any one of them "
            "is right, and their sum is not.",
        ),
        Mistake(
            "mean of all that are as far",
            slip(
                formulas.support,
                _TAKEN,
                f"np.sum(points * {_TIED}, axis=-2) / np.sum({_TIED}, axis=-2)",
            ),
            "Right where one point alone is farthest. If several are equally far, you take their mean, which is no "
            "point of the set: any one of them is right.",
        ),
        Mistake(
            "products one by one",
            lambda points, direction: np.max(
                points * np.asarray(direction)[..., None, :], axis=-2
            ),
            "You take the largest product of each coordinate by itself, and return products. Add the three products of "
            "a point first: that is its place. Then return the point whose place is largest.",
        ),
        Mistake(
            "foot on the line",
            lambda points, direction: (
                np.asarray(direction)
                * np.max(
                    np.sum(points * np.asarray(direction)[..., None, :], axis=-1),
                    axis=-1,
                )[..., None]
                / np.sum(np.square(direction), axis=-1)[..., None]
            ),
            "That is where the farthest point lands on the line through the origin. Return the point itself.",
        ),
        Mistake(
            "mean of the set",
            lambda points, direction: np.mean(points, axis=-2),
            "That is the middle of the points. The direction does not occur in it.",
        ),
        Mistake(
            "one set's answer for all",
            slip(
                formulas.support,
                _BEST,
                "np.argmax(along.reshape(-1, along.shape[-1])[0]) + np.zeros((*along.shape[:-1], 1, 1), dtype=int)",
            ),
            "Right for one set. In a batch you take the number of the first set's farthest point for all sets: "
            "argmax with axis=-1 gives one number a set.",
        ),
    ),  # fmt: skip
    hints=(
        "The place of a point along d is its dot product with d, as in lesson 00. Which point has the largest? Of "
        "several that are equally far, any one will do.",
        "np.argmax(along, axis=-1) gives the number of the farthest point of each set. To take it out of a batch: "
        "np.take_along_axis(points, best, axis=-2), where best has as many axes as points.",
        "along = np.sum(points * direction[..., None, :], axis=-1)\n"
        "best = np.argmax(____, axis=-1)[..., None, None]\n"
        "return np.take_along_axis(points, best, axis=____)[..., 0, :]",
    ),
)
