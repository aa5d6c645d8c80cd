"""Space cut into equal cubes (syllabus row 13)."""

from __future__ import annotations

from functools import partial

import numpy as np

from course.arrays import Array, IntArray, positive, scalar
from course.detection.brute_force import in_order, pairs_by
from course.shapes import AABB

#: A cell is this many times as wide as half of the boxes are.
WIDTH = 2.0
#: Boxes that reach into more cells are not entered in them.
MOST_CELLS = 64
#: The most cells along an axis, so that a cell's number fits 64 bits.
LONGEST = 1 << 20


def uniform_grid(boxes: AABB, *, cell_size: float | None = None) -> IntArray:
    """The pairs of boxes that overlap or touch, by a grid of equal cubes.

    Each box is entered in all cells it reaches into, and pairs are tested cell by cell.
    The few boxes that are far wider than a cell, of more than 64 cells, ask a tree of
    all instead (``BVH``).

    Source: Ericson, *Real-Time Collision Detection*, section 7.1.

    Args:
        boxes: AABB of batch (n,) [m]; they may reach to infinity.
        cell_size: [m]; None: twice the median of the boxes' largest extents. No less than
            2^-20 of the scene is taken.
    Returns:
        (m, 2) ints, i < j, sorted by i, then j.
    Raises:
        ValueError: anything else than boxes with one batch axis, a cell size that is
            not positive.
    """
    if cell_size is not None:
        cell_size = float(positive("cell_size", scalar("cell_size", cell_size)))
    return pairs_by(partial(_gridded, cell_size=cell_size), boxes)


def median_cell_size(bounds: Array) -> float:
    """Twice the median of the largest extents of boxes (n, 6); of points, what leaves one in each cell."""
    extents = bounds[:, 3:] - bounds[:, :3]
    half_are = float(np.median(np.maximum(np.maximum(*extents.T[:2]), extents[:, 2])))
    if half_are > 0.0:
        return WIDTH * half_are
    return _span(bounds) / len(bounds) ** (1 / 3) or 1.0


def _span(bounds: Array) -> float:
    return float(np.max(bounds[:, 3:].max(axis=0) - bounds[:, :3].min(axis=0)))


def _gridded(bounds: Array, *, cell_size: float | None) -> IntArray:
    from course.detection.grid_loops import cells_of, grid_pairs, table_of
    from course.detection.pair_loops import sorted_pairs

    if len(bounds) < 2:
        return np.empty((0, 2), dtype=np.intp)
    least = max(_span(bounds) / LONGEST, 1e-300)
    width = max(cell_size or median_cell_size(bounds), least)
    cells, counts = cells_of(bounds, bounds[:, :3].min(axis=0), width)
    small = np.flatnonzero(counts <= MOST_CELLS)
    if small.size == len(bounds):
        found, _ = grid_pairs(bounds, *table_of(cells, counts))
        return sorted_pairs(found, len(bounds))
    large = np.flatnonzero(counts > MOST_CELLS)
    pairs = [_of_large(bounds, large)]
    if small.size:
        table = table_of(cells[small], counts[small])
        found, _ = grid_pairs(bounds[small], *table)
        pairs.append(small[found])
    return in_order(np.concatenate(pairs))


def _of_large(bounds: Array, large: IntArray) -> IntArray:
    """The pairs that have a large box in them."""
    from course.detection.hierarchy import BVH

    boxes = AABB(bounds[:, :3], bounds[:, 3:])
    asked = BVH.build(boxes, method="morton").query(boxes[large])
    i, j = large[asked[:, 0]], asked[:, 1]
    is_large = np.zeros(len(bounds), dtype=bool)
    is_large[large] = True
    once = (i < j) | ~is_large[j]
    return np.column_stack([i, j])[once & (i != j)]
