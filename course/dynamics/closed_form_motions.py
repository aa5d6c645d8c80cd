"""Motions with a closed form, to test steps: parabola, pendulum, symmetric top."""

from __future__ import annotations

import numpy as np

from course import rotations
from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    failure,
    in_range,
    positive,
    scalars,
    vectors,
    written,
)
from course.dynamics.elliptic import jacobi_functions


def parabola(
    position: ArrayLike, velocity: ArrayLike, acceleration: ArrayLike, time: ArrayLike
) -> tuple[Array, Array]:
    """Motion under an even force: x + v t + a t^2/2 and v + a t.

    Args:
        position: x at time 0, (..., 3) [m].
        velocity: v at time 0, (..., 3) [m/s].
        acceleration: a, (..., 3) [m/s^2].
        time: t, (...) [s].
    Returns:
        Position and velocity at that time, (..., 3).
    """
    x, v = vectors("position", position), vectors("velocity", velocity)
    a, t = vectors("acceleration", acceleration), scalars("time", time)
    broadcast(position=(x, 1), velocity=(v, 1), acceleration=(a, 1), time=(t, 0))
    t = t[..., None]
    return x + v * t + 0.5 * a * t**2, v + a * t


def pendulum(
    amplitude: ArrayLike, frequency: ArrayLike, time: ArrayLike
) -> tuple[Array, Array]:
    """The pendulum theta_ddot = -w^2 sin theta, let go at rest at its amplitude.

    sin(theta/2) = k cn(w t)/dn(w t) with the modulus k = sin(amplitude/2), m = k^2
    (Landau and Lifshitz, *Mechanics*, section 11, problem 1, for the period 4 K/w).

    Args:
        amplitude: angle from the lowest point at time 0, 0 to pi, (...) [rad].
        frequency: w, of small swings, (...) [rad/s].
        time: (...) [s].
    Returns:
        The angle [rad] and its rate [rad/s], (...).
    Raises:
        ValueError: an amplitude outside 0..pi, a frequency that is not positive.
    """
    top, w = (
        in_range("amplitude", amplitude, 0, np.pi),
        positive("frequency", frequency),
    )
    t = scalars("time", time)
    broadcast(amplitude=(top, 0), frequency=(w, 0), time=(t, 0))
    k, k1 = np.sin(top / 2), np.cos(top / 2)
    sn, cn, dn = jacobi_functions(w * t, k1**2)
    return 2 * np.arctan2(k * cn, k1), -2 * w * k * k1 * sn / dn


def symmetric_top(
    moments: ArrayLike, angular_momentum: ArrayLike, time: ArrayLike
) -> tuple[Array, Array]:
    """The torque-free top with I1 = I2: the axis goes round L at |L|/I1, the body round
    the axis at l3 (1/I3 - 1/I1) (Landau and Lifshitz, *Mechanics*, sections 33 and 36).

    Args:
        moments: I1, I2, I3 with I1 = I2, (..., 3) [kg m^2].
        angular_momentum: l at time 0, in the principal axes, (..., 3) [kg m^2/s].
        time: t, (...) [s].
    Returns:
        l at that time, (..., 3), and the turn since time 0, (..., 4), as
        ``torque_free_rotation`` gives them.
    Raises:
        ValueError: I1 and I2 differ, a moment that is not positive.
    """
    moment = positive("moments", vectors("moments", moments))
    momentum = vectors("angular_momentum", angular_momentum)
    t = scalars("time", time)
    broadcast(moments=(moment, 1), angular_momentum=(momentum, 1), time=(t, 0))
    if not np.array_equal(moment[..., 0], moment[..., 1]):
        raise failure("moments", "the first two alike", written(moment.tolist()))
    about_L = rotations.from_rotation_vector(momentum * (t / moment[..., 0])[..., None])
    angle = momentum[..., 2] * (1 / moment[..., 2] - 1 / moment[..., 0]) * t
    about_axis = rotations.from_rotation_vector(
        angle[..., None] * np.array([0.0, 0.0, 1.0])
    )
    turn = rotations.from_matrix(
        rotations.to_matrix(about_L) @ rotations.to_matrix(about_axis)
    )
    return rotations.rotate(
        about_axis * np.array([-1.0, -1.0, -1.0, 1.0]), momentum
    ), turn
