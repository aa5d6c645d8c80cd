"""Solids in motion as compiled loops see them: one that is put where it is at a time, and the gap of two.

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
    by_gjk,
    in_own_measure,
    nearly_touching,
)
from course.overlap.separating_axis_loops import Solids
from course.overlap.triples import Triple, along, cross, dot, length, minus, row, scaled


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
def gap_at(a: Body, b: Body, radius: float, plane: bool, t: float, room: Room) -> tuple[float, Triple]:  # fmt: skip
    """Gap and N of two bodies at time t; they are put there.

    Args:
        radius: of both together.
        plane: whether B is a half space, one vertex on its plane and one normal.
    """
    place(a, t)
    place(b, t)
    if plane:
        n, foot = row(b.now.normals, 0), row(b.now.vertices, 0)
        gap = math.inf
        for k in range(len(a.arms)):
            gap = min(gap, dot(n, minus(row(a.now.vertices, k), foot)))
        return gap - radius, n
    count_a, count_b, scale = in_own_measure(a.now.vertices, a.now.vertex_start, 0, b.now.vertices, b.now.vertex_start, 0, room.a, room.b, room.v)  # fmt: skip
    ended, lower, upper = by_gjk(count_a, count_b, room)
    if lower > NEAR and upper - lower <= CERTAIN:
        toward = (room.v[0], room.v[1], room.v[2])
        apart = length(toward)
        return apart / scale - radius, scaled(1.0 / apart, toward)
    apart = nearly_touching(a.now, 0, b.now, 0, count_a, count_b, ended, lower, upper, room)  # fmt: skip
    return apart / scale - radius, (room.normal[0], room.normal[1], room.normal[2])


def warm() -> None:
    """Compiled with ``advancement_loops``, which calls them."""
