"""Solids that turn, advanced conservatively from gap to gap until they penetrate by a small depth.

``advancement_loops`` says why nothing is passed over. What is sought is the first time
at which the gap is below minus a depth: so solids that touch and part, or slide,
are never said to meet, and N is well defined all the way. From there the time at which
the gap was 0 is found between the last two steps.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.advancement_loops import Body, body_of, gap_at, place
from course.overlap.closest_loops import Room, room_for
from course.overlap.separating_axis_loops import Solids
from course.overlap.triples import Triple, along, cross, dot, length, minus, row

#: Steps after which a pair counts as meeting.
MOST_STEPS = 10_000
#: Solids that touch slide if they approach by less than this times their speed
#: (``swept.SLIDING``).
SLIDING = 1e-12
#: Turns of the iterations within a step; each ends earlier by itself.
MOST_TURNS = 60

#: Value, rate and bound of the second derivative of a length, at the beginning of a step.
Course = tuple[float, float, float]


class Pair(NamedTuple):
    """Two bodies that are followed, B a polytope or, with one vertex and one normal, a half space."""

    a: Body
    b: Body
    radius: float
    plane: bool
    speed: float  # a bound of how fast their gap changes [m/s]


class Limits(NamedTuple):
    """Until when a pair is followed, to what depth, and the gap that counts as none."""

    horizon: float
    depth: float
    band: float


@compiled
def swing(body: Body) -> float:
    """How fast a spin moves the vertices: the greatest |omega x r|."""
    greatest = 0.0
    for k in range(len(body.arms)):
        greatest = max(greatest, length(cross(body.spin, row(body.arms, k))))
    return greatest


@compiled
def swing_under(a: Body, b: Body, horizon: float) -> float:
    """How fast half space b moves at most where a is, by turning: |omega| times how far that is from its pivot."""
    arm = 0.0
    for k in range(len(a.arms)):
        arm = max(arm, length(row(a.arms, k)))
    far = length(minus(a.pivot, b.pivot)) + arm
    far += horizon * length(minus(a.velocity, b.velocity))
    return length(b.spin) * far


@compiled
def pair_gap(pair: Pair, t: float, room: Room) -> tuple[float, Triple]:
    """Gap and N of a pair at time t; its bodies are put there."""
    if not pair.plane:
        return gap_at(pair.a, pair.b, pair.radius, t, room)
    place(pair.a, t)
    place(pair.b, t)
    n, foot = row(pair.b.now.normals, 0), row(pair.b.now.vertices, 0)
    gap = math.inf
    for k in range(len(pair.a.arms)):
        gap = min(gap, dot(n, minus(row(pair.a.now.vertices, k), foot)))
    return gap - pair.radius, n


@compiled
def course_of(body: Body, k: int, pivot: Triple, n: Triple, foot: Triple) -> Course:
    """How vertex k moves along a fixed n, measured from the foot."""
    x = row(body.now.vertices, k)
    turning = cross(body.spin, minus(x, pivot))
    rate = dot(n, along(turning, 1.0, body.velocity))
    return dot(n, minus(x, foot)), rate, length(cross(body.spin, n)) * length(turning)


@compiled
def course_over(pair: Pair, k: int, pivot_a: Triple, pivot_b: Triple, n: Triple, foot: Triple, most: float) -> Course:  # fmt: skip
    """How high vertex k of A is over a half space that turns, for steps up to ``most``.

    h = n.y + const with y from B's pivot, n_dot = omega_B x n: h' = n_dot.y + n.y',
    |h''| <= |omega_B| |n_dot| |y| + 2 |n_dot| |y'| + |y''|.
    """
    a, b = pair.a, pair.b
    x = row(a.now.vertices, k)
    x_dot, n_dot = cross(a.spin, minus(x, pivot_a)), cross(b.spin, n)
    v = minus(a.velocity, b.velocity)
    y = minus(x, pivot_b)
    rate = dot(n, along(v, 1.0, x_dot)) + dot(n_dot, y)
    fast, turn = length(v) + length(x_dot), length(n_dot)
    bound = length(b.spin) * turn * (length(y) + fast * most)
    bound += 2.0 * turn * fast + length(a.spin) * length(x_dot)
    return dot(n, minus(x, foot)), rate, bound


@compiled
def at(course: Course, t: float, sign: float) -> float:
    """s + w t + sign K t^2/2."""
    return course[0] + t * (course[1] + sign * 0.5 * t * course[2])


@compiled
def root(course: Course) -> float:
    """The first t > 0 with s + w t - K t^2/2 = 0, s > 0."""
    s, w, k = course
    size = math.sqrt(w * w + 2.0 * k * s)
    if w <= 0.0:
        return 2.0 * s / (size - w) if size > w else math.inf
    return (size + w) / k if k > 0.0 else math.inf


@compiled
def courses(pair: Pair, n: Triple, t: float, most: float, table: Array) -> int:
    """Fill the table with the courses of all vertices, A's first; how many are A's."""
    a, b = pair.a, pair.b
    pivot_a, pivot_b = along(a.pivot, t, a.velocity), along(b.pivot, t, b.velocity)
    foot = row(b.now.vertices, 0)
    count = len(a.arms)
    turning = pair.plane and length(b.spin) > 0.0
    for k in range(count):
        if turning:
            found = course_over(pair, k, pivot_a, pivot_b, n, foot, most)
        else:
            found = course_of(a, k, pivot_a, n, foot)
        table[k, 0], table[k, 1], table[k, 2] = found
    for k in range(len(b.arms)):
        found = course_of(b, k, pivot_b, n, foot)
        if turning:
            found = (0.0, 0.0, 0.0)  # the courses of A are already those over B
        table[count + k, 0], table[count + k, 1], table[count + k, 2] = found
    return count


@compiled
def first_root(table: Array, count: int, total: int, level: float, most: float) -> float:  # fmt: skip
    """When the separation along N may first reach the level, ``most`` if not before.

    min_A (s + w t - K t^2/2) - max_B (s + w t + K t^2/2) - level is concave in t: from the
    right, the root of whichever vertices are foremost there leads to its first root.
    """
    t = most
    for _ in range(MOST_TURNS):
        low, high, p, q = math.inf, -math.inf, 0, 0
        for k in range(total):
            found = (table[k, 0], table[k, 1], table[k, 2])
            if k < count:
                value = at(found, t, -1.0)
                if value < low:
                    low, p = value, k
            else:
                value = at(found, t, 1.0)
                if value > high:
                    high, q = value, k
        if low - high >= level:
            return t
        s = table[p, 0] - table[q, 0] - level
        if s <= 0.0:
            return 0.0
        earlier = root((s, table[p, 1] - table[q, 1], table[p, 2] + table[q, 2]))
        if earlier >= t * (1.0 - 1e-12):
            return t
        t = earlier
    return 0.0


@compiled
def crossing(pair: Pair, level: float, t: float, gap: float, later: float, below: float, band: float, room: Room) -> float:  # fmt: skip
    """When the gap is at a level between t, where it is above, and later, where it is below.

    Regula falsi in the Illinois form; halved where one end has stayed three times, as where
    the gap is 0 for a while before it falls.
    """
    high, low, side = gap - level, below - level, 0
    for _ in range(MOST_TURNS):
        middle = t + (later - t) * (high / (high - low))
        if abs(side) > 2:
            middle = t + 0.5 * (later - t)
        if not t < middle < later:
            return t if middle <= t else later
        found, _ = pair_gap(pair, middle, room)
        found -= level
        if abs(found) <= 1e-3 * band:
            return middle
        if found > 0.0:
            t, high = middle, found
            low = 0.5 * low if side > 0 else low
            side = max(side, 0) + 1
        else:
            later, low = middle, found
            high = 0.5 * high if side < 0 else high
            side = min(side, 0) - 1
    return later


@compiled
def impact(pair: Pair, free: float, gap: float, t: float, below: float, band: float, room: Room) -> float:  # fmt: skip
    """The time of impact, when the pair is free at one time and penetrates at a later one.

    One that touches while it is free, as a box that tips over an edge, meets when it
    is in by more than rounding.
    """
    level = 0.0 if gap > band else -2.0 * band
    return crossing(pair, level, free, gap, t, below, band, room)


@compiled
def approaches(table: Array, count: int, total: int, band: float, slow: float) -> bool:
    """Whether what is foremost along N, to within the band, comes nearer."""
    low, high = math.inf, -math.inf
    for k in range(total):
        if k < count:
            low = min(low, table[k, 0])
        else:
            high = max(high, table[k, 0])
    a, b = math.inf, -math.inf
    for k in range(total):
        if k < count and table[k, 0] <= low + band:
            a = min(a, table[k, 1])
        elif k >= count and table[k, 0] >= high - band:
            b = max(b, table[k, 1])
    return a - b < -slow


@compiled
def advanced(pair: Pair, limits: Limits, table: Array, room: Room) -> float:
    """The time of impact of one pair."""
    horizon, depth, band = limits
    t = free = 0.0
    gap, n = pair_gap(pair, t, room)
    free_gap, total = gap, len(pair.a.arms) + len(pair.b.arms)
    if gap < -band:
        return 0.0
    count = courses(pair, n, t, horizon, table)
    slow = SLIDING * pair.speed
    at_once = gap <= band and approaches(table, count, total, band, slow)
    for _ in range(MOST_STEPS):
        step = first_root(table, count, total, pair.radius - depth, horizon - t)
        # The gap never falls faster than the speed.
        sure = (gap + depth) / pair.speed if pair.speed > 0.0 else math.inf
        t = min(t + max(step, sure), horizon)
        gap, n = pair_gap(pair, t, room)
        if gap <= -0.5 * depth or (t == horizon and gap < -band):
            if at_once and free == 0.0:
                return 0.0
            return impact(pair, free, free_gap, t, gap, band, room)
        if t == horizon:
            return math.inf
        if gap >= -band:
            free, free_gap = t, gap
        count = courses(pair, n, t, horizon - t, table)
    return t


@compiled
def turning_times(
    solids_a: Solids,
    solids_b: Solids,
    i: IntArray,
    j: IntArray,
    motion_a: Array,
    motion_b: Array,
    radius: Array,
    plane: bool,
    limits: Array,
    time: Array,
) -> None:
    """Time of impact of p pairs of solids that turn, written to time.

    Args:
        i, j: (p,) which solids.
        motion_a, motion_b: (p, 3, 3), rows velocity [m/s], spin [rad/s] and pivot [m].
        radius: of both together, (p,) [m].
        plane: whether the solids of B are half spaces.
        limits: (p, 3), horizon [s], depth and band [m].
        time: (p,) [s].
    """
    room = room_for(solids_a, solids_b)
    for p in range(time.size):
        origin = row(motion_a[p], 2)
        a = body_of(solids_a, i[p], origin, origin, row(motion_a[p], 0), row(motion_a[p], 1))  # fmt: skip
        b = body_of(solids_b, j[p], origin, row(motion_b[p], 2), row(motion_b[p], 0), row(motion_b[p], 1))  # fmt: skip
        speed = length(minus(a.velocity, b.velocity)) + swing(a)
        speed += swing_under(a, b, limits[p, 0]) if plane else swing(b)
        pair = Pair(a, b, radius[p], plane, speed)
        table = np.empty((len(a.arms) + len(b.arms), 3))
        bounds = Limits(limits[p, 0], limits[p, 1], limits[p, 2])
        time[p] = advanced(pair, bounds, table, room)


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    from course.overlap.impact_times import time_of_impact
    from course.shapes import AABB, HalfSpace

    box, floor = AABB(np.ones(3), np.full(3, 2.0)), HalfSpace((0.0, 0.0, 1.0), 0.0)
    for other in box, floor:
        still, turning = np.zeros(3), np.ones(3)
        time_of_impact(box, other, still, still, horizon=1.0, spin_a=turning)
