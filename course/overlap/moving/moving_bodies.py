"""Solids in motion as compiled loops see them: one that is put where it is at a time, and the gap of two.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.convex.closest_loops import closest_pairs
from course.overlap.convex.separating_axis import as_kernels_take_it
from course.overlap.convex.separating_axis_loops import Solids
from course.overlap.triples import Triple, along, cross, dot, length, minus, row, scaled
from course.shapes import Polytopes


class Places(NamedTuple):
    """Where the two solids of a pair are now, and room for what ``closest_pairs`` finds of them.

    ``seen`` are the arrays of ``now`` under another name, by which they cannot be written to:
    ``closest_pairs`` is compiled for such arrays, and need not be for others.
    """

    now_a: Solids  # one solid, without its radius
    now_b: Solids
    seen_a: Solids
    seen_b: Solids
    one: IntArray  # the number of the only solid
    gap: Array
    normal: Array
    point: Array


def places_for(a: Polytopes, b: Polytopes) -> Places:
    """Places for any solid of a and any of b."""
    now_a, now_b = one_solid(a), one_solid(b)
    seen_a = Solids(*map(as_kernels_take_it, now_a))
    seen_b = Solids(*map(as_kernels_take_it, now_b))
    one: Any = as_kernels_take_it(np.zeros(1, dtype=np.intp))
    gap, normal, point = np.empty(1), np.empty((1, 3)), np.empty((1, 3))
    return Places(now_a, now_b, seen_a, seen_b, one, gap, normal, point)


def one_solid(solids: Polytopes) -> Solids:
    """Arrays that hold any one of the solids."""
    corner = solids.loop_start[solids.face_start]
    starts = solids.vertex_start, solids.face_start, solids.edge_start, corner
    v, f, e, c = (int(np.diff(start).max(initial=0)) for start in starts)
    return Solids(
        np.zeros((v, 3)), np.zeros(2, np.intp), np.zeros(1), np.zeros((f, 3)),
        np.zeros(2, np.intp), np.zeros(c, np.intp), np.zeros(f + 1, np.intp),
        np.zeros((e, 2), np.intp), np.zeros((e, 2), np.intp), np.zeros(2, np.intp),
    )  # fmt: skip


class Body(NamedTuple):
    """A solid that moves: where it is now, and what it moves by."""

    now: Solids  # where it is written to
    arms: Array  # its vertices from the pivot at t = 0, (n, 3)
    facing: Array  # its normals at t = 0, (f, 3)
    pivot: Triple  # at t = 0, seen from the pair's frame
    velocity: Triple
    spin: Triple


@compiled
def write_numbers(numbers: IntArray, first: int, last: int, shift: int, out: IntArray) -> None:  # fmt: skip
    """out = numbers[first:last] counted from the shift."""
    for k in range(last - first):
        out[k] = numbers[first + k] - shift


@compiled
def write_pairs(pairs: IntArray, first: int, last: int, shift: int, out: IntArray) -> None:  # fmt: skip
    """out = pairs[first:last] counted from the shift; none stays none (-1)."""
    for k in range(last - first):
        for c in range(2):
            n = pairs[first + k, c]
            out[k, c] = n - shift if n >= 0 else n


@compiled
def rows_of(rows: Array, first: int, last: int, origin: Triple) -> Array:
    """rows[first:last] as seen from the origin."""
    picked = np.empty((last - first, 3))
    for k in range(last - first):
        for c in range(3):
            picked[k, c] = rows[first + k, c] - origin[c]
    return picked


@compiled
def write_solid(solids: Solids, i: int, facing: Array, out: Solids) -> None:
    """Solid i alone, but for its vertices, which move."""
    v, w = solids.vertex_start[i], solids.vertex_start[i + 1]
    f, g = solids.face_start[i], solids.face_start[i + 1]
    e, h = solids.edge_start[i], solids.edge_start[i + 1]
    first, last = solids.loop_start[f], solids.loop_start[g]
    out.vertex_start[1], out.face_start[1], out.edge_start[1] = w - v, g - f, h - e
    write_numbers(solids.loop, first, last, v, out.loop)
    write_numbers(solids.loop_start, f, g + 1, first, out.loop_start)
    write_pairs(solids.edges, e, h, v, out.edges)
    write_pairs(solids.edge_faces, e, h, f, out.edge_faces)
    for k in range(len(facing)):
        for c in range(3):
            out.normals[k, c] = facing[k, c]


@compiled
def body_of(
    solids: Solids, i: int, now: Solids, origin: Triple, pivot: Triple, velocity: Triple, spin: Triple
) -> Body:  # fmt: skip
    """Solid i as a body, seen from the origin."""
    first, last = solids.vertex_start[i], solids.vertex_start[i + 1]
    arms = rows_of(solids.vertices, first, last, pivot)
    first, last = solids.face_start[i], solids.face_start[i + 1]
    facing = rows_of(solids.normals, first, last, (0.0, 0.0, 0.0))
    write_solid(solids, i, facing, now)
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
def gap_at(a: Body, b: Body, radius: float, plane: bool, t: float, places: Places) -> tuple[float, Triple]:  # fmt: skip
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
    one, gaps, normal, point = places.one, places.gap, places.normal, places.point
    closest_pairs(places.seen_a, places.seen_b, one, one, gaps, normal, point, point)
    return gaps[0] - radius, row(normal, 0)


def warm() -> None:
    """Compiled with ``advancement_loops``, which calls them."""
