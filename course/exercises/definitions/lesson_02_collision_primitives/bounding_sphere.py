"""The exercise ``bounding_sphere``, Ritter's: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.arrays import Array
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.slips import slip

_CENTER = "center + (1 - radius / distance) * (point - center)"
#: By how much the widest pair is wider than the others, and a point is off the sphere [m].
CLEAR = 1e-3


def _cloud(rng: np.random.Generator, count: int, growing: int) -> dict[str, Array]:
    """Points of which at least so many let the sphere grow, and none hangs on rounding."""
    while True:
        place, spread = rng.uniform(-4.0, 4.0, 3), rng.uniform(0.5, 1.5, 3)
        points = np.round(place + spread * rng.normal(size=(count, 3)), 2)
        low, high = points[points.argmin(axis=0)], points[points.argmax(axis=0)]
        wide = np.sort(np.linalg.norm(high - low, axis=-1))
        clear = wide[2] - wide[1] > CLEAR
        # Nobody finds the widest pair by adding up over the wrong axis.
        lucky = np.argmax(np.linalg.norm(high - low, axis=0)) == np.argmax(
            np.linalg.norm(high - low, axis=1)
        )
        if clear and not lucky and _grown(points) >= growing:
            return {"points": points}


def _grown(points: Array) -> int:
    """How many of the points let the sphere grow; -1 where one is almost on it."""
    low, high = points[points.argmin(axis=0)], points[points.argmax(axis=0)]
    widest = int(np.argmax(np.linalg.norm(high - low, axis=-1)))
    center = 0.5 * (low[widest] + high[widest])
    radius, count = 0.5 * float(np.linalg.norm(high[widest] - low[widest])), 0
    for point in points:
        away = float(np.linalg.norm(point - center))
        ends = np.array_equal(point, low[widest]) or np.array_equal(point, high[widest])
        if abs(away - radius) < CLEAR and not (ends and count == 0):
            return -1
        if away > radius + CLEAR:
            count, radius = count + 1, 0.5 * (radius + away)
            center = center + (1 - radius / away) * (point - center)
    return count


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    by_hand = np.array([[0.0, 0, 0], [6, 0, 0], [3, 5, 0], [3, -0.5, 0]])
    return [
        Case("four points by hand", {"points": by_hand}),
        Case("twelve points", _cloud(rng, 12, 2)),
        Case("thirty points", _cloud(rng, 30, 2)),
        Case("twelve others", _cloud(rng, 12, 3)),
        Case("ten more", _cloud(rng, 10, 1)),
        Case("two points", {"points": np.array([[1.0, 2, 3], [5, 2, 0]])}, "edge"),
    ]


def _slip(name: str, message: str, *edits: str) -> Mistake:
    return Mistake(name, slip(formulas.bounding_sphere, *edits), message)


BOUNDING_SPHERE = Exercise(
    name="bounding_sphere",
    rows=(3,),
    points=3,
    minutes=12,
    level="stretch",
    task="Return the centre and the radius of Ritter's sphere around points.",
    arguments=(Value("points", "(n, 3)", "m", "at least two that differ"),),
    results=(
        Value("center", "(3,)", "m", "of the sphere"),
        Value("radius", "scalar", "m", "of the sphere"),
    ),
    reference=formulas.bounding_sphere,
    cases=_cases,
    properties=(
        Property(
            "holds the points",
            lambda given, answer: np.maximum(
                np.linalg.norm(given["points"] - answer[0], axis=-1) - answer[1], 0.0
            ),
            "A point is outside of it.",
        ),
    ),
    mistakes=(
        _slip(
            "first pass only",
            "That is the first sphere, with the widest pair as its diameter. Points outside of it are left out: let "
            "it grow for each.",
            "distance > radius",
            "False",
        ),
        _slip(
            "centre kept",
            "The radius grows by half of what is missing, and the centre stays: then the point is still outside. The "
            "centre moves toward the point by the other half.",
            _CENTER,
            "center",
        ),
        _slip(
            "grown about its centre",
            "You let the radius grow to the point, the centre kept. It holds all points but is larger than need be: "
            "the sphere through the point and the old one's far end has a radius of (r + d)/2.",
            "0.5 * (radius + distance)",
            "distance",
        ),
        _slip(
            "moved away",
            "The centre moves away from the point instead of toward it.",
            "center + (1",
            "center - (1",
        ),
        _slip(
            "share of the way",
            "The centre moves by d - r' of the way d to the point, that is by the share 1 - r'/d. You take the share "
            "r'/d.",
            "(1 - radius / distance)",
            "(radius / distance)",
        ),
        _slip(
            "half of the way",
            "The centre goes half of the way to the point. It has to stand halfway between the point and the old "
            "sphere's far end: it moves by (d - r)/2, and not by d/2.",
            "(1 - radius / distance) * (point",
            "0.5 * (point",
        ),
        _slip(
            "step times the whole way",
            "The centre moves by d - r' toward the point; but you multiply that by point - center, which is d long and "
            "not 1. Divide it by d.",
            "(1 - radius / distance)",
            "(distance - radius)",
        ),
        _slip(
            "share with the old radius",
            "The centre goes twice as far as it should: the share 1 - r/d takes the radius from before it grew. With "
            "the new one it is 1 - r'/d.",
            "(1 - radius / distance)",
            "2 * (1 - radius / distance)",
        ),
        _slip(
            "middle of the points",
            "You begin at the middle of all points. Ritter begins at the middle of the widest pair, which is nearer to "
            "where the sphere must be.",
            "0.5 * (low[widest] + high[widest])",
            "np.mean(points, axis=0)",
        ),
        _slip(
            "diameter",
            "The first radius is the whole distance of the pair. It is the diameter: take the half.",
            "0.5 * np.linalg.norm(high",
            "np.linalg.norm(high",
        ),
        _slip(
            "x alone",
            "You take the pair that is extreme in x. Of the three pairs, in x, y and z, it is the one with the "
            "largest distance.",
            "np.argmax(np.linalg.norm(high - low, axis=-1))",
            "0",
        ),
        _slip(
            "corners of the box",
            "You take the corners of the box around the points for the first pair: nobody may stand there. Take the "
            "points that are extreme, whole.",
            "points[np.argmin(points, axis=0)], points[np.argmax(points, axis=0)]",
            "np.tile(np.min(points, axis=0), (3, 1)), np.tile(np.max(points, axis=0), (3, 1))",
        ),
    ),
    hints=(
        "Two steps: a first sphere from the widest of three pairs, then a loop over the points. A point outside is at "
        "distance d > r: the new sphere touches the point and the old sphere's far end.",
        "points[np.argmin(points, axis=0)] holds three points, the lowest in x, in y and in z. The new radius is half "
        "the way from the point to the far end, (r + d)/2; the centre moves by d - r' toward the point.",
        "for point in points:\n"
        "    distance = np.linalg.norm(point - center)\n"
        "    if distance > radius:\n"
        "        radius = 0.5 * (____)\n"
        "        center = center + (____) * (point - center)\n"
        "return center, radius",
    ),
)
