"""Where two convex polygons in a plane overlap, with every corner named by what makes it.

Sutherland and Hodgman's clipping ("Reentrant polygon clipping", Communications of the ACM
17(1), 1974; C. Ericson, *Real-Time Collision Detection*, section 8.3.4): the *subject* is
cut by the line of each edge of the *clip* polygon in turn, and what is on its inner side
stays. Each corner remembers the edge that leaves it, so that a new corner is

* on an edge of the subject and an edge of the clip polygon: a *crossing*;
* on two edges of the clip polygon: one of its vertices.

**Ties.** What is within ``bias`` of a line counts as inside, so a vertex of the subject on
the border of the clip polygon stays and makes no crossings; a crossing within ``bias`` of a
vertex is that vertex; of two vertices in one place the subject's stays; a crossing that is
within ``bias`` of the line through its neighbours says nothing and goes. So the corners of
two polygons that coincide, or share an edge or a corner, are the same ones however they
are shaken by much less than ``bias``. The hull of the corners is exact to ``bias``.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.manifold.patches import A, desk

#: What a corner is; of two in one place the lesser stays.
SUBJECT, CLIP, CROSSING = 0, 1, 2


@compiled
def clip(
    corner: Array,
    subject: int,
    m: int,
    n: int,
    bias: float,
    cut: Array,
    what: IntArray,
) -> tuple[int, int]:
    """Clip one side's patch by the other's.

    Args:
        corner: of the ``Desk``; the sides' corners in the plane are its columns 3 and 4.
        subject: the side that is cut.
        m, n: corners of the subject (1: a point, 2: a segment), and of the polygon.
        bias: what counts as in one place [m].
        cut: (2, l, 3), two polygons by turns: x, y, height above a line.
        what: (2, l, 4) of each corner: what it is; the subject's edge (or vertex, if it
            is one), the clip polygon's; and the edge that leaves it: i of the
            subject, -1 - j of the clip polygon.
    Returns:
        How many corners the common part has, and which of the two polygons it is.
    """
    now, count, polygon = 0, m, 1 - subject
    for i in range(m):
        cut[0, i, 0], cut[0, i, 1] = corner[subject, i, 3], corner[subject, i, 4]
        name(what, 0, i, SUBJECT, i, -1, i)
    for j in range(n):
        k = j + 1 if j + 1 < n else 0
        x, y = corner[polygon, j, 3], corner[polygon, j, 4]
        ux, uy = corner[polygon, k, 3] - x, corner[polygon, k, 4] - y
        length = math.sqrt(ux * ux + uy * uy)
        if length == 0.0:
            continue
        ux, uy = ux / length, uy / length
        lowest = np.inf
        for i in range(count):
            above = ux * (cut[now, i, 1] - y) - uy * (cut[now, i, 0] - x)
            cut[now, i, 2] = above
            lowest = min(lowest, above)
        if lowest >= -bias:
            continue
        count = cut_by_line(cut, what, now, count, corner, polygon, n, j, bias)
        now = 1 - now
        if count == 0:
            return 0, now
    return merged(cut, what, now, count, corner, subject, m, n, bias), now


@compiled
def cut_by_line(
    cut: Array,
    what: IntArray,
    now: int,
    count: int,
    corner: Array,
    polygon: int,
    n: int,
    line: int,
    bias: float,
) -> int:
    """What lies inside one line, by the heights above it; it goes to the other polygon."""
    new, kept, room = 1 - now, 0, cut.shape[1] - 1
    for i in range(count):
        k = i + 1 if i + 1 < count else 0
        here, there = cut[now, i, 2], cut[now, k, 2]
        if here >= -bias:
            move(cut, what, now, i, new, kept)
            kept += 1
        if (here >= -bias) != (there >= -bias):
            t = min(max(here / (here - there), 0.0), 1.0)
            for axis in range(2):
                cut[new, kept, axis] = cut[now, i, axis] + t * (
                    cut[now, k, axis] - cut[now, i, axis]
                )
            edge = what[now, i, 3]
            leaving = -1 - line if here >= -bias else edge
            if edge >= 0:
                name(what, new, kept, CROSSING, edge, line, leaving)
            else:
                v = shared(cut, new, kept, corner, polygon, n, -1 - edge, line)
                name(what, new, kept, CLIP, -1, v, leaving)
            kept += 1
        if kept >= room:
            break
    return kept


@compiled
def shared(
    cut: Array,
    now: int,
    i: int,
    corner: Array,
    polygon: int,
    n: int,
    before: int,
    line: int,
) -> int:
    """The vertex where two edges of the clip polygon meet; but for rounding they are neighbours."""
    after = line + 1 if line + 1 < n else 0
    if before + 1 == line:
        return line
    if before == after:
        return after
    here = squared(cut, now, i, corner, polygon, line)
    return line if here <= squared(cut, now, i, corner, polygon, after) else after


@compiled
def merged(
    cut: Array,
    what: IntArray,
    now: int,
    count: int,
    corner: Array,
    subject: int,
    m: int,
    n: int,
    bias: float,
) -> int:
    """Crossings beside a vertex become it; what is in one place twice goes, and so do crossings on a straight line."""
    close, kept = bias * bias, 0
    for i in range(count):
        if what[now, i, 0] == CROSSING:
            take_vertex_beside(cut, what, now, i, corner, subject, m, n, close)
        if kept and twice(cut, now, kept - 1, i) <= close:
            if what[now, i, 0] < what[now, kept - 1, 0]:
                move(cut, what, now, i, now, kept - 1)
            continue
        move(cut, what, now, i, now, kept)
        kept += 1
    while kept > 1 and twice(cut, now, kept - 1, 0) <= close:
        if what[now, kept - 1, 0] < what[now, 0, 0]:
            move(cut, what, now, kept - 1, now, 0)
        kept -= 1
    i = 0
    while kept > 2 and i < kept:
        if what[now, i, 0] == CROSSING and straight(cut, now, kept, i, bias):
            for k in range(i + 1, kept):
                move(cut, what, now, k, now, k - 1)
            kept -= 1
        else:
            i += 1
    return kept


@compiled
def take_vertex_beside(
    cut: Array,
    what: IntArray,
    now: int,
    i: int,
    corner: Array,
    subject: int,
    m: int,
    n: int,
    close: float,
) -> None:
    """A crossing that is in one place with an end of one of its edges is that vertex, the subject's before the other."""
    edge, line, polygon = what[now, i, 1], what[now, i, 2], 1 - subject
    for end in (edge, edge + 1 if edge + 1 < m else 0):
        if squared(cut, now, i, corner, subject, end) <= close:
            cut[now, i, 0], cut[now, i, 1] = corner[subject, end, 3], corner[subject, end, 4]  # fmt: skip
            name(what, now, i, SUBJECT, end, -1, what[now, i, 3])
            return
    for end in (line, line + 1 if line + 1 < n else 0):
        if squared(cut, now, i, corner, polygon, end) <= close:
            cut[now, i, 0], cut[now, i, 1] = corner[polygon, end, 3], corner[polygon, end, 4]  # fmt: skip
            name(what, now, i, CLIP, -1, end, what[now, i, 3])
            return


@compiled
def straight(cut: Array, now: int, count: int, i: int, bias: float) -> bool:
    """Whether corner i lies between its neighbours, on the line through them."""
    p, q = i - 1 if i else count - 1, i + 1 if i + 1 < count else 0
    ux, uy = cut[now, q, 0] - cut[now, p, 0], cut[now, q, 1] - cut[now, p, 1]
    wx, wy = cut[now, i, 0] - cut[now, p, 0], cut[now, i, 1] - cut[now, p, 1]
    square, along = ux * ux + uy * uy, wx * ux + wy * uy
    if not 0.0 <= along <= square:
        return False
    return abs(ux * wy - uy * wx) <= bias * math.sqrt(square)


@compiled
def name(
    what: IntArray,
    now: int,
    i: int,
    kind: int,
    of_subject: int,
    of_polygon: int,
    leaving: int,
) -> None:
    """Say what a corner is."""
    what[now, i, 0], what[now, i, 1] = kind, of_subject
    what[now, i, 2], what[now, i, 3] = of_polygon, leaving


@compiled
def move(cut: Array, what: IntArray, now: int, i: int, new: int, k: int) -> None:
    """Corner i of one polygon becomes corner k of another or of the same."""
    cut[new, k, 0], cut[new, k, 1] = cut[now, i, 0], cut[now, i, 1]
    for column in range(4):
        what[new, k, column] = what[now, i, column]


@compiled
def twice(cut: Array, now: int, i: int, k: int) -> float:
    """The squared distance of two corners of a polygon."""
    x, y = cut[now, i, 0] - cut[now, k, 0], cut[now, i, 1] - cut[now, k, 1]
    return x * x + y * y


@compiled
def squared(
    cut: Array, now: int, i: int, corner: Array, side: int, vertex: int
) -> float:
    """The squared distance of a corner from one of a patch."""
    x, y = cut[now, i, 0] - corner[side, vertex, 3], cut[now, i, 1] - corner[side, vertex, 4]  # fmt: skip
    return x * x + y * y


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    room = desk(4, 4)
    room.corner[0, :, 3:] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
    room.corner[1, :, 3:] = room.corner[0, :, 3:] + 0.5
    clip(room.corner, A, 4, 4, 1e-9, room.cut, room.what)
