"""Conservative advancement in loops: from one look at a pair to the next, never past an impact.

The gap of two solids is that along the normal N of their nearest points, and along any
fixed N they are apart by no more than their gap. As far as the separation along N can be
followed, nothing is missed: to its root the solids are free, and there the gap and its
N are asked anew.

* In straight motion the separation along N is linear and the gap a convex function of
  time: this is Newton's iteration from the left, and a ray cast against the Minkowski
  difference (G. van den Bergen, "Ray casting against general convex objects with
  application to continuous collision detection", 2004).
* Of solids that turn each vertex moves along N by s + w t, to within K t^2/2 with
  K = |omega x N| |omega x r| (B. Mirtich, *Impulse-based Dynamic Simulation of Rigid Body
  Systems*, 1996, section 2.3.2, bounds the speed alone; with the rate itself the steps
  near an impact are Newton's). What is sought is the first time at which the gap is
  below minus a depth: so solids that touch and part, or slide, are never said to meet,
  and N is well defined. Then the time at which the gap was 0 is found between the
  last two looks.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.convex.separating_axis_loops import Solids
from course.overlap.moving.moving_bodies import Body, Places, body_of, gap_at
from course.overlap.triples import Triple, along, cross, dot, length, minus, row

#: Looks after which a pair in straight motion meets; to a grazing impact Newton halves
#: the way, 27 times.
MOST_LOOKS_STRAIGHT = 100
#: Looks after which a pair that turns counts as meeting.
MOST_LOOKS = 10_000
#: Turns of the iteration within a step; it ends earlier by itself.
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
    """Until when a pair is followed, to what depth, and the gap and the rate that count as none."""

    horizon: float
    depth: float
    band: float
    slow: float


class Search(NamedTuple):
    """What is known of a pair, which is to be looked at next at time t; done: t is the answer."""

    t: float
    done: bool
    at_once: bool  # it touches and approaches at the start
    early: (
        float  # the last time at which it did not penetrate, and its gap over the level
    )
    high: float
    late: float  # when it was in by the depth, inf before that, and its gap over the level
    low: float
    level: float  # the gap whose time is sought
    side: int  # how often in a row the early (above 0) or the late one was moved


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
def course_of(body: Body, k: int, pivot: Triple, n: Triple, foot: Triple) -> Course:
    """How vertex k moves along a fixed n, measured from the foot."""
    x = row(body.now.vertices, k)
    turning = cross(body.spin, minus(x, pivot))
    rate = dot(n, along(turning, 1.0, body.velocity))
    return dot(n, minus(x, foot)), rate, length(cross(body.spin, n)) * length(turning)


@compiled
def course_over(
    pair: Pair, k: int, pivot_a: Triple, pivot_b: Triple, n: Triple, foot: Triple, most: float
) -> Course:  # fmt: skip
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
def answer(t: float) -> Search:
    """A search that is done."""
    return Search(t, True, False, 0.0, 0.0, 0.0, 0.0, 0.0, 0)


@compiled
def straight_look(pair: Pair, s: Search, first: bool, gap: float, n: Triple, limits: Limits) -> Search:  # fmt: skip
    """What follows from the gap and N of a pair that does not turn: look at t - gap/rate."""
    rate = dot(n, minus(pair.a.velocity, pair.b.velocity))
    if first and gap < -limits.band:
        return answer(0.0)
    if first and gap <= limits.band:
        return answer(0.0 if rate < -limits.slow else math.inf)
    if gap <= 0.0625 * limits.band:
        return answer(s.t)
    later = s.t - gap / rate if rate < 0.0 else math.inf
    if later > limits.horizon or later == math.inf:
        return answer(math.inf)
    return Search(later, later == s.t, False, 0.0, 0.0, 0.0, 0.0, 0.0, 0)


@compiled
def between(s: Search) -> Search:
    """Where to look between the early and the late time: regula falsi, halves where one has stayed three times."""
    share = 0.5 if abs(s.side) > 2 else s.high / (s.high - s.low)
    middle = s.early + (s.late - s.early) * share
    if middle <= s.early:
        return answer(s.early)
    if middle >= s.late:
        return answer(s.late)
    return Search(middle, False, False, s.early, s.high, s.late, s.low, s.level, s.side)


@compiled
def narrowed(s: Search, gap: float, band: float) -> Search:
    """A look between the early and the late time: the end that has stayed counts half (Illinois)."""
    found = gap - s.level
    if abs(found) <= 1e-3 * band:
        return answer(s.t)
    if found > 0.0:
        low = 0.5 * s.low if s.side > 0 else s.low
        side = max(s.side, 0) + 1
        return between(
            Search(s.t, False, False, s.t, found, s.late, low, s.level, side)
        )
    high = 0.5 * s.high if s.side < 0 else s.high
    side = min(s.side, 0) - 1
    return between(Search(s.t, False, False, s.early, high, s.t, found, s.level, side))


@compiled
def deep(s: Search, gap: float, band: float) -> Search:
    """The pair is in by the depth: when did it begin?

    One that touched before, as a box that tips over an edge, when it was in by more
    than rounding.
    """
    if s.at_once and s.early == 0.0:
        return answer(0.0)
    level = 0.0 if s.high > band else -2.0 * band
    high, low = s.high - level, gap - level
    return between(Search(s.t, False, False, s.early, high, s.t, low, level, 0))


@compiled
def turning_look(
    pair: Pair, s: Search, first: bool, gap: float, n: Triple, limits: Limits, table: Array
) -> Search:  # fmt: skip
    """What follows from the gap and N of a pair that turns."""
    horizon, depth, band, slow = limits
    if s.late < math.inf:
        return narrowed(s, gap, band)
    if first and gap < -band:
        return answer(0.0)
    if not first and (gap <= -0.5 * depth or (s.t == horizon and gap < -band)):
        return deep(s, gap, band)
    if not first and s.t == horizon:
        return answer(math.inf)
    early, high = (s.t, gap) if gap >= -band else (s.early, s.high)
    total = len(pair.a.arms) + len(pair.b.arms)
    count = courses(pair, n, s.t, horizon - s.t, table)
    at_once = s.at_once
    if first and gap <= band:
        at_once = approaches(table, count, total, band, slow)
    step = first_root(table, count, total, pair.radius - depth, horizon - s.t)
    # The gap never falls faster than the speed.
    sure = (gap + depth) / pair.speed if pair.speed > 0.0 else math.inf
    t = min(s.t + max(step, sure), horizon)
    return Search(t, False, at_once, early, high, math.inf, 0.0, 0.0, 0)


@compiled
def motion_times(
    solids_a: Solids,
    solids_b: Solids,
    i: IntArray,
    j: IntArray,
    motion_a: Array,
    motion_b: Array,
    radius: Array,
    plane: bool,
    limits: Array,
    places: Places,
    time: Array,
) -> None:
    """Time of impact of p pairs of rounded polytopes, written to time.

    Args:
        i, j: (p,) which solids.
        motion_a, motion_b: (p, 3, 3), rows velocity [m/s], spin [rad/s] and pivot [m].
        radius: of both together, (p,) [m].
        plane: whether the solids of B are half spaces.
        limits: (p, 4), horizon [s], depth [m], and what counts as none, a gap [m] and a
            rate [m/s].
        places: where any of them may be put, ``moving_bodies.places_for``.
        time: (p,) [s].
    """
    for p in range(time.size):
        pair = pair_of(
            solids_a, solids_b, i[p], j[p], places, motion_a[p], motion_b[p], radius[p], plane, limits[p, 0]
        )  # fmt: skip
        bounds = Limits(limits[p, 0], limits[p, 1], limits[p, 2], limits[p, 3])
        table = np.empty((len(pair.a.arms) + len(pair.b.arms), 3))
        straight = length(pair.a.spin) == 0.0 and length(pair.b.spin) == 0.0
        s = Search(0.0, False, False, 0.0, 0.0, math.inf, 0.0, 0.0, 0)
        for k in range(MOST_LOOKS_STRAIGHT if straight else MOST_LOOKS):
            gap, n = gap_at(pair.a, pair.b, pair.radius, plane, s.t, places)
            if straight:
                s = straight_look(pair, s, k == 0, gap, n, bounds)
            else:
                s = turning_look(pair, s, k == 0, gap, n, bounds, table)
            if s.done:
                break
        time[p] = s.t


@compiled
def pair_of(
    solids_a: Solids,
    solids_b: Solids,
    i: int,
    j: int,
    places: Places,
    motion_a: Array,
    motion_b: Array,
    radius: float,
    plane: bool,
    horizon: float,
) -> Pair:
    """Two solids as bodies that move, seen from the pivot of the first."""
    origin = row(motion_a, 2)
    a = body_of(
        solids_a, i, places.now_a, origin, origin, row(motion_a, 0), row(motion_a, 1)
    )
    pivot = row(motion_b, 2)
    b = body_of(
        solids_b, j, places.now_b, origin, pivot, row(motion_b, 0), row(motion_b, 1)
    )
    speed = length(minus(a.velocity, b.velocity)) + swing(a)
    speed += swing_under(a, b, horizon) if plane else swing(b)
    return Pair(a, b, radius, plane, speed)


def warm() -> None:
    """Call the kernel once (``course.jit``)."""
    from course.overlap.impact_times import time_of_impact
    from course.shapes import AABB, Sphere

    box, ball = AABB(np.zeros(3), np.ones(3)), Sphere(np.full(3, 3.0), np.full((), 0.5))
    time_of_impact(box, ball, np.ones(3), np.zeros(3), horizon=1.0)
