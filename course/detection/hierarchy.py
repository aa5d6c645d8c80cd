"""Bounding volume hierarchies over boxes (syllabus row 8): a tree whose nodes bound all below them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from course.arrays import (
    Array,
    BoolArray,
    IntArray,
    choice,
    failure,
    non_negative,
    scalar,
    shaped,
    whole_number,
)
from course.detection.brute_force import (
    HUGE,
    SCALE,
    bounds_of,
    pairs_by,
    size_of,
)
from course.shapes import AABB

#: How a range of boxes is split in two, as ``hierarchy_builds`` numbers them.
METHODS = ("median", "surface_area", "morton")
LEAF_SIZE = 4


def bvh(boxes: AABB) -> IntArray:
    """The pairs of boxes that overlap or touch, by a bounding volume hierarchy in Morton order.

    Source: Ericson, *Real-Time Collision Detection*, chapter 6; T. Karras, "Maximizing
    Parallelism in the Construction of BVHs, Octrees, and k-d Trees", 2012.

    Args:
        boxes: AABB of batch (n,) [m]; they may reach to infinity.
    Returns:
        (m, 2) ints, i < j, sorted by i, then j.
    Raises:
        ValueError: anything else than boxes with one batch axis.
    """
    return pairs_by(_paired, boxes)


def _paired(bounds: Array) -> IntArray:
    from course.detection.hierarchy_walks import self_pairs
    from course.detection.pair_loops import sorted_pairs

    tree = _built(bounds, METHODS.index("morton"), LEAF_SIZE)
    found, _ = self_pairs(bounds, _fitted(bounds, *tree), *tree)
    return sorted_pairs(found, len(bounds))


def _built(
    bounds: Array, method: int, leaf_size: int
) -> tuple[IntArray, IntArray, IntArray]:
    """Order, right and ranges, as ``BVH`` has them."""
    from course.detection.hierarchy_builds import build

    tree = build(bounds, method, leaf_size)
    for array in tree:
        array.setflags(write=False)
    return tree


def _fitted(bounds: Array, order: IntArray, right: IntArray, ranges: IntArray) -> Array:
    """The bounds of the nodes, as ``BVH`` has them; nobody writes to them."""
    from course.detection.hierarchy_builds import fit

    reach = fit(bounds, order, right, ranges)
    reach.setflags(write=False)
    return reach


@dataclass(frozen=True, eq=False)
class BVH:
    """A binary tree over boxes; each node bounds the boxes below it.

    The nodes are numbered as a walk from the root, node 0, meets them, left before
    right: children come after their parents, the left one at once. Node k holds the
    boxes order[ranges[k, 0]:ranges[k, 1]].

    Source: Ericson, *Real-Time Collision Detection*, chapter 6; syllabus row 8.

    Attributes:
        boxes: AABB of batch (n,) [m], finite.
        order: (n,), the boxes as the leaves hold them.
        right: (nodes,), the right child; -1 of a leaf.
        ranges: (nodes, 2), first place in the order and one past the last.
        reach: (nodes, 6), l and u of the nodes' bounds [m].
    """

    boxes: AABB
    order: IntArray
    right: IntArray
    ranges: IntArray
    reach: Array

    @classmethod
    def build(
        cls, boxes: AABB, *, method: str = "surface_area", leaf_size: int = LEAF_SIZE
    ) -> BVH:
        """A tree over boxes, from above.

        Args:
            boxes: AABB of batch (n,) [m].
            method: how a range of boxes is split. "median": half of them on either side
                along the longest axis of their centres; "surface_area": by the bin of
                centres that makes A_left n_left + A_right n_right least, slower to
                build, quicker to ask; "morton": at the highest bit of sorted Morton
                codes, by far the quickest to build.
            leaf_size: the most boxes of a leaf (coinciding centres are halved as well).
        Raises:
            ValueError: boxes that reach to infinity, no row of boxes, another method.
        """
        bounds = _finite(boxes)
        number = METHODS.index(choice("method", method, METHODS))
        most = whole_number("leaf_size", leaf_size, minimum=1)
        large = size_of(bounds) >= HUGE
        tree = _built(bounds * SCALE if large else bounds, number, most)
        return cls(boxes, *tree, _fitted(bounds, *tree))

    def refit(self, boxes: AABB) -> BVH:
        """The same tree around boxes that have moved: its bounds from the leaves up, in n steps.

        Right at once, but worse the farther they have moved: ``cost`` tells.

        Args:
            boxes: AABB of batch (n,) [m], as many as there were.
        Raises:
            ValueError: another number of boxes, or such that reach to infinity.
        """
        bounds = _finite(boxes)
        shaped("boxes", boxes.lower, self.boxes.lower.shape)
        tree = (self.order, self.right, self.ranges)
        return replace(self, boxes=boxes, reach=_fitted(bounds, *tree))

    @property
    def children(self) -> IntArray:
        """Left and right child of each node, (nodes, 2); -1 of a leaf."""
        left = np.where(self.is_leaf, -1, np.arange(1, self.right.size + 1))
        return np.column_stack([left, self.right]).astype(np.intp)

    @property
    def is_leaf(self) -> BoolArray:
        """Which nodes are leaves, (nodes,)."""
        return self.right < 0

    @property
    def bounds(self) -> AABB:
        """The bounds of the nodes, of batch (nodes,) [m]."""
        return AABB(self.reach[:, :3], self.reach[:, 3:])

    @property
    def depth(self) -> IntArray:
        """How many nodes stand above each, (nodes,): 0 of the root."""
        depth = np.zeros(self.right.size, dtype=np.intp)
        for node in np.flatnonzero(~self.is_leaf):
            depth[[node + 1, self.right[node]]] = depth[node] + 1
        return depth

    def pairs(self) -> IntArray:
        """The pairs of the tree's own boxes, as ``bvh`` gives them."""
        from course.detection.pair_loops import sorted_pairs

        return sorted_pairs(self._walked()[0], self.boxes.count)

    def tests(self) -> int:
        """How often ``pairs`` asks whether a leaf overlaps a node."""
        return int(self._walked()[1])

    def _walked(self) -> tuple[IntArray, int]:
        from course.detection.hierarchy_walks import self_pairs

        tree = (self.order, self.right, self.ranges)
        return self_pairs(bounds_of(self.boxes), self.reach, *tree)

    def query(self, boxes: AABB) -> IntArray:
        """Which boxes of the tree each of other boxes overlaps or touches.

        Args:
            boxes: AABB of batch (q,) [m]; they may reach to infinity.
        Returns:
            (m, 2) ints, the number of the asked and that of the tree's box, sorted.
        """
        from course.detection.hierarchy_walks import query_pairs

        tree = (self.reach, self.order, self.right, self.ranges)
        found, _ = query_pairs(bounds_of(boxes), bounds_of(self.boxes), *tree)
        by_both = np.lexsort((found[:, 1], found[:, 0]))
        return found[by_both].astype(np.intp)

    def cost(self, *, node_cost: float = 1.0) -> float:
        """What a random query costs, in tests of boxes: sum over nodes of A/A_root x what is tested there.

        A small query box that meets the root meets a node with a probability that is
        near the ratio of their surface areas; there it tests two children (node_cost)
        or the boxes of a leaf, 1 each.

        Source: J. D. MacDonald, K. S. Booth, "Heuristics for Ray Tracing Using Space
        Subdivision", 1990.
        """
        from course.detection.hierarchy_walks import surface_area_cost

        each = float(non_negative("node_cost", scalar("node_cost", node_cost)))
        large = size_of(self.reach) >= HUGE
        reach = self.reach * SCALE if large else self.reach
        return float(surface_area_cost(reach, self.right, self.ranges, each))


def _finite(boxes: AABB) -> Array:
    bounds = bounds_of(boxes)
    endless = ~np.isfinite(bounds).all(axis=1)
    if endless.any():
        index = (int(np.argmax(endless)),)
        raise failure("boxes", "finite boxes", "one that reaches to infinity", index)
    return bounds
