"""Which boxes of a tree rays pass through.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array
from course.detection.hierarchy_walks import in_tree_order, nodes_after
from course.detection.pair_loops import Whole, new_list, room_for
from course.jit import compiled

#: What rounding may do to the two times of a slab (T. Ize, "Robust BVH Ray Traversal", 2013).
WIDER = 1.0 + 2.0**-49


@compiled
def passes(origin: Array, way: Array, q: int, box: Array, k: int) -> bool:
    """Whether ray q, from its origin to origin + way, has a point in common with box k.

    Slab by slab, t from (l - p)/w to (u - p)/w; along an axis in which it does not move
    it must lie between l and u (Ericson, *Real-Time Collision Detection*, section 5.3.3).
    """
    first, last = 0.0, 1.0
    for x in range(3):
        p, w = origin[q, x], way[q, x]
        if w == 0.0:
            if p < box[k, x] or p > box[k, 3 + x]:
                return False
            continue
        one, other = (box[k, x] - p) / w, (box[k, 3 + x] - p) / w
        first = max(first, min(one, other))
        last = min(last, max(one, other))
    return first <= last * WIDER


@compiled
def ray_pairs(
    origin: Array,
    way: Array,
    bounds: Array,
    reach: Array,
    order: Whole,
    right: Whole,
    ranges: Whole,
) -> Whole:
    """Which boxes of a tree each of q rays passes through, (m, 2), ray by ray."""
    after, packed = nodes_after(right), in_tree_order(bounds, order)
    found, count = new_list(0), 0
    for q in range(origin.shape[0]):
        node = 0
        while node < right.size:
            if not passes(origin, way, q, reach, node):
                node = after[node]
                continue
            if right[node] < 0:
                for r in range(ranges[node, 0], ranges[node, 1]):
                    if passes(origin, way, q, packed, r):
                        found = room_for(found, count)
                        found[count, 0], found[count, 1] = q, order[r]
                        count += 1
            node += 1
    return found[:count]


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    from course.detection.hierarchy import BVH
    from course.shapes import AABB

    lower = np.arange(18.0).reshape(6, 3)
    tree = BVH.build(AABB(lower, lower + 2), leaf_size=1)
    bounds = np.concatenate([lower, lower + 2], axis=1)
    arrays = (tree.reach, tree.order, tree.right, tree.ranges)
    ray_pairs(np.zeros((1, 3)), np.ones((1, 3)), bounds, *arrays)
