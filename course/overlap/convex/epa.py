"""Depth of two overlapping convex hulls by the expanding polytope algorithm (EPA).

Where A and B overlap the origin is inside A - B, and their depth is its distance from the
surface: the shortest translation that parts them. GJK ends with a tetrahedron of vertices
of A - B around the origin. Each turn takes the face of the polytope so far that is nearest the
origin, and the vertex of A - B furthest along its normal. If that is no further than the
face, this is a face of A - B, and no other is nearer; else the polytope grows to it.

G. van den Bergen, "Proximity Queries and Penetration Depth Computation on 3D Game Objects",
Game Developers Conference 2001; *Collision Detection in Interactive 3D Environments* (2003),
section 4.3.8.

Flat polytopes, slivers and more faces than there is room for are left to the separating axes
(``separating_axis_loops``), which need no tetrahedron and no luck.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.convex.gjk import FACES, SLIVER, ZERO, support

#: Room for vertices and faces of the polytope, which has about twice as many faces.
MOST_VERTICES, MOST_FACES = 64, 128
#: How far beyond a face, in the size of the pair, a vertex lies on it to rounding.
LEVEL = 1e-14


@compiled
def add_face(
    w: Array, i: int, j: int, k: int, corner: IntArray, plane: Array, count: int
) -> int:
    """Add the face w_i w_j w_k, counterclockwise seen from outside; how many there are, -1 if it is a sliver.

    plane[f] is the outward unit normal n and n.w of the face: the origin's distance from it.
    """
    ux, uy, uz = w[j, 0] - w[i, 0], w[j, 1] - w[i, 1], w[j, 2] - w[i, 2]
    vx, vy, vz = w[k, 0] - w[i, 0], w[k, 1] - w[i, 1], w[k, 2] - w[i, 2]
    x, y, z = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    area = x * x + y * y + z * z
    lengths = (ux * ux + uy * uy + uz * uz) * (vx * vx + vy * vy + vz * vz)
    if count >= MOST_FACES or area <= SLIVER * lengths:
        return -1
    size = math.sqrt(area)
    x, y, z = x / size, y / size, z / size
    corner[count, 0], corner[count, 1], corner[count, 2] = i, j, k
    plane[count, 0], plane[count, 1], plane[count, 2] = x, y, z
    plane[count, 3] = x * w[i, 0] + y * w[i, 1] + z * w[i, 2]
    return count + 1


@compiled
def tetrahedron(w: Array, corner: IntArray, plane: Array) -> int:
    """The four faces of the first four vertices, turned outward: 4, or -1 if one is a sliver."""
    ux, uy, uz = w[1, 0] - w[0, 0], w[1, 1] - w[0, 1], w[1, 2] - w[0, 2]
    vx, vy, vz = w[2, 0] - w[0, 0], w[2, 1] - w[0, 1], w[2, 2] - w[0, 2]
    x, y, z = w[3, 0] - w[0, 0], w[3, 1] - w[0, 1], w[3, 2] - w[0, 2]
    height = x * (uy * vz - uz * vy) + y * (uz * vx - ux * vz) + z * (ux * vy - uy * vx)
    # The faces go round counterclockwise seen from outside, or all the other way.
    count = ZERO
    for m in range(4):
        i, j, k = FACES[m, 0], FACES[m, 1], FACES[m, 2]
        if height < 0.0:
            j, k = k, j
        if count >= 0:
            count = add_face(w, i, j, k, corner, plane, count)
    return count


@compiled
def toggle(rim: IntArray, count: int, p: int, q: int) -> int:
    """Add the edge from p to q to the rim, or take it away if it is there the other way round."""
    for m in range(count):
        if rim[m, 0] == q and rim[m, 1] == p:
            rim[m, 0], rim[m, 1] = rim[count - 1, 0], rim[count - 1, 1]
            return count - 1
    rim[count, 0], rim[count, 1] = p, q
    return count + 1


@compiled
def grow(w: Array, new: int, corner: IntArray, plane: Array, count: int, rim: IntArray) -> int:  # fmt: skip
    """Faces that see the new vertex go, and their rim is joined to it; how many faces, -1 if that fails."""
    x, y, z, edges, f = w[new, 0], w[new, 1], w[new, 2], ZERO, 0
    while f < count:
        beyond = plane[f, 0] * x + plane[f, 1] * y + plane[f, 2] * z - plane[f, 3]
        if beyond <= LEVEL:
            f += 1
            continue
        for m in range(3):
            edges = toggle(rim, edges, corner[f, m], corner[f, (m + 1) % 3])
        count -= 1
        for m in range(3):
            corner[f, m] = corner[count, m]
        for m in range(4):
            plane[f, m] = plane[count, m]
    for m in range(edges):
        count = add_face(w, rim[m, 0], rim[m, 1], new, corner, plane, count)
        if count < 0:
            return -1
    return count if count >= 4 else -1


@compiled
def epa_depth(
    a: Array,
    count_a: int,
    b: Array,
    count_b: int,
    simplex: Array,
    w: Array,
    corner: IntArray,
    plane: Array,
    rim: IntArray,
    normal: Array,
) -> float:
    """The depth of two hulls, and the unit vector N along which A leaves B soonest.

    Args:
        a, b: vertices, the first count_a and count_b rows of (..., 3), of order 1.
        simplex: (4, 3), vertices of A - B around the origin.
        w, corner, plane, rim: (MOST_VERTICES, 3), (MOST_FACES, 3), (MOST_FACES, 4),
            (3 MOST_FACES, 2), room to work in.
        normal: (3,), N is written there.
    Returns:
        The depth; -1 where it is not certain.
    """
    for m in range(4):
        for k in range(3):
            w[m, k] = simplex[m, k]
    count = tetrahedron(w, corner, plane)
    for new in range(4, MOST_VERTICES):
        if count < 0:
            return -1.0
        best = 0
        for f in range(1, count):
            if plane[f, 3] < plane[best, 3]:
                best = f
        x, y, z, depth = plane[best, 0], plane[best, 1], plane[best, 2], plane[best, 3]
        i, j = support(a, count_a, x, y, z), support(b, count_b, -x, -y, -z)
        for k in range(3):
            w[new, k] = a[i, k] - b[j, k]
        if x * w[new, 0] + y * w[new, 1] + z * w[new, 2] - depth <= LEVEL:
            normal[0], normal[1], normal[2] = -x, -y, -z
            return max(depth, 0.0)
        count = grow(w, new, corner, plane, count, rim)
    return -1.0


@compiled
def epa_room() -> tuple[Array, IntArray, Array, IntArray]:
    """Arrays for ``epa`` to work in."""
    return (
        np.empty((MOST_VERTICES, 3)),
        np.empty((MOST_FACES, 3), np.intp),
        np.empty((MOST_FACES, 4)),
        np.empty((3 * MOST_FACES, 2), np.intp),
    )


def warm() -> None:
    """Call the kernel once (``course.jit``)."""
    box = np.array([[x, y, z] for x in (-1.0, 1) for y in (-1.0, 1) for z in (-1.0, 1)])
    around = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    epa_depth(box, 8, np.zeros((1, 3)), 1, around, *epa_room(), np.empty(3))
