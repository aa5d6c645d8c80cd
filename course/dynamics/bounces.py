"""A body against a fixed wall, and the ball that keeps bouncing."""

from __future__ import annotations

import numpy as np

from course import formulas
from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    in_range,
    non_negative,
    positive,
    unit_vectors,
    vectors,
    whole_number,
)


def wall_bounce(
    velocity: ArrayLike, normal: ArrayLike, restitution: ArrayLike
) -> Array:
    """Velocity after hitting a fixed wall.

    v' = v - (1 + e) (v.n) n while v.n < 0, else v. At e = 1 this is the
    slide's v - 2 (v.n) n (syllabus row 18). What that needs is 1/m2 = 0,
    v2 = 0 and e = 1; "coefficient = 1 for body 2" does not say so
    (misprint 4). The mass of the body drops out.

    Args:
        velocity: v, (..., 3) [m/s].
        normal: n, unit, out of the wall toward the body, (..., 3).
        restitution: e, from 0 to 1, (...).
    Returns:
        v', (..., 3) [m/s].
    Raises:
        ValueError: a wrong shape, restitution outside 0..1, a normal that is not of
            unit length.
    Example:
        >>> wall_bounce([1.0, 0.0, -2.0], [0.0, 0.0, 1.0], 0.5)
        array([1., 0., 1.])
    """
    v, n = vectors("velocity", velocity), unit_vectors("normal", normal)
    e = in_range("restitution", restitution, 0, 1)
    broadcast(velocity=(v, 1), normal=(n, 1), restitution=(e, 0))
    return formulas.wall_bounce(v, n, e)


def bounce_times(
    height: ArrayLike, restitution: ArrayLike, count: int, gravity: ArrayLike = 9.81
) -> Array:
    """Times of the first impacts of a ball dropped onto the ground.

    t_k = sqrt(2 h/g) (1 + 2 (e + e^2 + ... + e^k)), k = 0, 1, ..., count - 1:
    each flight between impacts lasts e times the one before (from the wall
    law of syllabus row 18). At e = 0 all of them are the first.

    Args:
        height: h, how far the ball falls before it touches, (...) [m].
        restitution: e, from 0 to 1, (...).
        count: how many impacts, at least 1.
        gravity: g, (...) [m/s^2].
    Returns:
        Times from the drop, (..., count) [s].
    Raises:
        ValueError: a negative height, restitution outside 0..1, gravity <= 0, count <
            1.
    Example:
        >>> bounce_times(1.0, 0.5, 3).round(4)
        array([0.4515, 0.903 , 1.1288])
    """
    count = whole_number("count", count, minimum=1)
    h, e, g = _drop(height, restitution, gravity)
    return formulas.bounce_times(h, e, count, g)


def bounce_rest_time(
    height: ArrayLike, restitution: ArrayLike, gravity: ArrayLike = 9.81
) -> Array:
    """When a dropped ball comes to rest, after infinitely many impacts if 0 < e < 1.

    sqrt(2 h/g) (1 + e)/(1 - e), the limit of ``bounce_times``; infinity at
    e = 1 unless the height is 0.

    Args:
        height, restitution, gravity: as in ``bounce_times``.
    Returns:
        Time from the drop, (...) [s].
    Example:
        >>> round(float(bounce_rest_time(1.0, 0.5)), 6)
        1.354571
    """
    h, e, g = _drop(height, restitution, gravity)
    return _limit(np.sqrt(2 * h / g), 1 + e, 1 - e)


def bounce_path_length(height: ArrayLike, restitution: ArrayLike) -> Array:
    """How far a dropped ball travels, up and down, until it rests.

    h (1 + e^2)/(1 - e^2): the k-th rise is e^(2k) h; infinity at e = 1 unless
    the height is 0.

    Args:
        height, restitution: as in ``bounce_times``.
    Returns:
        Length, (...) [m].
    """
    h, e = non_negative("height", height), in_range("restitution", restitution, 0, 1)
    broadcast(height=(h, 0), restitution=(e, 0))
    return _limit(h, 1 + e**2, (1 - e) * (1 + e))


def _drop(
    height: ArrayLike, restitution: ArrayLike, gravity: ArrayLike
) -> tuple[Array, Array, Array]:
    """All three, broadcast to the whole batch."""
    h, e = non_negative("height", height), in_range("restitution", restitution, 0, 1)
    g = positive("gravity", gravity)
    batch = broadcast(height=(h, 0), restitution=(e, 0), gravity=(g, 0))
    h, e, g = (np.broadcast_to(x, batch) for x in (h, e, g))
    return h, e, g


def _limit(first: Array, numerator: Array, denominator: Array) -> Array:
    """first * numerator / denominator, where 0 stays 0 even at infinitely many
    repetitions.
    """
    top = np.broadcast_to(
        first * numerator,
        np.broadcast_shapes(first.shape, numerator.shape, denominator.shape),
    )
    result = np.where(top > 0, np.inf, 0.0)
    return np.divide(top, denominator, out=result, where=denominator > 0)[()]
