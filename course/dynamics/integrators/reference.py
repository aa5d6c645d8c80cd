"""SciPy's DOP853 as the reference where there is no closed form."""

from __future__ import annotations

from functools import partial

import numpy as np

from course.arrays import Array, ArrayLike, failure, scalar, scalars, written
from course.dynamics.bodies import Bodies
from course.dynamics.integrators.components import multiplied, normalized
from course.dynamics.integrators.motion import Motion, Wrench, step_and_time


def dop853(
    bodies: Bodies,
    wrench: Wrench | None,
    step: float,
    *,
    time: float = 0.0,
    relative_tolerance: float = 1e-13,
) -> Bodies:
    """The bodies one step later, by as many smaller steps as the tolerance requires.

    The method of order 8 of Dormand and Prince with the error control of Hairer,
    Norsett and Wanner (*Solving Ordinary Differential Equations I*, section II.5), from
    ``scipy.integrate``; quaternions are four numbers, normalized where they are read.

    Args:
        bodies, wrench, step, time: as in ``explicit_euler``.
        relative_tolerance: of the error in one smaller step, 1e-13 to below 1. The
            absolute tolerance is the same number of m, m/s, rad and rad/s.
    Raises:
        ValueError: as ``explicit_euler``, and a tolerance out of range.
        RuntimeError: SciPy gave up.
    """
    h, t = step_and_time(step, time)
    return reference_motion(
        bodies, wrench, [t + h], time=t, relative_tolerance=relative_tolerance
    )[0]


def reference_motion(
    bodies: Bodies,
    wrench: Wrench | None,
    times: ArrayLike,
    *,
    time: float = 0.0,
    relative_tolerance: float = 1e-13,
) -> list[Bodies]:
    """The bodies at each of these times, by ``dop853``.

    Args:
        times: (t,) [s], monotonic, in one direction from ``time``.
    """
    start = scalar("time", time)
    at = scalars("times", times)
    if at.ndim != 1 or not at.size:
        raise failure("times", "shape (t,) with at least one", f"shape {at.shape}")
    direction = np.diff(np.concatenate([[start], at]))
    if not (np.all(direction >= 0) or np.all(direction <= 0)):
        raise failure(
            "times",
            "times one after the other in one direction from time",
            written(at),
        )
    tolerance = scalar("relative_tolerance", relative_tolerance)
    if not 1e-13 <= tolerance < 1:
        raise failure(
            "relative_tolerance", "a number from 1e-13 to below 1", written(tolerance)
        )
    motion, reached, states = Motion.of(bodies), start, []
    for end in at:
        if end != reached and len(bodies):
            # A separate run to each time: between its own steps DOP853 interpolates,
            # only to order 7.
            motion = _run(motion, wrench, (reached, end), tolerance)
        reached = end
        states.append(motion.to_bodies())
    return states


def _run(
    motion: Motion, wrench: Wrench | None, span: tuple[float, float], tolerance: float
) -> Motion:
    """The motion at the end of a span of time."""
    from scipy.integrate import solve_ivp

    options = {"method": "DOP853", "rtol": tolerance, "atol": tolerance}
    rates = partial(_rates, motion, wrench)
    solution = solve_ivp(rates, span, _packed(motion), **options)
    if not solution.success:
        raise RuntimeError(f"dop853: {solution.message}")
    return _unpacked(motion, solution.y[:, -1].reshape(13, -1))


def _scales(motion: Motion) -> tuple[Array, Array]:
    """Mass and middle moment, which scale momenta to velocities: one tolerance fits all
    bodies.
    """
    mass = np.where(np.isfinite(motion.bodies.mass), motion.bodies.mass, 1.0)
    return mass, motion.frames.moments[1]


def _packed(motion: Motion) -> Array:
    mass, moment = _scales(motion)
    rows = (
        motion.position,
        motion.orientation,
        motion.momentum / mass,
        motion.angular_momentum / moment,
    )
    return np.concatenate(rows).ravel()


def _unpacked(motion: Motion, y: Array) -> Motion:
    mass, moment = _scales(motion)
    q = normalized(y[3:7])
    if motion.fixed is not None:
        q = np.where(motion.fixed, motion.orientation, q)
    return motion.moved(
        position=y[:3].copy(),
        orientation=q,
        momentum=y[7:10] * mass,
        angular_momentum=y[10:] * moment,
    )


def _rates(motion: Motion, wrench: Wrench | None, time: float, flat: Array) -> Array:
    y = flat.reshape(13, -1)
    here = _unpacked(motion, y)
    mass, moment = _scales(motion)
    force, torque = here.wrench(wrench, time)
    rates = np.zeros(y.shape)
    rates[:3] = here.velocity
    omega = np.concatenate([0.5 * here.angular_velocity, np.zeros((1, y.shape[1]))])
    rates[3:7] = multiplied(omega, y[3:7])
    rates[7:10] = force / mass
    rates[10:] = torque / moment
    return rates.ravel()
