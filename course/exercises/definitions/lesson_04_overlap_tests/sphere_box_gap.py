"""The exercise ``sphere_box_gap``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.arrays import Array
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_04_overlap_tests.shared import (
    Given,
    center,
    length,
    place,
    point,
    radius,
)
from course.exercises.slips import slip

_ARGUMENTS = (
    center("center", "the sphere"),
    length("radius", "radius of the sphere"),
    point("lower", "lowest corner of the box"),
    point("upper", "highest corner of the box"),
)
_RETURN = "np.where(inset > 0, -inset, outside) - radius"
_INSET = "np.minimum(center - lower, upper - center)"


def _given(*values: object) -> Given:
    return {
        v.name: np.asarray(x, float) for v, x in zip(_ARGUMENTS, values, strict=True)
    }


def _share(rng: np.random.Generator, kind: int) -> Array:
    """Where the centre lies between the corners: inside, beyond a face, an edge, a corner, by turns."""
    inside = rng.uniform(0.1, 0.9, 3)
    beyond = np.where(rng.uniform(size=3) < 0.5, -1.0, 2.0) + rng.uniform(-0.6, 0.6, 3)
    axes = rng.permutation(3)[: (kind % 4)]
    inside[axes] = beyond[axes]
    return inside


def _drawn(
    rng: np.random.Generator, shape: tuple[int, ...] = (), turn: int = 0
) -> Given:
    count = int(np.prod(shape))
    lower = place(rng, shape)
    upper = np.round(lower + rng.uniform(0.6, 3.0, (*shape, 3)), 2)
    share = np.array([_share(rng, k + turn) for k in range(count)]).reshape(*shape, 3)
    x = np.round(lower + share * (upper - lower), 3)
    return _given(x, radius(rng, shape), lower, upper)


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    lower, upper = np.array([1.0, 1, 1]), np.array([5.0, 4, 7])
    return [
        Case("beyond a face", _given([3.0, 2, 9], 0.5, lower, upper)),
        Case("its centre inside", _given([3.0, 3.5, 4], 0.25, lower, upper)),
        *(Case(f"drawn, {k + 1}", _drawn(rng, (), k)) for k in range(4)),
        Case("its centre on a face", _given([5.0, 2, 3], 0.5, lower, upper), "edge"),
        Case("close beyond an edge", _given([5.3, 4.4, 3], 0.125, lower, upper), "edge"),
        Case("it touches a corner", _given([7.0, 5, 9], 3.0, lower, upper), "edge"),
        Case("a point inside", _given([2.0, 2, 1.5], 0.0, lower, upper), "edge"),
        Case("three of them", _drawn(rng, (3,)), "batch"),
        Case("sixteen of them", _drawn(rng, (16,)), "batch"),
        Case("a 2 by 8 batch", _drawn(rng, (2, 8)), "batch"),
    ]  # fmt: skip


def _wrong(name: str, message: str, *edits: str) -> Mistake:
    return Mistake(name, slip(formulas.sphere_box_gap, *edits), message)


SPHERE_BOX_GAP = Exercise(
    name="sphere_box_gap",
    rows=(3, 4),
    points=3,
    minutes=10,
    level="stretch",
    task="Return the gap of a sphere and an upright box, also with the centre inside.",
    arguments=_ARGUMENTS,
    results=(Value("gap", "(...)", "m", "signed gap"),),
    reference=formulas.sphere_box_gap,
    cases=_cases,
    mistakes=(
        _wrong(
            "inside taken for touching",
            "Right outside. With the centre inside, the nearest point of the box is the centre itself, at distance 0: "
            "then every depth is the radius. It has to go out past the nearest face.",
            _RETURN,
            "outside - radius",
        ),
        _wrong(
            "past the farthest face",
            "Inside, you leave past a face that is far. The shortest way out is past the nearest one.",
            f"np.min({_INSET}, axis=-1)",
            f"np.max({_INSET}, axis=-1)",
        ),
        _wrong(
            "farther side of each axis",
            "Inside, you take the farther one of the two faces of each axis.",
            "np.minimum(center",
            "np.maximum(center",
        ),
        _wrong(
            "sign inside",
            "Inside, the way to the nearest face counts below 0, and the radius comes to it.",
            "-inset, outside",
            "inset, outside",
        ),
        _wrong(
            "radius left out inside",
            "Inside, the radius is missing: for the whole sphere to leave, its centre must go beyond the face by r.",
            _RETURN,
            "np.where(inset > 0, -inset, outside - radius)",
        ),
        _wrong(
            "radius left out",
            "That is the gap of the centre. The sphere reaches beyond it by its radius.",
            _RETURN,
            "np.where(inset > 0, -inset, outside)",
        ),
        _wrong(
            "to the middle",
            "You measure to the middle of the box. Nearest is the place whose coordinates are the centre's, each "
            "limited to the box.",
            "np.clip(center, lower, upper)",
            "(lower + upper) / 2",
        ),
        _wrong(
            "the largest coordinate",
            "Beyond an edge or a corner you take the largest of the three distances. They are at right angles: it is "
            "their root of squares.",
            "np.linalg.norm(center - np.clip(center, lower, upper), axis=-1)",
            "np.max(np.abs(center - np.clip(center, lower, upper)), axis=-1)",
        ),
        _wrong(
            "0 where they overlap",
            "Right where they are apart. Where they overlap the gap is below 0, and says how deep.",
            f"return {_RETURN}",
            f"return np.maximum({_RETURN}, 0.0)",
        ),
    ),
    hints=(
        "Outside: the nearest point of a box has the centre's coordinates, each limited to between lower and upper. "
        "Inside: six faces, and the nearest of them is the way out.",
        "np.clip(center, lower, upper) is the nearest point. Inside, np.minimum(center - lower, upper - center) is "
        "the way to the nearer face on each axis; the least of the three, with a minus sign, is the depth.",
        "outside = np.linalg.norm(center - np.clip(center, ____, ____), axis=-1)\n"
        "inset = np.min(np.minimum(center - lower, ____), axis=-1)\n"
        "return np.where(inset > 0, ____, outside) - radius",
    ),
)
