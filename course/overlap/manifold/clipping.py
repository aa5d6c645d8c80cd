"""Where two convex polygons in a plane overlap, with every corner named by what makes it.

Sutherland and Hodgman's clipping ("Reentrant polygon clipping", Communications of the ACM
17(1), 1974; C. Ericson, *Real-Time Collision Detection*, section 8.3.4): the *subject* is
cut by the line of each edge of the *clip* polygon in turn, and what is on its inner side
stays. Every corner remembers only the edge that leaves it: edge i of the subject as i, edge
j of the clip polygon as -1 - j. So in the end a corner between

* two edges of the subject is a vertex of it;
* two edges of the clip polygon is one of its vertices;
* an edge of each is a *crossing*.

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
    leaving: IntArray,
    what: IntArray,
) -> int:
    """Clip one side's patch by the other's.

    Args:
        corner: of the ``Desk``; the sides' corners in the plane are its columns 3 and 4.
        subject: the side that is cut.
        m, n: corners of the subject (1: a point, 2: a segment), and of the polygon.
        bias: what counts as in one place [m].
        cut, leaving: (2, l, 3), (2, l), two polygons by turns: x, y, height above a line;
            the edge that leaves.
        what: (l, 3), what each corner of the common part is: kind, edge (or vertex, if
            it is one) of the subject, and of the clip polygon.
    Returns:
        How many corners the common part has.
    """
    now, count, polygon = 0, m, 1 - subject
    for i in range(m):
        cut[0, i, 0], cut[0, i, 1] = corner[subject, i, 3], corner[subject, i, 4]
        leaving[0, i] = i
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
        count = cut_by_line(cut, leaving, now, count, j, bias)
        now = 1 - now
        if count == 0:
            return 0
    name(cut, leaving, now, count, corner, polygon, n, what)
    return merged(cut, what, now, count, corner, subject, m, n, bias)


@compiled
def cut_by_line(
    cut: Array, leaving: IntArray, now: int, count: int, line: int, bias: float
) -> int:
    """What lies inside one line, by the heights above it; it goes to the other polygon."""
    new, kept, room = 1 - now, 0, cut.shape[1] - 1
    for i in range(count):
        k = i + 1 if i + 1 < count else 0
        here, there = cut[now, i, 2], cut[now, k, 2]
        inside = here >= -bias
        x, y, edge = cut[now, i, 0], cut[now, i, 1], leaving[now, i]
        if inside:
            cut[new, kept, 0], cut[new, kept, 1], leaving[new, kept] = x, y, edge
            kept += 1
        if inside != (there >= -bias):
            t = min(max(here / (here - there), 0.0), 1.0)
            cut[new, kept, 0] = x + t * (cut[now, k, 0] - x)
            cut[new, kept, 1] = y + t * (cut[now, k, 1] - y)
            leaving[new, kept] = -1 - line if inside else edge
            kept += 1
        if kept >= room:
            break
    return kept


@compiled
def name(
    cut: Array,
    leaving: IntArray,
    now: int,
    count: int,
    corner: Array,
    polygon: int,
    n: int,
    what: IntArray,
) -> None:
    """Say what each corner is, by the edges that arrive there and leave."""
    arrives = leaving[now, count - 1]
    for i in range(count):
        leaves = leaving[now, i]
        if arrives >= 0 and leaves >= 0:
            what[i, 0], what[i, 1], what[i, 2] = SUBJECT, leaves, -1
        elif arrives < 0 and leaves < 0:
            v = shared(cut, now, i, corner, polygon, n, -1 - arrives, -1 - leaves)
            what[i, 0], what[i, 1], what[i, 2] = CLIP, -1, v
        else:
            what[i, 0] = CROSSING
            what[i, 1], what[i, 2] = max(arrives, leaves), -1 - min(arrives, leaves)
        arrives = leaves


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
        if what[i, 0] == CROSSING:
            take_vertex_beside(cut, what, now, i, corner, subject, m, n, close)
        if kept and twice(cut, now, kept - 1, i) <= close:
            if what[i, 0] < what[kept - 1, 0]:
                move(cut, what, now, i, kept - 1)
            continue
        if kept < i:
            move(cut, what, now, i, kept)
        kept += 1
    while kept > 1 and twice(cut, now, kept - 1, 0) <= close:
        if what[kept - 1, 0] < what[0, 0]:
            move(cut, what, now, kept - 1, 0)
        kept -= 1
    i = 0
    while kept > 2 and i < kept:
        if what[i, 0] == CROSSING and straight(cut, now, kept, i, close):
            for k in range(i + 1, kept):
                move(cut, what, now, k, k - 1)
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
    """A crossing in one place with an end of one of its edges is that vertex, the subject's before the other."""
    edge, line, polygon = what[i, 1], what[i, 2], 1 - subject
    for end in (edge, edge + 1 if edge + 1 < m else 0):
        if squared(cut, now, i, corner, subject, end) <= close:
            cut[now, i, 0], cut[now, i, 1] = corner[subject, end, 3], corner[subject, end, 4]  # fmt: skip
            what[i, 0], what[i, 1], what[i, 2] = SUBJECT, end, -1
            return
    for end in (line, line + 1 if line + 1 < n else 0):
        if squared(cut, now, i, corner, polygon, end) <= close:
            cut[now, i, 0], cut[now, i, 1] = corner[polygon, end, 3], corner[polygon, end, 4]  # fmt: skip
            what[i, 0], what[i, 1], what[i, 2] = CLIP, -1, end
            return


@compiled
def straight(cut: Array, now: int, count: int, i: int, close: float) -> bool:
    """Whether corner i lies between its neighbours, on the line through them."""
    p, q = i - 1 if i else count - 1, i + 1 if i + 1 < count else 0
    ux, uy = cut[now, q, 0] - cut[now, p, 0], cut[now, q, 1] - cut[now, p, 1]
    wx, wy = cut[now, i, 0] - cut[now, p, 0], cut[now, i, 1] - cut[now, p, 1]
    square, along, across = ux * ux + uy * uy, wx * ux + wy * uy, ux * wy - uy * wx
    return 0.0 <= along <= square and across * across <= close * square


@compiled
def move(cut: Array, what: IntArray, now: int, i: int, k: int) -> None:
    """Corner i becomes corner k."""
    cut[now, k, 0], cut[now, k, 1] = cut[now, i, 0], cut[now, i, 1]
    what[k, 0], what[k, 1], what[k, 2] = what[i, 0], what[i, 1], what[i, 2]


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
    clip(room.corner, A, 4, 4, 1e-9, *room[3:])
