"""When two moving shapes meet, and what a moving shape sweeps.

Straight lines are exact (``swept``); what turns is advanced conservatively
(``advancement``). A compound is asked part by part, and the earliest impact counts.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    failure,
    non_negative,
    positive,
    vectors,
    written,
)
from course.overlap.arguments import LARGEST, checked, convex_parts
from course.overlap.moving.advancement import Motion, turning_time
from course.overlap.pairs import KINDS, TABLE
from course.shapes import AABB, Shape


def time_of_impact(
    a: Shape,
    b: Shape,
    velocity_a: ArrayLike,
    velocity_b: ArrayLike,
    *,
    horizon: ArrayLike,
    spin_a: ArrayLike | None = None,
    spin_b: ArrayLike | None = None,
    pivot_a: ArrayLike | None = None,
    pivot_b: ArrayLike | None = None,
    tolerance: ArrayLike | None = None,
) -> Array:
    """When two moving shapes begin to overlap (syllabus row 12).

    x(t) = c + v t + exp(t omega x)(x - c)   for every point x of a shape, c its pivot.

    Shapes that do not turn are served exactly: of two whose gap is above 0, the first
    t at which it is not, so that those that only graze meet. Shapes that turn are
    advanced conservatively: no penetration deeper than the tolerance is missed,
    shallower ones may be, and the time is that at which the gap reaches 0. A pair that
    rolls along at a gap of nearly 0 may need more than 10,000 steps: then the time that
    was reached is given as the impact. Never is a pair said not to meet that was not
    followed to the horizon.

    Args:
        a, b: shapes of any kinds.
        velocity_a, velocity_b: v of each, of its pivot where it turns, (..., 3) [m/s].
        horizon: how long the motion lasts, at or above 0, (...) [s]; may be infinite
            where nothing turns.
        spin_a, spin_b: omega, constant, in world axes, (..., 3) [rad/s]; 0 if not given.
        pivot_a, pivot_b: c at t = 0, (..., 3) [m]; the middle of the shape's bounds if
            not given. A half space that turns needs one.
        tolerance: above 0, (...) [m], for what turns; a millionth of the extent of the
            smaller of the two if not given, and never more than half of what a ball
            inside each measures together.
    Returns:
        (...) [s], of all arguments broadcast: 0 for shapes that penetrate, or touch and
        approach; inf for those that touch and part or slide, and that do not meet
        within the horizon.
    Raises:
        TypeError: what is no shape.
        ValueError: arguments that do not fit or are out of range.
    """
    checked(a, b)
    end = non_negative("horizon", horizon, infinite=True)
    depth = None if tolerance is None else positive("tolerance", tolerance)
    motion_a = _motion("a", a, velocity_a, spin_a, pivot_a)
    motion_b = _motion("b", b, velocity_b, spin_b, pivot_b)
    batch = _batch(a, b, motion_a, motion_b, end, depth)
    turning = np.broadcast_to(motion_a.turns | motion_b.turns, batch)
    if np.any(turning & np.isinf(end)):
        raise failure("horizon", "finite numbers where a shape turns", "inf")
    time = np.full(batch, np.inf)
    for _, _, first, second in convex_parts(a, b):
        found = np.full(batch, np.inf)
        if not np.all(turning):
            relative = motion_a.velocity - motion_b.velocity
            found[...] = straight_time(first, second, relative, end)
        if np.any(turning):
            found[turning] = turning_time(
                first, second, motion_a, motion_b, end, depth, turning
            )
        np.minimum(time, found, out=time)
    return time[()]


def straight_time(a: Shape, b: Shape, velocity: Array, horizon: Array) -> Array:
    """Time of impact of two shapes without parts, A moving by velocity as seen from B."""
    if KINDS.index(a.kind) > KINDS.index(b.kind):
        a, b, velocity = b, a, -velocity
    return TABLE[a.kind, b.kind].time(a, b, velocity, horizon)


def swept_bounds(a: Shape, velocity: ArrayLike, horizon: ArrayLike) -> AABB:
    """The axis-aligned box around all places of a shape that moves in a straight line.

    The bounds at the start and at the end: l + min(0, v T) to u + max(0, v T)
    (C. Ericson, *Real-Time Collision Detection*, section 5.5; syllabus row 12).

    Args:
        a: a shape of any kind; that of a half space is endless.
        velocity: v, (..., 3) [m/s].
        horizon: T, at or above 0, (...) [s].
    Returns:
        boxes of all arguments broadcast.
    """
    checked(a, a)
    v, end = _rate("velocity", velocity), non_negative("horizon", horizon)
    own = np.empty(a.batch, dtype=bool)
    broadcast(a=(own, 0), velocity=(v, 1), horizon=(end, 0))
    way, box = v * end[..., None], _bounds(a)
    return AABB(box.lower + np.minimum(way, 0.0), box.upper + np.maximum(way, 0.0))


def _motion(
    which: str,
    shape: Shape,
    velocity: ArrayLike,
    spin: ArrayLike | None,
    pivot: ArrayLike | None,
) -> Motion:
    """How a shape moves, checked; without a pivot it turns about the middle of its bounds."""
    v = _rate(f"velocity_{which}", velocity)
    omega = np.zeros(3) if spin is None else _rate(f"spin_{which}", spin)
    if pivot is not None:
        return Motion(v, omega, _rate(f"pivot_{which}", pivot))
    if not np.any(omega):
        return Motion(v, omega, np.zeros(3))
    if shape.kind == "half_space":
        raise failure(f"pivot_{which}", "what a half space turns about", "None")
    return Motion(v, omega, _bounds(shape).center)


def _bounds(shape: Any) -> AABB:
    """Every kind has bounds; their common class does not say so."""
    box: AABB = shape.bounds()
    return box


def _rate(name: str, value: ArrayLike) -> Array:
    array = vectors(name, value)
    largest = np.max(np.abs(array), initial=0.0)
    if not largest <= LARGEST:
        raise failure(name, f"numbers up to {LARGEST:g}", written(largest))
    return array


def _batch(
    a: Shape, b: Shape, motion_a: Motion, motion_b: Motion, end: Array, depth: Array | None
) -> tuple[int, ...]:  # fmt: skip
    """The batch of all arguments broadcast."""
    arguments: dict[str, tuple[Any, int]] = {
        "a": (np.empty(a.batch, dtype=bool), 0),
        "b": (np.empty(b.batch, dtype=bool), 0),
        "horizon": (end, 0),
    }
    if depth is not None:
        arguments["tolerance"] = (depth, 0)
    for which, motion in ("a", motion_a), ("b", motion_b):
        for name in ("velocity", "spin", "pivot"):
            arguments[f"{name}_{which}"] = (getattr(motion, name), 1)
    return broadcast(**arguments)
