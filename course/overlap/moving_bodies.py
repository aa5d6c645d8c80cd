"""Solids in motion as compiled loops see them: one that is put where it is at a time, and the gap of two.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.closest_loops import closest_pairs
from course.overlap.separating_axis_loops import Solids
from course.overlap.triples import Triple, along, cross, dot, length, minus, row, scaled


class Found(NamedTuple):
    """Room for what ``closest_pairs`` finds of one pair: the radius of both is left out there."""

    one: IntArray  # the number of the only solid
    gap: Array
    normal: Array
    point: Array


class Body(NamedTuple):
    """A solid that moves: where it is now, and what it moves by."""

    now: Solids  # one solid
    arms: Array  # its vertices from the pivot at t = 0, (n, 3)
    facing: Array  # its normals at t = 0, (f, 3)
    pivot: Triple  # at t = 0, seen from the pair's frame
    velocity: Triple
    spin: Triple


@compiled
def numbers_of(numbers: IntArray, first: int, last: int, shift: int) -> IntArray:
    """numbers[first:last] counted from the shift."""
    picked = np.empty(last - first, np.intp)
    for k in range(last - first):
        picked[k] = numbers[first + k] - shift
    return picked


@compiled
def pairs_of(pairs: IntArray, first: int, last: int, shift: int) -> IntArray:
    """pairs[first:last] counted from the shift; none stays none (-1)."""
    picked = np.empty((last - first, 2), np.intp)
    for k in range(last - first):
        for c in range(2):
            n = pairs[first + k, c]
            picked[k, c] = n - shift if n >= 0 else n
    return picked


@compiled
def rows_of(rows: Array, first: int, last: int, origin: Triple) -> Array:
    """rows[first:last] as seen from the origin."""
    picked = np.empty((last - first, 3))
    for k in range(last - first):
        for c in range(3):
            picked[k, c] = rows[first + k, c] - origin[c]
    return picked


@compiled
def one_of(solids: Solids, i: int) -> Solids:
    """Solid i alone, in arrays of its own."""
    none = (0.0, 0.0, 0.0)
    v, w = solids.vertex_start[i], solids.vertex_start[i + 1]
    f, g = solids.face_start[i], solids.face_start[i + 1]
    e, h = solids.edge_start[i], solids.edge_start[i + 1]
    first, last = solids.loop_start[f], solids.loop_start[g]
    core = np.zeros(1)  # without its radius
    return Solids(
        rows_of(solids.vertices, v, w, none),
        numbers_of(solids.vertex_start, i, i + 2, v),
        core,
        rows_of(solids.normals, f, g, none),
        numbers_of(solids.face_start, i, i + 2, f),
        numbers_of(solids.loop, first, last, v),
        numbers_of(solids.loop_start, f, g + 1, first),
        pairs_of(solids.edges, e, h, v),
        pairs_of(solids.edge_faces, e, h, f),
        numbers_of(solids.edge_start, i, i + 2, e),
    )


@compiled
def body_of(solids: Solids, i: int, origin: Triple, pivot: Triple, velocity: Triple, spin: Triple) -> Body:  # fmt: skip
    """Solid i as a body, seen from the origin."""
    first, last = solids.vertex_start[i], solids.vertex_start[i + 1]
    arms = rows_of(solids.vertices, first, last, pivot)
    first, last = solids.face_start[i], solids.face_start[i + 1]
    facing = rows_of(solids.normals, first, last, (0.0, 0.0, 0.0))
    place = minus(pivot, origin)
    return Body(one_of(solids, i), arms, facing, place, velocity, spin)


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
def gap_at(a: Body, b: Body, radius: float, plane: bool, t: float, found: Found) -> tuple[float, Triple]:  # fmt: skip
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
    closest_pairs(a.now, b.now, found.one, found.one, found.gap, found.normal, found.point, found.point)  # fmt: skip
    return found.gap[0] - radius, row(found.normal, 0)


@compiled
def room_to_find() -> Found:
    """Room for what is found."""
    one, gap, normal, point = np.zeros(1, np.intp), np.empty(1), np.empty((1, 3)), np.empty((1, 3))  # fmt: skip
    return Found(one, gap, normal, point)


def warm() -> None:
    """Compiled with ``advancement_loops``, which calls them."""
