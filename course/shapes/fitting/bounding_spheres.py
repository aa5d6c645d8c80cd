"""Spheres around points: Ritter's quick one, and the smallest."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from course.arrays import Array, ArrayLike, choice
from course.shapes.fitting.point_sets import checked_sets, each_set
from course.shapes.sphere import Sphere


def bounding_sphere(points: ArrayLike, *, method: str = "exact") -> Sphere:
    """A sphere around each set of points: the smallest, or Ritter's.

    "ritter": from the most distant of the pairs that are extreme in x, y and z, grown by
    each point outside; one pass, typically 7 to 8 percent larger than the smallest.
    "exact": the smallest, which two to four of the points fix.
    Source: Ritter, "An efficient bounding sphere", *Graphics Gems*, 1990; Welzl, LNCS
    555, 1991, and Gartner, "Fast and robust smallest enclosing balls", ESA 1999; Ericson,
    *Real-Time Collision Detection*, section 4.3; syllabus row 3.

    Args:
        points: (..., n, 3) [m], n >= 1.
        method: "exact" or "ritter".
    Returns:
        Spheres of the batch; the radius is the distance of the farthest point.
    Raises:
        ValueError: no points, NaN or infinity, another method.
    """
    given = checked_sets(points)
    method = choice("method", method, ("exact", "ritter"))
    fit = _ritter if method == "ritter" else smallest_ball
    center, radius = each_set(given, fit, (3,), ())
    return Sphere(center, radius)


def _ritter(points: Array) -> tuple[Array, Array]:
    """Centre and radius of Ritter's sphere around (n, 3) points."""
    lowest, highest = points[points.argmin(axis=0)], points[points.argmax(axis=0)]
    widest = int(np.argmax(np.linalg.norm(highest - lowest, axis=1)))
    center = lowest[widest] + 0.5 * (highest[widest] - lowest[widest])
    radius = 0.5 * float(np.linalg.norm(highest[widest] - lowest[widest]))
    for point in points:
        distance = float(np.linalg.norm(point - center))
        if distance > radius:
            # The sphere through the point and the far end of the one so far.
            radius = 0.5 * (radius + distance)
            center = center + (1 - radius / distance) * (point - center)
    return center, np.linalg.norm(points - center, axis=1).max()


def smallest_ball(points: Array) -> tuple[Array, Array]:
    """Centre and radius of the smallest ball around points in any dimension, (n, d).

    It is fixed by at most d + 1 of them. From one point on, the farthest point outside
    joins those that fix the ball, and those that fix the larger ball stay: the radius
    grows with each step, so that no choice comes twice.

    Args:
        points: (n, d).
    Returns:
        Centre (d,) and radius.
    """
    origin = points[0]
    local = points - origin
    fixing = np.zeros(1, dtype=np.intp)
    center, radius = np.zeros(points.shape[1]), -1.0
    while True:
        distance = np.linalg.norm(local - center, axis=1)
        farthest = int(np.argmax(distance))
        if farthest in fixing and radius >= 0:
            break
        some = np.append(fixing, farthest) if radius >= 0 else fixing
        chosen, wider, reach = _ball_of_few(local[some])
        if reach <= radius:  # rounding: nothing is gained any more
            break
        fixing, center, radius = some[chosen], wider, reach
    center = origin + center
    return center, np.linalg.norm(points - center, axis=1).max()


def _ball_of_few(points: Array) -> tuple[list[int], Array, float]:
    """The points that fix the smallest ball around a few, its centre and radius.

    The smallest ball's centre is as far from all points that fix it. Of all centres so
    made, each with the radius that it needs, its is the least.
    """
    best: tuple[list[int], Array, float] = ([], points[0], np.inf)
    for size in range(1, min(len(points), points.shape[1] + 1) + 1):
        for some in combinations(range(len(points)), size):
            center = _equidistant(points[list(some)])
            reach = float(np.linalg.norm(points - center, axis=1).max())
            if reach < best[2]:
                best = list(some), center, reach
    return best


def _equidistant(points: Array) -> Array:
    """The point as far from all of some points, in the plane or line they span.

    (p_i - p_0).x = |p_i - p_0|^2 / 2, and of all such x the shortest.
    """
    arms = points[1:] - points[0]
    if not len(arms):
        return points[0]
    half = 0.5 * np.sum(arms * arms, axis=1)
    return np.asarray(points[0] + np.linalg.lstsq(arms, half, rcond=None)[0])
