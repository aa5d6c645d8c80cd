"""Upright boxes that lie on one another or on the ground: four contacts for each pair of faces."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike, IntArray, positive, vectors
from course.overlap.contact_arrays import Contacts

UP = np.array([0.0, 0.0, 1.0])
#: The corners of a square of side 2, in the order in which corners are counted.
FOUR = np.array([(1, 1, 0), (-1, 1, 0), (-1, -1, 0), (1, -1, 0)])
#: What counts as the same height, or as an overlap, relative to the size of a box.
CLOSE = 1e-9


def supports(lower: ArrayLike, size: ArrayLike) -> tuple[IntArray, IntArray]:
    """(upper, lower) of all boxes of one size of which one lies on the other with some area.

    Args:
        lower: the corner of each box with the least coordinates, (n, 3) [m].
        size: edges of every box, (3,) [m].
    Returns:
        Two arrays of indices, sorted by the upper box, then by the lower one.
    """
    from scipy.spatial import cKDTree

    low = vectors("lower", lower) / positive("size", vectors("size", size))
    near = cKDTree(low).query_pairs(1 + CLOSE, p=np.inf, output_type="ndarray")
    first, second = near.reshape(-1, 2).T
    above = low[first, 2] > low[second, 2]
    over, under = np.where(above, (first, second), (second, first))
    apart = np.abs(low[over] - low[under])
    on = (apart[:, 2] > 1 - CLOSE) & np.all(apart[:, :2] < 1 - CLOSE, axis=1)
    over, under = over[on], under[on]
    order = np.lexsort((under, over))
    return over[order], under[order]


def stacked_box_contacts(lower: ArrayLike, size: ArrayLike) -> Contacts:
    """The corners of all faces of boxes of one size that lie on another or on the ground z = 0.

    Args:
        lower: the corner of each box with the least coordinates, (n, 3) [m].
        size: edges of every box, (3,) [m].
    Returns:
        Those with the ground first, which is body n; four for each face, N upward.
    """
    low, edges = vectors("lower", lower), vectors("size", size)
    over, under = supports(low, edges)
    ground = np.flatnonzero(low[:, 2] <= CLOSE * edges[2])
    upper = np.concatenate([ground, over])
    rests_on = np.concatenate([np.full(ground.size, len(low)), under])
    below = np.concatenate([low[ground], low[under]])
    start, end = np.maximum(low[upper], below), np.minimum(low[upper], below) + edges
    point = _corners(start, end)
    point[:, :, 2] = low[upper, None, 2]
    count = 4 * upper.size
    return Contacts(
        np.repeat(upper, 4),
        np.repeat(rests_on, 4),
        point.reshape(-1, 3),
        np.broadcast_to(UP, (count, 3)),
        np.zeros(count),
    )


def _corners(start: Array, end: Array) -> Array:
    """The corners of rectangles from their least to their greatest coordinates, (k, 4, 3)."""
    at = 0.5 * (FOUR + (1, 1, 0))
    return np.asarray(start[:, None] * (1 - at) + end[:, None] * at)
