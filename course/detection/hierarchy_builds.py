"""Trees of boxes built from above: a range of boxes is split in two, and each half again.

The boxes of a node are a range of one ``order``, which the splits permute. Three of them:

- median: the centres' median along their longest axis (Ericson, *Real-Time Collision
  Detection*, section 6.3);
- surface_area: of planes between bins of centres, on all three axes, the one with the
  least A_left n_left + A_right n_right (I. Wald, "On fast Construction of SAH-based
  Bounding Volume Hierarchies", 2007), A the surface area of a box;
- morton: the boxes are sorted by Morton code, and a range is split where the highest bit
  changes that is not common to all of it (T. Karras, "Maximizing Parallelism in the
  Construction of BVHs, Octrees, and k-d Trees", 2012).

Nodes are numbered as a walk from the root meets them, left before right: the left child of
node k is k + 1, and children come after their parents.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array
from course.detection.pair_loops import Whole, radix_order
from course.jit import compiled

MEDIAN, SURFACE_AREA, MORTON = 0, 1, 2
BINS = 16
#: Bits of a Morton code, a third of them an axis.
CODE_BITS = 63


@compiled
def spread_bits(x: int) -> int:
    """The lowest 21 bits of x, two zeros between each and the next."""
    x = (x | x << 32) & 0x1F00000000FFFF
    x = (x | x << 16) & 0x1F0000FF0000FF
    x = (x | x << 8) & 0x100F00F00F00F00F
    x = (x | x << 4) & 0x10C30C30C30C30C3
    return (x | x << 2) & 0x1249249249249249


@compiled
def morton_codes(centers: Array) -> Whole:
    """The Morton code of each point (n, 3): its cell's three whole numbers, bit by bit in turn.

    The cells are 2^21 an axis, cubes that the longest axis sets.
    """
    low, span = np.zeros(3), 0.0
    for k in range(3):
        low[k] = centers[:, k].min()
        span = max(span, centers[:, k].max() - low[k])
    scale = 2097151.0 / span if span > 1e-290 else 0.0
    codes = np.empty(centers.shape[0], dtype=np.int64)
    for i in range(codes.size):
        x = spread_bits(int((centers[i, 0] - low[0]) * scale))
        y = spread_bits(int((centers[i, 1] - low[1]) * scale))
        codes[i] = x | y << 1 | spread_bits(int((centers[i, 2] - low[2]) * scale)) << 2
    return codes


@compiled
def longest_axis(centers: Array, order: Whole, begin: int, end: int) -> int:
    """The axis along which the centres of a range reach farthest."""
    best, axis = -1.0, 0
    for k in range(3):
        low = high = centers[order[begin], k]
        for r in range(begin + 1, end):
            low, high = min(low, centers[order[r], k]), max(high, centers[order[r], k])
        if high - low > best:
            best, axis = high - low, k
    return axis


@compiled
def split_median(centers: Array, order: Whole, begin: int, end: int) -> int:
    """Permute a range so that its first half lies below its second along the longest axis.

    Source: C. A. R. Hoare, "Algorithm 65: FIND", 1961.
    """
    axis = longest_axis(centers, order, begin, end)
    middle = (begin + end) // 2
    left, right = begin, end - 1
    while left < right:
        pivot = centers[order[middle], axis]
        i, j = left, right
        while i <= j:
            while centers[order[i], axis] < pivot:
                i += 1
            while centers[order[j], axis] > pivot:
                j -= 1
            if i <= j:
                order[i], order[j] = order[j], order[i]
                i += 1
                j -= 1
        if j < middle:
            left = i
        if middle < i:
            right = j
    return middle


@compiled
def surface_area(box: Array) -> float:
    """2(ab + bc + ca) of a box (6,), or 0 of none (l > u)."""
    a, b, c = box[3] - box[0], box[4] - box[1], box[5] - box[2]
    return 2.0 * (a * b + b * c + c * a) if a >= 0.0 else 0.0


@compiled
def include(box: Array, other: Array) -> None:
    """Grow a box (6,) so that it holds another."""
    for k in range(3):
        box[k] = min(box[k], other[k])
        box[k + 3] = max(box[k + 3], other[k + 3])


@compiled
def empty(box: Array) -> None:
    """Make it a box that holds nothing: l = inf, u = -inf."""
    box[:3] = math.inf
    box[3:] = -math.inf


@compiled
def best_plane(
    bounds: Array, counts: Whole, areas: Array, box: Array
) -> tuple[float, int]:
    """The bin before which a plane costs least, A_left n_left + A_right n_right, and that cost.

    Args:
        bounds: (BINS, 6), what the boxes of each bin reach; counts: (BINS,), how many.
        areas: (BINS,), box: (6,), room to work in.
    """
    empty(box)
    for b in range(BINS - 1, 0, -1):
        include(box, bounds[b])
        areas[b] = surface_area(box)
    empty(box)
    total, count, least, best = counts.sum(), 0, math.inf, 0
    for b in range(1, BINS):
        include(box, bounds[b - 1])
        count += counts[b - 1]
        cost = surface_area(box) * count + areas[b] * (total - count)
        if 0 < count < total and cost < least:
            least, best = cost, b
    return least, best


@compiled
def split_surface_area(
    bounds: Array, centers: Array, order: Whole, begin: int, end: int
) -> int:
    """Permute a range by the best of the planes between bins; where all centres coincide, halve it."""
    reach, counts = np.empty((BINS, 6)), np.zeros(BINS, dtype=np.int64)
    areas, box = np.empty(BINS), np.empty(6)
    least, axis, plane, start, width = math.inf, -1, 0, 0.0, 0.0
    for k in range(3):
        low = high = centers[order[begin], k]
        for r in range(begin + 1, end):
            low, high = min(low, centers[order[r], k]), max(high, centers[order[r], k])
        scale = BINS / (high - low) if high - low > 1e-290 else 0.0
        if scale == 0.0:
            continue
        counts[:] = 0
        for b in range(BINS):
            empty(reach[b])
        for r in range(begin, end):
            b = min(int((centers[order[r], k] - low) * scale), BINS - 1)
            counts[b] += 1
            include(reach[b], bounds[order[r]])
        cost, best = best_plane(reach, counts, areas, box)
        if cost < least:
            least, axis, plane, start, width = cost, k, best, low, scale
    if axis < 0:
        return (begin + end) // 2
    middle = begin
    for r in range(begin, end):
        if min(int((centers[order[r], axis] - start) * width), BINS - 1) < plane:
            order[r], order[middle] = order[middle], order[r]
            middle += 1
    return middle


@compiled
def split_morton(codes: Whole, begin: int, end: int) -> int:
    """Where the highest bit changes that a sorted range has not in common; equal codes are halved.

    A search by halves: what stands before that place is nearer to the first code than to
    the last, as numbers of bits that differ go.
    """
    first, last = codes[begin], codes[end - 1]
    if first == last:
        return (begin + end) // 2
    low, high = begin, end - 1
    while high - low > 1:
        middle = (low + high) // 2
        if first ^ codes[middle] < codes[middle] ^ last:
            low = middle
        else:
            high = middle
    return high


@compiled
def build(bounds: Array, method: int, leaf_size: int) -> tuple[Whole, Whole, Whole]:
    """A tree over boxes (n, 6).

    Returns:
        order: (n,), the boxes as the leaves hold them, one leaf after the other.
        right: (nodes,), the right child, or -1 of a leaf; the left is the next node.
        ranges: (nodes, 2), first and one past the last place in the order of its boxes.
    """
    n = bounds.shape[0]
    if n == 0:
        none = np.empty((0, 2), dtype=np.int32)
        return none[:, 0].copy(), none[:, 0].copy(), none
    centers = bounds[:, :3] + bounds[:, 3:]
    order, codes = np.arange(n).astype(np.int32), np.zeros(0, dtype=np.int64)
    if method == MORTON:
        codes = morton_codes(centers)
        order = radix_order(codes, CODE_BITS)
        codes = codes[order]
    right = np.full(2 * n - 1, -1, dtype=np.int32)
    ranges = np.empty((2 * n - 1, 2), dtype=np.int32)
    stack = [(0, n, -1)]
    nodes = 0
    while len(stack) > 0:
        begin, end, parent = stack.pop()
        if parent >= 0:
            right[parent] = nodes
        ranges[nodes, 0], ranges[nodes, 1] = begin, end
        if end - begin > leaf_size:
            if method == MORTON:
                middle = split_morton(codes, begin, end)
            elif method == MEDIAN:
                middle = split_median(centers, order, begin, end)
            else:
                middle = split_surface_area(bounds, centers, order, begin, end)
            stack.append((middle, end, nodes))
            stack.append((begin, middle, -1))
        nodes += 1
    return order, right[:nodes], ranges[:nodes]


@compiled
def fit(bounds: Array, order: Whole, right: Whole, ranges: Whole) -> Array:
    """The bounds of all nodes, (nodes, 6), from the leaves up: children come after their parents."""
    reach = np.empty((right.size, 6))
    for node in range(right.size - 1, -1, -1):
        if right[node] >= 0:
            reach[node] = reach[node + 1]
            include(reach[node], reach[right[node]])
        else:
            empty(reach[node])
            for r in range(ranges[node, 0], ranges[node, 1]):
                include(reach[node], bounds[order[r]])
    return reach


def warm() -> None:
    """Called by others only (``course.jit``); ``course.detection.hierarchy_walks`` compiles it."""
