"""Space cut in two again and again: kd-trees and BSP trees of boxes (syllabus row 13)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array, ArrayLike, IntArray, failure, vectors, written
from course.detection.brute_force import HUGE, bounds_of, pairs_by, size_of
from course.shapes import AABB


def kd_tree(boxes: AABB) -> IntArray:
    """The pairs of boxes that overlap or touch, by a kd-tree: planes across x, y, z in turn.

    Each plane goes through the median of the middles of a cell's boxes; a pair is
    tested where both boxes reach into one cell.

    Source: J. L. Bentley, "Multidimensional binary search trees used for associative
    searching", 1975; Ericson, *Real-Time Collision Detection*, section 7.3.

    Args:
        boxes: AABB of batch (n,) [m]; they may reach to infinity.
    Returns:
        (m, 2) ints, i < j, sorted by i, then j.
    Raises:
        ValueError: anything else than boxes with one batch axis.
    """
    return pairs_by(_by_axes, boxes)


def bsp_tree(boxes: AABB) -> IntArray:
    """The pairs of boxes that overlap or touch, by a BSP tree: planes of any direction.

    Each plane goes through the median along one of four directions: the axes, and the
    one along which the centres of the cell vary most. The one that leaves the fewest
    pairs to test is taken, n_left^2 + n_right^2, a box that is cut counted twice.

    Source: H. Fuchs, Z. M. Kedem, B. F. Naylor, "On Visible Surface Generation by a
    Priori Tree Structures", 1980; Ericson, *Real-Time Collision Detection*, chapter 8.

    Args:
        boxes: AABB of batch (n,) [m]; they may reach to infinity.
    Returns:
        (m, 2) ints, i < j, sorted by i, then j.
    Raises:
        ValueError: anything else than boxes with one batch axis.
    """
    return pairs_by(_by_planes, boxes)


def _by_axes(bounds: Array) -> IntArray:
    return Partition.build(AABB(bounds[:, :3], bounds[:, 3:]), oblique=False).pairs()


def _by_planes(bounds: Array) -> IntArray:
    return Partition.build(AABB(bounds[:, :3], bounds[:, 3:]), oblique=True).pairs()


@dataclass(frozen=True, eq=False)
class Partition:
    """A tree of planes; its leaves are cells that fill space, each with the boxes that reach into it.

    The nodes are numbered as a walk from the root, node 0, meets them, left before
    right. A point is left of a plane where n.x < d.

    Attributes:
        boxes: AABB of batch (n,) [m].
        planes: (nodes, 4), n (unit) and d [m]; 0 of a leaf.
        right: (nodes,), the child right of the plane; -1 of a leaf. The left one is the
            next node.
        ranges: (nodes, 2), of a leaf where in held its boxes are.
        held: the boxes of all leaves, a box once for each cell it reaches into.
        tests: how many pairs of boxes share a cell, counted once a cell.
    """

    boxes: AABB
    planes: Array
    right: IntArray
    ranges: IntArray
    held: IntArray
    tests: int

    @classmethod
    def build(cls, boxes: AABB, *, oblique: bool) -> Partition:
        """Cut space by finite boxes of batch (n,): as ``bsp_tree`` if oblique, else as ``kd_tree``.

        Raises:
            ValueError: no row of boxes; coordinates beyond 1e100 m.
        """
        from course.detection.partition_loops import cut

        bounds = bounds_of(boxes)
        if size_of(bounds) >= HUGE:
            raise failure("boxes", f"coordinates below {HUGE:g}", written(size_of(bounds)))  # fmt: skip
        planes, right, ranges, held, tests = cut(bounds, bool(oblique))
        for array in (planes, right, ranges, held):
            array.setflags(write=False)
        return cls(boxes, planes, right, ranges, held, int(tests))

    def pairs(self) -> IntArray:
        """The pairs of the boxes that overlap or touch, sorted."""
        from course.detection.pair_loops import sorted_pairs
        from course.detection.partition_loops import cell_pairs

        bounds = bounds_of(self.boxes)
        tree = (self.planes, self.right, self.ranges, self.held)
        return sorted_pairs(cell_pairs(bounds, *tree), len(bounds))

    def cell_of(self, points: ArrayLike) -> IntArray:
        """The leaf whose cell holds each point, (...).

        Args:
            points: (..., 3) [m].
        """
        x = vectors("points", points)
        node = np.zeros(x.shape[:-1], dtype=np.intp)
        while np.any(inner := self.right[node] >= 0):
            n = self.planes[node]
            along = n[..., 0] * x[..., 0] + n[..., 1] * x[..., 1] + n[..., 2] * x[..., 2]  # fmt: skip
            below = np.where(along < n[..., 3], node + 1, self.right[node])
            node = np.where(inner, below, node)
        return node
