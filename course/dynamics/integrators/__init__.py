"""Steps in time with one signature, batched over bodies: (bodies, wrench, step, *,
time=0.0) -> Bodies.
"""

from course.dynamics.integrators.motion import Wrench, uniform_gravity
from course.dynamics.integrators.reference import dop853, reference_motion
from course.dynamics.integrators.runge_kutta import (
    explicit_euler,
    midpoint,
    rk4,
    symplectic_euler,
)
from course.dynamics.integrators.splitting_method import splitting
from course.dynamics.integrators.stepping import advance

__all__ = [
    "Wrench",
    "advance",
    "dop853",
    "explicit_euler",
    "midpoint",
    "reference_motion",
    "rk4",
    "splitting",
    "symplectic_euler",
    "uniform_gravity",
]
