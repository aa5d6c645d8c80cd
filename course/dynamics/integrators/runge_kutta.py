"""Explicit steps: Euler, symplectic Euler, midpoint and classical Runge-Kutta.

Orientations are not vectors: adding to a quaternion leaves the rotation group. So each
step writes R(t) = exp([theta(t)]) R0 and integrates the rotation vector theta, whose
rate is omega only to first order:

theta' = omega - theta x omega / 2 + theta x (theta x omega) / 12 + ...

(H. Munthe-Kaas, "Runge-Kutta methods on Lie groups", BIT 38, 1998; Hairer, Lubich and
Wanner, *Geometric Numerical Integration*, section IV.8, where two correcting terms are
shown to suffice for order 4). Every stage is a rotation, so the wrench only sees unit
quaternions. The alternative, a quaternion in R^4 normalized after the step, has order 4
too, but its stages are not rotations.
"""

from __future__ import annotations

from collections.abc import Sequence

from course.arrays import Array
from course.dynamics.bodies import Bodies
from course.dynamics.integrators.components import cross
from course.dynamics.integrators.motion import Motion, Wrench, step_and_time


def explicit_euler(
    bodies: Bodies, wrench: Wrench | None, step: float, *, time: float = 0.0
) -> Bodies:
    """One step of explicit Euler: everything from the rates at the start, order 1.

    x' = x + h v, p' = p + h F, L' = L + h tau, q' = exp(h omega / 2) q
    (syllabus row 14; lesson 09). On an oscillator its energy grows by the
    factor 1 + (h w)^2 a step, whatever the step.

    Args:
        bodies: n bodies; fixed ones stay as they are.
        wrench: ``wrench(bodies, time) -> (force, torque)``, each (n, 3), world axes
            [N], [N m]; what it says of fixed bodies is not read. None: nothing acts.
        step: h [s]; below 0 goes back in time.
        time: at the start of the step [s].
    Returns:
        The bodies at time + step.
    Raises:
        ValueError: a step or time that is not a finite number, a wrench of
            another shape or with NaN or infinity.
    """
    return _runge_kutta(bodies, wrench, step, time, (), (1.0,))


def symplectic_euler(
    bodies: Bodies, wrench: Wrench | None, step: float, *, time: float = 0.0
) -> Bodies:
    """One step of symplectic Euler: momenta first, then positions with the new momenta,
    order 1.

    p' = p + h F, L' = L + h tau, x' = x + h v', q' = exp(h omega' / 2) q with
    omega' = I^-1 L' at the old orientation. Stable on an oscillator to
    h w < 2 (damped by the ratio z: h w < 2 (sqrt(1 + z^2) - z)), its energy
    off by a bounded part. Of a turning body it keeps L, but not the energy:
    omega' belongs to the orientation before the turn.

    Arguments, result and errors as in ``explicit_euler``.
    """
    h, t = step_and_time(step, time)
    start = Motion.of(bodies)
    force, torque = start.wrench(wrench, t)
    kicked = start.moved(
        momentum=start.momentum + h * force,
        angular_momentum=start.angular_momentum + h * torque,
    )
    return kicked.moved(
        position=start.position + h * kicked.velocity,
        orientation=kicked.turned(h * kicked.angular_velocity),
    ).to_bodies()


def midpoint(
    bodies: Bodies, wrench: Wrench | None, step: float, *, time: float = 0.0
) -> Bodies:
    """One step of the explicit midpoint method: the rates half a step on, order 2.

    On an oscillator its energy grows by the factor 1 + (h w)^4 / 4 a step
    (Hairer, Norsett and Wanner, *Solving Ordinary Differential Equations I*,
    section II.1 for the method).

    Arguments, result and errors as in ``explicit_euler``.
    """
    return _runge_kutta(bodies, wrench, step, time, (0.5,), (0.0, 1.0))


def rk4(
    bodies: Bodies, wrench: Wrench | None, step: float, *, time: float = 0.0
) -> Bodies:
    """One step of the classical Runge-Kutta method, order 4.

    On an oscillator its energy changes by the factor
    1 - (h w)^6/72 + (h w)^8/576 a step: it falls up to h w = 2 sqrt 2 and
    grows beyond (Hairer, Norsett and Wanner, *Solving Ordinary Differential
    Equations I*, section II.1 for the method).

    Arguments, result and errors as in ``explicit_euler``.
    """
    return _runge_kutta(
        bodies, wrench, step, time, (0.5, 0.5, 1.0), (1 / 6, 1 / 3, 1 / 3, 1 / 6)
    )


def _runge_kutta(
    bodies: Bodies,
    wrench: Wrench | None,
    step: float,
    time: float,
    nodes: Sequence[float],
    weights: Sequence[float],
) -> Bodies:
    """Stage i + 1 lies ``nodes[i]`` h along the rates of stage i.

    The step along their weighted mean.
    """
    h, t = step_and_time(step, time)
    start = Motion.of(bodies)
    slopes = [_slopes(start, start, None, wrench, t)]
    for node in nodes:
        reached, theta = _along(start, slopes[-1], node * h)
        slopes.append(_slopes(start, reached, theta, wrench, t + node * h))
    used = [(w, s) for w, s in zip(weights, slopes, strict=True) if w]
    mean = tuple(
        sum((w * s[i] for w, s in used[1:]), used[0][0] * used[0][1][i])
        for i in range(4)
    )
    return _along(start, mean, h)[0].to_bodies()


def _slopes(
    start: Motion, here: Motion, theta: Array | None, wrench: Wrench | None, time: float
) -> tuple[Array, ...]:
    """Rates of position, rotation vector and both momenta; theta is the rotation so
    far.
    """
    force, torque = here.wrench(wrench, time)
    rate = here.angular_velocity
    if theta is not None:
        turn = cross(theta, rate)
        rate = rate - 0.5 * turn + cross(theta, turn) / 12.0
    return here.velocity, rate, force, torque


def _along(
    start: Motion, slopes: tuple[Array, ...], span: float
) -> tuple[Motion, Array]:
    velocity, rate, force, torque = slopes
    theta = span * rate
    reached = start.moved(
        position=start.position + span * velocity,
        orientation=start.turned(theta),
        momentum=start.momentum + span * force,
        angular_momentum=start.angular_momentum + span * torque,
    )
    return reached, theta
