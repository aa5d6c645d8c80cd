"""Capsules around points."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike
from course.shapes.capsule import Capsule
from course.shapes.fitting.bounding_spheres import smallest_ball
from course.shapes.fitting.point_sets import checked_sets, each_set, principal_axes


def capsule_around(points: ArrayLike) -> Capsule:
    """A capsule around each set of points, along the longest principal axis.

    Seen along this axis, the points' smallest circle gives place and radius r. A point at
    height z and distance d from the axis then lets the lower end be no higher than
    z + sqrt(r^2 - d^2), the upper one no lower than z - sqrt(r^2 - d^2). It is the least
    of those with this axis' direction and radius, not of all.
    Source: Ericson, *Real-Time Collision Detection*, sections 4.3.3 and 4.5.1; syllabus
    row 3.

    Args:
        points: (..., n, 3) [m], n >= 1.
    Returns:
        Capsules of the batch; their start and end are equal where a sphere does.
    Raises:
        ValueError: no points, NaN or infinity.
    """
    given = checked_sets(points)
    start, end, radius = each_set(given, _capsule, (3,), (3,), ())
    return Capsule(start, end, radius)


def _capsule(points: Array) -> tuple[Array, ...]:
    """Start, end and radius of one capsule, around (n, 3)."""
    axes = principal_axes(points)
    local = (points - points[0]) @ axes
    center, radius = smallest_ball(local[:, 1:])
    aside = np.sum(np.square(local[:, 1:] - center), axis=1)
    reach = np.sqrt(np.maximum(radius**2 - aside, 0.0))
    low, high = (local[:, 0] + reach).min(), (local[:, 0] - reach).max()
    if low > high:  # one sphere holds them all
        low = high = 0.5 * (low + high)
    start, end = (points[0] + axes @ [height, *center] for height in (low, high))
    return start, end, _distances(points, start, end).max()


def _distances(points: Array, start: Array, end: Array) -> Array:
    """How far points (n, 3) are from a segment."""
    along, arms = end - start, points - start
    length = along @ along
    part = np.clip(arms @ along / length, 0.0, 1.0) if length else np.zeros(len(arms))
    return np.linalg.norm(arms - part[:, None] * along, axis=1)
