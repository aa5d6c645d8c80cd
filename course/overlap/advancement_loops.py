"""Conservative advancement in loops: from one gap to the next, never past an impact.

The gap of two solids apart is that along the normal N of their nearest points, and along
any fixed N they are apart by no more than their gap. So that far as the separation
along N can be followed, nothing is missed: to its root the solids are free. There the gap
and its N are asked anew.

* In straight motion the separation along N is linear, and the gap a convex function of
  time: this is Newton's iteration, which comes from the left, and a ray cast against the
  Minkowski difference (G. van den Bergen, "Ray casting against general convex objects
  with application to continuous collision detection", 2004).
* Of solids that turn, each vertex moves along N by n.r + n.r_dot t, to within K t^2/2
  with K = |omega x n| |omega x r| (B. Mirtich, *Impulse-based Dynamic Simulation of Rigid
  Body Systems*, 1996, section 2.3.2, bounds the speed alone; with the rate itself the
  steps near an impact are those of Newton).

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.closest_loops import (
    CERTAIN,
    NEAR,
    Room,
    combine,
    in_own_measure,
    nearly_touching,
    room_for,
)
from course.overlap.closest_loops import length as distance
from course.overlap.gjk import APART, gjk
from course.overlap.separating_axis_loops import Solids
from course.overlap.triples import Triple, along, cross, dot, length, minus, row, scaled

#: Steps after which a ray stands; to a grazing impact Newton halves the way, 27 times.
MOST_STEPS_OF_RAYS = 100


class Body(NamedTuple):
    """A solid that moves: where it is now, and what it moves by."""

    now: Solids  # one solid
    arms: Array  # its vertices from the pivot at t = 0, (n, 3)
    facing: Array  # its normals at t = 0, (f, 3)
    pivot: Triple  # at t = 0, seen from the pair's frame
    velocity: Triple
    spin: Triple


@compiled
def some_of(rows: IntArray, first: int, last: int, shift: int) -> IntArray:
    """Rows of numbers counted from ``shift``; none stays none (-1)."""
    picked = np.empty((last - first, 2), np.intp)
    for k in range(last - first):
        for c in range(2):
            n = rows[first + k, c]
            picked[k, c] = n - shift if n >= 0 else n
    return picked


@compiled
def one_of(solids: Solids, i: int) -> Solids:
    """Solid i alone, in arrays of its own."""
    v, w = solids.vertex_start[i], solids.vertex_start[i + 1]
    f, g = solids.face_start[i], solids.face_start[i + 1]
    e, h = solids.edge_start[i], solids.edge_start[i + 1]
    first, last = solids.loop_start[f], solids.loop_start[g]
    return Solids(
        solids.vertices[v:w].copy(),
        np.array([0, w - v]),
        solids.radius[i : i + 1].copy(),
        solids.normals[f:g].copy(),
        np.array([0, g - f]),
        solids.loop[first:last] - v,
        solids.loop_start[f : g + 1] - first,
        some_of(solids.edges, e, h, v),
        some_of(solids.edge_faces, e, h, f),
        np.array([0, h - e]),
    )


@compiled
def body_of(solids: Solids, i: int, origin: Triple, pivot: Triple, velocity: Triple, spin: Triple) -> Body:  # fmt: skip
    """Solid i as a body, seen from the origin."""
    now = one_of(solids, i)
    for k in range(len(now.vertices)):
        for c in range(3):
            now.vertices[k, c] -= pivot[c]
    arms, facing = now.vertices.copy(), now.normals.copy()
    return Body(now, arms, facing, minus(pivot, origin), velocity, spin)


@compiled
def turned(x: Triple, axis: Triple, cosine: float, sine: float) -> Triple:
    """x turned about a unit axis: x cos + (axis x x) sin + axis (axis.x) (1 - cos) (Rodrigues)."""
    y = along(scaled(cosine, x), sine, cross(axis, x))
    return along(y, dot(axis, x) * (1.0 - cosine), axis)


@compiled
def place(body: Body, t: float) -> Triple:
    """Put a body where it is at time t; where its pivot is."""
    speed = length(body.spin)
    axis = scaled(1.0 / speed, body.spin) if speed > 0.0 else (0.0, 0.0, 1.0)
    cosine, sine = math.cos(speed * t), math.sin(speed * t)
    pivot = along(body.pivot, t, body.velocity)
    for k in range(len(body.arms)):
        x = row(body.arms, k)
        if speed > 0.0:
            x = turned(x, axis, cosine, sine)
        for c in range(3):
            body.now.vertices[k, c] = pivot[c] + x[c]
    if speed > 0.0:
        for k in range(len(body.facing)):
            x = turned(row(body.facing, k), axis, cosine, sine)
            for c in range(3):
                body.now.normals[k, c] = x[c]
    return pivot


@compiled
def gap_at(a: Body, b: Body, radius: float, t: float, room: Room) -> tuple[float, Triple]:  # fmt: skip
    """Gap and N of two bodies at time t; they are put there."""
    place(a, t)
    place(b, t)
    x, y, v = room.a, room.b, room.v
    count_a, count_b, scale = in_own_measure(a.now.vertices, a.now.vertex_start, 0, b.now.vertices, b.now.vertex_start, 0, x, y, v)  # fmt: skip
    ended, count, lower = gjk(x, count_a, y, count_b, v, math.inf, room.w, room.pick, room.share, room.weight)  # fmt: skip
    upper = math.inf
    if ended == APART:
        combine(x, room.pick, 0, room.share, count, room.point_a)
        combine(y, room.pick, 1, room.share, count, room.point_b)
        upper = distance(room.point_a, room.point_b)
    if lower > NEAR and upper - lower <= CERTAIN:
        towards = (v[0], v[1], v[2])
        apart = length(towards)
        return apart / scale - radius, scaled(1.0 / apart, towards)
    apart = nearly_touching(a.now, 0, b.now, 0, count_a, count_b, lower, upper, room)
    return apart / scale - radius, (room.normal[0], room.normal[1], room.normal[2])


@compiled
def ray_time(a: Body, b: Body, radius: float, horizon: float, band: float, slow: float, room: Room) -> float:  # fmt: skip
    """Time of impact of two bodies that do not turn: t - gap/rate from the left."""
    v = minus(a.velocity, b.velocity)
    gap, n = gap_at(a, b, radius, 0.0, room)
    rate = dot(n, v)
    if gap < -band:
        return 0.0
    if gap <= band:
        return 0.0 if rate < -slow else math.inf
    t = 0.0
    for _ in range(MOST_STEPS_OF_RAYS):
        if rate >= 0.0:
            return math.inf
        later = t - gap / rate
        if later > horizon:
            return math.inf
        if later == t:
            break
        t = later
        gap, n = gap_at(a, b, radius, t, room)
        rate = dot(n, v)
        if gap <= 0.0625 * band:
            break
    return t


@compiled
def ray_times(
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
    """Time of impact of p pairs of rounded polytopes in straight motion, written to time.

    Args:
        as of ``swept_loops.polytope_times``.
    """
    none, room = (0.0, 0.0, 0.0), room_for(solids_a, solids_b)
    for p in range(time.size):
        origin = row(solids_a.vertices, solids_a.vertex_start[i[p]])
        start_b = row(solids_b.vertices, solids_b.vertex_start[j[p]])
        a = body_of(solids_a, i[p], origin, origin, row(velocity, p), none)
        b = body_of(solids_b, j[p], origin, start_b, none, none)
        radius = solids_a.radius[i[p]] + solids_b.radius[j[p]]
        time[p] = ray_time(a, b, radius, horizon[p], band[p], slow[p], room)


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    from course.overlap.impact_times import time_of_impact
    from course.shapes import AABB, Sphere

    box, ball = AABB(np.zeros(3), np.ones(3)), Sphere(np.full(3, 3.0), 0.5)
    time_of_impact(box, ball, np.ones(3), np.zeros(3), horizon=1.0)
