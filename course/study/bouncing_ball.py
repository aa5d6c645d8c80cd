"""A bouncing ball by two fixed-step loops, their energy errors, and published figures.

The loops and the measure of their error are those of the
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
    choice,
    failure,
    in_range,
    non_negative,
    positive,
    scalar,
    scalars,
)
from course.dynamics import BallMotion, ball_events
from course.scenes import GRAVITY

ORDERS = ("ode", "bullet")

# SimBenchmark's scene.
BALLS, MASS, RADIUS, DROP, DURATION = 49, 10.0, 0.1, 5.0, 20.0


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
        [
            0.0185024,
            0.296044,
            1.85055,
            29.631,
            185.027,
            2982.68,
            18808.3,
            313419.0,
            2.03326e6,
        ]
    ),
    bullet_error=np.array(
        [
            7.52322,
            120.372,
            752.345,
            12038.5,
            75245.4,
            1.20178e6,
            7.40664e6,
            1.19223e8,
            7.67704e8,
        ]
    ),
    dart_error=np.array(
        [
            7.38571,
            30.5831,
            483.166,
            10870.7,
            72274.4,
            1.18966e6,
            7.37588e6,
            1.19086e8,
            7.67291e8,
        ]
    ),
    raisim_error=np.array(
        [
            0.101869,
            1.00818,
            0.918387,
            31.3531,
            415.806,
            1606.01,
            548.46,
            12691.3,
            607745.0,
        ]
    ),
    ode_seconds=np.array([187, 46.6, 19.4, 4.54, 1.88, 0.471, 0.184, 0.0496, 0.0182]),
    bullet_seconds=np.array(
        [81.3, 20.4, 8.40, 2.09, 0.862, 0.228, 0.0991, 0.0306, 0.0146]
    ),
    source=(
        "github.com/leggedrobotics/SimBenchmark, data/bouncing/sample.csv; its authors develop RaiSim,"
        " whose figures here are with its error reduction on"
    ),
)


def engine_ball_step(
    position: ArrayLike,
    velocity: ArrayLike,
    step: float,
    *,
    order: str = "ode",
    restitution: float = 1.0,
    radius: float = RADIUS,
    gravity: float = GRAVITY,
) -> tuple[Array, Array]:
    """One fixed step of a bouncing ball as engines take it; what is checked first makes the difference.

    ``course.formulas.bouncing_ball_step``, for the lowest point, is the "ode" order.

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
    order: str,
    step: float,
    *,
    height: float = DROP,
    radius: float = RADIUS,
    duration: float = DURATION,
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
    h, end = (
        float(positive("step", scalar("step", step))),
        float(positive("duration", duration)),
    )
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
        heights = np.asarray(
            z + k * (step * v) - drop * (0.5 * k * (k + 1)), dtype=np.float64
        )
        velocities = np.asarray(v - k * (GRAVITY * step), dtype=np.float64)
        deciding = velocities if order == "ode" else velocities - GRAVITY * step
        low = np.flatnonzero((heights < RADIUS) & (deciding < 0))
        end = int(low[0]) + 1 if low.size else min(k_max, count - done)
        end = min(end, count - done)
        flights.append(
            BallMotion(_times(step, end) + step * done, heights[:end], velocities[:end])
        )
        done += end
        if low.size:
            v = after_bounce(float(velocities[end - 1]))
            z = float(heights[end - 1]) + step * v
        else:
            z, v = float(heights[end]), float(velocities[end])
    return flights
