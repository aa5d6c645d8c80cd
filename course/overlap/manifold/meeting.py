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
from course.overlap.manifold.clipping import CROSSING, SUBJECT, Cut, clip, cut_room
from course.overlap.manifold.labels import (
    EDGE,
    FACE,
    FACE_B,
    KIND_A,
    KIND_B,
    LABEL,
    NORMAL,
    PARALLEL_SINE,
    PLACE_A,
    PLACE_B,
    POINT,
    SEPARATION,
    VERTEX,
    WIDTH,
    Pair,
    label,
    nearest_on_edge,
)
from course.overlap.manifold.patches import Patch, patch_room

#: Where both bodies' features would do, those of the one that lies on this side of the
#: other are taken: no direction that a scene is likely to have lies across it.
UPPER = (0.4170, 0.5743, 0.7046)
#: Two separations that differ by less than this times the smaller solid are one.
SAME_DEPTH = 1e-9


@compiled
def manifold_normal(
    a: Patch, b: Patch, count_a: int, count_b: int, found: Array, normal: Array
) -> None:
    """Along which the two patches are compared: between the normals of two faces, the normal of one, or the one found.

    It does not depend on which of two nearly parallel faces the query took its normal from.
    """
    for axis in range(3):
        normal[axis] = found[axis]
    if count_a > 2 and count_b > 2:
        x, y, z = (
            b.normal[0] - a.normal[0],
            b.normal[1] - a.normal[1],
            b.normal[2] - a.normal[2],
        )
        length = math.sqrt(x * x + y * y + z * z)
        normal[0], normal[1], normal[2] = x / length, y / length, z / length
    elif count_b > 2:
        normal[:] = b.normal
    elif count_a > 2:
        normal[0], normal[1], normal[2] = -a.normal[0], -a.normal[1], -a.normal[2]


@compiled
def preferred(normal: Array) -> float:
    """+1 where A is on the upper side of B, else -1: exchanging A and B exchanges the answer."""
    up = UPPER[0] * normal[0] + UPPER[1] * normal[1] + UPPER[2] * normal[2]
    return 1.0 if up >= 0.0 else -1.0


@compiled
def flatten(normal: Array, a: Patch, count_a: int, b: Patch, count_b: int) -> None:
    """The corners of both patches in the plane at right angles to N, by t_1 and t_2 = N x t_1."""
    x, y, z = normal[0], normal[1], normal[2]
    if abs(x) < 0.6:  # t_1 = (1, 0, 0) without its part along N
        tx, ty, tz = 1.0 - x * x, -x * y, -x * z
    else:
        tx, ty, tz = -y * x, 1.0 - y * y, -y * z
    length = math.sqrt(tx * tx + ty * ty + tz * tz)
    tx, ty, tz = tx / length, ty / length, tz / length
    ux, uy, uz = y * tz - z * ty, z * tx - x * tz, x * ty - y * tx
    for i in range(count_a):
        p = a.corner[i]
        a.flat[i, 0] = p[0] * tx + p[1] * ty + p[2] * tz
        a.flat[i, 1] = p[0] * ux + p[1] * uy + p[2] * uz
    for i in range(count_b):
        p = b.corner[i]
        b.flat[i, 0] = p[0] * tx + p[1] * ty + p[2] * tz
        b.flat[i, 1] = p[0] * ux + p[1] * uy + p[2] * uz


@compiled
def meet(
    pair: Pair,
    found: Array,
    names: IntArray,
    numbers: Array,
    margin: float,
    rounding: float,
    cut: Cut,
    other: Cut,
) -> int:
    """The points of two patches, flattened before.

    Args:
        found: (7,) what the distance query says: point halfway, normal, gap.
        names, numbers: rows to be filled (``labels``); enough for all points.
        margin: greatest separation of a point.
        rounding: by how much a separation may be above it.
        cut, other: room for clipping.
    Returns:
        How many points.
    """
    if pair.count_a > 2 or pair.count_b > 2:
        count = _faces(pair, names, cut, other)
    elif pair.count_a == 2 and pair.count_b == 2:
        count = _edges(pair, names)
    else:
        count = 0
    lowest = np.inf
    for k in range(count):
        label(pair, names[k], numbers[k])
        lowest = min(lowest, numbers[k, SEPARATION])
    edges_bend = pair.count_a < 3 and pair.count_b < 3
    if count == 0 or (edges_bend and lowest > found[6] + rounding):
        _found_point(pair, found, names[count], numbers[count])
        lowest = min(lowest, numbers[count, SEPARATION])
        count += 1
    return _kept(names, numbers, count, max(margin, lowest) + rounding)


@compiled
def _faces(pair: Pair, names: IntArray, cut: Cut, other: Cut) -> int:
    """The corners of what a face and the other patch have in common."""
    a_first = pair.count_b > 2 and (pair.count_a < 3 or pair.first > 0)
    a, b = pair.a.flat, pair.b.flat
    if a_first:
        count = clip(a, pair.count_a, b, pair.count_b, pair.bias, cut, other)
    else:
        count = clip(b, pair.count_b, a, pair.count_a, pair.bias, cut, other)
    for k in range(count):
        what = cut.what[k, 0]
        if what == CROSSING:
            mine, place = EDGE, cut.what[k, 1]
            theirs, there = EDGE, cut.what[k, 2]
        elif what == SUBJECT:
            mine, place, theirs, there = VERTEX, cut.what[k, 1], FACE, 0
        else:
            mine, place, theirs, there = FACE, 0, VERTEX, cut.what[k, 2]
        if a_first:
            _write(names[k], mine, place, theirs, there)
        else:
            _write(names[k], theirs, there, mine, place)
    return count


@compiled
def _write(row: IntArray, kind_a: int, i: int, kind_b: int, j: int) -> None:
    row[LABEL] = FACE_B
    row[KIND_A], row[PLACE_A], row[KIND_B], row[PLACE_B] = kind_a, i, kind_b, j


@compiled
def _edges(pair: Pair, names: IntArray) -> int:
    """Two edges seen along the normal: one crossing, two ends, or nothing in common."""
    p, q = pair.a.flat, pair.b.flat
    ex, ey = p[1, 0] - p[0, 0], p[1, 1] - p[0, 1]
    fx, fy = q[1, 0] - q[0, 0], q[1, 1] - q[0, 1]
    e, f = math.sqrt(ex * ex + ey * ey), math.sqrt(fx * fx + fy * fy)
    if e == 0.0 or f == 0.0:
        return 0
    wx, wy = q[0, 0] - p[0, 0], q[0, 1] - p[0, 1]
    cross = ex * fy - ey * fx
    if abs(cross) <= PARALLEL_SINE * e * f:
        along_q = (wx * ex + wy * ey) / e
        end_q = along_q + (fx * ex + fy * ey) / e
        return _shared_length(pair, names, e, along_q, end_q)
    s, t = (wx * fy - wy * fx) / cross, (wx * ey - wy * ex) / cross
    slack_s, slack_t = pair.bias / e, pair.bias / f
    if min(s, 1.0 - s) < -slack_s or min(t, 1.0 - t) < -slack_t:
        return 0
    _write(names[0], EDGE, 0, EDGE, 0)
    return 1


@compiled
def _shared_length(
    pair: Pair, names: IntArray, length: float, start: float, end: float
) -> int:
    """The ends of what two parallel edges share; A's runs from 0 to its length, B's from start to end.

    Each is a vertex of one body beside the edge of the other; where two vertices lie
    together, it is that of the preferred body.
    """
    tie = pair.bias if pair.first > 0 else -pair.bias
    low_b, high_b = (0, 1) if start <= end else (1, 0)
    low, high = min(start, end), max(start, end)
    if min(high, length) - max(low, 0.0) < -pair.bias:
        return 0
    count = 1
    if low <= tie:
        _write(names[0], VERTEX, 0, EDGE, 0)
    else:
        _write(names[0], EDGE, 0, VERTEX, low_b)
    if min(high, length) - max(low, 0.0) > pair.bias:
        if high >= length - tie:
            _write(names[1], VERTEX, 1, EDGE, 0)
        else:
            _write(names[1], EDGE, 0, VERTEX, high_b)
        count = 2
    return count


@compiled
def _found_point(pair: Pair, found: Array, names: IntArray, numbers: Array) -> None:
    """The point that the distance query found, named by the features it lies on."""
    half, n = 0.5 * found[6], found[3:6]
    on_a, on_b = half + pair.radius_a, half + pair.radius_b
    p = (found[0] + on_a * n[0], found[1] + on_a * n[1], found[2] + on_a * n[2])
    q = (found[0] - on_b * n[0], found[1] - on_b * n[1], found[2] - on_b * n[2])
    kind_a, i = _feature_at(pair.a, pair.count_a, p, pair.bias)
    kind_b, j = _feature_at(pair.b, pair.count_b, q, pair.bias)
    _write(names, kind_a, i, kind_b, j)
    if (kind_a == FACE and kind_b != VERTEX) or (kind_b == FACE and kind_a != VERTEX):
        numbers[:] = 0.0
        for axis in range(3):
            numbers[POINT + axis] = found[axis]
            numbers[NORMAL + axis] = n[axis]
        numbers[SEPARATION] = found[6]
    else:
        label(pair, names, numbers)


@compiled
def _feature_at(
    patch: Patch, count: int, p: tuple[float, float, float], bias: float
) -> tuple[int, int]:
    """The vertex, else the edge, else the face of a patch that a point is on."""
    close, corner = bias * bias, patch.corner
    if count == 1:
        return VERTEX, 0
    for i in range(count):
        x, y, z = p[0] - corner[i, 0], p[1] - corner[i, 1], p[2] - corner[i, 2]
        if x * x + y * y + z * z <= close:
            return VERTEX, i
    if count == 2:
        return EDGE, 0
    for i in range(count):
        x, y, z = nearest_on_edge(patch, count, i, p)
        x, y, z = p[0] - x, p[1] - y, p[2] - z
        if x * x + y * y + z * z <= close:
            return EDGE, i
    return FACE, 0


@compiled
def _kept(names: IntArray, numbers: Array, count: int, highest: float) -> int:
    """Close up to the rows with d at or below the highest."""
    kept = 0
    for k in range(count):
        if numbers[k, SEPARATION] > highest:
            continue
        if kept < k:
            for column in range(WIDTH):
                numbers[kept, column] = numbers[k, column]
            for column in range(5):
                names[kept, column] = names[k, column]
        kept += 1
    return kept


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    a, b = patch_room(4), patch_room(4)
    a.corner[:2] = [(-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)]
    b.corner[:2] = [(0.0, -1.0, 0.0), (0.0, 1.0, 0.0)]
    up, found = np.zeros(3), np.array([0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0])
    manifold_normal(a, b, 2, 2, found[3:6], up)
    flatten(up, a, 2, b, 2)
    pair = Pair(a, b, 2, 2, 0.0, 0.0, up, 1.0, 1e-6, preferred(up))
    rows = np.zeros((9, 5), dtype=np.intp), np.zeros((9, WIDTH))
    meet(pair, found, *rows, 0.0, 1e-9, cut_room(12), cut_room(12))
