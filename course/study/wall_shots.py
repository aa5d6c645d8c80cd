"""A bullet and a wall, looked at once a step, and the same asked as a sweep."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.study.asking import asked

#: Of the wall, whose front is at x = 0, and of the bullet [m].
THICKNESS, RADIUS = 0.1, 0.002
#: Where the bullet is at the start and, if nothing stops it, at the end [m].
START, END = -13.0, 13.0


@dataclass(frozen=True, eq=False)
class WallShot:
    """A bullet that flies along x at a wall.

    Args:
        times: (t,) [s].
        x: of its centre, (t,) [m].
        looks: where it is at each look if nothing stops it, (k,) [m].
        stop: when it was stopped [s]; inf if never.
        place: where [m].
    """

    times: Array
    x: Array
    looks: Array
    stop: float
    place: float


def look_places(speed: float, rate: float, before: float) -> Array:
    """Where the centre is at each look, (k,) [m].

    Args:
        speed: [m/s].
        rate: looks a second.
        before: how far in front of the wall the bullet is at one look, in ways from
            look to look.
    """
    way = speed / rate
    first = -before * way - RADIUS
    count = np.floor((first - START) / way)
    return np.asarray(np.arange(first - count * way, END, way))


def by_looking(speed: float, rate: float, before: float, times: Array) -> WallShot:
    """Stopped at the first look at which it touches the wall."""
    looks = look_places(speed, rate, before)
    touches = (looks >= -RADIUS) & (looks <= THICKNESS + RADIUS)
    place = float(looks[np.argmax(touches)]) if touches.any() else np.inf
    return _stopped(speed, looks, place, times)


def by_sweeping(
    speed: float, rate: float, before: float, times: Array, function: Callable[..., Any] = formulas.swept_boxes_time
) -> WallShot:  # fmt: skip
    """Stopped at the time of impact that a ``swept_boxes_time`` gives for some step."""
    looks = look_places(speed, rate, before)
    starts = np.zeros((len(looks), 3))
    starts[:, 0] = looks
    moving, still = np.array([speed, 0.0, 0.0]), np.zeros(3)
    front, back = np.array([0.0, -3.0, -3.0]), np.array([THICKNESS, 3.0, 3.0])
    (found,) = asked(
        function, [(len(looks),)], starts - RADIUS, starts + RADIUS,
        np.broadcast_to(moving, starts.shape), np.broadcast_to(front, starts.shape),
        np.broadcast_to(back, starts.shape), np.broadcast_to(still, starts.shape), 1 / rate, never=True,
    )  # fmt: skip
    hit = np.flatnonzero(np.isfinite(found))
    place = float(looks[hit[0]] + speed * found[hit[0]]) if hit.size else np.inf
    return _stopped(speed, looks, place, times)


def _stopped(speed: float, looks: Array, place: float, times: Array) -> WallShot:
    place = max(place, START)
    x = np.minimum(START + speed * times, place)
    stop = (place - START) / speed
    return WallShot(times, x, looks, stop, place)


def enough_looks(speed: float) -> float:
    """The least number of looks a second with which none is missed, v/(t + 2 r), of a speed [m/s]."""
    return speed / (THICKNESS + 2 * RADIUS)


def passing_share(
    speed: float, rates: Array, *, count: int = 2000, seed: int = 6
) -> Array:
    """Share of bullets that no look sees, (k,): each is looked at first at a drawn moment."""
    rng = np.random.default_rng(seed)
    before = rng.uniform(0.0, 1.0, count)
    shares = []
    for rate in np.asarray(rates, dtype=float):
        way, wide = speed / rate, THICKNESS + 2 * RADIUS
        # The next look after the one in front of the wall, from the first touch on.
        after = (1 - before) * way
        shares.append(np.mean(after > wide))
    return np.array(shares)
