"""The nearest points of two segments, also where these are parallel, cross, or are only points.

A kernel module (``course.jit``): import it where it is called.

The squared distance of s u and w + t v is a convex quadratic of s and t on the
square 0 <= s, t <= 1: it is least inside, where the two lines are nearest, or on one of
the square's four sides, where an end of one segment is nearest to the other. All five
are tried and measured, so that nothing hangs on whether two directions count as
parallel (C. Ericson, *Real-Time Collision Detection*, section 5.1.9, divides by what
tells that; D. Eberly, "Robust computation of distance between line segments", 2015, has
the same five candidates). Inside, s comes from u x v and not from u.u v.v - (u.v)^2,
which has lost all its digits at an angle of 1e-8.
"""

from __future__ import annotations

from math import inf

from course.arrays import Array
from course.jit import compiled
from course.overlap.triples import (
    Triple,
    across,
    along,
    cross,
    dot,
    length,
    minus,
    row,
    scaled,
)

#: Distance, s and t.
Candidate = tuple[float, float, float]
#: Lengths below this are none: their squares have lost digits [m].
TINY = 1e-150
#: A distance below this times the lengths has no digits left that give a direction.
TOUCHING = 1e-11


@compiled
def nearest(point: Triple, start: Triple, way: Triple) -> float:
    """The t in [0, 1] at which start + t way is nearest to the point: clamp((point - start).way / way.way)."""
    square = dot(way, way)
    if square == 0.0:
        return 0.0
    return min(1.0, max(0.0, dot(minus(point, start), way) / square))


@compiled
def nearer(
    best: Candidate, u: Triple, w: Triple, v: Triple, s: float, t: float
) -> Candidate:
    """The best candidate so far, or the points s u and w + t v where these are nearer."""
    distance = length(minus(scaled(s, u), along(w, t, v)))
    return (distance, s, t) if distance < best[0] else best


@compiled
def nearest_parameters(u: Triple, w: Triple, v: Triple) -> Candidate:
    """(distance, s, t) of the nearest points s u and w + t v, 0 <= s, t <= 1."""
    zero = (0.0, 0.0, 0.0)
    best = (inf, 0.0, 0.0)
    for end in (0.0, 1.0):
        best = nearer(best, u, w, v, nearest(along(w, end, v), zero, u), end)
        best = nearer(best, u, w, v, end, nearest(scaled(end, u), w, v))
    n = cross(u, v)
    square = dot(n, n)
    if square > 0.0:
        s = dot(cross(w, v), n) / square
        if 0.0 < s < 1.0:
            t = nearest(scaled(s, u), w, v)
            s = nearest(along(w, t, v), zero, u)
            best = nearer(best, u, w, v, s, t)
    return best


@compiled
def normal_of_touching(u: Triple, v: Triple, difference: Triple) -> Triple:
    """A unit vector at right angles to u and v, on the side of the difference, for segments that cross or touch."""
    longer = u if dot(u, u) >= dot(v, v) else v
    size = length(longer)
    n = cross(u, v)
    if size <= TINY:
        return 0.0, 0.0, 1.0
    if length(n) <= TINY:
        return across(longer)
    axis = scaled(1.0 / size, longer)
    n = scaled(1.0 / length(n), n)
    n = along(n, -dot(n, axis), axis)  # what rounding left along the nearly parallel
    if length(n) < 0.5:
        return across(longer)
    n = along(n, -dot(n, axis), axis)
    side = -1.0 if dot(n, difference) < 0.0 else 1.0
    return scaled(side / length(n), n)


@compiled
def closest_capsules(
    start_a: Array,
    end_a: Array,
    radius_a: Array,
    start_b: Array,
    end_b: Array,
    radius_b: Array,
    gap: Array,
    normal: Array,
    point_a: Array,
    point_b: Array,
) -> None:
    """Fill gap (n,), normal, point_a and point_b (n, 3) of n pairs of capsules, start and end (n, 3), radius (n,)."""
    for i in range(gap.size):
        p, q = row(start_a, i), row(start_b, i)
        u, v = minus(row(end_a, i), p), minus(row(end_b, i), q)
        w = minus(q, p)  # seen from p, so that no digits are lost far from the origin
        distance, s, t = nearest_parameters(u, w, v)
        difference = minus(scaled(s, u), along(w, t, v))
        if distance > max(TINY, TOUCHING * (length(u) + length(v))):
            n = scaled(1.0 / distance, difference)
        else:
            n = normal_of_touching(u, v, difference)
        gap[i] = distance - (radius_a[i] + radius_b[i])
        a = along(along(p, s, u), -radius_a[i], n)
        b = along(along(q, t, v), radius_b[i], n)
        for k in range(3):
            normal[i, k] = n[k]
            point_a[i, k] = a[k]
            point_b[i, k] = b[k]


def warm() -> None:
    """Compile the kernels."""
    import numpy as np

    x, r = np.eye(3), np.ones(3)
    for array in (x, r):
        array.flags.writeable = False
    closest_capsules(x, x, r, x, x, r, np.empty(3), *np.empty((3, 3, 3)))
