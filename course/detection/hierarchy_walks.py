"""Walks through a tree of boxes whose nodes are numbered as a walk meets them.

Where a box misses a node it misses everything below it, and the walk goes on at the node
after these: no stack is needed (Ericson, *Real-Time Collision Detection*, section 6.6.2).

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array
from course.detection.pair_loops import Whole, new_list, overlap, room_for
from course.jit import compiled


@compiled
def nodes_after(right: Whole) -> Whole:
    """The node at which a walk goes on that leaves out what is below a node: one past its last."""
    after = np.empty_like(right)
    for node in range(right.size - 1, -1, -1):
        after[node] = after[right[node]] if right[node] >= 0 else node + 1
    return after


@compiled
def in_tree_order(bounds: Array, order: Whole) -> Array:
    """The boxes in the order of the leaves, so that a leaf's lie side by side."""
    packed = np.empty((order.size, 6))
    for r in range(order.size):
        packed[r] = bounds[order[r]]
    return packed


@compiled
def query_pairs(
    asked: Array,
    bounds: Array,
    reach: Array,
    order: Whole,
    right: Whole,
    ranges: Whole,
) -> tuple[Whole, int]:
    """Which boxes of a tree each of q asked overlaps, (m, 2), in their order; how many nodes were tested."""
    after, packed = nodes_after(right), in_tree_order(bounds, order)
    found, count, tests = new_list(0), 0, 0
    for q in range(asked.shape[0]):
        node = 0
        while node < right.size:
            tests += 1
            if not overlap(asked, q, reach, node):
                node = after[node]
                continue
            if right[node] < 0:
                for r in range(ranges[node, 0], ranges[node, 1]):
                    if overlap(asked, q, packed, r):
                        found = room_for(found, count)
                        found[count, 0], found[count, 1] = q, order[r]
                        count += 1
            node += 1
    return found[:count], tests


@compiled
def self_pairs(
    bounds: Array, reach: Array, order: Whole, right: Whole, ranges: Whole
) -> tuple[Whole, int]:
    """The pairs of a tree's own boxes, (m, 2), each once, in no order; how many nodes were tested.

    Each leaf asks the nodes that come after it, so that no two leaves meet twice.
    """
    after, packed = nodes_after(right), in_tree_order(bounds, order)
    found, count = new_list(order.size), 0
    tests = 0
    for leaf in range(right.size):
        if right[leaf] >= 0:
            continue
        begin, end = ranges[leaf, 0], ranges[leaf, 1]
        for r in range(begin, end):
            for s in range(r + 1, end):
                if overlap(packed, r, packed, s):
                    found = room_for(found, count)
                    found[count, 0], found[count, 1] = order[r], order[s]
                    count += 1
        node = leaf + 1
        while node < right.size:
            tests += 1
            if not overlap(reach, leaf, reach, node):
                node = after[node]
                continue
            if right[node] < 0:
                for r in range(begin, end):
                    if overlap(packed, r, reach, node):
                        for s in range(ranges[node, 0], ranges[node, 1]):
                            if overlap(packed, r, packed, s):
                                found = room_for(found, count)
                                found[count, 0], found[count, 1] = order[r], order[s]
                                count += 1
            node += 1
    return found[:count], tests


@compiled
def surface_area_cost(
    reach: Array, right: Whole, ranges: Whole, node_cost: float
) -> float:
    """Sum of A(node)/A(root) times node_cost, of leaves times how many boxes they hold."""
    total = 0.0
    whole = 0.0
    for node in range(right.size):
        a = reach[node, 3] - reach[node, 0]
        b = reach[node, 4] - reach[node, 1]
        c = reach[node, 5] - reach[node, 2]
        area = a * b + b * c + c * a
        if node == 0:
            whole = area
        held = node_cost if right[node] >= 0 else float(ranges[node, 1] - ranges[node, 0])  # fmt: skip
        total += held * (area / whole if whole > 0.0 else 1.0)
    return total


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    from course.detection.hierarchy import BVH
    from course.shapes import AABB

    lower = np.arange(18.0).reshape(6, 3)
    boxes = AABB(lower, lower + 2)
    for method in ("median", "surface_area", "morton"):
        tree = BVH.build(boxes, method=method, leaf_size=1)
    tree.pairs()
    tree.query(boxes)
    tree.cost()
