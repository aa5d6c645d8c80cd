"""Space cut into equal cubes (syllabus row 13)."""

from __future__ import annotations

from functools import partial

import numpy as np

from course.arrays import Array, IntArray, positive, scalar
from course.detection.brute_force import pairs_by
from course.shapes import AABB

#: Boxes that are this many times as wide as half of the boxes are not entered in cells.
WIDE = 2.0
#: The most cells along an axis, so that a cell's number fits 64 bits.
LONGEST = 1 << 20
#: What a cell is wider than its widest box, so that rounding moves none two cells on.
ROUNDED_UP = 1.0 + 1e-6


def uniform_grid(boxes: AABB, *, cell_size: float | None = None) -> IntArray:
    """The pairs of boxes that overlap or touch, by a grid of equal cubes.

    Each box is entered in the cell of its lower corner, and tested against those of
    its own cell and of the 26 around it; of two neighbouring cells one asks the other.
    Boxes that are wider than a cell are put in a tree instead, which all others ask (``BVH``).

    Source: Ericson, *Real-Time Collision Detection*, section 7.1.

    Args:
        boxes: AABB of batch (n,) [m]; they may reach to infinity.
        cell_size: [m]; None: the largest extent of the boxes that are at most twice as
            wide as the median. No less than 2^-20 of the scene is taken.
    Returns:
        (m, 2) ints, i < j, sorted by i, then j.
    Raises:
        ValueError: anything else than boxes with one batch axis, a cell size that is
            not positive.
    """
    if cell_size is not None:
        cell_size = float(positive("cell_size", scalar("cell_size", cell_size)))
    return pairs_by(partial(_gridded, cell_size=cell_size), boxes)


def median_cell_size(widths: Array) -> float:
    """The largest of the widths that are at most twice their median, (n,)."""
    limit = WIDE * float(np.median(widths))
    return float(np.max(widths, where=widths <= limit, initial=0.0))


def widths_of(bounds: Array) -> Array:
    """The largest extent of each box (n, 6), (n,)."""
    x, y, z = (bounds[:, k + 3] - bounds[:, k] for k in range(3))
    return np.maximum(np.maximum(x, y), z)


def _gridded(bounds: Array, *, cell_size: float | None) -> IntArray:
    from course.detection.grid_loops import grid_pairs
    from course.detection.pair_loops import sorted_pairs

    if len(bounds) < 2:
        return np.empty((0, 2), dtype=np.intp)
    widths = widths_of(bounds)
    lower = bounds[:, :3]
    span = float(np.max(lower.max(axis=0) - lower.min(axis=0)))
    width = max(cell_size or median_cell_size(widths), span / LONGEST, 1e-290)
    small = np.flatnonzero(widths <= width)
    if small.size == len(bounds):
        found, _ = grid_pairs(bounds, width * ROUNDED_UP)
        return sorted_pairs(found, len(bounds))
    wide = np.flatnonzero(widths > width)
    parts = [wide[_met(bounds[wide], None)]]
    if small.size:
        parts.append(small[grid_pairs(bounds[small], width * ROUNDED_UP)[0]])
        asked, met = _met(bounds[wide], bounds[small]).T
        parts.append(np.column_stack([small[asked], wide[met]]))
    return sorted_pairs(np.concatenate(parts).astype(np.int32), len(bounds))


def _met(wide: Array, asked: Array | None) -> IntArray:
    """Which wide boxes the asked meet, or each other if none are asked, by a tree of them."""
    from course.detection.hierarchy import BVH
    from course.detection.hierarchy_walks import query_pairs

    tree = BVH.build(AABB(wide[:, :3], wide[:, 3:]), method="morton")
    if asked is None:
        return tree.pairs()
    return query_pairs(asked, wide, tree.reach, tree.order, tree.right, tree.ranges)[0]
