"""Distance of two polytopes by trying all pairs of features: slow, and always right.

The surface of A - B is made of faces of A less vertices of B, vertices of A less faces of B,
and parallelograms of an edge of each (C. Ericson, *Real-Time Collision Detection*, section 9.1).
Apart, the distance is the least distance of any of them from the origin; each is cut
into triangles here. Serves where GJK cannot say how near its answer is, and as its test.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.convex.gjk import ONE, TWO, ZERO, on_triangle
from course.overlap.convex.separating_axis_loops import Solids

#: Whether the vertices are B's; no words written out, see ``ZERO``.
PLAIN, SWAPPED = np.array([False, True])


@compiled
def put(w: Array, pick: IntArray, m: int, a: Array, i: int, b: Array, j: int) -> None:
    """Corner m of the simplex is a_i - b_j."""
    w[m, 0], w[m, 1], w[m, 2] = a[i, 0] - b[j, 0], a[i, 1] - b[j, 1], a[i, 2] - b[j, 2]
    pick[m, 0], pick[m, 1] = i, j


@compiled
def offer(
    w: Array, trial: IntArray, least: float, pick: IntArray, share: Array
) -> float:
    """The triangle w against the least squared distance so far; what is nearer is kept in pick and share."""
    square, p, q, r = on_triangle(w, ZERO, ONE, TWO)
    if square >= least:
        return least
    share[0], share[1], share[2] = p, q, r
    for m in range(3):
        pick[m, 0], pick[m, 1] = trial[m, 0], trial[m, 1]
    return square


@compiled
def vertices_and_faces(
    a: Array,
    b: Array,
    points: Solids,
    i: int,
    faces: Solids,
    j: int,
    swapped: bool,
    least: float,
    pick: IntArray,
    share: Array,
) -> float:
    """Every vertex of solid i against every face of solid j; swapped: i is B's."""
    w, trial = np.empty((4, 3)), np.empty((4, 2), np.intp)
    first = faces.vertex_start[j]
    for k in range(points.vertex_start[i + 1] - points.vertex_start[i]):
        for f in range(faces.face_start[j], faces.face_start[j + 1]):
            corner = faces.loop[faces.loop_start[f]] - first
            for n in range(faces.loop_start[f] + 2, faces.loop_start[f + 1]):
                other = faces.loop[n - 1] - first, faces.loop[n] - first
                if swapped:
                    put(w, trial, ZERO, a, corner, b, k)
                    put(w, trial, ONE, a, other[0], b, k)
                    put(w, trial, TWO, a, other[1], b, k)
                else:
                    put(w, trial, ZERO, a, k, b, corner)
                    put(w, trial, ONE, a, k, b, other[0])
                    put(w, trial, TWO, a, k, b, other[1])
                least = offer(w, trial, least, pick, share)
    return least


@compiled
def edge_ends(solids: Solids, i: int, e: int) -> tuple[int, int]:
    """The vertices of edge e of solid i, counted from its own first; a point's one edge is from 0 to 0."""
    k = solids.edge_start[i] + e
    if k >= solids.edge_start[i + 1]:
        return ZERO, ZERO
    first = solids.vertex_start[i]
    return solids.edges[k, 0] - first, solids.edges[k, 1] - first


@compiled
def edges_and_edges(
    a: Array,
    b: Array,
    solids_a: Solids,
    i: int,
    solids_b: Solids,
    j: int,
    least: float,
    pick: IntArray,
    share: Array,
) -> float:
    """Every edge of A against every edge of B: a parallelogram, two triangles."""
    w, trial = np.empty((4, 3)), np.empty((4, 2), np.intp)
    edges_a = max(1, solids_a.edge_start[i + 1] - solids_a.edge_start[i])
    edges_b = max(1, solids_b.edge_start[j + 1] - solids_b.edge_start[j])
    for e in range(edges_a):
        p, q = edge_ends(solids_a, i, e)
        for f in range(edges_b):
            r, s = edge_ends(solids_b, j, f)
            put(w, trial, ZERO, a, p, b, r)
            put(w, trial, ONE, a, q, b, r)
            put(w, trial, TWO, a, q, b, s)
            least = offer(w, trial, least, pick, share)
            put(w, trial, ONE, a, p, b, s)
            least = offer(w, trial, least, pick, share)
    return least


@compiled
def nearest_of_all(
    a: Array,
    b: Array,
    solids_a: Solids,
    i: int,
    solids_b: Solids,
    j: int,
    pick: IntArray,
    share: Array,
) -> float:
    """The squared distance of the surfaces of two polytopes.

    Args:
        a, b: their vertices, which may be shifted and scaled together.
        pick, share: (4, 2) and (4,): three pairs of vertices are left there, and their
            weights at the nearest points.
    """
    least = edges_and_edges(a, b, solids_a, i, solids_b, j, math.inf, pick, share)
    least = vertices_and_faces(a, b, solids_a, i, solids_b, j, PLAIN, least, pick, share)  # fmt: skip
    return vertices_and_faces(
        a, b, solids_b, j, solids_a, i, SWAPPED, least, pick, share
    )


def warm() -> None:
    """Called by others only (``course.jit``); ``course.overlap.convex.closest_loops`` compiles it."""
