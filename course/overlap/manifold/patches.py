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

#: A face or edge that leans by less than this may touch with all of itself [rad].
FLAT_ANGLE = 0.02
FLAT_COSINE = math.cos(FLAT_ANGLE)
#: What is nearer than this times the smaller solid counts as in one place.
BIAS = 1e-6
#: Two features whose leaning differs by less are alike; the first is taken.
LEAN_BIAS = 1e-6


class Solids(NamedTuple):
    """The arrays of ``course.shapes`` ``Polytopes`` that kernels here read: m solids end to end."""

    vertices: Array
    vertex_start: IntArray
    radius: Array
    normals: Array
    face_start: IntArray
    loop: IntArray
    loop_start: IntArray
    edges: IntArray
    edge_start: IntArray


class Patch(NamedTuple):
    """Room for the patch of one solid.

    corner (k, 3): counter-clockwise about N, from the pair's own origin; vertex (k,):
    their numbers in the solid; flat (k, 2): the corners in the plane of the manifold;
    normal (3,): out of the face, if it is one.
    """

    corner: Array
    vertex: IntArray
    flat: Array
    normal: Array


@compiled
def height_and_size(
    solids: Solids, solid: int, origin: Array, x: float, y: float, z: float
) -> tuple[float, float]:
    """How far a solid's core reaches along (x, y, z) from the origin, and its greatest distance from its first vertex."""
    vertices, first = solids.vertices, solids.vertex_start[solid]
    top, size = -np.inf, 0.0
    for v in range(first, solids.vertex_start[solid + 1]):
        along = height(vertices, v, origin, x, y, z)
        top = max(top, along)
        dx = vertices[v, 0] - vertices[first, 0]
        dy = vertices[v, 1] - vertices[first, 1]
        dz = vertices[v, 2] - vertices[first, 2]
        size = max(size, dx * dx + dy * dy + dz * dz)
    return top, math.sqrt(size)


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
def supporting_patch(
    solids: Solids,
    solid: int,
    origin: Array,
    side: float,
    normal: Array,
    top: float,
    bias: float,
    patch: Patch,
) -> tuple[int, int]:
    """The patch of a solid toward side * normal, which is -1 for A and +1 for B.

    Args:
        top, bias: height of the solid that way, and what counts as being that high.
        patch: is filled.
    Returns:
        Corners (1 vertex, 2 edge, 3 or more face), and the feature's number among its
        kind in the solid.
    """
    x, y, z = side * normal[0], side * normal[1], side * normal[2]
    face = _flat_face(solids, solid, origin, x, y, z, top - bias)
    if face >= 0:
        return _take_face(solids, solid, origin, side, face, patch)
    first, edge = solids.vertex_start[solid], -1
    least = math.sin(FLAT_ANGLE)
    for e in range(solids.edge_start[solid], solids.edge_start[solid + 1]):
        p, q = solids.edges[e, 0], solids.edges[e, 1]
        low = height(solids.vertices, p, origin, x, y, z)
        high = height(solids.vertices, q, origin, x, y, z)
        if max(low, high) < top - bias:
            continue
        leaning = abs(high - low) / _distance(solids.vertices, p, q)
        if leaning < least - LEAN_BIAS:
            least, edge = leaning, e
    if edge >= 0:
        _take(solids, solid, origin, solids.edges[edge, 0], 0, patch)
        _take(solids, solid, origin, solids.edges[edge, 1], 1, patch)
        return 2, edge - solids.edge_start[solid]
    for v in range(first, solids.vertex_start[solid + 1]):
        if height(solids.vertices, v, origin, x, y, z) >= top - bias:
            _take(solids, solid, origin, v, 0, patch)
            return 1, v - first
    return 0, -1


@compiled
def _flat_face(
    solids: Solids,
    solid: int,
    origin: Array,
    x: float,
    y: float,
    z: float,
    level: float,
) -> int:
    """The face that leans least of those that have a corner at the level or above; -1 if none is flat."""
    normals, best, least = solids.normals, -1, 1.0
    for f in range(solids.face_start[solid], solids.face_start[solid + 1]):
        nx, ny, nz = normals[f, 0], normals[f, 1], normals[f, 2]
        if nx * x + ny * y + nz * z < FLAT_COSINE:
            continue
        cx, cy, cz = ny * z - nz * y, nz * x - nx * z, nx * y - ny * x
        leaning = math.sqrt(cx * cx + cy * cy + cz * cz)
        if leaning > least - LEAN_BIAS:
            continue
        for k in range(solids.loop_start[f], solids.loop_start[f + 1]):
            if height(solids.vertices, solids.loop[k], origin, x, y, z) >= level:
                best, least = f, leaning
                break
    return best


@compiled
def _take_face(
    solids: Solids, solid: int, origin: Array, side: float, face: int, patch: Patch
) -> tuple[int, int]:
    """A face's corners, counter-clockwise about N: those of A, which looks down, backwards."""
    begin, end = solids.loop_start[face], solids.loop_start[face + 1]
    for k in range(end - begin):
        place = k if side > 0 else end - begin - 1 - k
        _take(solids, solid, origin, solids.loop[begin + k], place, patch)
    patch.normal[:] = solids.normals[face]
    return end - begin, face - solids.face_start[solid]


@compiled
def _take(
    solids: Solids, solid: int, origin: Array, vertex: int, place: int, patch: Patch
) -> None:
    for axis in range(3):
        patch.corner[place, axis] = solids.vertices[vertex, axis] - origin[axis]
    patch.vertex[place] = vertex - solids.vertex_start[solid]


@compiled
def edge_between(solids: Solids, solid: int, p: int, q: int) -> int:
    """The number of the edge between two vertices of a solid, all numbers the solid's own; -1 if there is none."""
    first, begin = solids.vertex_start[solid], solids.edge_start[solid]
    for e in range(begin, solids.edge_start[solid + 1]):
        a, b = solids.edges[e, 0] - first, solids.edges[e, 1] - first
        if (a == p and b == q) or (a == q and b == p):
            return e - begin
    return -1


@compiled
def _distance(vertices: Array, p: int, q: int) -> float:
    x = vertices[q, 0] - vertices[p, 0]
    y = vertices[q, 1] - vertices[p, 1]
    z = vertices[q, 2] - vertices[p, 2]
    return max(math.sqrt(x * x + y * y + z * z), 1e-300)


def patch_room(corners: int) -> Patch:
    """An empty patch with room for so many corners."""
    return Patch(
        np.zeros((corners, 3)),
        np.zeros(corners, dtype=np.intp),
        np.zeros((corners, 2)),
        np.zeros(3),
    )


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    whole = np.array([0, 1], dtype=np.intp)
    none = np.zeros(2, dtype=np.intp)
    point = Solids(np.zeros((1, 3)), whole, np.ones(1), np.zeros((0, 3)), none,
                   none[:0], none[:1], np.zeros((0, 2), dtype=np.intp), none)  # fmt: skip
    up, origin = np.array([0.0, 0.0, 1.0]), np.zeros(3)
    height_and_size(point, 0, origin, 0.0, 0.0, 1.0)
    supporting_patch(point, 0, origin, 1.0, up, 0.0, 0.0, patch_room(4))
    edge_between(point, 0, 0, 1)
