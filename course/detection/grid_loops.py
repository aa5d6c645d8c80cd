"""A grid of cubes in loops: boxes sorted by the cell of their lower corner.

No box is wider than a cell. The lower corners of two that overlap are then in one cell or in
neighbours, and of each two neighbouring cells one asks the other: its own, the next along x,
and three in each of four rows. Cells are numbered along x, then y, then z, so that a row's
three lie side by side in the sorted order, and as the cell that asks goes up, so does what
it asks: one finger a row follows it. No table of cells is needed, and empty ones cost nothing.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array
from course.detection.hierarchy_walks import in_tree_order
from course.detection.pair_loops import (
    DIGIT,
    Whole,
    new_list,
    overlap,
    radix_order,
    room_for,
)
from course.jit import compiled


@compiled
def cell_numbers(bounds: Array, cell_size: float) -> tuple[Whole, int, int]:
    """The number of the cell of each box's lower corner, (n,), and how much it grows by a row and by a layer."""
    n = bounds.shape[0]
    origin, most = np.zeros(3), np.zeros(3, dtype=np.int64)
    for k in range(3):
        origin[k] = bounds[:, k].min()
        most[k] = int((bounds[:, k].max() - origin[k]) / cell_size)
    # One cell more a row and a row more a layer: beyond the last there is nobody.
    row = most[0] + 2
    layer = row * (most[1] + 2)
    cells = np.empty(n, dtype=np.int64)
    for i in range(n):
        x = int((bounds[i, 0] - origin[0]) / cell_size)
        y = int((bounds[i, 1] - origin[1]) / cell_size)
        z = int((bounds[i, 2] - origin[2]) / cell_size)
        cells[i] = x + row * y + layer * z
    return cells, row, layer


@compiled
def bits_of(number: int) -> int:
    """How many bits of a whole number a radix sort has to look at."""
    bits = DIGIT
    while number >> bits > 0:
        bits += DIGIT
    return bits


@compiled
def grid_pairs(bounds: Array, cell_size: float) -> tuple[Whole, int]:
    """The pairs of boxes no wider than a cell, (m, 2), each once, in no order; how many were tested.

    Args:
        bounds: (n, 6) [m], n > 0.
        cell_size: [m], more than the widest box by 1e-6 of it, for rounding.
    """
    n = bounds.shape[0]
    cells, row, layer = cell_numbers(bounds, cell_size)
    order = radix_order(cells, bits_of(cells.max()))
    packed, cells = in_tree_order(bounds, order), cells[order]
    found, count = new_list(n), 0
    tests = 0
    rows = np.array([row, layer - row, layer, layer + row])
    finger = np.zeros(4, dtype=np.int64)
    for k in range(n):
        cell = cells[k]
        for r in range(5):
            if r == 4:
                first, last = k + 1, cell + 1
            else:
                while finger[r] < n and cells[finger[r]] < cell + rows[r] - 1:
                    finger[r] += 1
                first, last = finger[r], cell + rows[r] + 1
            other = first
            while other < n and cells[other] <= last:
                if overlap(packed, k, packed, other):
                    found = room_for(found, count)
                    found[count, 0], found[count, 1] = order[k], order[other]
                    count += 1
                other += 1
            tests += other - first
    return found[:count], tests


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    grid_pairs(np.array([[0.0, 0, 0, 1, 1, 1]] * 2), 1.1)
