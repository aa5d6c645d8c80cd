"""The nearest points of many pairs of rounded polytopes, pair by pair.

Far enough apart GJK answers, and says within what bounds. Where it does not, or the sets
are so near that the direction between them is mostly rounding, the separating axes
do (``separating_axis_loops``), whose separation is a lower bound of the gap for whatever axis;
of both the greater is the gap. All is done in the pair's own measure: from a vertex
of A, in sizes of the pair (a power of two, so that nothing is rounded by that).

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.convex.epa import epa_depth
from course.overlap.convex.gjk import APART, INSIDE, ONE, THREE, ZERO, gjk_distance
from course.overlap.convex.nearest_features import nearest_of_all
from course.overlap.convex.room import Room, in_own_measure, most, room_for, room_of
from course.overlap.convex.separating_axis_loops import (
    Solids,
    greatest_separation,
    separation_along,
)

#: What is as near as this, in sizes of the pair, has its direction from the separating axes.
NEAR = 1e-7
#: How far apart, in sizes of the pair, upper and lower bound of a distance may be.
CERTAIN = 1e-14
#: How much shorter than along an axis a distance may seem, relatively, and be the better known.
DOUBT = 1e-6
#: How much further back than the foremost vertex another may be and belong to the same feature, in
#: sizes of the pair, and in units of the last place of its coordinates.
LEVEL, PLACES = 4e-15, 8.0
EPS = 2.0**-52


@compiled
def combine(p: Array, pick: IntArray, side: int, share: Array, count: int, out: Array) -> None:  # fmt: skip
    """The sum of share times the picked vertices of one side."""
    # From the first of them, so that equal coordinates stay what they are.
    first = pick[0, side]
    for k in range(3):
        x = 0.0
        for m in range(1, count):
            x += share[m] * (p[pick[m, side], k] - p[first, k])
        out[k] = p[first, k] + x


@compiled
def length(x: Array, y: Array) -> float:
    """|x - y|"""
    return math.sqrt((x[0] - y[0]) ** 2 + (x[1] - y[1]) ** 2 + (x[2] - y[2]) ** 2)


@compiled
def largest(p: Array, i: int) -> float:
    """The largest coordinate of p_i, without its sign."""
    return max(abs(p[i, 0]), max(abs(p[i, 1]), abs(p[i, 2])))


@compiled
def unit(v: Array, normal: Array) -> float:
    """|v|; v / |v| is written to normal."""
    size = math.sqrt(v[0] ** 2 + v[1] ** 2 + v[2] ** 2)
    for k in range(3):
        normal[k] = v[k] / size
    return size


@compiled
def front(
    p: Array,
    count: int,
    normal: Array,
    sign: float,
    thick: float,
    out: Array,
    number: IntArray,
) -> int:
    """The vertices furthest along sign times the normal to within thick, seen along it, to out; how many.

    So the fronts of two solids lie in one plane, and their nearest points are opposite.
    """
    x, y, z = sign * normal[0], sign * normal[1], sign * normal[2]
    high, found = -math.inf, 0
    for k in range(count):
        high = max(high, p[k, 0] * x + p[k, 1] * y + p[k, 2] * z)
    for k in range(count):
        along = p[k, 0] * x + p[k, 1] * y + p[k, 2] * z
        if along >= high - thick:
            out[found, 0] = p[k, 0] - along * x
            out[found, 1] = p[k, 1] - along * y
            out[found, 2] = p[k, 2] - along * z
            number[found] = k
            found += 1
    return found


@compiled
def opposite_points(count_a: int, count_b: int, thick: float, room: Room) -> None:
    """Points of the features that meet along room.normal, the one above the other, to room.point_a and point_b."""
    fronts_a = front(
        room.a, count_a, room.normal, -1.0, thick, room.front_a, room.number_a
    )
    fronts_b = front(
        room.b, count_b, room.normal, 1.0, thick, room.front_b, room.number_b
    )
    for k in range(3):
        room.v[k] = room.front_a[0, k] - room.front_b[0, k]
    _, count, _ = gjk_distance(
        room.front_a,
        fronts_a,
        room.front_b,
        fronts_b,
        room.v,
        math.inf,
        room.w,
        room.pick,
        room.share,
        room.weight,
    )
    for m in range(count):
        room.pick[m, 0] = room.number_a[room.pick[m, 0]]
        room.pick[m, 1] = room.number_b[room.pick[m, 1]]
    combine(room.a, room.pick, ZERO, room.share, count, room.point_a)
    combine(room.b, room.pick, ONE, room.share, count, room.point_b)


@compiled
def by_gjk(count_a: int, count_b: int, room: Room) -> tuple[int, float, float]:
    """GJK from room.v: how it ended, lower and upper bound of the distance; points of the upper one to room."""
    ended, count, lower = gjk_distance(
        room.a,
        count_a,
        room.b,
        count_b,
        room.v,
        math.inf,
        room.w,
        room.pick,
        room.share,
        room.weight,
    )
    if ended != APART:
        return ended, lower, math.inf
    combine(room.a, room.pick, ZERO, room.share, count, room.point_a)
    combine(room.b, room.pick, ONE, room.share, count, room.point_b)
    return ended, lower, length(room.point_a, room.point_b)


@compiled
def by_epa(count_a: int, count_b: int, thick: float, room: Room) -> float:
    """The depth from GJK's last simplex, points to room; -1 where EPA is not sure."""
    depth = epa_depth(
        room.a,
        count_a,
        room.b,
        count_b,
        room.w,
        room.hull,
        room.corner,
        room.plane,
        room.rim,
        room.normal,
    )
    if depth >= 0.0:
        opposite_points(count_a, count_b, thick, room)
    return depth


@compiled
def by_all_features(a: Solids, i: int, b: Solids, j: int, count_a: int, count_b: int, room: Room) -> float:  # fmt: skip
    """The distance where GJK lost its way: points and the vector v between them are written to room."""
    for once_more in (True, False):
        nearest_of_all(room.a, room.b, a, i, b, j, room.pick, room.share)
        combine(room.a, room.pick, ZERO, room.share, THREE, room.point_a)
        combine(room.b, room.pick, ONE, room.share, THREE, room.point_b)
        for k in range(3):
            room.v[k] = room.point_a[k] - room.point_b[k]
        # Of features that are as near to rounding the first was taken; from so near GJK finds the best.
        if once_more:
            _, lower, upper = by_gjk(count_a, count_b, room)
            if upper - lower <= CERTAIN:
                break
    return length(room.point_a, room.point_b)


@compiled
def nearly_touching(
    a: Solids,
    i: int,
    b: Solids,
    j: int,
    count_a: int,
    count_b: int,
    ended: int,
    lower: float,
    upper: float,
    thick: float,
    room: Room,
) -> float:
    """The gap of two polytopes that overlap, nearly touch, or are apart by what GJK is not sure of.

    Args:
        ended: how GJK did.
        lower, upper: bounds of their distance by GJK, which has left the points of the upper
            one and the vector v of the lower one in room.
        thick: how much further back a vertex may be and belong to the same feature.
    """
    normal, v = room.normal, room.v
    if ended == INSIDE:
        depth = by_epa(count_a, count_b, thick, room)
        if depth >= 0.0:
            return -depth
    sure = upper - lower <= CERTAIN and lower > 0.0
    s = greatest_separation(room.a, count_a, room.b, count_b, a, i, b, j, room.arcs_a, room.arcs_b, normal)  # fmt: skip
    # Seen at a small angle a distance is hardly shorter: if in doubt it is that of the points.
    if sure and lower >= s * (1.0 - DOUBT):
        return unit(v, normal)
    opposite_points(count_a, count_b, thick, room)
    if s <= CERTAIN or length(room.point_a, room.point_b) - s <= CERTAIN:
        return s
    distance = by_all_features(a, i, b, j, count_a, count_b, room)
    size = math.sqrt(v[0] ** 2 + v[1] ** 2 + v[2] ** 2)
    x, y, z = v[0] / size, v[1] / size, v[2] / size
    if separation_along(room.a, count_a, room.b, count_b, x, y, z) <= s and distance - s <= CERTAIN:  # fmt: skip
        return s
    return unit(v, normal)


@compiled
def pairs_by_points(
    vertices_a: Array,
    start_a: IntArray,
    radius_a: Array,
    vertices_b: Array,
    start_b: IntArray,
    radius_b: Array,
    i: IntArray,
    j: IntArray,
    gap: Array,
    normal: Array,
    point_a: Array,
    point_b: Array,
) -> None:
    """What GJK and EPA are sure of, as ``closest_pairs`` writes it; the gap of the other pairs is NaN.

    They read no face and no edge, which take longer to find than a distance does.
    """
    room = room_of(most(start_a), most(start_b), ZERO, ZERO)
    core_a, core_b, v, n, p_a, p_b = room.a, room.b, room.v, room.normal, room.point_a, room.point_b  # fmt: skip
    w, pick, share, weight = room.w, room.pick, room.share, room.weight
    for p in range(i.size):
        count_a, count_b, scale = in_own_measure(
            vertices_a, start_a, i[p], vertices_b, start_b, j[p], core_a, core_b, v
        )
        ended, count, lower = gjk_distance(
            core_a, count_a, core_b, count_b, v, math.inf, w, pick, share, weight
        )
        r_a, r_b, at = radius_a[i[p]], radius_b[j[p]], start_a[i[p]]
        gap[p] = math.nan
        if ended == APART and lower > NEAR:
            combine(core_a, pick, ZERO, share, count, p_a)
            combine(core_b, pick, ONE, share, count, p_b)
            if length(p_a, p_b) - lower > CERTAIN:
                continue
            apart = unit(v, n)
        elif ended == INSIDE:
            thick = LEVEL + PLACES * EPS * scale * largest(vertices_a, at)
            apart = -by_epa(count_a, count_b, thick, room)
            if apart > 0.0:
                continue
        else:
            continue
        gap[p] = apart / scale - r_a - r_b
        for k in range(3):
            origin = vertices_a[at, k]
            normal[p, k] = n[k]
            point_a[p, k] = p_a[k] / scale - r_a * n[k] + origin
            point_b[p, k] = p_b[k] / scale + r_b * n[k] + origin


@compiled
def closest_pairs(
    a: Solids,
    b: Solids,
    i: IntArray,
    j: IntArray,
    gap: Array,
    normal: Array,
    point_a: Array,
    point_b: Array,
) -> None:
    """Gap, normal and nearest points of the pairs (i, j), written to the last four, (p,) and (p, 3)."""
    room = room_for(a, b)
    # What every pair needs has a name of its own: a tuple counts its arrays at each use.
    vertices_a, start_a, vertices_b, start_b = a.vertices, a.vertex_start, b.vertices, b.vertex_start  # fmt: skip
    core_a, core_b, v, n, p_a, p_b = room.a, room.b, room.v, room.normal, room.point_a, room.point_b  # fmt: skip
    w, pick, share, weight = room.w, room.pick, room.share, room.weight
    radius_a, radius_b = a.radius, b.radius
    for p in range(i.size):
        count_a, count_b, scale = in_own_measure(
            vertices_a, start_a, i[p], vertices_b, start_b, j[p], core_a, core_b, v
        )
        ended, count, lower = gjk_distance(
            core_a, count_a, core_b, count_b, v, math.inf, w, pick, share, weight
        )
        upper = math.inf
        if ended == APART:
            combine(core_a, pick, ZERO, share, count, p_a)
            combine(core_b, pick, ONE, share, count, p_b)
            upper = length(p_a, p_b)
        if lower > NEAR and upper - lower <= CERTAIN:
            apart = unit(v, n)
        else:
            thick = LEVEL + PLACES * EPS * scale * largest(vertices_a, start_a[i[p]])
            apart = nearly_touching(a, i[p], b, j[p], count_a, count_b, ended, lower, upper, thick, room)  # fmt: skip
        r_a, r_b, at = radius_a[i[p]], radius_b[j[p]], start_a[i[p]]
        gap[p] = apart / scale - r_a - r_b
        for k in range(3):
            origin = vertices_a[at, k]
            normal[p, k] = n[k]
            point_a[p, k] = p_a[k] / scale - r_a * n[k] + origin
            point_b[p, k] = p_b[k] / scale + r_b * n[k] + origin


@compiled
def least_translations(
    a: Solids, b: Solids, i: IntArray, j: IntArray, separation: Array, normal: Array
) -> None:
    """The greatest separation of the pairs (i, j) and its axis, written to the last two, (p,) and (p, 3)."""
    room = room_for(a, b)
    for p in range(i.size):
        count_a, count_b, scale = in_own_measure(
            a.vertices,
            a.vertex_start,
            i[p],
            b.vertices,
            b.vertex_start,
            j[p],
            room.a,
            room.b,
            room.v,
        )
        s = greatest_separation(
            room.a,
            count_a,
            room.b,
            count_b,
            a,
            i[p],
            b,
            j[p],
            room.arcs_a,
            room.arcs_b,
            room.normal,
        )
        separation[p] = s / scale - a.radius[i[p]] - b.radius[j[p]]
        for k in range(3):
            normal[p, k] = room.normal[k]


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    from course.overlap.convex.closest import closest_points, least_translation
    from course.overlap.convex.convex_pairs import closest_convex
    from course.shapes import AABB, polytopes

    cube = AABB(np.zeros((1, 3)), np.ones((1, 3)))
    closest_convex(cube, cube)
    box = polytopes(cube)
    closest_points(box, box, [0], [0])
    least_translation(box, box, [0], [0])
