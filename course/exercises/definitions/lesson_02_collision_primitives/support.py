"""The exercise ``support``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_02_collision_primitives.shared import (
    DIRECTION,
    POINTS,
    drawn,
)
from course.exercises.slips import slip

_ALONG = "np.sum(points * direction[..., None, :], axis=-1)"


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
        Case("three sets of five", drawn(rng, (3,), 5), "batch"),
        Case("three sets of three", drawn(rng, (3,), 3), "batch"),
        Case("a 2 by 4 batch", drawn(rng, (2, 4), 7), "batch"),
    ]  # fmt: skip


def _below(rng: np.random.Generator) -> dict[str, Any]:
    """Points that all lie against the direction: their places are below 0."""
    case = drawn(rng, (), 6)
    against = -20.0 * np.sign(case["direction"])
    return {"points": case["points"] + against, "direction": case["direction"]}


def _corner(points: Any, direction: Any) -> Any:
    """The corner of the box around the points that is farthest along the direction."""
    d = np.asarray(direction)
    low, high = np.min(points, axis=-2), np.max(points, axis=-2)
    return np.where(d > 0, high, low)


SUPPORT = Exercise(
    name="support",
    rows=(3, 6),
    points=1,
    minutes=7,
    task="Return the point of each set that lies farthest along a direction.",
    arguments=(POINTS, DIRECTION),
    results=(Value("farthest", "(..., 3)", "m", "one of the points of each set"),),
    reference=formulas.support,
    cases=_cases,
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
            "You choose each coordinate by itself: that is a corner of the box around the points, and none of the "
            "points need be there. One point has to be farthest, with all of its coordinates.",
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
                "np.argmax(along, axis=-1)[..., None, None]",
                "np.argmax(along.reshape(-1, along.shape[-1])[0]) + np.zeros((*along.shape[:-1], 1, 1), dtype=int)",
            ),
            "Right for one set. In a batch you take the number of the first set's farthest point for all sets: "
            "argmax with axis=-1 gives one number a set.",
        ),
    ),  # fmt: skip
    hints=(
        "The place of a point along d is its dot product with d, as in lesson 00. Which point has the largest?",
        "np.argmax(along, axis=-1) gives the number of the farthest point of each set. To take it out of a batch: "
        "np.take_along_axis(points, best, axis=-2), where best has as many axes as points.",
        "along = np.sum(points * direction[..., None, :], axis=-1)\n"
        "best = np.argmax(____, axis=-1)[..., None, None]\n"
        "return np.take_along_axis(points, best, axis=____)[..., 0, :]",
    ),
)
