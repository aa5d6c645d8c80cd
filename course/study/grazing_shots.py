"""Where a sweep of balls breaks: grazing in numbers of 32 bits, and balls that touch after a stop."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course.arrays import Array
from course.overlap import time_of_impact
from course.shapes import Sphere

#: Of both balls of a shot [m], and its speed [m/s].
RADIUS, SPEED = 0.002, 900.0
#: Half the distance of two neighbouring numbers near 1, of 32 and of 64 bits.
SINGLE, DOUBLE = 2.0**-24, 2.0**-53
#: Numbers of a ``swept_spheres_time``.
Arguments = tuple[Any, ...]


def far_shots(distance: float, count: int, *, seed: int) -> Arguments:
    """Shots from far away of which half hit, as numbers of 32 bits.

    Each would pass the other ball's centre at a distance drawn evenly from 0 to 4 radii;
    it hits below 2. It is followed until it is well behind.
    """
    rng = np.random.default_rng(seed)
    way, aside = rng.normal(size=(2, count, 3))
    way /= np.linalg.norm(way, axis=-1, keepdims=True)
    aside = np.cross(way, aside)
    aside /= np.linalg.norm(aside, axis=-1, keepdims=True)
    passes = rng.uniform(0.0, 4 * RADIUS, (count, 1))
    values = (
        passes * aside - distance * way, np.full(count, RADIUS), SPEED * way,
        np.zeros((count, 3)), np.full(count, RADIUS), np.zeros((count, 3)),
    )  # fmt: skip
    return (*(v.astype(np.float32) for v in values), np.float32(2 * distance / SPEED))


def wrong_in_single(
    function: Callable[..., Any], distances: Sequence[float], *, count: int = 4000, seed: int = 6
) -> Array:  # fmt: skip
    """Share of wrong verdicts of a ``swept_spheres_time`` that computes with 32 bits.

    The truth is that of the same numbers with 64 bits, by the library.
    """
    shares = []
    for distance in distances:
        shots = far_shots(distance, count, seed=seed)
        x, r, v, y, s, w, horizon = (np.asarray(value, dtype=float) for value in shots)
        truth = time_of_impact(Sphere(x, r), Sphere(y, s), v, w, horizon=horizon)
        said = np.isfinite(np.asarray(function(*shots), dtype=float))
        shares.append(np.mean(said != np.isfinite(truth)))
    return np.array(shares)


def rounding_of_the_root_says(
    distances: Sequence[float], *, count: int = 4000, seed: int = 7
) -> Array:
    """The share that rounding alone predicts, from what is under the root.

    b^2 - a c = |v|^2 (r^2 - h^2) is a difference of two numbers of about |v|^2 |m|^2.
    Each is rounded in about four steps: together they scatter by 1.5 u |v|^2 |m|^2.
    """
    rng = np.random.default_rng(seed)
    h = rng.uniform(0.0, 4 * RADIUS, count)
    inside = (2 * RADIUS) ** 2 - h**2
    noise = 1.5 * SINGLE * rng.normal(size=count)
    far = np.asarray(distances, dtype=float)[:, None]
    return np.mean((inside + noise * far**2 >= 0) != (inside >= 0), axis=-1)


def distance_of_the_root() -> float:
    """From how far on rounding is as large as what counts, |m| = r/2^-11.5 [m].

    An error of 2^-23 |v|^2 |m|^2 equals |v|^2 r^2, r the sum of both radii.
    """
    return float(2 * RADIUS / np.sqrt(2 * SINGLE))


def impact_by_nearest(
    center_a: Any, radius_a: Any, velocity_a: Any, center_b: Any, radius_b: Any, velocity_b: Any, horizon: Any
) -> Any:  # fmt: skip
    """The same question by the nearest approach, h = |m x v|/|v|, in the numbers that are given.

    b^2 - a c = |v|^2 (r - h)(r + h): no difference of large numbers.
    """
    m, v, r = center_a - center_b, velocity_a - velocity_b, radius_a + radius_b
    speed, b = np.linalg.norm(v, axis=-1), np.sum(m * v, axis=-1)
    h = np.linalg.norm(np.cross(m, v), axis=-1) / speed
    root = speed * np.sqrt(np.maximum((r - h) * (r + h), 0))
    c = np.sum(m * m, axis=-1) - r**2
    meets = (b < 0) & (h <= r)
    time = np.where(
        c < 0, 0, np.where(meets, c / np.where(meets, -b + root, 1), np.inf)
    )
    return np.where(time <= horizon, time, np.inf)


# Balls that are stopped at the time of impact, and thrown back.


def stopped_shots(
    function: Callable[..., Any], short: float, *, count: int = 4000, seed: int = 8
) -> Arguments:
    """Balls A where a ``swept_spheres_time`` stopped them, on their way back.

    A comes from about 5 m away, anywhere within 10 m of the origin, at 1 to 9 m/s, and
    is put at x + v t; then its velocity is turned round.

    Args:
        short: how much larger A is taken to be for the stop [m].
    """
    rng = np.random.default_rng(seed)
    way, aside = rng.normal(size=(2, count, 3))
    way /= np.linalg.norm(way, axis=-1, keepdims=True)
    aside = np.cross(way, aside)
    aside /= np.linalg.norm(aside, axis=-1, keepdims=True)
    r, s = rng.uniform(0.1, 0.5, (2, count))
    y = rng.uniform(-10.0, 10.0, (count, 3)) / np.sqrt(3)
    x = y - 5 * way + rng.uniform(0.0, 0.7, (count, 1)) * (r + s)[:, None] * aside
    v = rng.uniform(1.0, 9.0, (count, 1)) * way
    still = np.zeros((count, 3))
    time = np.asarray(function(x, r + short, v, y, s, still, 10.0))
    return x + time[:, None] * v, r, -v, y, s, still, 10.0


def held_share(
    function: Callable[..., Any], shorts: Sequence[float], *, only_approaching: bool = False
) -> Array:  # fmt: skip
    """Share of the balls on their way back that are said to meet at once, for each way of stopping short.

    Args:
        only_approaching: whether those that part are not asked about.
    """
    shares = []
    for short in shorts:
        back = stopped_shots(function, short)
        x, _, v, y, _, w, _ = back
        held = np.asarray(function(*back)) == 0
        if only_approaching:
            held = held & (np.sum((x - y) * (v - w), axis=-1) < 0)
        shares.append(np.mean(held))
    return np.array(shares)


def typical_depth() -> float:
    """How deep a stopped ball overlaps, by one standard deviation, with radii of 0.6 m together [m].

    1.5 u |m|^2/(2 r), with |m| = 5 m: see ``depth_says``.
    """
    return 1.5 * DOUBLE * 5.0**2 / (2 * 0.6)


def depth_says(shorts: Sequence[float], *, count: int = 4000, seed: int = 9) -> Array:
    """The share that rounding predicts: how far from touching a stop ends.

    What is under the root scatters by 1.5 u |v|^2 |m|^2, as above. The root of it,
    |v| sqrt(r^2 - h^2), moves the stop along the line, and the gap changes by the
    cosine sqrt(r^2 - h^2)/r of that: by 1.5 u |m|^2/(2 r), with |m| = 5 m.
    """
    rng = np.random.default_rng(seed)
    reach = rng.uniform(0.1, 0.5, (2, count)).sum(axis=0)
    error = 1.5 * DOUBLE * 5.0**2 / (2 * reach) * rng.normal(size=count)
    return np.array([np.mean(short + error < 0) for short in shorts])
