"""How bodies without torque turn in steps, how far off that is, and how fast a wobble grows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from course import rotations
from course.arrays import Array, ArrayLike, failure, positive, scalar, vectors
from course.dynamics import Bodies, Wrench, free_tumble, principal_axes, splitting
from course.scenes import spinning_body
from course.study.stability import Integrator, growth_rate

#: A plain step on arrays: (x, R, p, L, mass, I_body, force, torque, h) -> (x, R, p, L) one step on.
PlainStep = Callable[..., tuple[Array, Array, Array, Array]]


def tilt_growth(
    moments: ArrayLike,
    *,
    axis: int = 1,
    spin: float = 1.0,
    tilt: float = 1e-6,
    turns: float = 10.0,
) -> Array:
    """How fast a small tilt grows, measured on the motion [1/s]; 0 where it does not.

    Where the tilt comes to ten times its start, the slope of its logarithm from there until it is a hundredth of a
    radian. The motion is that of ``splitting`` of order 4 with 60 steps a turn.

    Args:
        moments: of n bodies, (n, 3) [kg m^2]; the axes are numbered as they stand here.
        axis: the one that the bodies spin about, 0, 1 or 2.
        spin: Omega, |L| over the moment about that axis [rad/s].
        tilt: at the start, of L toward the next axis [rad].
        turns: how long they are watched, in turns of 2 pi/Omega.
    Returns:
        (n,).
    """
    moment = positive("moments", vectors("moments", moments))
    if moment.ndim != 2:
        raise failure("moments", "shape (n, 3)", f"shape {moment.shape}")
    bodies = Bodies.concatenate(
        spinning_body(one, tilt=tilt, spin=spin, axis=axis).bodies for one in moment
    )
    step = 2 * np.pi / abs(scalar("spin", spin)) / 60
    times: Array = step * np.arange(round(60 * turns) + 1, dtype=float)
    across = []
    for _ in times:
        seen = np.einsum("nji,nj->ni", bodies.rotation, bodies.angular_momentum)
        across.append(
            np.linalg.norm(np.delete(seen, axis, axis=1), axis=1)
            / np.linalg.norm(seen, axis=1)
        )
        bodies = splitting(bodies, None, step, order=4)
    return np.array(
        [_slope_between(times, one, 10 * tilt, 1e-2) for one in np.transpose(across)]
    )


def method_of(plain: PlainStep) -> Integrator:
    """A step on plain arrays as a method with the house's signature.

    Args:
        plain: (x, R, p, L, mass, I_body, force, torque, h) -> (x, R, p, L), as the exercise symplectic_euler_step
            has it, for n bodies at once.
    """

    def method(
        bodies: Bodies, wrench: Wrench | None, step: float, *, time: float = 0.0
    ) -> Bodies:
        none = np.zeros(bodies.position.shape)
        force, torque = (none, none) if wrench is None else wrench(bodies, time)
        x, turned, p, momentum = plain(
            bodies.position, bodies.rotation, bodies.momentum, bodies.angular_momentum,
            bodies.mass, bodies.inertia, force, torque, step,
        )  # fmt: skip
        return _as_bodies(bodies, x, turned, p, momentum)

    return method


def even_spin_error(bodies: Bodies, times: ArrayLike) -> Array:
    """How far off the cheapest model of turning is, which keeps omega as it is, at each time, (t,) [rad].

    Exact for a ball, and about a principal axis.

    Args:
        bodies: exactly one, with no torque on it.
        times: (t,) [s].
    """
    truth = free_tumble(bodies, times)
    even = rotations.turned(
        bodies.orientation, truth.times[:, None] * bodies.angular_velocity
    )
    _, axes = principal_axes(bodies.inertia[0])
    return rotations.angle_between(rotations.to_matrix(even) @ axes, truth.rotation)


def turn_for(
    bodies: Bodies, method: Integrator, duration: float, step: float, **options: Any
) -> Bodies:
    """The bodies after a time without forces, by as many whole steps of at most ``step`` as it takes [s]."""
    count = max(1, round(duration / scalar("step", step)))
    for _ in range(count):
        bodies = method(bodies, None, duration / count, **options)
    return bodies


def turn_by_plain_steps(
    bodies: Bodies, plain: PlainStep, duration: float, step: float
) -> Bodies:
    """As ``turn_for``, by a step on plain arrays, with no checks between the steps."""
    count = max(1, round(duration / scalar("step", step)))
    none, h = np.zeros(bodies.position.shape), duration / count
    given = bodies.mass, bodies.inertia, none, none, h
    x, turned = bodies.position, bodies.rotation
    p, momentum = bodies.momentum, bodies.angular_momentum
    for _ in range(count):
        x, turned, p, momentum = plain(x, turned, p, momentum, *given)
    return _as_bodies(bodies, x, turned, p, momentum)


def _as_bodies(
    bodies: Bodies, x: Array, turned: Array, p: Array, momentum: Array
) -> Bodies:
    """The bodies where plain arrays say they are."""
    return replace(
        bodies,
        position=x,
        orientation=rotations.from_matrix(turned),
        momentum=p,
        angular_momentum=momentum,
    )


def turn_in_body_axes(bodies: Bodies, duration: float, step: float) -> Bodies:
    """As ``turn_for``, by Euler as it is often written: on l in body axes, and on the quaternion, renormalised.

    Each half of it, with what it loses, stands in ``course.dynamics``: ``body_frame_euler``, ``quaternion_euler``.
    """
    count = max(1, round(duration / scalar("step", step)))
    h, inverse, q = duration / count, np.linalg.inv(bodies.inertia), bodies.orientation
    l_body = np.einsum("nji,nj->ni", bodies.rotation, bodies.angular_momentum)
    for _ in range(count):
        omega = np.einsum("nij,nj->ni", inverse, l_body)
        u, w = q[:, :3], q[:, 3:]
        along = w * omega + np.cross(u, omega)
        q = q + 0.5 * h * np.concatenate(
            [along, -np.sum(u * omega, axis=-1, keepdims=True)], axis=-1
        )
        q = q / np.linalg.norm(q, axis=-1, keepdims=True)
        l_body = l_body + h * np.cross(l_body, omega)
    position = bodies.position + duration * bodies.velocity
    return replace(
        bodies,
        position=position,
        orientation=q,
        angular_momentum=rotations.rotate(q, l_body),
    )


def counting_wrench() -> tuple[Wrench, list[int]]:
    """A wrench of zeros that counts how often it is asked, and the list whose one entry is that count."""
    asked = [0]

    def wrench(bodies: Bodies, time: float) -> tuple[Array, Array]:
        asked[0] += 1
        return np.zeros(bodies.position.shape), np.zeros(bodies.position.shape)

    return wrench, asked


def _slope_between(times: Array, sizes: Array, low: float, high: float) -> float:
    """The rate of growth while a size is between two bounds for the first time; 0 where it never is."""
    within = (np.maximum.accumulate(sizes) > low) & (
        np.maximum.accumulate(sizes) < high
    )
    return growth_rate(times[within], sizes[within]) if within.sum() > 2 else 0.0
