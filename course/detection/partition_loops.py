"""Space cut by planes, in loops: a tree whose leaves are cells, and the boxes that reach into each.

A box that a plane cuts is held on both sides. Two boxes that overlap may therefore meet in
many cells; the pair belongs to the one cell that holds the lower corner of what they have
in common, p = max(l_i, l_j). A point is left of a plane n.x = d where n.p < d. Rounding
does not disturb that: with n.l and n.u taken over a box in the same order of the same
products, n.p lies between them in floating point too, as each step keeps the order.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array
from course.detection.pair_loops import Whole, new_list, overlap, room_for
from course.jit import compiled

#: A cell with so many boxes is not cut.
CELL_SIZE = 8
#: A cut is no use where it leaves more than this part of the boxes on one side, or makes
#: this much more of them altogether.
LEFT, GROWN = 0.8, 1.5
#: How often a vector is multiplied by the covariance, to turn toward its principal axis.
TURNS = 8
DEEPEST = 60


@compiled
def interval(bounds: Array, i: int, nx: float, ny: float, nz: float) -> tuple[float, float]:  # fmt: skip
    """The least and the greatest n.x of box i."""
    low = nx * bounds[i, 0 if nx > 0.0 else 3]
    high = nx * bounds[i, 3 if nx > 0.0 else 0]
    low += ny * bounds[i, 1 if ny > 0.0 else 4]
    high += ny * bounds[i, 4 if ny > 0.0 else 1]
    low += nz * bounds[i, 2 if nz > 0.0 else 5]
    high += nz * bounds[i, 5 if nz > 0.0 else 2]
    return low, high


@compiled
def median_plane(
    bounds: Array, cell: Whole, nx: float, ny: float, nz: float
) -> tuple[float, float]:
    """The plane across n through the median of a cell's middles: its offset, and its cost.

    The cost is the number of pairs left to test, (n_left^2 + n_right^2)/n^2, or inf
    where the plane is no use (LEFT, GROWN).
    """
    n = cell.size
    middles = np.empty(n)
    for k in range(n):
        low, high = interval(bounds, cell[k], nx, ny, nz)
        middles[k] = 0.5 * (low + high)
    offset = np.sort(middles)[n // 2]
    left, right = 0, 0
    for k in range(n):
        low, high = interval(bounds, cell[k], nx, ny, nz)
        left += low < offset
        right += high >= offset
    if max(left, right) > LEFT * n or left + right > GROWN * n:
        return offset, math.inf
    return offset, (float(left) * left + float(right) * right) / (float(n) * n)


@compiled
def principal_axis(bounds: Array, cell: Whole) -> tuple[float, float, float]:
    """The direction along which a cell's centres vary most, by the power method; x where they do not."""
    n = cell.size
    centers, mean = np.empty((n, 3)), np.zeros(3)
    for k in range(n):
        for a in range(3):
            centers[k, a] = 0.5 * (bounds[cell[k], a] + bounds[cell[k], a + 3])
            mean[a] += centers[k, a] / n
    x, y, z = 0.6, 0.5, 0.62
    for _ in range(TURNS):
        u = v = w = 0.0
        for k in range(n):
            a, b, c = centers[k, 0] - mean[0], centers[k, 1] - mean[1], centers[k, 2] - mean[2]  # fmt: skip
            along = a * x + b * y + c * z
            u, v, w = u + a * along, v + b * along, w + c * along
        length = math.sqrt(u * u + v * v + w * w)
        if not 0.0 < length < math.inf:
            return 1.0, 0.0, 0.0
        x, y, z = u / length, v / length, w / length
    return x, y, z


@compiled
def best_plane(bounds: Array, cell: Whole, depth: int, oblique: bool) -> Array:
    """The plane (n, d) that cuts a cell, and its cost, (5,).

    Of a kd-tree the axes take turns, x, y, z, and the next one serves where a cut is no
    use. Else the cheapest of the three axes and the principal axis of the centres.
    """
    best = np.zeros(5)
    best[4] = math.inf
    for turn in range(4 if oblique else 3):
        if turn == 3:
            x, y, z = principal_axis(bounds, cell)
        else:
            axis = (depth + turn) % 3
            x = 1.0 if axis == 0 else 0.0
            y = 1.0 if axis == 1 else 0.0
            z = 1.0 if axis == 2 else 0.0
        offset, cost = median_plane(bounds, cell, x, y, z)
        if cost < best[4]:
            best[0], best[1], best[2], best[3], best[4] = x, y, z, offset, cost
            if not oblique:
                break
    return best


@compiled
def cut(bounds: Array, oblique: bool) -> tuple[Array, Whole, Whole, Whole, int]:
    """A partition of space by the boxes (n, 6) in it.

    Returns:
        planes: (nodes, 4), n and d; of a leaf 0.
        right: (nodes,), the child right of the plane, -1 of a leaf; the left is the next node.
        ranges: (nodes, 2), of a leaf where its boxes are listed.
        held: the boxes of all leaves.
        tests: how many pairs the leaves hold.
    """
    n = bounds.shape[0]
    planes, right = np.zeros((16, 4)), np.full(16, -1, dtype=np.int32)
    ranges, held = np.zeros((16, 2), dtype=np.int64), np.empty(2 * n + 16, np.int32)
    stack = [(np.arange(n).astype(np.int32), 0, -1)]
    nodes, count, tests = 0, 0, 0
    while len(stack) > 0:
        cell, depth, parent = stack.pop()
        if nodes == right.size:
            planes = np.concatenate((planes, np.zeros_like(planes)))
            right = np.concatenate((right, np.full_like(right, -1)))
            ranges = np.concatenate((ranges, np.zeros_like(ranges)))
        if parent >= 0:
            right[parent] = nodes
        plane = np.zeros(5)
        plane[4] = math.inf
        if cell.size > CELL_SIZE and depth < DEEPEST:
            plane = best_plane(bounds, cell, depth, oblique)
        if plane[4] < math.inf:
            planes[nodes] = plane[:4]
            left_cell, right_cell = sides(bounds, cell, plane)
            stack.append((right_cell, depth + 1, nodes))
            stack.append((left_cell, depth + 1, -1))
        else:
            while count + cell.size > held.size:
                held = np.concatenate((held, held))
            held[count : count + cell.size] = cell
            ranges[nodes, 0], ranges[nodes, 1] = count, count + cell.size
            count += cell.size
            tests += cell.size * (cell.size - 1) // 2
        nodes += 1
    return planes[:nodes], right[:nodes], ranges[:nodes], held[:count], tests


@compiled
def sides(bounds: Array, cell: Whole, plane: Array) -> tuple[Whole, Whole]:
    """The boxes of a cell that reach to the left of a plane, and those that reach to its right."""
    left, right = np.empty_like(cell), np.empty_like(cell)
    m, n = 0, 0
    for k in range(cell.size):
        low, high = interval(bounds, cell[k], plane[0], plane[1], plane[2])
        if low < plane[3]:
            left[m] = cell[k]
            m += 1
        if high >= plane[3]:
            right[n] = cell[k]
            n += 1
    return left[:m].copy(), right[:n].copy()


@compiled
def cell_of(planes: Array, right: Whole, x: float, y: float, z: float) -> int:
    """The leaf whose cell holds a point."""
    node = 0
    while right[node] >= 0:
        along = planes[node, 0] * x
        along += planes[node, 1] * y
        along += planes[node, 2] * z
        node = node + 1 if along < planes[node, 3] else right[node]
    return node


@compiled
def cell_pairs(
    bounds: Array, planes: Array, right: Whole, ranges: Whole, held: Whole
) -> Whole:
    """The pairs that overlap, (m, 2), each in the cell it belongs to, in no order."""
    found, count = new_list(bounds.shape[0]), 0
    for leaf in range(right.size):
        if right[leaf] >= 0:
            continue
        begin, end = ranges[leaf, 0], ranges[leaf, 1]
        for r in range(begin, end):
            i = held[r]
            for s in range(r + 1, end):
                j = held[s]
                if not overlap(bounds, i, bounds, j):
                    continue
                x = max(bounds[i, 0], bounds[j, 0])
                y = max(bounds[i, 1], bounds[j, 1])
                z = max(bounds[i, 2], bounds[j, 2])
                if cell_of(planes, right, x, y, z) == leaf:
                    found = room_for(found, count)
                    found[count, 0], found[count, 1] = i, j
                    count += 1
    return found[:count]


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    from course.detection.partitions import Partition
    from course.shapes import AABB

    lower = np.arange(60.0).reshape(20, 3)
    for oblique in (False, True):
        Partition.build(AABB(lower, lower + 2), oblique=oblique).pairs()
