"""The points of one manifold: which features of two patches meet, and which of these points are kept.

* A face and anything: what the other patch, seen along the faces' normal, has in common
  with the face (``clipping``). The corners of that polygon are the points of the manifold;
  between them the load can be anywhere (the support polygon).
* Two edges: their crossing; where they are parallel the two ends of what they share.
* Else, and where nothing was found because the patches only lean toward each other: the
  point that the distance query found.

Of these the points with d <= margin stay; the deepest does in any case.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.manifold.clipping import CLIP, SUBJECT, clip
from course.overlap.manifold.labels import (
    EDGE,
    FACE,
    FACE_B,
    LABEL,
    NORMAL,
    PARALLEL_SINE,
    POINT,
    SEPARATION,
    VERTEX,
    WIDTH,
    Pair,
    label,
    nearest_on_edge,
)
from course.overlap.manifold.patches import MANIFOLD, A, B, desk

#: Where both bodies' features would do, those of the one that lies on this side of the
#: other are taken: no direction that a scene is likely to have lies across it.
UPPER = (0.4170, 0.5743, 0.7046)
#: Two separations that differ by less than this times the smaller solid are one.
SAME_DEPTH = 1e-9


@compiled
def upward(normal: Array, k: int) -> float:
    """How far row k points along ``UPPER``."""
    x, y, z = normal[k, 0], normal[k, 1], normal[k, 2]
    return UPPER[0] * x + UPPER[1] * y + UPPER[2] * z


@compiled
def set_manifold_normal(normal: Array, count_a: int, count_b: int, found: Array) -> int:
    """N of the manifold: between the normals of two faces, that of one, or the one found; returns the preferred side.

    It does not depend on which of two nearly parallel faces the query took its normal
    from. The preferred side is the upper one: exchanging A and B exchanges it.
    """
    x, y, z = 0.0, 0.0, 0.0
    if count_b > 2:
        x, y, z = normal[B, 0], normal[B, 1], normal[B, 2]
    if count_a > 2:
        x, y, z = x - normal[A, 0], y - normal[A, 1], z - normal[A, 2]
    if count_a < 3 and count_b < 3:
        x, y, z = found[0], found[1], found[2]
    length = math.sqrt(x * x + y * y + z * z)
    normal[MANIFOLD, 0], normal[MANIFOLD, 1] = x / length, y / length
    normal[MANIFOLD, 2] = z / length
    return A if upward(normal, MANIFOLD) >= 0.0 else B


@compiled
def flatten(corner: Array, normal: Array, count_a: int, count_b: int) -> None:
    """The corners of both patches in the plane at right angles to N, by t_1 and t_2 = N x t_1."""
    x, y, z = normal[MANIFOLD, 0], normal[MANIFOLD, 1], normal[MANIFOLD, 2]
    if abs(x) < 0.6:  # t_1 = (1, 0, 0) without its part along N
        tx, ty, tz = 1.0 - x * x, -x * y, -x * z
    else:
        tx, ty, tz = -y * x, 1.0 - y * y, -y * z
    length = math.sqrt(tx * tx + ty * ty + tz * tz)
    tx, ty, tz = tx / length, ty / length, tz / length
    ux, uy, uz = y * tz - z * ty, z * tx - x * tz, x * ty - y * tx
    for side in range(2):
        for i in range(count_a if side == A else count_b):
            px, py, pz = corner[side, i, 0], corner[side, i, 1], corner[side, i, 2]
            corner[side, i, 3] = px * tx + py * ty + pz * tz
            corner[side, i, 4] = px * ux + py * uy + pz * uz


@compiled
def meet(
    pair: Pair,
    corner: Array,
    normal: Array,
    cut: Array,
    leaving: IntArray,
    what: IntArray,
    names: IntArray,
    numbers: Array,
    begin: int,
) -> int:
    """The points that two patches have in common, flattened before: their names and numbers.

    Args:
        corner, normal, cut, leaving, what: of the ``Desk``.
        names, numbers: tables (``labels``) with room for all points from row ``begin`` on.
    Returns:
        How many; none where the patches pass each other by.
    """
    count = 0
    if pair.count_a > 2 or pair.count_b > 2:
        count = common_polygon(pair, corner, cut, leaving, what, names, begin)
    elif pair.count_a == 2 and pair.count_b == 2:
        count = two_edges(pair, corner, names, begin)
    elif pair.count_a == 1 and pair.count_b == 1:
        write(names, begin, VERTEX, 0, VERTEX, 0)
        count = 1
    for k in range(begin, begin + count):
        label(pair, corner, normal, names, numbers, k)
    return count


@compiled
def common_polygon(
    pair: Pair,
    corner: Array,
    cut: Array,
    leaving: IntArray,
    what: IntArray,
    names: IntArray,
    begin: int,
) -> int:
    """The corners of what a face and the other patch have in common."""
    faces = pair.count_a > 2 and pair.count_b > 2
    a_is_cut = pair.first == A if faces else pair.count_b > 2
    if a_is_cut:
        count = clip(
            corner, A, pair.count_a, pair.count_b, pair.bias, cut, leaving, what
        )
    else:
        count = clip(
            corner, B, pair.count_b, pair.count_a, pair.bias, cut, leaving, what
        )
    for k in range(count):
        kind, i, j = what[k, 0], what[k, 1], what[k, 2]
        mine = theirs = EDGE
        if kind == SUBJECT:
            mine, theirs, j = VERTEX, FACE, 0
        elif kind == CLIP and faces:
            mine, theirs, i = FACE, VERTEX, 0
        elif kind == CLIP:  # an edge through a vertex: it crosses an edge there
            i = 0
        if a_is_cut:
            write(names, begin + k, mine, i, theirs, j)
        else:
            write(names, begin + k, theirs, j, mine, i)
    return count


@compiled
def write(names: IntArray, k: int, kind_a: int, i: int, kind_b: int, j: int) -> None:
    """Name row k by two features."""
    names[k, LABEL] = FACE_B
    names[k, 1], names[k, 2], names[k, 3], names[k, 4] = kind_a, i, kind_b, j


@compiled
def two_edges(pair: Pair, corner: Array, names: IntArray, begin: int) -> int:
    """Two edges seen along the normal: one crossing, two ends, or nothing in common."""
    ex, ey = corner[A, 1, 3] - corner[A, 0, 3], corner[A, 1, 4] - corner[A, 0, 4]
    fx, fy = corner[B, 1, 3] - corner[B, 0, 3], corner[B, 1, 4] - corner[B, 0, 4]
    wx, wy = corner[B, 0, 3] - corner[A, 0, 3], corner[B, 0, 4] - corner[A, 0, 4]
    e, f = math.sqrt(ex * ex + ey * ey), math.sqrt(fx * fx + fy * fy)
    if e == 0.0 or f == 0.0:
        return 0
    sine = ex * fy - ey * fx
    if abs(sine) <= PARALLEL_SINE * e * f:
        start = (wx * ex + wy * ey) / e
        end = start + (fx * ex + fy * ey) / e
        return shared_length(pair, names, begin, e, start, end)
    s, t = (wx * fy - wy * fx) / sine, (wx * ey - wy * ex) / sine
    if min(s, 1.0 - s) * e < -pair.bias or min(t, 1.0 - t) * f < -pair.bias:
        return 0
    write(names, begin, EDGE, 0, EDGE, 0)
    return 1


@compiled
def shared_length(
    pair: Pair, names: IntArray, begin: int, length: float, start: float, end: float
) -> int:
    """The ends of what two parallel edges share; A's runs from 0 to its length, B's from start to end.

    Each is a vertex of one body beside the edge of the other; where two vertices lie
    together, it is that of the preferred body.
    """
    tie = pair.bias if pair.first == A else -pair.bias
    low_b, high_b = (0, 1) if start <= end else (1, 0)
    low, high = min(start, end), max(start, end)
    shared = min(high, length) - max(low, 0.0)
    if shared < -pair.bias:
        return 0
    if low <= tie:
        write(names, begin, VERTEX, 0, EDGE, 0)
    else:
        write(names, begin, EDGE, 0, VERTEX, low_b)
    if shared <= pair.bias:
        return 1
    if high >= length - tie:
        write(names, begin + 1, VERTEX, 1, EDGE, 0)
    else:
        write(names, begin + 1, EDGE, 0, VERTEX, high_b)
    return 2


@compiled
def point_found(
    pair: Pair,
    corner: Array,
    normal: Array,
    found: Array,
    gap: float,
    names: IntArray,
    numbers: Array,
    k: int,
) -> None:
    """The point that the distance query found, which is the origin, named by the features it lies on."""
    x, y, z = found[0], found[1], found[2]
    up, down = 0.5 * gap + pair.radius_a, 0.5 * gap + pair.radius_b
    kind_a, i = feature_at(corner, A, pair.count_a, up * x, up * y, up * z, pair.bias)
    kind_b, j = feature_at(
        corner, B, pair.count_b, -down * x, -down * y, -down * z, pair.bias
    )
    write(names, k, kind_a, i, kind_b, j)
    if kind_a + kind_b > FACE:  # a face, and more than a vertex of the other
        for column in range(WIDTH):
            numbers[k, column] = 0.0
        for axis in range(3):
            numbers[k, POINT + axis] = 0.0
            numbers[k, NORMAL + axis] = found[axis]
        numbers[k, SEPARATION] = gap
    else:
        label(pair, corner, normal, names, numbers, k)


@compiled
def feature_at(
    corner: Array, side: int, count: int, x: float, y: float, z: float, bias: float
) -> tuple[int, int]:
    """The vertex, else the edge, else the face of a patch that a point is on."""
    if count == 1:
        return VERTEX, 0
    close = bias * bias
    for i in range(count):
        u, v, w = x - corner[side, i, 0], y - corner[side, i, 1], z - corner[side, i, 2]
        if u * u + v * v + w * w <= close:
            return VERTEX, i
    if count == 2:
        return EDGE, 0
    for i in range(count):
        u, v, w = nearest_on_edge(corner, side, i, count, (x, y, z))
        if (x - u) ** 2 + (y - v) ** 2 + (z - w) ** 2 <= close:
            return EDGE, i
    return FACE, 0


@compiled
def kept(
    names: IntArray,
    numbers: Array,
    begin: int,
    count: int,
    margin: float,
    rounding: float,
) -> int:
    """Close up to the rows with d <= margin, and those as deep as the deepest; how many there are."""
    highest = margin + rounding
    lowest = np.inf
    for k in range(begin, begin + count):
        lowest = min(lowest, numbers[k, SEPARATION])
    highest, left = max(highest, lowest + rounding), begin
    for k in range(begin, begin + count):
        if numbers[k, SEPARATION] > highest:
            continue
        if left < k:
            for column in range(WIDTH):
                numbers[left, column] = numbers[k, column]
            for column in range(5):
                names[left, column] = names[k, column]
        left += 1
    return left - begin


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    room, up = desk(2, 2), np.array([0.0, 0.0, 1.0])
    room.corner[0, :2, 0], room.corner[1, :2, 1] = (-1.0, 1.0), (-1.0, 1.0)
    first = set_manifold_normal(room.normal, 2, 2, up)
    flatten(room.corner, room.normal, 2, 2)
    pair = Pair(2, 2, 0.0, 0.0, 1.0, 1e-6, first)
    rows = np.zeros((9, 8), dtype=np.intp), np.zeros((9, WIDTH))
    meet(pair, room.corner, room.normal, *room[3:], *rows, 0)
    point_found(pair, room.corner, room.normal, up, 0.0, *rows, 0)
    kept(*rows, 0, 1, 0.0, 1e-9)
