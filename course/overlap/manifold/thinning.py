"""At most so many points of a manifold: the deepest first, then the widest area.

Source: C. Ericson, *Real-Time Collision Detection*, section 5.5 (few contact points), and
the reduction that physics engines make (E. Coumans, "Contact generation", GDC 2010): the
deepest point, the one farthest from it, then always the one that adds most area.

What an octagon loses is geometry: its four widest corners hold 1/sqrt(2) of its area, and
a load over the rest tips it. Ties go to the first point, by a relative bias, so that the
choice is the same from frame to frame.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.manifold.labels import POINT, SEPARATION, WIDTH

#: Squares of lengths and areas that differ by less are alike, relative.
ALIKE = 2e-6


@compiled
def thin(
    names: IntArray,
    numbers: Array,
    begin: int,
    count: int,
    limit: int,
    bias: float,
    order: IntArray,
) -> int:
    """Move the points to be kept to the front, deepest first.

    Args:
        names, numbers: tables (``labels``); ``count`` rows from ``begin`` on are the
            corners of a convex polygon in its order.
        limit: how many may stay, at least 1.
        bias: separations that differ by less are alike [m].
        order: room for ``limit`` indices.
    Returns:
        How many stay.
    """
    if count <= limit:
        return count
    order[0] = deepest(numbers, begin, count, bias)
    chosen = 1
    while chosen < limit:
        best, most = -1, -1.0
        for k in range(begin, begin + count):
            more = gain(numbers, order, chosen, k)
            if more > most + ALIKE * abs(most):
                best, most = k, more
        if best < 0:  # not before all are chosen
            break
        order[chosen] = best
        chosen += 1
    for k in range(limit):
        swap(names, numbers, begin + k, order[k])
        for later in range(k + 1, limit):  # what lay there is at order[k] now
            if order[later] == begin + k:
                order[later] = order[k]
    return limit


@compiled
def deepest(numbers: Array, begin: int, count: int, bias: float) -> int:
    """The first of the deepest rows."""
    least = np.inf
    for k in range(begin, begin + count):
        least = min(least, numbers[k, SEPARATION])
    for k in range(begin, begin + count):
        if numbers[k, SEPARATION] <= least + bias:
            return k
    return begin


@compiled
def gain(numbers: Array, order: IntArray, chosen: int, k: int) -> float:
    """What point k adds: its distance from the first; once there are two, the area beyond the polygon they make.

    That is a triangle: k, the last point before it that is chosen, and the next after it.
    The squares of both are returned; -1 for a point that is chosen already.
    """
    before, after, least, most = -1, -1, order[0], order[0]
    for at in range(chosen):
        i = order[at]
        if i == k:
            return -1.0
        least, most = min(least, i), max(most, i)
        if i < k and i > before:
            before = i
        if i > k and (after < 0 or i < after):
            after = i
    before, after = before if before >= 0 else most, after if after >= 0 else least
    px, py, pz = seen_from(numbers, k, before)
    if chosen == 1:
        return px * px + py * py + pz * pz
    qx, qy, qz = seen_from(numbers, k, after)
    x, y, z = py * qz - pz * qy, pz * qx - px * qz, px * qy - py * qx
    return x * x + y * y + z * z


@compiled
def seen_from(numbers: Array, k: int, other: int) -> tuple[float, float, float]:
    """From another point to point k."""
    return (
        numbers[k, POINT] - numbers[other, POINT],
        numbers[k, POINT + 1] - numbers[other, POINT + 1],
        numbers[k, POINT + 2] - numbers[other, POINT + 2],
    )


@compiled
def swap(names: IntArray, numbers: Array, i: int, k: int) -> None:
    """Exchange two rows."""
    for column in range(WIDTH):
        numbers[i, column], numbers[k, column] = numbers[k, column], numbers[i, column]
    for column in range(5):
        names[i, column], names[k, column] = names[k, column], names[i, column]


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    rows = np.zeros((3, 5), dtype=np.intp), np.zeros((3, WIDTH))
    thin(*rows, 0, 3, 2, 0.0, np.zeros(3, dtype=np.intp))
