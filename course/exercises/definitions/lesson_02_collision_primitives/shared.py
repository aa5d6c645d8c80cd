"""What the exercises of this lesson share: clouds of points that lie away from the origin, and directions.

A support is the one farthest point: drawn directions see no two points as far by less
than ``CLEAR``, so that no answer hangs on rounding or on which of two is taken first.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array
from course.exercises.definition import Value

POINTS = Value("points", "(..., n, 3)", "m", "at least one point")
DIRECTION = Value("direction", "(..., 3)", "", "of any length but 0")
#: By how much the farthest point is ahead of the others [m].
CLEAR = 1e-3


def cloud(rng: np.random.Generator, shape: tuple[int, ...], count: int) -> Array:
    """Points about a place away from the origin, (*shape, count, 3) [m]."""
    place = rng.choice([-1, 1], (*shape, 1, 3)) * rng.uniform(1.5, 4.0, (*shape, 1, 3))
    spread = rng.uniform(0.3, 1.5, (*shape, 1, 3))
    return np.asarray(np.round(place + spread * rng.normal(size=(*shape, count, 3)), 2))


def clear_direction(rng: np.random.Generator, points: Array) -> Array:
    """Directions for sets of points (..., n, 3) along and against which one point is ahead, (..., 3)."""
    found = np.zeros((*points.shape[:-2], 3))
    wanted = np.ones(points.shape[:-2], dtype=bool)
    while wanted.any():
        drawn = np.round(rng.uniform(0.3, 2.5, found.shape), 2)
        drawn *= rng.choice([-1, 1], found.shape)
        found = np.where(wanted[..., None], drawn, found)
        ordered = np.sort(np.sum(points * found[..., None, :], axis=-1), axis=-1)
        ahead = np.minimum(
            ordered[..., -1] - ordered[..., -2], ordered[..., 1] - ordered[..., 0]
        )
        wanted = ahead < CLEAR
    return found


def drawn(rng: np.random.Generator, shape: tuple[int, ...], count: int) -> dict[str, Any]:  # fmt: skip
    """Points and a direction, by name."""
    points = cloud(rng, shape, count)
    return {"points": points, "direction": clear_direction(rng, points)}
