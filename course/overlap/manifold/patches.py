"""Which part of a polytope meets the other one: a face, an edge or a vertex.

Along the normal N of a pair, the parts that can touch are the highest of B and the lowest
of A. A *patch* is the largest feature there: a face that leans by less than ``FLAT_ANGLE``
from lying at right angles to N, else an edge that does, else a vertex. It is a closed
polygon of k corners; an edge is one of two, a vertex one of one, so that clipping needs to
know no more kinds.

Source: D. Gregorius, "Robust contact creation for physics simulations", GDC 2015
(reference and incident features); C. Ericson, *Real-Time Collision Detection*, chapter 5.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.convex.separating_axis_loops import Solids as Solids

#: A face or edge that leans by less than this may touch with all of itself [rad].
FLAT_ANGLE = 0.02
FLAT_COSINE, FLAT_SINE = math.cos(FLAT_ANGLE), math.sin(FLAT_ANGLE)
#: What is nearer than this times the smaller solid counts as in one place.
BIAS = 1e-6
#: Two features of which the leaning differs by less are alike; the first is taken.
LEAN_BIAS = 1e-6
#: The sides, and the rows of ``Desk.normal``: of A's face, of B's, of the manifold.
A, B, MANIFOLD = 0, 1, 2


class Desk(NamedTuple):
    """Where a pair is worked on: room for its patches and for clipping.

    corner (2, k, 5): A's and B's corners, counter-clockwise about N: x, y, z from the
    pair's origin, then their two coordinates in the plane of the manifold; vertex (2, k):
    the corners' numbers in their solids; normal (3, 3): see ``MANIFOLD``;
    cut (2, l, 3), leaving (2, l) and what (l, 3): see ``clipping``.
    """

    corner: Array
    vertex: IntArray
    normal: Array
    cut: Array
    leaving: IntArray
    what: IntArray


def desk(corners_a: int, corners_b: int) -> Desk:
    """Room for two patches of so many corners."""
    corners = max(corners_a, corners_b, 2)
    length = 2 * (max(corners_a, 2) + max(corners_b, 2))
    return Desk(
        np.zeros((2, corners, 5)),
        np.zeros((2, corners), dtype=np.intp),
        np.zeros((3, 3)),
        np.zeros((2, length, 3)),
        np.zeros((2, length), dtype=np.intp),
        np.zeros((length, 3), dtype=np.intp),
    )


@compiled
def height(
    vertices: Array, v: int, origin: Array, x: float, y: float, z: float
) -> float:
    """(v - origin) . (x, y, z)"""
    return (
        (vertices[v, 0] - origin[0]) * x
        + (vertices[v, 1] - origin[1]) * y
        + (vertices[v, 2] - origin[2]) * z
    )


@compiled
def distance(vertices: Array, p: int, q: int) -> float:
    """Between two vertices."""
    x = vertices[q, 0] - vertices[p, 0]
    y = vertices[q, 1] - vertices[p, 1]
    z = vertices[q, 2] - vertices[p, 2]
    return math.sqrt(x * x + y * y + z * z)


@compiled
def highest(
    vertices: Array,
    begin: int,
    end: int,
    origin: Array,
    x: float,
    y: float,
    z: float,
) -> float:
    """How far some vertices reach along (x, y, z) from the origin."""
    top = -np.inf
    for v in range(begin, end):
        top = max(top, height(vertices, v, origin, x, y, z))
    return top


@compiled
def supporting_patch(
    solids: Solids,
    solid: int,
    side: int,
    origin: Array,
    normal: Array,
    bias: float,
    corner: Array,
    vertex: IntArray,
    face_normal: Array,
) -> tuple[int, int]:
    """The patch of a solid that looks along N (side B) or against it (side A).

    Args:
        normal: N, (3,).
        bias: what counts as in one place [m].
        corner, vertex, face_normal: of the desk; the side's rows are filled.
    Returns:
        Corners (1 vertex, 2 edge, 3 or more face), and the feature's number among its
        kind in the solid.
    """
    sign = 1.0 if side == B else -1.0
    x, y, z = sign * normal[0], sign * normal[1], sign * normal[2]
    vertices, edges = solids.vertices, solids.edges
    first, last = solids.vertex_start[solid], solids.vertex_start[solid + 1]
    level = highest(vertices, first, last, origin, x, y, z) - bias
    begin, end = solids.face_start[solid], solids.face_start[solid + 1]
    face = flat_face(solids.normals, begin, end, solids.loop, solids.loop_start,
                     vertices, origin, x, y, z, level)  # fmt: skip
    if face >= 0:
        start, stop = solids.loop_start[face], solids.loop_start[face + 1]
        for k in range(stop - start):
            place = k if side == B else stop - start - 1 - k  # A looks down
            take(vertices, first, solids.loop[start + k], origin, side, place, corner, vertex)  # fmt: skip
        for axis in range(3):
            face_normal[side, axis] = solids.normals[face, axis]
        return stop - start, face - begin
    begin, end = solids.edge_start[solid], solids.edge_start[solid + 1]
    edge = flat_edge(edges, begin, end, vertices, origin, x, y, z, level)
    if edge >= 0:
        for k in range(2):
            take(vertices, first, edges[edge, k], origin, side, k, corner, vertex)
        return 2, edge - begin
    for v in range(first, last):
        if height(vertices, v, origin, x, y, z) >= level:
            take(vertices, first, v, origin, side, 0, corner, vertex)
            return 1, v - first
    return 0, -1


@compiled
def flat_face(
    normals: Array,
    begin: int,
    end: int,
    loop: IntArray,
    loop_start: IntArray,
    vertices: Array,
    origin: Array,
    x: float,
    y: float,
    z: float,
    level: float,
) -> int:
    """The face that leans least of those that have a corner at the level or above; -1 if none is flat."""
    best, least = -1, 1.0
    for f in range(begin, end):
        nx, ny, nz = normals[f, 0], normals[f, 1], normals[f, 2]
        if nx * x + ny * y + nz * z < FLAT_COSINE:
            continue
        cx, cy, cz = ny * z - nz * y, nz * x - nx * z, nx * y - ny * x
        leaning = math.sqrt(cx * cx + cy * cy + cz * cz)
        if leaning > least - LEAN_BIAS:
            continue
        for k in range(loop_start[f], loop_start[f + 1]):
            if height(vertices, loop[k], origin, x, y, z) >= level:
                best, least = f, leaning
                break
    return best


@compiled
def flat_edge(
    edges: IntArray,
    begin: int,
    end: int,
    vertices: Array,
    origin: Array,
    x: float,
    y: float,
    z: float,
    level: float,
) -> int:
    """The edge that leans least of those that have an end at the level or above; -1 if none is flat."""
    best, least = -1, FLAT_SINE
    for e in range(begin, end):
        p, q = edges[e, 0], edges[e, 1]
        low = height(vertices, p, origin, x, y, z)
        high = height(vertices, q, origin, x, y, z)
        length = distance(vertices, p, q)
        if max(low, high) < level or length == 0.0:
            continue
        leaning = abs(high - low) / length
        if leaning < least - LEAN_BIAS:
            best, least = e, leaning
    return best


@compiled
def take(
    vertices: Array,
    first: int,
    v: int,
    origin: Array,
    side: int,
    place: int,
    corner: Array,
    vertex: IntArray,
) -> None:
    """Vertex v, of a solid whose first is ``first``, becomes a corner of the patch."""
    for axis in range(3):
        corner[side, place, axis] = vertices[v, axis] - origin[axis]
    vertex[side, place] = v - first


@compiled
def edge_between(
    edges: IntArray, begin: int, end: int, first: int, p: int, q: int
) -> int:
    """The number in its solid of the edge between vertices p and q, counted from ``first``; -1 if there is none."""
    for e in range(begin, end):
        a, b = edges[e, 0] - first, edges[e, 1] - first
        if (a == p and b == q) or (a == q and b == p):
            return e - begin
    return -1


def ball() -> Solids:
    """One sphere of radius 1 about the origin, on which kernels are warmed."""
    from course.overlap.convex.separating_axis import as_kernels_take_it

    whole, none = np.array([0, 1], dtype=np.intp), np.zeros(2, dtype=np.intp)
    arrays = (np.zeros((1, 3)), whole, np.ones(1), np.zeros((0, 3)), none, none[:0],
              none[:1], *np.zeros((2, 0, 2), dtype=np.intp), none)  # fmt: skip
    return Solids(*map(as_kernels_take_it, arrays))


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    up, room = np.array([0.0, 0.0, 1.0]), desk(4, 4)
    supporting_patch(ball(), 0, B, np.zeros(3), up, 0.0, *room[:3])
    edge_between(ball().edges, 0, 0, 0, 0, 1)
