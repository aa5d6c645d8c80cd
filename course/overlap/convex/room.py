"""Room for the loops over pairs of polytopes, and a pair's vertices in its own measure.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.convex.epa import epa_room
from course.overlap.convex.separating_axis_loops import Solids


class Room(NamedTuple):
    """Arrays to work in, large enough for every pair."""

    a: Array  # vertices of A and B in the pair's measure
    b: Array
    front_a: Array  # vertices of the features that meet, and their numbers in a and b
    front_b: Array
    number_a: IntArray
    number_b: IntArray
    arcs_a: Array
    arcs_b: Array
    hull: Array  # of EPA
    corner: IntArray
    plane: Array
    rim: IntArray
    w: Array  # the simplex of GJK
    pick: IntArray
    share: Array
    weight: Array
    v: Array
    normal: Array  # what is found, in the pair's measure
    point_a: Array
    point_b: Array


@compiled
def most(start: IntArray) -> int:
    """The greatest count in an array of starts."""
    greatest = 0
    for k in range(start.size - 1):
        greatest = max(greatest, start[k + 1] - start[k])
    return greatest


@compiled
def room_for(a: Solids, b: Solids) -> Room:
    """Room for every pair of a solid of a and one of b."""
    return room_of(
        most(a.vertex_start),
        most(b.vertex_start),
        most(a.edge_start),
        most(b.edge_start),
    )


@compiled
def room_of(p: int, q: int, edges_a: int, edges_b: int) -> Room:
    """Room for p and q vertices, and that many edges."""
    hull, corner, plane, rim = epa_room()
    return Room(
        np.empty((p, 3)),
        np.empty((q, 3)),
        np.empty((p, 3)),
        np.empty((q, 3)),
        np.empty(p, np.intp),
        np.empty(q, np.intp),
        np.empty((edges_a, 12)),
        np.empty((edges_b, 12)),
        hull,
        corner,
        plane,
        rim,
        np.empty((4, 3)),
        np.empty((4, 2), np.intp),
        np.empty(4),
        np.empty(4),
        np.empty(3),
        np.empty(3),
        np.empty(3),
        np.empty(3),
    )


@compiled
def shifted(
    p: Array,
    first: int,
    last: int,
    origin: Array,
    at: int,
    out: Array,
    v: Array,
    sign: float,
) -> float:
    """Write p[first:last] - origin[at] to out, add sign times its mean to v; its largest coordinate."""
    ox, oy, oz = origin[at, 0], origin[at, 1], origin[at, 2]
    x = y = z = reach = 0.0
    for m in range(last - first):
        u, v_, w = p[first + m, 0] - ox, p[first + m, 1] - oy, p[first + m, 2] - oz
        out[m, 0], out[m, 1], out[m, 2] = u, v_, w
        x, y, z = x + u, y + v_, z + w
        u, v_, w = abs(u), abs(v_), abs(w)
        if u > reach:
            reach = u
        if v_ > reach:
            reach = v_
        if w > reach:
            reach = w
    part = sign / (last - first)
    v[0], v[1], v[2] = v[0] + part * x, v[1] + part * y, v[2] + part * z
    return reach


@compiled
def in_own_measure(
    vertices_a: Array,
    start_a: IntArray,
    i: int,
    vertices_b: Array,
    start_b: IntArray,
    j: int,
    a: Array,
    b: Array,
    v: Array,
) -> tuple[int, int, float]:
    """Vertices of both from A's first, in sizes of the pair, to a and b: how many each has, and the scale.

    v is from the mean of B to that of A, where GJK begins.
    """
    at, last_a, first_b, last_b = start_a[i], start_a[i + 1], start_b[j], start_b[j + 1]
    v[0] = v[1] = v[2] = 0.0
    size = shifted(vertices_a, at, last_a, vertices_a, at, a, v, 1.0)
    size = max(size, shifted(vertices_b, first_b, last_b, vertices_a, at, b, v, -1.0))
    scale = math.ldexp(1.0, -math.frexp(size)[1]) if size > 0.0 else 1.0
    for m in range(last_a - at):
        for k in range(3):
            a[m, k] *= scale
    for m in range(last_b - first_b):
        for k in range(3):
            b[m, k] *= scale
    return last_a - at, last_b - first_b, scale


def warm() -> None:
    """Called by others only (``course.jit``); ``course.overlap.convex.closest_loops`` compiles it."""
