"""Separating axes in loops: two polytopes, by the faces and edges of both.

For a unit vector N the *separation along N* is the least N.a of A less the greatest N.b of B.
No translation along N by less than its opposite parts the two, so that

    gap = max over N of (min_A N.a - max_B N.b)

for overlapping solids, and the greatest is at a face of A - B. These faces are those of A
(turned round), those of B, and one for each pair of edges that cross on the Gauss map
(C. Ericson, *Real-Time Collision Detection*, section 5.2.1; S. Gottschalk, M. C. Lin, D. Manocha,
"OBBTree", SIGGRAPH 1996; D. Gregorius, "The Separating Axis Test", GDC 2013).

Whatever is tried as N, the separation along it is a lower bound of the gap, as long as all
vertices are asked and N has length 1. An axis that rounding has turned, the product of two
nearly parallel edges say, can therefore do no harm, and no epsilon decides a verdict.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled

#: Sine of the angle below which two edges are parallel: their product is rounding.
PARALLEL = 1e-14
#: Cosine of half the angle of the arc between an edge's faces below which it does not say
#: which way is out.
THIN = 1e-3
#: Where in an arc's row its direction and its two normals begin; from an array, because a number
#: written out has machine code of its own wherever it is an argument.
ALONG, ONE, OTHER = np.array([3, 6, 9])


class Solids(NamedTuple):
    """The arrays of ``Polytopes`` as kernels take them: vertices, faces and edges of m solids end to end."""

    vertices: Array
    vertex_start: IntArray
    radius: Array
    normals: Array
    face_start: IntArray
    loop: IntArray
    loop_start: IntArray
    edges: IntArray
    edge_faces: IntArray
    edge_start: IntArray


@compiled
def separation_along(
    a: Array, count_a: int, b: Array, count_b: int, x: float, y: float, z: float
) -> float:
    """min_A N.a - max_B N.b for N = (x, y, z)."""
    low = x * a[0, 0] + y * a[0, 1] + z * a[0, 2]
    for k in range(1, count_a):
        along = x * a[k, 0] + y * a[k, 1] + z * a[k, 2]
        if along < low:
            low = along
    high = x * b[0, 0] + y * b[0, 1] + z * b[0, 2]
    for k in range(1, count_b):
        along = x * b[k, 0] + y * b[k, 1] + z * b[k, 2]
        if along > high:
            high = along
    return low - high


@compiled
def try_axis(
    a: Array,
    count_a: int,
    b: Array,
    count_b: int,
    x: float,
    y: float,
    z: float,
    best: float,
    normal: Array,
) -> float:
    """The better of the best separation so far and that along (x, y, z); the normal is written with it."""
    s = separation_along(a, count_a, b, count_b, x, y, z)
    if s <= best:
        return best
    normal[0], normal[1], normal[2] = x, y, z
    return s


@compiled
def face_axes(
    a: Array,
    count_a: int,
    b: Array,
    count_b: int,
    normals: Array,
    first: int,
    last: int,
    sign: float,
    best: float,
    normal: Array,
) -> float:
    """Try the normals of some faces, of B with sign 1, of A with sign -1: N points out of B."""
    for f in range(first, last):
        x, y, z = sign * normals[f, 0], sign * normals[f, 1], sign * normals[f, 2]
        best = try_axis(a, count_a, b, count_b, x, y, z, best, normal)
    return best


@compiled
def edge_arcs(
    p: Array,
    zero: int,
    edges: IntArray,
    beside: IntArray,
    first: int,
    last: int,
    normals: Array,
    arc: Array,
) -> tuple[int, bool]:
    """Some edges as arcs of the Gauss map, a row each.

    A row is the edge's first point (0:3), its unit direction u (3:6), and the normals of its two
    faces (6:9, 9:12), u turned so that u.(n_2 x n_1) >= 0. An edge without length is left out.

    Args:
        p: the solid's vertices, of which the first has the number ``zero`` among all.
        edges, beside: vertices and faces of all edges, of which first to last are meant.
    Returns:
        How many rows, and whether all have two faces.
    """
    count, faced = 0, True
    for e in range(first, last):
        m, n, f, g = edges[e, 0] - zero, edges[e, 1] - zero, beside[e, 0], beside[e, 1]
        x, y, z = p[n, 0] - p[m, 0], p[n, 1] - p[m, 1], p[n, 2] - p[m, 2]
        length = math.sqrt(x * x + y * y + z * z)
        if length == 0.0:
            continue
        x, y, z = x / length, y / length, z / length
        if f < 0 or g < 0:
            faced = False
        else:
            bx, by, bz = normals[f, 0], normals[f, 1], normals[f, 2]
            cx, cy, cz = normals[g, 0], normals[g, 1], normals[g, 2]
            turn = x * (cy * bz - cz * by) + y * (cz * bx - cx * bz) + z * (cx * by - cy * bx)  # fmt: skip
            if turn < 0.0:
                x, y, z = -x, -y, -z
            arc[count, 6], arc[count, 7], arc[count, 8] = bx, by, bz
            arc[count, 9], arc[count, 10], arc[count, 11] = cx, cy, cz
        arc[count, 0], arc[count, 1], arc[count, 2] = p[m, 0], p[m, 1], p[m, 2]
        arc[count, 3], arc[count, 4], arc[count, 5] = x, y, z
        count += 1
    return count, faced


@compiled
def dot(p: Array, k: int, i: int, q: Array, m: int, j: int) -> float:
    """p[k, i:i + 3] . q[m, j:j + 3]"""
    return p[k, i] * q[m, j] + p[k, i + 1] * q[m, j + 1] + p[k, i + 2] * q[m, j + 2]


@compiled
def arcs_cross(p: Array, k: int, q: Array, m: int) -> bool:
    """Whether arc k of A crosses arc m of -B: only then do their edges make a face of A - B.

    With A's normals n_1, n_2 and B's m_1, m_2, and u parallel to n_2 x n_1, w to m_2 x m_1:
    n_1 and n_2 on either side of the plane across w, m_1 and m_2 on either side of that
    across u, and both pairs on one hemisphere (Gregorius 2013).
    """
    c, d = -dot(q, m, ONE, p, k, ALONG), -dot(q, m, OTHER, p, k, ALONG)
    if c * d >= 0.0:
        return False
    s, t = dot(p, k, ONE, q, m, ALONG), dot(p, k, OTHER, q, m, ALONG)
    return s * t < 0.0 and c * t > 0.0


@compiled
def edge_axes(
    a: Array,
    count_a: int,
    b: Array,
    count_b: int,
    p: Array,
    edges_a: int,
    q: Array,
    edges_b: int,
    pruned: bool,
    best: float,
    normal: Array,
) -> float:
    """Try the products of the edges of A and B, those whose arcs p and q cross if pruned, else all both ways round."""
    for k in range(edges_a):
        for m in range(edges_b):
            if pruned and not arcs_cross(p, k, q, m):
                continue
            x = p[k, 4] * q[m, 5] - p[k, 5] * q[m, 4]
            y = p[k, 5] * q[m, 3] - p[k, 3] * q[m, 5]
            z = p[k, 3] * q[m, 4] - p[k, 4] * q[m, 3]
            length = math.sqrt(x * x + y * y + z * z)
            if length <= PARALLEL:
                continue
            x, y, z = x / length, y / length, z / length
            # Of the edges alone: never less than with all vertices.
            s = x * (p[k, 0] - q[m, 0]) + y * (p[k, 1] - q[m, 1]) + z * (p[k, 2] - q[m, 2])  # fmt: skip
            out = 0.0
            if pruned:
                out += x * (p[k, 6] + p[k, 9] - q[m, 6] - q[m, 9])
                out += y * (p[k, 7] + p[k, 10] - q[m, 7] - q[m, 10])
                out += z * (p[k, 8] + p[k, 11] - q[m, 8] - q[m, 11])
            if s > best and out < THIN:
                best = try_axis(a, count_a, b, count_b, x, y, z, best, normal)
            if -s > best and out > -THIN:
                best = try_axis(a, count_a, b, count_b, -x, -y, -z, best, normal)
    return best


@compiled
def any_axis_across(
    arcs_a: Array, edges_a: int, arcs_b: Array, edges_b: int, normal: Array
) -> None:
    """A unit vector across the first edge of either, where all edges are parallel and there is no face."""
    if edges_a + edges_b == 0:
        normal[0], normal[1], normal[2] = 0.0, 0.0, 1.0
        return
    row = arcs_a[0] if edges_a > 0 else arcs_b[0]
    x, y, z = row[3], row[4], row[5]
    # Across it and across the axis that it is least along.
    if abs(z) <= abs(x) and abs(z) <= abs(y):
        x, y, z = y, -x, 0.0
    elif abs(y) <= abs(x):
        x, y, z = -z, 0.0, x
    else:
        x, y, z = 0.0, z, -y
    length = math.sqrt(x * x + y * y + z * z)
    normal[0], normal[1], normal[2] = x / length, y / length, z / length


@compiled
def greatest_separation(
    a: Array,
    count_a: int,
    b: Array,
    count_b: int,
    solids_a: Solids,
    i: int,
    solids_b: Solids,
    j: int,
    arcs_a: Array,
    arcs_b: Array,
    normal: Array,
) -> float:
    """The greatest separation of two polytopes along an axis; where they overlap it is their gap.

    Args:
        a, b: their vertices, which may be shifted and scaled together.
        arcs_a, arcs_b: (>= number of edges, 12), room to work in.
        normal: (3,), the axis is written there, out of B toward A.
    """
    faces_a, last_a = solids_a.face_start[i], solids_a.face_start[i + 1]
    faces_b, last_b = solids_b.face_start[j], solids_b.face_start[j + 1]
    normals_a, normals_b = solids_a.normals, solids_b.normals
    best = face_axes(a, count_a, b, count_b, normals_b, faces_b, last_b, 1.0, -math.inf, normal)  # fmt: skip
    best = face_axes(a, count_a, b, count_b, normals_a, faces_a, last_a, -1.0, best, normal)  # fmt: skip
    edges_a, faced_a = edge_arcs(
        a,
        solids_a.vertex_start[i],
        solids_a.edges,
        solids_a.edge_faces,
        solids_a.edge_start[i],
        solids_a.edge_start[i + 1],
        normals_a,
        arcs_a,
    )
    edges_b, faced_b = edge_arcs(
        b,
        solids_b.vertex_start[j],
        solids_b.edges,
        solids_b.edge_faces,
        solids_b.edge_start[j],
        solids_b.edge_start[j + 1],
        normals_b,
        arcs_b,
    )
    # Of a polygon, a segment or a point the arcs are no arcs: these have two faces or none.
    pruned = faced_a and faced_b and last_a - faces_a > 2 and last_b - faces_b > 2
    best = edge_axes(a, count_a, b, count_b, arcs_a, edges_a, arcs_b, edges_b, pruned, best, normal)  # fmt: skip
    if best == -math.inf:
        any_axis_across(arcs_a, edges_a, arcs_b, edges_b, normal)
        best = separation_along(a, count_a, b, count_b, normal[0], normal[1], normal[2])
    return best


def warm() -> None:
    """Called by others only (``course.jit``); ``course.overlap.convex.closest_loops`` compiles it."""
