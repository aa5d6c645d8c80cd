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

import math

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.manifold.labels import POINT, SEPARATION, WIDTH

#: Lengths and areas that differ by less are alike, relative.
ALIKE = 1e-6


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
        order: room for ``limit`` + 1 indices.
    Returns:
        How many stay.
    """
    if count <= limit:
        return count
    order[0] = deepest(numbers, begin, count, bias)
    chosen = 1
    while chosen < limit:
        best, most = -1, 0.0
        for k in range(begin, begin + count):
            if contains(order, chosen, k):
                continue
            gain = spread(numbers, order, chosen, k)
            if best < 0 or gain > most * (1.0 + ALIKE):
                best, most = k, gain
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
def contains(order: IntArray, chosen: int, k: int) -> bool:
    """Whether k is among the first so many."""
    for at in range(chosen):
        if order[at] == k:
            return True
    return False


@compiled
def spread(numbers: Array, order: IntArray, chosen: int, k: int) -> float:
    """The distance from the first point; once there are two, the area of their polygon with k."""
    first = order[0]
    if chosen == 1:
        x = numbers[k, POINT] - numbers[first, POINT]
        y = numbers[k, POINT + 1] - numbers[first, POINT + 1]
        z = numbers[k, POINT + 2] - numbers[first, POINT + 2]
        return math.sqrt(x * x + y * y + z * z)
    order[chosen] = k
    x = y = z = 0.0
    here = next_above(order, chosen + 1, -1)
    start = here
    while True:
        there = next_above(order, chosen + 1, here)
        last = there < 0
        if last:
            there = start
        px, py, pz = seen_from(numbers, here, first)
        qx, qy, qz = seen_from(numbers, there, first)
        x, y, z = x + py * qz - pz * qy, y + pz * qx - px * qz, z + px * qy - py * qx
        if last:
            return 0.5 * math.sqrt(x * x + y * y + z * z)
        here = there


@compiled
def next_above(order: IntArray, count: int, after: int) -> int:
    """The least of the indices above one; -1 if there is none."""
    best = -1
    for at in range(count):
        if order[at] > after and (best < 0 or order[at] < best):
            best = order[at]
    return best


@compiled
def seen_from(numbers: Array, k: int, first: int) -> tuple[float, float, float]:
    """From the first point to point k."""
    return (
        numbers[k, POINT] - numbers[first, POINT],
        numbers[k, POINT + 1] - numbers[first, POINT + 1],
        numbers[k, POINT + 2] - numbers[first, POINT + 2],
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
