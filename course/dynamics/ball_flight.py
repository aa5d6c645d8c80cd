"""A dropped ball in closed form, and from impact to impact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    in_range,
    non_negative,
    positive,
    scalar,
    whole_number,
)

#: Of free fall [m/s^2].
GRAVITY = 9.81


@dataclass(frozen=True, eq=False)
class BallMotion:
    """Height above the ground [m] and velocity, up positive [m/s], at each time [s]; all (t,) or (..., t)."""

    time: Array
    height: Array
    velocity: Array


@dataclass(frozen=True, eq=False)
class BallEvents:
    """A ball from impact to impact.

    Args:
        time: of each impact, (c,) [s].
        speed: upward, after each impact, (c,) [m/s].
        rest: when it was put to rest [s], infinity if it never was.
        finished: False if max_events came before the end of the motion.
        start: height [m] and gravity [m/s^2] at the drop.
    """

    time: Array
    speed: Array
    rest: float
    finished: bool
    start: tuple[float, float]

    def motion(self, time: ArrayLike) -> BallMotion:
        """Height and velocity at any times up to the last event (NaN after it if not finished)."""
        t = non_negative("time", time)
        height, gravity = self.start
        flight = np.searchsorted(self.time, t, side="right")
        began = np.concatenate([[0.0], self.time])[flight]
        from_height = np.concatenate([[height], np.zeros(self.time.size)])[flight]
        speed = np.concatenate([[0.0], self.speed])[flight]
        since = t - began
        z, v = (
            from_height + since * (speed - 0.5 * gravity * since),
            speed - gravity * since,
        )
        known = self.finished | (flight < self.time.size)
        z = np.where(t >= self.rest, 0.0, np.where(known, z, np.nan))
        return BallMotion(
            t, z, np.where(t >= self.rest, 0.0, np.where(known, v, np.nan))
        )


def ball_motion(
    time: ArrayLike,
    height: ArrayLike,
    restitution: ArrayLike,
    gravity: ArrayLike = GRAVITY,
) -> BallMotion:
    """The dropped ball in closed form.

    The k-th flight starts at t_k (``bounce_times``) with
    speed e^(k+1) sqrt(2 g h); with q = t/t_0 - 1 it is flight
    k = floor(log_e(1 - q (1 - e)/(2 e))) for e < 1, floor(q/2) at e = 1.

    Args:
        time: t from the drop, (...) [s].
        height: h that it falls before it touches, (...) [m].
        restitution: e, from 0 to 1, (...).
        gravity: g, (...) [m/s^2].
    Returns:
        Height and velocity, the shapes broadcast; at rest once all bounces are over.
    """
    t, h = non_negative("time", time), positive("height", height)
    e, g = in_range("restitution", restitution, 0, 1), positive("gravity", gravity)
    broadcast(time=(t, 0), height=(h, 0), restitution=(e, 0), gravity=(g, 0))
    t, h, e, g = np.broadcast_arrays(t, h, e, g)
    fall = np.sqrt(2 * h / g)
    q = t / fall - 1
    loses = (e > 0) & (e < 1)
    base = np.where(loses, e, 0.5)  # any base does where it is not used

    def began(k: Array) -> Array:
        return np.where(loses, 2 * base * (1 - base**k) / (1 - base), 2 * k)

    left = np.where(loses, 1 - q * (1 - base) / (2 * base), 1.0)
    flying = (q >= 0) & (left > 0) & (e > 0)
    k = np.floor(
        np.where(
            loses,
            np.log(np.where(flying, left, 1.0)) / np.log(base),
            np.maximum(q, 0) / 2,
        )
    )
    k = (
        k - (q < began(k)) + (q >= began(k + 1))
    )  # where rounding put it on the wrong side of an impact
    since, speed = (q - began(k)) * fall, np.where(flying, e ** (k + 1), 0.0) * g * fall
    z = np.where(
        q < 0, h - 0.5 * g * t**2, np.maximum(since * (speed - 0.5 * g * since), 0.0)
    )
    v = np.where(q < 0, -g * t, speed - g * since)
    moving = (q < 0) | flying
    return BallMotion(t, np.where(moving, z, 0.0)[()], np.where(moving, v, 0.0)[()])


def ball_events(
    height: float,
    restitution: float,
    duration: float,
    *,
    gravity: float = GRAVITY,
    rest_speed: float = 0.0,
    max_events: int = 10_000,
) -> BallEvents:
    """The dropped ball, from impact to impact: each impact is located, then v' = -e v.

    For e < 1 the impacts crowd together before a finite time
    (``bounce_rest_time``). With rest_speed = 0 only rounding
    ends them: for e <= 1/2 the speed is 0 in the end (after 1077 impacts at
    e = 1/2 from 1 m), above that it never is and max_events are used up. A ball
    that leaves the ground slower than rest_speed is put to rest.

    Args:
        height: that it falls before it touches [m].
        restitution: e, from 0 to 1.
        duration: [s].
        rest_speed: [m/s]; above g times the time that matters is a fair choice.
        max_events: impacts after which it gives up.
    """
    h, g = (
        float(positive("height", scalar("height", height))),
        float(positive("gravity", gravity)),
    )
    e = float(in_range("restitution", scalar("restitution", restitution), 0, 1))
    end = float(non_negative("duration", scalar("duration", duration)))
    slow = float(non_negative("rest_speed", scalar("rest_speed", rest_speed)))
    whole_number("max_events", max_events, minimum=1)
    times: list[float] = []
    speeds: list[float] = []
    time, speed = np.sqrt(2 * h / g), e * np.sqrt(2 * g * h)
    while time <= end and len(times) < max_events:
        times.append(float(time))
        if speed <= slow:
            speeds.append(0.0)
            return BallEvents(
                np.array(times), np.array(speeds), float(time), True, (h, g)
            )
        speeds.append(float(speed))
        time, speed = time + 2 * speed / g, e * speed
    return BallEvents(
        np.array(times), np.array(speeds), np.inf, bool(time > end), (h, g)
    )
