"""Sweep and prune: sort the boxes along one axis, and test those whose intervals overlap there."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray, failure, written
from course.detection.brute_force import HUGE, bounds_of, pairs_by, size_of
from course.shapes import AABB


def sweep_and_prune(boxes: AABB) -> IntArray:
    """The pairs of boxes that overlap or touch, by a sweep along the axis of the widest spread.

    In the order of l along that axis a box meets those after it for as long as
    l_j <= u_i; only these are tested on the two other axes.

    Source: D. Baraff, *Dynamic Simulation of Non-Penetrating Rigid Bodies*, Cornell
    1992; Ericson, *Real-Time Collision Detection*, section 7.5.

    Args:
        boxes: AABB of batch (n,) [m]; they may reach to infinity.
    Returns:
        (m, 2) ints, i < j, sorted by i, then j.
    Raises:
        ValueError: anything else than boxes with one batch axis.
    """
    return pairs_by(_swept, boxes)


def sweep_axis(bounds: Array) -> int:
    """The axis along which the centres of boxes (n, 6) vary most; 0 of no box."""
    if not len(bounds):
        return 0
    return int(np.argmax(np.var(bounds[:, :3] + bounds[:, 3:], axis=0)))


def _swept(bounds: Array) -> IntArray:
    from course.detection.pair_loops import sorted_pairs
    from course.detection.sweeping_loops import sweep

    axis = sweep_axis(bounds)
    order = np.argsort(bounds[:, axis], kind="stable")
    return sorted_pairs(sweep(bounds, order, axis)[0], len(bounds))


class CoherentSweep:
    """Sweep and prune that remembers the order of the last frame.

    From frame to frame boxes move little: the old order is nearly sorted, and an
    insertion sort mends it in n steps and one swap of neighbours for each two boxes
    that have passed each other. Boxes that jump cost up to n swaps each.

    Source: J. D. Cohen, M. C. Lin, D. Manocha, M. K. Ponamgi, "I-COLLIDE", 1995.

    Args:
        axis: 0, 1 or 2, along which it sweeps; None: the widest spread of the first
            frame.

    Attributes:
        order: (n,), the boxes by their lower bound along the axis; None before the
            first frame.
        swaps: how many the last frame took: 0 in a frame that sorts anew, as the first
            does and every one with another number of boxes.
        tests: how many pairs the last frame tested on all axes.
    """

    def __init__(self, *, axis: int | None = None) -> None:
        if axis is not None and axis not in (0, 1, 2):
            raise failure("axis", "0, 1, 2 or None", written(axis))
        self.axis = axis
        self.order: IntArray | None = None
        self.swaps = 0
        self.tests = 0

    def pairs(self, boxes: AABB) -> IntArray:
        """The pairs of this frame, as ``sweep_and_prune`` gives them.

        Args:
            boxes: AABB of batch (n,) [m]; box i is the same body in every frame.
        """
        from course.detection.pair_loops import sorted_pairs
        from course.detection.sweeping_loops import insertion_sort, sweep

        bounds = bounds_of(boxes)
        if self.axis is None:
            self.axis = sweep_axis(bounds) if size_of(bounds) < HUGE else 0
        keys = np.ascontiguousarray(bounds[:, self.axis])
        if self.order is None or self.order.size != keys.size:
            self.order, self.swaps = np.argsort(keys, kind="stable"), 0
        else:
            self.swaps = insertion_sort(keys, self.order)
        found, self.tests = sweep(bounds, self.order, self.axis)
        return sorted_pairs(found, keys.size)
