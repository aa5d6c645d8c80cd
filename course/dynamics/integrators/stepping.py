"""Many steps of one size."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from course.arrays import whole_number
from course.dynamics.bodies import Bodies
from course.dynamics.integrators.motion import Wrench, step_and_time
from course.dynamics.integrators.splitting_method import free_flight, splitting


def advance(
    bodies: Bodies,
    wrench: Wrench | None,
    step: float,
    count: int,
    *,
    method: Callable[..., Bodies] = splitting,
    time: float = 0.0,
    **options: Any,
) -> Bodies:
    """The bodies after ``count`` steps: step k starts at time + k step.

    ``splitting`` without a wrench goes through all steps of some thousand
    bodies before it turns to the next, which is faster and differs by
    rounding only.

    Args:
        bodies, wrench, step, time: as in ``explicit_euler``.
        count: how many steps, 0 or more.
        method: a step in time.
        options: handed on to every step.
    Raises:
        ValueError: as the method, and a count that is not a whole number of at least 0.
    """
    h, start = step_and_time(step, time)
    steps = whole_number("count", count)
    if (
        method is splitting
        and wrench is None
        and set(options) <= {"order", "velocity_dependent"}
    ):
        return free_flight(bodies, h, steps, order=options.get("order", 2))
    for k in range(steps):
        bodies = method(bodies, wrench, h, time=start + k * h, **options)
    return bodies
