"""A dropped ball as a function of somebody's own has it: by its steps, or by its times of impact."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.dynamics import ball_events
from course.scenes import GRAVITY
from course.study.asking import RUN_AWAY, asked


@dataclass(frozen=True, eq=False)
class SteppedBall:
    """The lowest point of a ball that is dropped.

    Args:
        times, height, velocity: (t,) [s], [m], upward [m/s].
    """

    times: Array
    height: Array
    velocity: Array

    @property
    def energy(self) -> Array:
        """Of 1 kg, kinetic and potential, (t,) [J]."""
        return GRAVITY * self.height + 0.5 * self.velocity**2


def stepped_ball(
    height: float,
    restitution: float,
    step: float,
    duration: float,
    *,
    function: Callable[..., Any] = formulas.bouncing_ball_step,
) -> SteppedBall:
    """A ball by fixed steps of ``bouncing_ball_step``; one that has run away is left where it is.

    Args:
        height: of the drop [m].
        restitution: e.
        step, duration: [s].
        function: (height, velocity, step, restitution, gravity) -> height, velocity.
    Raises:
        UnusableResult: what it gives is no height and no velocity.
    """
    count = round(duration / step)
    state = np.empty((count + 1, 2))
    state[0] = height, 0.0
    for k in range(count):
        state[k + 1] = state[k]
        if np.abs(state[k]).max() < RUN_AWAY:
            x, v = (float(number) for number in state[k])
            state[k + 1] = asked(function, ((), ()), x, v, step, restitution, GRAVITY)
    times: Array = step * np.arange(count + 1, dtype=float)
    return SteppedBall(times, state[:, 0], state[:, 1])


def exact_ball(height: float, restitution: float, times: Array) -> SteppedBall:
    """The ball from impact to impact, at these times [s]."""
    events = ball_events(height, restitution, float(times[-1]), rest_speed=1e-3)
    motion = events.motion(times)
    return SteppedBall(times, motion.height, motion.velocity)


def flown_ball(
    height: float,
    restitution: float,
    count: int,
    times: Array,
    *,
    function: Callable[..., Any] = formulas.bounce_times,
) -> tuple[SteppedBall, Array]:
    """A ball that touches the floor at the times which ``bounce_times`` gives, and falls freely between.

    It falls from its height until the first of them, wherever it is then: above the floor
    where that time is too short, in it where it is too long. From one to the next it
    flies the parabola that begins and ends on the floor; after the last it lies.

    Args:
        height, restitution, count: of the drop [m], e, how many impacts.
        times: at which the ball is wanted, (t,) [s].
        function: (height, restitution, count, gravity) -> (count,) [s].
    Returns:
        The ball, and the times of impact (count,) [s].
    """
    given = height, restitution, count, GRAVITY
    (impacts,) = asked(function, ((count,),), *given)
    hit = np.sort(impacts)
    number = np.searchsorted(hit, times, side="right")
    last = hit[np.maximum(number - 1, 0)]
    after = hit[np.minimum(number, count - 1)]
    flying = 0.5 * GRAVITY * (times - last) * (after - times)
    speed = 0.5 * GRAVITY * (last + after - 2 * times)
    falls, lies = number == 0, number == count
    x = np.select([falls, lies], [height - 0.5 * GRAVITY * times**2, 0 * times], flying)
    v = np.select([falls, lies], [-GRAVITY * times, 0 * times], speed)
    return SteppedBall(times, x, v), impacts
