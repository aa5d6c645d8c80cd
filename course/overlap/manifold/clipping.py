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
from typing import NamedTuple

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled

#: What a corner is.
SUBJECT, CROSSING, CLIP = 0, 1, 2


class Cut(NamedTuple):
    """Room for a polygon that is being cut.

    place (k, 2); what (k, 4): kind, edge or vertex of the subject, edge or vertex of
    the clip polygon, and the edge that leaves: i of the subject, -1 - j of the clip
    polygon; inward (k,): heights above the line.
    """

    place: Array
    what: IntArray
    inward: Array


@compiled
def clip(
    subject: Array, m: int, polygon: Array, n: int, bias: float, first: Cut, second: Cut
) -> int:
    """Clip m corners of the subject (1: a point, 2: a segment) by a polygon of n, both counter-clockwise.

    Returns:
        How many corners the common part has; they are in ``first``.
    """
    count = m
    for i in range(m):
        first.place[i, 0], first.place[i, 1] = subject[i, 0], subject[i, 1]
        _name(first, i, SUBJECT, i, -1, i)
    for j in range(n):
        k = j + 1 if j + 1 < n else 0
        x, y = polygon[j, 0], polygon[j, 1]
        ux, uy = polygon[k, 0] - x, polygon[k, 1] - y
        length = math.sqrt(ux * ux + uy * uy)
        if length == 0.0:
            continue
        ux, uy = ux / length, uy / length
        lowest = np.inf
        for i in range(count):
            above = ux * (first.place[i, 1] - y) - uy * (first.place[i, 0] - x)
            first.inward[i] = above
            lowest = min(lowest, above)
        if lowest >= -bias:
            continue
        kept = _cut(first, count, polygon, n, j, bias, second)
        for i in range(kept):
            for axis in range(2):
                first.place[i, axis] = second.place[i, axis]
            for column in range(4):
                first.what[i, column] = second.what[i, column]
        count = kept
        if count == 0:
            return 0
    return _merged(first, count, subject, m, polygon, n, bias)


@compiled
def _cut(
    cut: Cut, count: int, polygon: Array, n: int, line: int, bias: float, result: Cut
) -> int:
    """What lies inside one line, by the heights above it."""
    kept = 0
    for i in range(count):
        k = i + 1 if i + 1 < count else 0
        here, there = cut.inward[i], cut.inward[k]
        if here >= -bias:
            result.place[kept, 0], result.place[kept, 1] = (
                cut.place[i, 0],
                cut.place[i, 1],
            )
            for column in range(4):
                result.what[kept, column] = cut.what[i, column]
            kept += 1
        if (here >= -bias) != (there >= -bias) and kept < len(result.place):
            t = min(max(here / (here - there), 0.0), 1.0)
            for axis in range(2):
                result.place[kept, axis] = cut.place[i, axis] + t * (
                    cut.place[k, axis] - cut.place[i, axis]
                )
            edge = cut.what[i, 3]
            leaving = -1 - line if here >= -bias else edge
            if edge >= 0:
                _name(result, kept, CROSSING, edge, line, leaving)
            else:
                _name(
                    result, kept, CLIP, -1, _shared(-1 - edge, line, polygon, n,
                    result.place, kept), leaving,
                )  # fmt: skip
            kept += 1
        if kept >= len(result.place):
            break
    return kept


@compiled
def _shared(
    before: int, line: int, polygon: Array, n: int, place: Array, at: int
) -> int:
    """The vertex where two edges of the clip polygon meet; rounding aside they are neighbours."""
    after = line + 1 if line + 1 < n else 0
    if before == after:
        return after
    if (before + 1) % n == line:
        return line
    near_line = _squared(polygon, line, place, at)
    return line if near_line <= _squared(polygon, after, place, at) else after


@compiled
def _merged(
    cut: Cut, count: int, subject: Array, m: int, polygon: Array, n: int, bias: float
) -> int:
    """Crossings beside a vertex become it, what is in one place twice goes, and so do crossings on a straight line."""
    close, kept = bias * bias, 0
    for i in range(count):
        if cut.what[i, 0] == CROSSING:
            _take_vertex_beside(cut, i, subject, m, polygon, n, close)
        if kept and _squared(cut.place, kept - 1, cut.place, i) <= close:
            if cut.what[i, 0] == SUBJECT or (
                cut.what[i, 0] == CLIP and cut.what[kept - 1, 0] == CROSSING
            ):
                _move(cut, i, kept - 1)
            continue
        _move(cut, i, kept)
        kept += 1
    while kept > 1 and _squared(cut.place, kept - 1, cut.place, 0) <= close:
        if cut.what[0, 0] == CROSSING or (
            cut.what[0, 0] == CLIP and cut.what[kept - 1, 0] == SUBJECT
        ):
            _move(cut, kept - 1, 0)
        kept -= 1
    i = 0
    while kept > 2 and i < kept:
        if cut.what[i, 0] == CROSSING and _straight(cut.place, kept, i, bias):
            for k in range(i + 1, kept):
                _move(cut, k, k - 1)
            kept -= 1
        else:
            i += 1
    return kept


@compiled
def _take_vertex_beside(
    cut: Cut, i: int, subject: Array, m: int, polygon: Array, n: int, close: float
) -> None:
    edge, line = cut.what[i, 1], cut.what[i, 2]
    for end in (edge, (edge + 1) % m):
        if _squared(subject, end, cut.place, i) <= close:
            cut.place[i, 0], cut.place[i, 1] = subject[end, 0], subject[end, 1]
            _name(cut, i, SUBJECT, end, -1, cut.what[i, 3])
            return
    for end in (line, (line + 1) % n):
        if _squared(polygon, end, cut.place, i) <= close:
            cut.place[i, 0], cut.place[i, 1] = polygon[end, 0], polygon[end, 1]
            _name(cut, i, CLIP, -1, end, cut.what[i, 3])
            return


@compiled
def _straight(place: Array, count: int, i: int, bias: float) -> bool:
    """Whether corner i lies between its neighbours, on the line through them."""
    p, q = (i - 1) % count, (i + 1) % count
    ux, uy = place[q, 0] - place[p, 0], place[q, 1] - place[p, 1]
    wx, wy = place[i, 0] - place[p, 0], place[i, 1] - place[p, 1]
    square, along = ux * ux + uy * uy, wx * ux + wy * uy
    if not 0.0 <= along <= square:
        return False
    return abs(ux * wy - uy * wx) <= bias * math.sqrt(square)


@compiled
def _name(
    cut: Cut, i: int, kind: int, of_subject: int, of_polygon: int, leaving: int
) -> None:
    cut.what[i, 0], cut.what[i, 1], cut.what[i, 2] = kind, of_subject, of_polygon
    cut.what[i, 3] = leaving


@compiled
def _move(cut: Cut, source: int, target: int) -> None:
    cut.place[target, 0], cut.place[target, 1] = (
        cut.place[source, 0],
        cut.place[source, 1],
    )
    for column in range(4):
        cut.what[target, column] = cut.what[source, column]


@compiled
def _squared(p: Array, i: int, q: Array, k: int) -> float:
    x, y = p[i, 0] - q[k, 0], p[i, 1] - q[k, 1]
    return x * x + y * y


def cut_room(corners: int) -> Cut:
    """An empty polygon with room for so many corners."""
    return Cut(
        np.zeros((corners, 2)),
        np.zeros((corners, 4), dtype=np.intp),
        np.zeros(corners),
    )


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    clip(square + 0.5, 4, square, 4, 1e-9, cut_room(16), cut_room(16))
