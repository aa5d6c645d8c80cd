"""The manifolds of many pairs, one after the other.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.manifold.labels import (
    FACE,
    POINT,
    SEPARATION,
    VERTEX,
    WIDTH,
    Pair,
)
from course.overlap.manifold.meeting import (
    SAME_DEPTH,
    flatten,
    kept,
    meet,
    point_found,
    set_manifold_normal,
)
from course.overlap.manifold.patches import (
    BIAS,
    A,
    B,
    Desk,
    Solids,
    ball,
    desk,
    distance,
    edge_between,
    supporting_patch,
)
from course.overlap.manifold.references import choose_normal
from course.overlap.manifold.thinning import thin

#: How much of the largest coordinate is taken for rounding of the input.
ROUNDING = 32 * 2.0**-52


@compiled
def manifolds(
    a: Solids,
    b: Solids,
    pairs: IntArray,
    found: Array,
    margin: float,
    limit: int,
    begin: int,
    room: Desk,
    names: IntArray,
    numbers: Array,
) -> tuple[int, int]:
    """The points of the pairs from ``begin`` on, as far as there is room for them.

    Args:
        pairs: (p, 2) which solid of a, which of b.
        found: (p, 7) of each pair the point halfway, the normal and the gap.
        margin, limit: as in ``contact_points``; limit 0 is none.
        names: (c, 8): label, kinds and places (``labels``), then the pair and the
            features of A and B.
        numbers: (c, 15) (``labels``).
    Returns:
        The first pair that is not done, and how many rows were filled.
    """
    count, p = 0, begin
    origin, normal = np.empty(3), np.empty(3)
    order = np.empty(limit, dtype=np.intp)
    while p < len(pairs) and count + room.cut.shape[1] <= len(numbers):
        if found[p, 6] <= margin:
            i, j = pairs[p, 0], pairs[p, 1]
            more = manifold(a, i, b, j, found, p, margin, limit, room, origin, normal,
                            order, names, numbers, count)  # fmt: skip
            for k in range(count, count + more):
                names[k, 5] = p
                for axis in range(3):
                    numbers[k, POINT + axis] += origin[axis]
            count += more
        p += 1
    return p, count


@compiled
def manifold(
    a: Solids,
    i: int,
    b: Solids,
    j: int,
    found: Array,
    p: int,
    margin: float,
    limit: int,
    room: Desk,
    origin: Array,
    normal: Array,
    order: IntArray,
    names: IntArray,
    numbers: Array,
    begin: int,
) -> int:
    """The points of one pair, counted from the origin, in the rows from ``begin`` on."""
    origin[:] = found[p, :3]
    gap, radius_a, radius_b = found[p, 6], a.radius[i], b.radius[j]
    size_a = radius_a + size_of(a.vertices, a.vertex_start[i], a.vertex_start[i + 1])
    size_b = radius_b + size_of(b.vertices, b.vertex_start[j], b.vertex_start[j + 1])
    scale, noise = scales(size_a, size_b, origin)
    bias = BIAS * scale + noise
    chosen = choose(a, i, b, j, origin, gap + radius_a + radius_b - bias, normal)
    count = 0
    for attempt in range(2):
        if attempt or not chosen:
            normal[:] = found[p, 3:6]
        count_a, feature_a = supporting_patch(a, i, A, origin, normal, bias, *room[:3])
        count_b, feature_b = supporting_patch(b, j, B, origin, normal, bias, *room[:3])
        first = set_manifold_normal(room.normal, count_a, count_b, normal)
        pair = Pair(count_a, count_b, radius_a, radius_b, scale, bias, first)
        flatten(room.corner, room.normal, count_a, count_b)
        count = meet(pair, room.corner, room.normal, *room[3:], names, numbers, begin)  # fmt: skip
        if count or not chosen:
            break
    rounding = SAME_DEPTH * scale + noise
    if count == 0 or (count_a < 3 and count_b < 3 and lowest(numbers, begin, count) > gap + rounding):  # fmt: skip
        point_found(pair, room.corner, room.normal, normal, gap, names, numbers, begin + count)  # fmt: skip
        count += 1
    count = kept(names, numbers, begin, count, margin, rounding)
    if limit:
        count = thin(names, numbers, begin, count, limit, bias, order)
    number(a, i, A, count_a, feature_a, room.vertex, names, begin, count)
    number(b, j, B, count_b, feature_b, room.vertex, names, begin, count)
    return count


@compiled
def choose(
    a: Solids, i: int, b: Solids, j: int, origin: Array, least: float, normal: Array
) -> bool:
    """Write the normal of a face that is as good as any, and whether there is one."""
    best = choose_normal(
        b.normals, b.face_start[j], b.face_start[j + 1], b.loop, b.loop_start, b.vertices,
        a.vertices, a.vertex_start[i], a.vertex_start[i + 1], origin, B, least, -1.0, normal,
    )  # fmt: skip
    best = choose_normal(
        a.normals, a.face_start[i], a.face_start[i + 1], a.loop, a.loop_start, a.vertices,
        b.vertices, b.vertex_start[j], b.vertex_start[j + 1], origin, A, least, best, normal,
    )  # fmt: skip
    return best >= 0.0


@compiled
def size_of(vertices: Array, begin: int, end: int) -> float:
    """The greatest distance of a vertex from the first."""
    size = 0.0
    for v in range(begin + 1, end):
        size = max(size, distance(vertices, begin, v))
    return size


@compiled
def scales(size_a: float, size_b: float, origin: Array) -> tuple[float, float]:
    """The size of the smaller solid (of the other if it is a point), and the rounding of coordinates."""
    scale = min(size_a, size_b)
    if scale == 0.0:
        scale = max(size_a, size_b)
    reach = max(abs(origin[0]), abs(origin[1]), abs(origin[2])) + size_a + size_b
    return scale, ROUNDING * reach


@compiled
def lowest(numbers: Array, begin: int, count: int) -> float:
    """The least separation of some rows."""
    least = math.inf
    for k in range(begin, begin + count):
        least = min(least, numbers[k, SEPARATION])
    return least


@compiled
def number(
    solids: Solids,
    solid: int,
    side: int,
    corners: int,
    feature: int,
    vertex: IntArray,
    names: IntArray,
    begin: int,
    count: int,
) -> None:
    """Number the features of one side in its solid: vertices first, then edges, then faces."""
    first, first_edge = solids.vertex_start[solid], solids.edge_start[solid]
    last_edge = solids.edge_start[solid + 1]
    vertices = solids.vertex_start[solid + 1] - first
    for k in range(begin, begin + count):
        kind, place = names[k, 1 + 2 * side], names[k, 2 + 2 * side]
        if kind == VERTEX:
            what = vertex[side, place]
        elif kind == FACE:
            what = vertices + last_edge - first_edge + feature
        elif corners == 2:
            what = vertices + feature
        else:
            p, q = vertex[side, place], vertex[side, (place + 1) % corners]
            what = vertices + edge_between(solids.edges, first_edge, last_edge, first, p, q)  # fmt: skip
        names[k, 6 + side] = what


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    rows = np.zeros((20, 8), dtype=np.intp), np.zeros((20, WIDTH))
    found = np.array([[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, -2.0]])
    pairs = np.zeros((1, 2), dtype=np.intp)
    manifolds(ball(), ball(), pairs, found, 0.0, 4, 0, desk(1, 1), *rows)
