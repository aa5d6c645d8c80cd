"""The exercise ``compound_support``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_02_collision_primitives.shared import (
    CLEAR,
    DIRECTION,
    cloud,
)
from course.exercises.definitions.turning import rotation_matrices
from course.exercises.slips import slip

_INWARD = "np.sum(rotation * direction[..., None, :, None], axis=-2)"
_PLACED = "np.sum(rotation * own[..., None, :], axis=-1) + translation"
_CHOSEN = "support(placed, direction)"


def _drawn(
    rng: np.random.Generator, shape: tuple[int, ...], parts: int = 3
) -> dict[str, Any]:
    """Parts whose points lie off their own origin, and a direction that no two points or parts see alike."""
    while True:
        given = {
            "points": np.round(0.6 * cloud(rng, (*shape, parts), 5), 2),
            "rotation": rotation_matrices(rng, (*shape, parts)),
            "translation": rng.uniform(-3.0, 3.0, (*shape, parts, 3)).round(2),
            "direction": rng.uniform(0.4, 2.0, (*shape, 3)).round(2)
            * rng.choice([-1, 1], (*shape, 3)),
        }
        if _clear(given):
            return given


def _clear(given: dict[str, Any]) -> bool:
    turn, d = given["rotation"], given["direction"]
    world = np.einsum("...ij,...nj->...ni", turn, given["points"])
    world = world + given["translation"][..., None, :]
    place = np.sort(np.einsum("...ni,...i->...n", world, d[..., None, :]), axis=-1)
    best = np.sort(place[..., -1], axis=-1)
    first = (place[..., -1] - place[..., -2]).min()
    return bool(min(first, (best[..., -1] - best[..., -2]).min()) > 10 * CLEAR)


def _hammer() -> dict[str, Any]:
    """A handle along x and a head across it at its end."""
    signs = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1.0)])
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    handle, head = signs * [3.0, 0.2, 0.2], signs * [1.0, 0.5, 0.4]
    return {
        "points": np.stack([handle, head]),
        "rotation": np.stack([np.eye(3), quarter]),
        "translation": np.array([[0.0, 0.0, 0.0], [3.5, 0.0, 0.0]]),
        "direction": np.array([1.0, 2.0, 1.0]),
    }


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    return [
        Case("a hammer of two boxes", _hammer()),
        Case("three parts", _drawn(rng, ())),
        Case("three other parts", _drawn(rng, ())),
        Case("four parts", _drawn(rng, (), 4)),
        Case("a single part", _drawn_alone(rng), "edge"),
        Case("two compounds", _drawn(rng, (2,)), "batch"),
        Case("three compounds of three", _drawn(rng, (3,)), "batch"),
        Case("a 2 by 3 batch", _drawn(rng, (2, 3), 2), "batch"),
    ]


def _drawn_alone(rng: np.random.Generator) -> dict[str, Any]:
    given = _drawn(rng, (), 2)
    return {n: v[:1] if n != "direction" else v for n, v in given.items()}


def _slip(name: str, message: str, *edits: str) -> Mistake:
    return Mistake(name, slip(formulas.compound_support, *edits), message)


COMPOUND_SUPPORT = Exercise(
    name="compound_support",
    rows=(7,),
    points=3,
    minutes=9,
    task="Return the point of a compound that lies farthest along a direction; each part has points in its own axes, "
    "a rotation and a translation.",
    arguments=(
        Value(
            "points", "(..., m, n, 3)", "m", "n points of each of m parts, in its axes"
        ),
        Value("rotation", "(..., m, 3, 3)", "", "columns: the axes of each part"),
        Value("translation", "(..., m, 3)", "m", "where the origin of each part is"),
        DIRECTION,
    ),
    results=(Value("farthest", "(..., 3)", "m", "a point of the compound"),),
    reference=formulas.compound_support,
    cases=_cases,
    mistakes=(
        _slip(
            "direction not turned",
            "You ask each part along the world's direction, but its points are given in its own axes. Say the "
            "direction in these axes first.",
            _INWARD,
            "direction[..., None, :] + 0 * translation",
        ),
        _slip(
            "turned the wrong way",
            "You turn the direction with R, out of the part's axes. Into them it goes with the transposed R: the "
            "dot products with R's columns.",
            _INWARD,
            "np.sum(rotation * direction[..., None, None, :], axis=-1)",
        ),
        _slip(
            "rows for columns",
            "Both times you take R for its transpose: it is as if every part were turned the other way round. A part's "
            "axes are the columns of R, and its point x is at R x + t.",
            _INWARD,
            "np.sum(rotation * direction[..., None, None, :], axis=-1)",
            _PLACED,
            "np.sum(rotation * own[..., :, None], axis=-2) + translation",
        ),
        _slip(
            "points of the world, direction of the part",
            "You place the points in the world, but ask them along the direction as it is in the part's own axes. "
            "Points and direction must be told in the same axes: placed points go with `direction` itself.",
            "own = support(points, inward)",
            "own = support(np.sum(rotation[..., None, :, :] * points[..., None, :], axis=-1), inward)",
            _PLACED,
            "own + translation",
        ),
        Mistake(
            "corner of the box",
            lambda points, rotation, translation, direction: np.max(
                np.sum(rotation[..., None, :, :] * points[..., None, :], axis=-1)
                + translation[..., None, :],
                axis=(-3, -2),
            ),
            "You take the largest of each coordinate by itself: that is a corner of the AABB, and not a point of the "
            "compound. One point has to be farthest along the direction, with all of its coordinates.",
        ),
        _slip(
            "not turned back",
            "The farthest point of a part is still in the part's own axes. Turn it with R before you move it.",
            _PLACED,
            "own + translation",
        ),
        _slip(
            "turned back the wrong way",
            "The part's point goes into the world with R, not with the transposed R.",
            _PLACED,
            "np.sum(rotation * own[..., :, None], axis=-2) + translation",
        ),
        _slip(
            "not moved",
            "The translation is missing: every part stands at the origin.",
            _PLACED,
            "np.sum(rotation * own[..., None, :], axis=-1)",
        ),
        _slip(
            "moved before the turn",
            "You move first and turn then. A part is turned in its own axes, and then moved: R x + t.",
            _PLACED,
            "np.sum(rotation * (own + translation)[..., None, :], axis=-1)",
        ),
        _slip(
            "part by its middle",
            "You choose the part whose origin lies farthest. A part behind it may reach farther: compare the parts' "
            "farthest points.",
            _CHOSEN,
            "np.take_along_axis(placed, np.argmax(np.sum(translation * direction[..., None, :], axis=-1), "
            "axis=-1)[..., None, None], axis=-2)[..., 0, :]",
        ),
        _slip(
            "part by its own reach",
            "You choose the part that reaches farthest from its *own* origin. Where it stands counts as well.",
            _CHOSEN,
            "np.take_along_axis(placed, np.argmax(np.sum((placed - translation) * direction[..., None, :], axis=-1), "
            "axis=-1)[..., None, None], axis=-2)[..., 0, :]",
        ),
        _slip(
            "first part",
            "You return the point of the first part. Another may reach farther.",
            _CHOSEN,
            "placed[..., 0, :]",
        ),
        _slip(
            "farthest against it",
            "In the end you take the part that reaches least far along the direction.",
            _CHOSEN,
            "support(placed, -direction)",
        ),
        _slip(
            "one of each part",
            "You return a point for each part. Only the farthest of these is asked: one more support, along the "
            "direction of the world.",
            _CHOSEN,
            "placed",
        ),
        _slip(
            "part's direction in the end",
            "In the last step the points are in the world, but `inward` holds a direction for each part, in its own "
            "axes. Ask the placed points along the one direction of the world.",
            _CHOSEN,
            "support(placed, inward)",
        ),
        _slip(
            "mean of the parts",
            "You take the mean of the parts' farthest points, which need not be a point of the compound. Only one "
            "part is the farthest.",
            _CHOSEN,
            "np.mean(placed, axis=-2)",
        ),
    ),
    hints=(
        "Two times `support`: first of each part's points, then of the m points that came. What has to be done to the "
        "direction before, and to the points between?",
        "In a part's own axes the direction is R transposed times d, the dot products of d with R's columns. The point "
        "that comes goes back as R x + t. Then the farthest of the m placed points along d itself.",
        "inward = np.sum(rotation * direction[..., None, :, None], axis=-2)\n"
        "own = support(points, ____)\n"
        "placed = np.sum(rotation * own[..., None, :], axis=-1) + ____\n"
        "return support(____, direction)",
    ),
)
