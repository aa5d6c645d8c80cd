"""Sweep and prune in loops: an insertion sort that counts, and the sweep itself.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array
from course.detection.pair_loops import Whole, new_list, overlap, room_for
from course.jit import compiled


@compiled
def insertion_sort(keys: Array, order: Whole) -> int:
    """Sort an order by its keys, in place; the number of swaps of neighbours that takes.

    Nearly sorted already, as from one frame to the next, it takes time n + swaps.
    """
    swaps = 0
    for k in range(1, order.size):
        box, place = order[k], k
        while place > 0 and keys[order[place - 1]] > keys[box]:
            order[place] = order[place - 1]
            place -= 1
        order[place] = box
        swaps += k - place
    return swaps


@compiled
def sweep(bounds: Array, order: Whole, axis: int) -> tuple[Whole, int]:
    """The pairs met by a sweep along an axis, and how many were tested on the two others.

    Args:
        bounds: (n, 6) [m].
        order: (n,), the boxes by their lower bound along the axis.
    Returns:
        (m, 2), each pair once, in no order; the number of tests.
    """
    n, count, tests = order.size, 0, 0
    sorted_bounds = np.empty((n, 6))
    for k in range(n):
        sorted_bounds[k] = bounds[order[k]]
    found = new_list(n)
    for k in range(n):
        end = sorted_bounds[k, axis + 3]
        later = k + 1
        while later < n and sorted_bounds[later, axis] <= end:
            if overlap(sorted_bounds, k, sorted_bounds, later):
                found = room_for(found, count)
                found[count, 0], found[count, 1] = order[k], order[later]
                count += 1
            later += 1
        tests += later - k - 1
    return found[:count], tests


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    order = np.arange(2)
    insertion_sort(np.array([1.0, 0.0]), order)
    sweep(np.zeros((2, 6)), order, 0)
