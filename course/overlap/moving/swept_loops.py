"""Swept separating axes in loops: two boxes by 15 axes, two polytopes by their faces and crossing edges.

``swept.time_along_axes`` says what is asked of the axes; here it is asked one axis at a
time, with four numbers kept: how far apart the solids are at the start, when the last
axis is entered, when the first is left, and whether one of those on which they touch
keeps them apart.

The axes of two polytopes are the normals of the faces of A - B: those of A's and B's
faces, and one for each pair of edges that cross on the Gauss map
(``separating_axis_loops``). An axis too many does no harm. Flat solids have in-plane
axes besides: with them a polygon, a segment or a point is bounded in its own plane.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.convex.box_axes_loops import relative_pose
from course.overlap.convex.separating_axis_loops import (
    PARALLEL,
    Solids,
    arcs_cross,
    edge_arcs,
    separation_along,
)
from course.overlap.moving.moving_bodies import rows_of
from course.overlap.triples import Triple, cross, dot, length, minus, row, scaled

#: Solids that touch slide if they approach by less than this times their speed
#: (``swept.SLIDING``).
SLIDING = 1e-12

#: Separation at the start, entered, left, kept apart.
Overlap = tuple[float, float, float, bool]
#: The gap that counts as none, the rate that counts as none, and how far apart along an
#: axis solids still are on it: 0, or the gap that counts as none where both are flat,
#: since what has no thickness is entered and left at one instant.
Limits = tuple[float, float, float]


@compiled
def along_axis(found: Overlap, s: float, w: float, limits: Limits) -> Overlap:
    """What is known with one more axis, along which the solids are apart by s + w t."""
    gap, entered, left, kept = found
    band, slow, loose = limits
    if w < 0.0:
        entered = max(entered, -s / w)
    elif w > 0.0:
        left = min(left, (loose - s) / w)
    elif s > loose:
        left = -math.inf
    return max(gap, s), entered, left, kept or (s >= -band and w >= -slow)


@compiled
def time_of(found: Overlap, horizon: float, band: float) -> float:
    """The time of impact, when all axes are known."""
    gap, entered, left, kept = found
    if gap < -band:
        return 0.0
    if gap <= band:
        return math.inf if kept else 0.0
    if entered <= left and left >= 0.0 and entered <= horizon:
        return entered
    return math.inf


@compiled
def both_sides(found: Overlap, c: float, reach: float, w: float, limits: Limits) -> Overlap:  # fmt: skip
    """Along an axis on which the centres are c + w t apart and the solids reach that far together, from either side."""
    found = along_axis(found, c - reach, w, limits)
    return along_axis(found, -c - reach, -w, limits)


@compiled
def box_axes_found(
    half_a: Array, half_b: Array, p: int, r: Array, t: Array, u: Array, limits: Limits
) -> Overlap:  # fmt: skip
    """The 15 axes of pair p in A's axes (Ericson 4.4.1): r = R_A' R_B, B's centre t and velocity u."""
    found = (-math.inf, -math.inf, math.inf, False)
    for i in range(3):
        reach = half_a[p, i]
        for j in range(3):
            reach += half_b[p, j] * abs(r[i, j])
        found = both_sides(found, t[i], reach, u[i], limits)
    for j in range(3):
        reach, c, w = half_b[p, j], 0.0, 0.0
        for i in range(3):
            reach += half_a[p, i] * abs(r[i, j])
            c, w = c + t[i] * r[i, j], w + u[i] * r[i, j]
        found = both_sides(found, c, reach, w, limits)
    for i in range(3):
        k, m = (i + 1) % 3, (i + 2) % 3
        for j in range(3):
            y, z = -r[m, j], r[k, j]
            sine = math.sqrt(y * y + z * z)
            if sine <= PARALLEL:
                continue
            y, z = y / sine, z / sine
            reach = half_a[p, k] * abs(y) + half_a[p, m] * abs(z)
            for n in range(3):
                reach += half_b[p, n] * abs(r[k, n] * y + r[m, n] * z)
            c, w = t[k] * y + t[m] * z, u[k] * y + u[m] * z
            found = both_sides(found, c, reach, w, limits)
    return found


@compiled
def box_times(
    center_a: Array,
    axes_a: Array,
    half_a: Array,
    center_b: Array,
    axes_b: Array,
    half_b: Array,
    velocity: Array,
    horizon: Array,
    band: Array,
    time: Array,
) -> None:
    """Time of impact of p pairs of boxes, written to time.

    Args:
        center_a, half_a, center_b, half_b: (p, 3) [m]; axes_a, axes_b: (p, 3, 3), columns.
        velocity: of A as seen from B, (p, 3) [m/s].
        horizon: (p,) [s].
        band: the gap that counts as none, (p,) [m].
        time: (p,) [s].
    """
    r, t, u = np.empty((3, 3)), np.empty(3), np.empty(3)
    for p in range(time.size):
        relative_pose(center_a, axes_a, center_b, axes_b, p, r, t)
        speed = 0.0
        for i in range(3):
            u[i] = 0.0
            for k in range(3):
                u[i] -= axes_a[p, k, i] * velocity[p, k]
            speed += velocity[p, i] ** 2
        limits = (band[p], SLIDING * math.sqrt(speed), 0.0)
        found = box_axes_found(half_a, half_b, p, r, t, u, limits)
        time[p] = time_of(found, horizon[p], band[p])


@compiled
def try_axis(found: Overlap, a: Array, b: Array, n: Triple, v: Triple, limits: Limits) -> Overlap:  # fmt: skip
    """With the axis n, out of B toward A."""
    s = separation_along(a, len(a), b, len(b), n[0], n[1], n[2])
    return along_axis(found, s, dot(n, v), limits)


@compiled
def try_both(found: Overlap, a: Array, b: Array, n: Triple, v: Triple, limits: Limits) -> Overlap:  # fmt: skip
    """With the axes n and -n."""
    found = try_axis(found, a, b, n, v, limits)
    return try_axis(found, a, b, scaled(-1.0, n), v, limits)


@compiled
def face_axes(
    found: Overlap, a: Array, b: Array, solids: Solids, i: int, sign: float, v: Triple, limits: Limits
) -> Overlap:  # fmt: skip
    """With the normals of solid i, which is B with sign 1, A with sign -1."""
    for f in range(solids.face_start[i], solids.face_start[i + 1]):
        n = scaled(sign, row(solids.normals, f))
        found = try_axis(found, a, b, n, v, limits)
    return found


@compiled
def unit_cross(p: Triple, q: Triple) -> tuple[Triple, bool]:
    """p x q made a unit vector, and whether it is one: not of parallel unit vectors."""
    n = cross(p, q)
    sine = length(n)
    if sine <= PARALLEL:
        return n, False
    return scaled(1.0 / sine, n), True


@compiled
def entry(arcs: Array, k: int, first: int) -> Triple:
    """arcs[k, first:first + 3]"""
    return arcs[k, first], arcs[k, first + 1], arcs[k, first + 2]


@compiled
def edge_axes(
    found: Overlap,
    a: Array,
    b: Array,
    arcs_a: Array,
    arcs_b: Array,
    pruned: bool,
    v: Triple,
    limits: Limits,
) -> Overlap:
    """With the products of edges, those whose arcs cross if pruned, both ways round."""
    for k in range(len(arcs_a)):
        for m in range(len(arcs_b)):
            if pruned and not arcs_cross(arcs_a, k, arcs_b, m):
                continue
            n, crosses = unit_cross(entry(arcs_a, k, 3), entry(arcs_b, m, 3))
            if not crosses:
                continue
            # The edges alone are apart by as much as all vertices, or more: where that
            # changes nothing, the vertices need not be asked.
            s = dot(n, minus(row(arcs_a, k), row(arcs_b, m)))
            w = dot(n, v)
            if along_axis(found, s, w, limits) != found:
                found = try_axis(found, a, b, n, v, limits)
            if along_axis(found, -s, -w, limits) != found:
                found = try_axis(found, a, b, scaled(-1.0, n), v, limits)
    return found


@compiled
def flat_axes(found: Overlap, a: Array, b: Array, edges: Array, v: Triple, limits: Limits) -> Overlap:  # fmt: skip
    """With what bounds A - B within its own plane, line or point, if it has no volume.

    Along each of the directions of edges and of x, y and z, across two of them, and
    across one in the plane of two.
    """
    for k in range(len(edges)):
        p = row(edges, k)
        found = try_both(found, a, b, p, v, limits)
        for m in range(k):
            n, crosses = unit_cross(p, row(edges, m))
            if crosses:
                found = try_both(found, a, b, n, v, limits)
                for side in (p, row(edges, m)):
                    across, _ = unit_cross(side, n)
                    found = try_both(found, a, b, across, v, limits)
    return found


@compiled
def directions(arcs_a: Array, arcs_b: Array) -> Array:
    """x, y, z and the directions of all edges, a row each."""
    found = np.zeros((3 + len(arcs_a) + len(arcs_b), 3))
    for c in range(3):
        found[c, c] = 1.0
        for k in range(len(arcs_a)):
            found[3 + k, c] = arcs_a[k, 3 + c]
        for k in range(len(arcs_b)):
            found[3 + len(arcs_a) + k, c] = arcs_b[k, 3 + c]
    return found


@compiled
def arcs_of(solids: Solids, i: int, seen: Array) -> tuple[Array, bool]:
    """The edges of solid i as arcs of the Gauss map (``edge_arcs``), and whether it has a volume."""
    first, last = solids.edge_start[i], solids.edge_start[i + 1]
    arcs = np.zeros((last - first, 12))
    zero, edges, beside = solids.vertex_start[i], solids.edges, solids.edge_faces
    count, faced = edge_arcs(seen, zero, edges, beside, first, last, solids.normals, arcs)  # fmt: skip
    faces = solids.face_start[i + 1] - solids.face_start[i]
    return arcs[:count], faced and faces > 2


@compiled
def polytope_axes_found(
    solids_a: Solids, i: int, solids_b: Solids, j: int, v: Triple, limits: Limits
) -> Overlap:  # fmt: skip
    """All axes of the cores of solid i of A and solid j of B."""
    origin = row(solids_a.vertices, solids_a.vertex_start[i])
    a = rows_of(solids_a.vertices, solids_a.vertex_start[i], solids_a.vertex_start[i + 1], origin)  # fmt: skip
    b = rows_of(solids_b.vertices, solids_b.vertex_start[j], solids_b.vertex_start[j + 1], origin)  # fmt: skip
    arcs_a, solid_a = arcs_of(solids_a, i, a)
    arcs_b, solid_b = arcs_of(solids_b, j, b)
    flat = not (solid_a or solid_b)
    if flat:
        limits = (limits[0], limits[1], limits[0])
    found = (-math.inf, -math.inf, math.inf, False)
    found = face_axes(found, a, b, solids_b, j, 1.0, v, limits)
    found = face_axes(found, a, b, solids_a, i, -1.0, v, limits)
    pruned = solid_a and solid_b
    found = edge_axes(found, a, b, arcs_a, arcs_b, pruned, v, limits)
    if flat:
        found = flat_axes(found, a, b, directions(arcs_a, arcs_b), v, limits)
    return found


@compiled
def polytope_times(
    solids_a: Solids,
    solids_b: Solids,
    i: IntArray,
    j: IntArray,
    velocity: Array,
    horizon: Array,
    band: Array,
    slow: Array,
    time: Array,
) -> None:
    """Time of impact of p pairs of polytopes (their radii are not read), written to time.

    Args:
        i, j: (p,) which solids.
        velocity: of A as seen from B, (p, 3) [m/s].
        horizon: (p,) [s].
        band, slow: the gap and the rate that count as none, (p,) [m, m/s].
        time: (p,) [s].
    """
    for p in range(time.size):
        v = row(velocity, p)
        limits = (band[p], slow[p], 0.0)
        found = polytope_axes_found(solids_a, i[p], solids_b, j[p], v, limits)
        time[p] = time_of(found, horizon[p], band[p])


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    from course.overlap.impact_times import time_of_impact
    from course.shapes import AABB, OBB, ConvexHull

    upright = AABB(np.zeros(3), np.ones(3))
    box = OBB(np.full(3, 2.0), np.eye(3), np.ones(3))
    for other in (box, ConvexHull(np.eye(3))):
        time_of_impact(upright, other, np.ones(3), np.zeros(3), horizon=1.0)
