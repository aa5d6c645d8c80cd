"""Every pair tested: what all other broad phases must equal, and what every one of them begins with."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from course.arrays import Array, IntArray, failure
from course.shapes import AABB

#: How many pairs a block of ``all_pairs`` tests at once.
BLOCK = 1 << 20
#: Coordinates beyond it are scaled down, so that no area or length overflows.
HUGE = 1e100
SCALE = 2.0**-900


def all_pairs(boxes: AABB) -> IntArray:
    """The pairs of boxes that overlap or touch, by testing all n(n - 1)/2.

    i and j overlap where l_i <= u_j and l_j <= u_i on each of the three axes.

    Source: Ericson, *Real-Time Collision Detection*, sections 4.2.1 and 7.1.

    Args:
        boxes: AABB of batch (n,) [m]; they may reach to infinity.
    Returns:
        (m, 2) ints, i < j, sorted by i, then j.
    Raises:
        ValueError: anything else than boxes with one batch axis.
    """
    bounds = bounds_of(boxes)
    n, lower, upper = boxes.count, bounds[:, :3].T, bounds[:, 3:].T
    found, begin = [np.empty((0, 2), dtype=np.intp)], 0
    while begin < n:
        end = min(n, begin + max(1, BLOCK // (n - begin)))
        meet = np.arange(begin, end)[:, None] < np.arange(begin, n)
        for low, high in zip(lower, upper, strict=True):
            meet &= low[begin:end, None] <= high[begin:]
            meet &= low[begin:] <= high[begin:end, None]
        found.append(np.argwhere(meet) + begin)
        begin = end
    return np.concatenate(found)


def bounds_of(boxes: AABB, name: str = "boxes") -> Array:
    """l and u side by side, (n, 6); refuses all but AABBs with one batch axis."""
    if not isinstance(boxes, AABB):
        raise failure(name, "AABB of batch (n,)", type(boxes).__name__)
    if len(boxes.batch) != 1:
        raise failure(name, "AABB of batch (n,)", f"batch {boxes.batch}")
    return np.concatenate([boxes.lower, boxes.upper], axis=1)


def pairs_by(search: Callable[[Array], IntArray], boxes: AABB) -> IntArray:
    """The pairs that a search of finite boxes finds, for any boxes.

    Boxes that reach to infinity are tested against all others. Huge coordinates are
    scaled by a power of two, which loses no pair and at most digits near 0: those
    pairs are tested again.
    """
    bounds = bounds_of(boxes)
    largest = size_of(bounds)
    if largest < HUGE:
        return search(bounds)
    finite = np.isfinite(bounds).all(axis=1)
    inside = np.flatnonzero(finite)
    pairs = inside[search(bounds[finite] * SCALE)]
    pairs = pairs[overlapping(bounds, pairs[:, 0], pairs[:, 1])]
    endless = [
        np.column_stack([np.full(others.size, i), others])
        for i in np.flatnonzero(~finite).tolist()
        for others in [_partners(bounds, finite, i)]
    ]
    return in_order(np.concatenate([pairs, *endless]))


def size_of(bounds: Array) -> float:
    """The largest coordinate, without its sign; 0 of no box."""
    return max(bounds.max(), -bounds.min()) if bounds.size else 0.0


def overlapping(bounds: Array, i: Any, j: Any) -> Any:
    """Whether boxes i and j overlap or touch."""
    a, b = bounds[i], bounds[j]
    return np.all((a[..., :3] <= b[..., 3:]) & (b[..., :3] <= a[..., 3:]), axis=-1)


def in_order(pairs: IntArray) -> IntArray:
    """Pairs either way round, as i < j, sorted."""
    pairs = np.sort(pairs, axis=1)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def _partners(bounds: Array, finite: Any, i: int) -> IntArray:
    """Whom an endless box overlaps, of the endless ones only those after it."""
    meets = overlapping(bounds, i, slice(None))
    meets[: i + 1] &= finite[: i + 1]
    return np.flatnonzero(meets)
