"""Capsules: against spheres by the nearest point of a segment, against each other by two segments.

A capsule is all that is within r of a segment, a sphere all within r of a point: their
gap is the distance of segment and segment, or point, less both radii (C. Ericson,
*Real-Time Collision Detection*, section 4.5.1).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, ArrayLike, broadcast, non_negative, vectors
from course.overlap.convex.closest import Closest
from course.overlap.convex.separating_axis import as_kernels_take_it
from course.overlap.directions import TINY, UP, directed
from course.shapes import Capsule, Sphere

#: A distance below this times the length has no digits left that give a direction.
TOUCHING = 1e-11


def closest_point_on_segment(
    point: ArrayLike, start: ArrayLike, end: ArrayLike
) -> Array:
    """The point of a segment that is nearest to a point.

    a + t (b - a),  t = clamp((p - a).(b - a) / |b - a|^2, 0, 1)   (Ericson, section
    5.1.2); a itself where the segment is only a point.

    Args:
        point: p, (..., 3) [m].
        start, end: a and b, (..., 3) [m].
    Returns:
        (..., 3) [m].
    """
    p, a, b = vectors("point", point), vectors("start", start), vectors("end", end)
    broadcast(point=(p, 1), start=(a, 1), end=(b, 1))
    way = b - a
    return np.asarray(a + parameter(p - a, way)[..., None] * way)


def parameter(offset: Array, way: Array) -> Array:
    """t = clamp(offset.way / way.way, 0, 1), 0 where way is zero; (...) of (..., 3)."""
    square = np.einsum("...i,...i", way, way)
    t = np.einsum("...i,...i", offset, way) / np.where(square == 0, 1.0, square)
    return np.asarray(np.clip(np.where(square == 0, 0.0, t), 0.0, 1.0))


def sphere_capsule_gap(
    center: ArrayLike,
    radius: ArrayLike,
    start: ArrayLike,
    end: ArrayLike,
    capsule_radius: ArrayLike,
) -> Array:
    """Signed gap of a sphere and a capsule, |x - q| - r - R, q nearest on the segment.

    Args:
        center: x, (..., 3) [m].
        radius: r, (...) [m].
        start, end: of the capsule's segment, (..., 3) [m].
        capsule_radius: R, (...) [m].
    Returns:
        (...) [m]; below 0 they overlap.
    """
    sphere = vectors("center", center), non_negative("radius", radius)
    a, b = vectors("start", start), vectors("end", end)
    r = non_negative("capsule_radius", capsule_radius)
    broadcast(
        center=(sphere[0], 1), radius=(sphere[1], 0),
        start=(a, 1), end=(b, 1), capsule_radius=(r, 0),
    )  # fmt: skip
    return closest_sphere_capsule(Sphere(*sphere), Capsule(a, b, r)).gap


def capsule_gap(
    start_a: ArrayLike,
    end_a: ArrayLike,
    radius_a: ArrayLike,
    start_b: ArrayLike,
    end_b: ArrayLike,
    radius_b: ArrayLike,
) -> Array:
    """Signed gap of two capsules: the distance of their segments less both radii.

    Parallel segments, segments that cross and segments that are only points are no
    special cases: see ``course.overlap.curved.segments``.

    Args:
        start_a, end_a, start_b, end_b: of the segments, (..., 3) [m].
        radius_a, radius_b: (...) [m].
    Returns:
        (...) [m]; below 0 they overlap.
    """
    p_a, q_a = vectors("start_a", start_a), vectors("end_a", end_a)
    p_b, q_b = vectors("start_b", start_b), vectors("end_b", end_b)
    r_a, r_b = non_negative("radius_a", radius_a), non_negative("radius_b", radius_b)
    broadcast(
        start_a=(p_a, 1), end_a=(q_a, 1), radius_a=(r_a, 0),
        start_b=(p_b, 1), end_b=(q_b, 1), radius_b=(r_b, 0),
    )  # fmt: skip
    return two_capsules_gap(Capsule(p_a, q_a, r_a), Capsule(p_b, q_b, r_b))


def closest_sphere_capsule(a: Sphere, b: Capsule) -> Closest:
    """The nearest points of a sphere and a capsule, as of two spheres about x and q.

    Where x lies on the segment N is a direction across it, upward if it is a point.
    """
    way = b.end - b.start
    offset = a.center - b.start
    apart = offset - parameter(offset, way)[..., None] * way
    distance, normal = directed(apart, UP)
    length = np.sqrt(np.einsum("...i,...i", way, way))
    on = distance <= np.maximum(TINY, TOUCHING * length)
    if np.any(on):
        normal = np.where(on[..., None], across(way), normal)
    return Closest(
        gap=distance - (a.radius + b.radius),
        normal=normal,
        point_a=a.center - a.radius[..., None] * normal,
        point_b=a.center - apart + b.radius[..., None] * normal,
    )


def across(way: Array) -> Array:
    """Unit vectors at right angles to others, (..., 3), the same every time; upward for zero."""
    axis = np.eye(3)[np.argmin(np.abs(way), axis=-1)]
    return directed(np.cross(way, axis), UP)[1]


def closest_capsules(a: Capsule, b: Capsule) -> Closest:
    """The nearest points of two capsules, by the compiled loop over their segments."""
    from course.overlap.curved import segments

    batch, given = _flat(a, b)
    gap, found = np.empty(len(given[0])), np.empty((3, *given[0].shape))
    arrays: Any = [*given, gap, *found]
    segments.closest_capsules(*arrays)
    normal, point_a, point_b = found.reshape(3, *batch, 3)
    return Closest(gap.reshape(batch), normal, point_a, point_b)


def two_capsules_gap(a: Capsule, b: Capsule) -> Array:
    """Their gap alone, (...) [m]."""
    from course.overlap.curved import segments

    batch, given = _flat(a, b)
    gap = np.empty(len(given[0]))
    arrays: Any = [*given, gap]
    segments.gaps_of_capsules(*arrays)
    return gap.reshape(batch)


def _flat(a: Capsule, b: Capsule) -> tuple[tuple[int, ...], Any]:
    """The broadcast batch, and start, end and radius of A and of B along one axis."""
    batch = np.broadcast_shapes(a.batch, b.batch)
    count = int(np.prod(batch, dtype=np.intp))
    return batch, [
        as_kernels_take_it(wide.reshape(count, *wide.shape[len(batch) :]))
        for shape in (a.broadcast_to(batch), b.broadcast_to(batch))
        for wide in (shape.start, shape.end, shape.radius)
    ]
