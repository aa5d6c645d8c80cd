"""A grid of cubes in loops: each box is entered in every cell it reaches into.

Two boxes may share several cells. Their pair belongs to the one that holds the lower
corner of what they have in common, p = max(l_i, l_j). On each axis that is the first cell
of one of the two boxes: an entry keeps a bit for each axis along which its cell is its box's
first, and a pair is tested only where the bits of both make up all three.

Cells are kept in a table of buckets, cell number modulo their count. Cells that share a
bucket are told apart by their numbers.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray
from course.detection.pair_loops import overlap, room_for
from course.jit import compiled


@compiled
def cells_of(
    bounds: Array, origin: Array, cell_size: float
) -> tuple[IntArray, IntArray]:
    """First and last cell of each box, (n, 6) whole numbers from 0, and how many cells it reaches into, (n,)."""
    cells = np.empty(bounds.shape, dtype=np.int64)
    counts = np.empty(bounds.shape[0], dtype=np.int64)
    for i in range(counts.size):
        number = 1.0
        for k in range(3):
            cells[i, k] = int((bounds[i, k] - origin[k]) / cell_size)
            cells[i, k + 3] = int((bounds[i, k + 3] - origin[k]) / cell_size)
            number *= cells[i, k + 3] - cells[i, k] + 1
        counts[i] = int(min(number, 1e18))
    return cells, counts


@compiled
def table_of(
    cells: IntArray, counts: IntArray
) -> tuple[IntArray, IntArray, IntArray, IntArray]:
    """The entries of boxes in their cells, sorted by bucket (a counting sort).

    Returns:
        start: (buckets + 1,), where each bucket's entries begin.
        box, cell, first: (entries,), the box, the number of its cell, and the bits of
            the axes along which it is the box's first.
    """
    entries = counts.sum()
    buckets = 1
    while buckets < entries:
        buckets *= 2
    # Odd numbers of cells an axis: neighbours fall into different buckets.
    width = (cells[:, 3].max() + 1) | 1
    layer = width * ((cells[:, 4].max() + 1) | 1)
    start = np.zeros(buckets + 2, dtype=np.int64)
    box, first = np.empty(entries, dtype=np.int32), np.empty(entries, dtype=np.uint8)
    cell = np.empty(entries, dtype=np.int64)
    for filling in (False, True):
        for i in range(counts.size):
            for z in range(cells[i, 2], cells[i, 5] + 1):
                for y in range(cells[i, 1], cells[i, 4] + 1):
                    for x in range(cells[i, 0], cells[i, 3] + 1):
                        number = x + width * y + layer * z
                        bucket = number & (buckets - 1)
                        if not filling:
                            start[bucket + 2] += 1
                            continue
                        e = start[bucket + 1]
                        start[bucket + 1] += 1
                        box[e], cell[e] = i, number
                        first[e] = (
                            (x == cells[i, 0])
                            | (y == cells[i, 1]) << 1
                            | (z == cells[i, 2]) << 2
                        )
        if not filling:
            for b in range(2, buckets + 2):
                start[b] += start[b - 1]
    return start[: buckets + 1], box, cell, first


@compiled
def grid_pairs(
    bounds: Array, start: IntArray, box: IntArray, cell: IntArray, first: IntArray
) -> tuple[IntArray, int]:
    """The pairs of boxes that overlap, (m, 2), each once, in no order; how many were tested."""
    found, count = np.empty((2 * bounds.shape[0] + 16, 2), dtype=np.int32), 0
    tests = 0
    for bucket in range(start.size - 1):
        for e in range(start[bucket], start[bucket + 1]):
            for f in range(e + 1, start[bucket + 1]):
                if (first[e] | first[f]) != 7 or cell[e] != cell[f]:
                    continue
                tests += 1
                if overlap(bounds, box[e], bounds, box[f]):
                    found = room_for(found, count)
                    found[count, 0], found[count, 1] = box[e], box[f]
                    count += 1
    return found[:count], tests


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    from course.detection.grid import uniform_grid
    from course.shapes import AABB

    uniform_grid(AABB(np.zeros((2, 3)), np.ones((2, 3))))
