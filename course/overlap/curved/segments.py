"""The nearest points of two segments, also where these are parallel, cross, or are only points.

A kernel module (``course.jit``): import it where it is called.

Two lines are nearest where s = (w x v).n / n.n, n = u x v, between s u and w + t v. Clamped to the
segment, with the t that is nearest to that point, and where that is an end, the s
nearest to it: this is the answer (C. Ericson, *Real-Time Collision Detection*, section 5.1.9;
D. Sunday, "Distance between lines, segments and rays", 2001).

Nearly parallel that s has lost its digits. The squared distance is a convex quadratic of s
and t on the square 0 <= s, t <= 1, so that it is least inside or on one of the four sides,
where an end of one segment is nearest to the other: all five are tried and measured, and
nothing hangs on what counts as parallel (D. Eberly, "Robust computation of distance
between line segments", 2015). And s comes from u x v, not from u.u v.v - (u.v)^2, which has no
digits left at an angle of 1e-8.
"""

from __future__ import annotations

import math

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
#: Square of the sine of the angle below which lines are nearly parallel.
NEARLY_PARALLEL = 1e-6
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
def nearest_parameters(u: Triple, w: Triple, v: Triple) -> tuple[float, float]:
    """(s, t) of the nearest points s u and w + t v, 0 <= s, t <= 1."""
    n = cross(u, v)
    square = dot(n, n)
    if square <= NEARLY_PARALLEL * dot(u, u) * dot(v, v):
        return nearest_of_five(u, w, v)
    s = min(1.0, max(0.0, dot(cross(w, v), n) / square))
    t = nearest(scaled(s, u), w, v)
    if t == 0.0 or t == 1.0:
        s = nearest(along(w, t, v), (0.0, 0.0, 0.0), u)
    return s, t


@compiled
def nearest_of_five(u: Triple, w: Triple, v: Triple) -> tuple[float, float]:
    """The same for segments that are nearly parallel, parallel, or points."""
    zero = (0.0, 0.0, 0.0)
    best = (math.inf, 0.0, 0.0)
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
    return best[1], best[2]


@compiled
def nearer(
    best: Candidate, u: Triple, w: Triple, v: Triple, s: float, t: float
) -> Candidate:
    """The best candidate so far, or the points s u and w + t v where these are nearer."""
    distance = length(minus(scaled(s, u), along(w, t, v)))
    return (distance, s, t) if distance < best[0] else best


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
        s, t = nearest_parameters(u, w, v)
        difference = minus(scaled(s, u), along(w, t, v))
        distance = length(difference)
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


@compiled
def gaps_of_capsules(
    start_a: Array,
    end_a: Array,
    radius_a: Array,
    start_b: Array,
    end_b: Array,
    radius_b: Array,
    gap: Array,
) -> None:
    """Fill gap (n,) alone."""
    for i in range(gap.size):
        p, q = row(start_a, i), row(start_b, i)
        u, w, v = minus(row(end_a, i), p), minus(q, p), minus(row(end_b, i), q)
        s, t = nearest_parameters(u, w, v)
        distance = length(minus(scaled(s, u), along(w, t, v)))
        gap[i] = distance - (radius_a[i] + radius_b[i])


def warm() -> None:
    """Compile the kernels."""
    import numpy as np

    x, r = np.eye(3), np.ones(3)
    for array in (x, r):
        array.flags.writeable = False
    closest_capsules(x, x, r, x, x, r, np.empty(3), *np.empty((3, 3, 3)))
    gaps_of_capsules(x, x, r, x, x, r, np.empty(3))
