"""Spheres around the nodes of a tree of boxes, and the walk that asks them.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array
from course.detection.hierarchy_walks import in_tree_order, nodes_after
from course.detection.pair_loops import Whole, new_list, overlap, room_for
from course.jit import compiled

#: Radii are a little larger than computed, so that rounding loses no pair.
ROUNDED_UP = 1.0 + 1e-14


@compiled
def farthest_corner(x: float, y: float, z: float, bounds: Array, i: int) -> float:
    """The distance of a point from the farthest corner of box i."""
    a = max(x - bounds[i, 0], bounds[i, 3] - x)
    b = max(y - bounds[i, 1], bounds[i, 4] - y)
    c = max(z - bounds[i, 2], bounds[i, 5] - z)
    return math.sqrt(a * a + b * b + c * c)


@compiled
def fit_spheres(
    bounds: Array, reach: Array, order: Whole, right: Whole, ranges: Whole
) -> Array:
    """A sphere a node, (nodes, 4): about the middle of its bounds, as large as its boxes' corners ask.

    Of an inner node that is what its children's spheres ask, |c - c_k| + r_k, or the
    half diagonal of its bounds where that is less.
    """
    spheres = np.empty((right.size, 4))
    for node in range(right.size - 1, -1, -1):
        for k in range(3):
            spheres[node, k] = 0.5 * (reach[node, k] + reach[node, k + 3])
        x, y, z = spheres[node, 0], spheres[node, 1], spheres[node, 2]
        if right[node] < 0:
            radius = 0.0
            for r in range(ranges[node, 0], ranges[node, 1]):
                radius = max(radius, farthest_corner(x, y, z, bounds, order[r]))
        else:
            radius = 0.0
            for side in range(2):
                child = node + 1 if side == 0 else right[node]
                a, b, c = spheres[child, 0] - x, spheres[child, 1] - y, spheres[child, 2] - z  # fmt: skip
                away = math.sqrt(a * a + b * b + c * c)
                radius = max(radius, away + spheres[child, 3])
            radius = min(radius, farthest_corner(x, y, z, reach, node))
        # The last term is for places so far from the origin that they are rounded themselves.
        far = max(abs(x), max(abs(y), abs(z)))
        spheres[node, 3] = radius * ROUNDED_UP + 1e-15 * far + 1e-150
    return spheres


@compiled
def spheres_overlap(spheres: Array, i: int, j: int) -> bool:
    """Whether |c_i - c_j| <= r_i + r_j."""
    x = spheres[i, 0] - spheres[j, 0]
    y = spheres[i, 1] - spheres[j, 1]
    z = spheres[i, 2] - spheres[j, 2]
    reach = spheres[i, 3] + spheres[j, 3]
    return x * x + y * y + z * z <= reach * reach


@compiled
def sphere_pairs(
    bounds: Array, spheres: Array, order: Whole, right: Whole, ranges: Whole
) -> tuple[Whole, int]:
    """The pairs of a tree's own boxes, (m, 2), each once, in no order; how many spheres were tested."""
    after, packed = nodes_after(right), in_tree_order(bounds, order)
    found, count = new_list(order.size), 0
    tests = 0
    for leaf in range(right.size):
        if right[leaf] >= 0:
            continue
        node = leaf
        while node < right.size:
            if node != leaf:
                tests += 1
                if not spheres_overlap(spheres, leaf, node):
                    node = after[node]
                    continue
            if right[node] < 0:
                for r in range(ranges[leaf, 0], ranges[leaf, 1]):
                    begin = r + 1 if node == leaf else ranges[node, 0]
                    for s in range(begin, ranges[node, 1]):
                        if overlap(packed, r, packed, s):
                            found = room_for(found, count)
                            found[count, 0], found[count, 1] = order[r], order[s]
                            count += 1
            node += 1
    return found[:count], tests


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    from course.detection.spheres import SphereTree
    from course.shapes import AABB

    lower = np.arange(18.0).reshape(6, 3)
    SphereTree.build(AABB(lower, lower + 2), leaf_size=1).pairs()
