"""A dropped ball four ways: closed form, event by event, and two fixed-step loops.

The fixed-step loops and the measure of their error are those of the
"bouncing" test of SimBenchmark (github.com/leggedrobotics/SimBenchmark):
49 balls of 10 kg and radius 0.1 m, dropped from 5 m at e = 1, for 20 s.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    choice,
    failure,
    in_range,
    non_negative,
    positive,
    scalar,
    scalars,
    whole_number,
)

ORDERS = ("ode", "bullet")

# SimBenchmark's scene.
BALLS, MASS, RADIUS, DROP, GRAVITY, DURATION = 49, 10.0, 0.1, 5.0, 9.81, 20.0


@dataclass(frozen=True, eq=False)
class PublishedBouncing:
    """Figures that others measured: step [s], mean squared energy error [J^2], seconds on their machine."""

    step: Array
    ode_error: Array
    bullet_error: Array
    dart_error: Array
    raisim_error: Array
    ode_seconds: Array
    bullet_seconds: Array
    source: str


PUBLISHED_BOUNCING = PublishedBouncing(
    step=np.array([1e-5, 4e-5, 1e-4, 4e-4, 1e-3, 4e-3, 1e-2, 4e-2, 1e-1]),
    ode_error=np.array(
        [0.0185024, 0.296044, 1.85055, 29.631, 185.027, 2982.68, 18808.3, 313419.0, 2.03326e6]
    ),
    bullet_error=np.array(
        [7.52322, 120.372, 752.345, 12038.5, 75245.4, 1.20178e6, 7.40664e6, 1.19223e8, 7.67704e8]
    ),
    dart_error=np.array(
        [7.38571, 30.5831, 483.166, 10870.7, 72274.4, 1.18966e6, 7.37588e6, 1.19086e8, 7.67291e8]
    ),
    raisim_error=np.array(
        [0.101869, 1.00818, 0.918387, 31.3531, 415.806, 1606.01, 548.46, 12691.3, 607745.0]
    ),
    ode_seconds=np.array([187, 46.6, 19.4, 4.54, 1.88, 0.471, 0.184, 0.0496, 0.0182]),
    bullet_seconds=np.array([81.3, 20.4, 8.40, 2.09, 0.862, 0.228, 0.0991, 0.0306, 0.0146]),
    source=(
        "github.com/leggedrobotics/SimBenchmark, data/bouncing/sample.csv; its authors develop RaiSim,"
        " whose figures here are with its error reduction on"
    ),
)


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
        z, v = from_height + since * (speed - 0.5 * gravity * since), speed - gravity * since
        known = self.finished | (flight < self.time.size)
        z = np.where(t >= self.rest, 0.0, np.where(known, z, np.nan))
        return BallMotion(t, z, np.where(t >= self.rest, 0.0, np.where(known, v, np.nan)))


def ball_motion(
    time: ArrayLike, height: ArrayLike, restitution: ArrayLike, gravity: ArrayLike = GRAVITY
) -> BallMotion:
    """The dropped ball in closed form.

    The k-th flight starts at t_k (``course.dynamics.bounce_times``) with
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
    k = np.floor(np.where(loses, np.log(np.where(flying, left, 1.0)) / np.log(base), np.maximum(q, 0) / 2))
    k = k - (q < began(k)) + (q >= began(k + 1))  # where rounding put it on the wrong side of an impact
    since, speed = (q - began(k)) * fall, np.where(flying, e ** (k + 1), 0.0) * g * fall
    z = np.where(q < 0, h - 0.5 * g * t**2, np.maximum(since * (speed - 0.5 * g * since), 0.0))
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
    (``course.dynamics.bounce_rest_time``). With rest_speed = 0 they use up
    max_events and never get past it; a ball that leaves the ground slower
    than rest_speed is put to rest.

    Args:
        height: that it falls before it touches [m].
        restitution: e, from 0 to 1.
        duration: [s].
        rest_speed: [m/s]; above g times the time that matters is a fair choice.
        max_events: impacts after which it gives up.
    """
    h, g = float(positive("height", scalar("height", height))), float(positive("gravity", gravity))
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
            return BallEvents(np.array(times), np.array(speeds), float(time), True, (h, g))
        speeds.append(float(speed))
        time, speed = time + 2 * speed / g, e * speed
    return BallEvents(np.array(times), np.array(speeds), np.inf, bool(time > end), (h, g))


def bouncing_ball_step(
    position: ArrayLike,
    velocity: ArrayLike,
    step: float,
    *,
    order: str = "ode",
    restitution: float = 1.0,
    radius: float = RADIUS,
    gravity: float = GRAVITY,
) -> tuple[Array, Array]:
    """One fixed step of a ball above the ground z = 0; what is checked first makes the difference.

    "ode": if z < r and v < 0: v = -e v, else v = v - g h. "bullet":
    v = v - g h, then if z < r and v < 0: v = -e v. Then z = z + h v in both.
    In the second the reflected velocity has the pull of a step in it that
    the ball never felt, and each bounce gains energy (named after the two
    engines whose published errors they reproduce).

    Args:
        position: height z of the centre, (...) [m].
        velocity: v, up positive, (...) [m/s].
        step: h [s].
    Returns:
        z and v after the step, (...).
    """
    z, v = scalars("position", position), scalars("velocity", velocity)
    h, g = positive("step", step), positive("gravity", gravity)
    e, r = in_range("restitution", restitution, 0, 1), non_negative("radius", radius)
    pulled = v - g * h
    if choice("order", order, ORDERS) == "ode":
        v = np.where((z < r) & (v < 0), -e * v, pulled)
    else:
        v = np.where((z < r) & (pulled < 0), -e * pulled, pulled)
    return (z + h * v)[()], v[()]


def bouncing_loop(
    order: str, step: float, *, height: float = DROP, radius: float = RADIUS, duration: float = DURATION
) -> BallMotion:
    """Every step of a fixed-step loop at e = 1, written to be read; ``energy_error`` is the fast one.

    Returns:
        Time, height of the centre and velocity at the start of each step, (duration/step,).
    """
    count = _samples(step, duration)
    bullet = choice("order", order, ORDERS) == "bullet"
    z, v = float(height), 0.0
    heights, velocities = np.empty(count), np.empty(count)
    for k in range(count):
        heights[k], velocities[k] = z, v
        if bullet:
            v -= GRAVITY * step
            if z < radius and v < 0:
                v = -v
        elif z < radius and v < 0:
            v = -v
        else:
            v -= GRAVITY * step
        z += step * v
    return BallMotion(_times(step, count), heights, velocities)


def energy_error(order: str, step: float, *, duration: float = DURATION) -> float:
    """SimBenchmark's error of a fixed-step loop: the mean of (E - E0)^2 over the starts of its steps [J^2].

    E is the energy of all 49 balls, E0 = 49 m g H. Between two bounces v is
    linear and z quadratic in the number of steps, so each flight is one
    array operation: the same loop as ``bouncing_loop`` up to rounding.
    """
    squares, count = 0.0, _samples(step, duration)
    for motion in _flights(choice("order", order, ORDERS), float(step), count):
        squares += float(np.sum(_energy_change(motion) ** 2))
    return squares / count


def event_driven_error(step: float, *, duration: float = DURATION) -> tuple[float, int]:
    """The same error at the same times of the ball that goes from impact to impact, and its events."""
    count = _samples(step, duration)
    events = ball_events(DROP - RADIUS, 1.0, duration)
    motion = events.motion(_times(step, count))
    centre = BallMotion(motion.time, motion.height + RADIUS, motion.velocity)
    return float(np.mean(_energy_change(centre) ** 2)), events.time.size


@dataclass(frozen=True, eq=False)
class BouncingErrors:
    """Energy error against cost: steps taken by the loops, impacts located by the other."""

    step: Array
    steps: Array
    ode: Array
    bullet: Array
    event_driven: Array
    events: int


def bouncing_errors(step: ArrayLike = tuple(PUBLISHED_BOUNCING.step)) -> BouncingErrors:
    """``energy_error`` of both orders and ``event_driven_error``, for each step size, (s,)."""
    sizes = np.atleast_1d(positive("step", step))
    events = [event_driven_error(float(h)) for h in sizes]
    return BouncingErrors(
        step=sizes,
        steps=np.array([_samples(float(h), DURATION) for h in sizes]),
        ode=np.array([energy_error("ode", float(h)) for h in sizes]),
        bullet=np.array([energy_error("bullet", float(h)) for h in sizes]),
        event_driven=np.array([error for error, _ in events]),
        events=events[0][1],
    )


def _samples(step: float, duration: float) -> int:
    h, end = float(positive("step", scalar("step", step))), float(positive("duration", duration))
    # Cut off, not rounded, as SimBenchmark does: 20/4e-5 is 499999.99999999994 in
    # float64, and only 499999 samples give its last digit there.
    count = int(end / h)
    if count < 1:
        raise failure("step", f"at most the duration, {end:g}", f"{h:g}")
    return count


def _times(step: float, count: int) -> Array:
    return np.asarray(step * np.arange(count), dtype=np.float64)


def _energy_change(motion: BallMotion) -> Array:
    """E - E0 of all balls, from the height of the centre and the velocity."""
    return BALLS * MASS * (GRAVITY * (motion.height - DROP) + 0.5 * motion.velocity**2)


def _flights(order: str, step: float, count: int) -> list[BallMotion]:
    """The loop cut into flights: states at the start of each step, from one bounce to the next."""
    after_bounce: Callable[[float], float] = (
        (lambda v: -v) if order == "ode" else (lambda v: -(v - GRAVITY * step))
    )
    z, v, done, flights = DROP, 0.0, 0, []
    drop: float = GRAVITY * step * step
    while done < count:
        # z after k steps is z + h k v - h^2 g k (k + 1)/2: room to reach the ground, and one more.
        slope = step * v - 0.5 * drop
        k_max = int((slope + np.sqrt(slope**2 + 2 * drop * max(z, 0.0))) / drop) + 2
        k = np.arange(min(k_max, count - done) + 1)
        heights: Array = z + k * (step * v) - drop * (0.5 * k * (k + 1))
        velocities: Array = v - k * (GRAVITY * step)
        deciding = velocities if order == "ode" else velocities - GRAVITY * step
        low = np.flatnonzero((heights < RADIUS) & (deciding < 0))
        end = int(low[0]) + 1 if low.size else min(k_max, count - done)
        end = min(end, count - done)
        flights.append(BallMotion(_times(step, end) + step * done, heights[:end], velocities[:end]))
        done += end
        if low.size:
            v = after_bounce(float(velocities[end - 1]))
            z = float(heights[end - 1]) + step * v
        else:
            z, v = float(heights[end]), float(velocities[end])
    return flights
