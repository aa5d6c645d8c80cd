"""A mark on a tumbling handle, carried by somebody's own velocity, acceleration, rate or turn: does it stay on it?"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import cumulative_simpson
from scipy.spatial.transform import Rotation

from course import formulas
from course.arrays import Array
from course.dynamics import free_tumble
from course.scenes import handle_mass_properties, spinning_handle
from course.scenes.spinning import HANDLE_CENTERS, HANDLE_HALF_EXTENTS
from course.study.asking import asked

#: How the centre moves: thrown up [m/s] under a weak pull [m/s^2], so that it stays in the picture.
THROWN, PULL = np.array([0.01, 0.0, 0.075]), np.array([0.0, 0.0, -0.05])
#: omega of another body, which has no say [rad/s].
OTHER = np.array([2.0, 1.0, -1.5])


@dataclass(frozen=True, eq=False)
class Tumbling:
    """The exact motion of the handle.

    Args:
        times: equally spaced, (t,) [s].
        position, velocity: of the centre, (t, 3) [m], [m/s].
        rotation: (t, 3, 3).
        omega, omega_dot: (t, 3) [rad/s], [rad/s^2].
        arm: from the centre to the place of the mark on the handle, (t, 3) [m].
    """

    times: Array
    position: Array
    velocity: Array
    rotation: Array
    omega: Array
    omega_dot: Array
    arm: Array


#: Where the mark is at each time, (t, 3) [m].
Mark = Callable[[Tumbling], Array]


def tumbling(times: Array, *, tilt: float) -> Tumbling:
    """The handle, spinning about its stem, thrown; the mark is on a corner of its crossbar."""
    bodies = spinning_handle(tilt=tilt).bodies
    motion = free_tumble(bodies, times)
    turned = motion.rotation
    inertia = turned @ bodies.inertia[0] @ np.swapaxes(turned, -1, -2)
    momentum = np.broadcast_to(motion.angular_momentum, (len(times), 3))
    omega_dot = formulas.angular_acceleration(inertia, momentum, 0 * momentum)
    t = times[:, None]
    bar = HANDLE_CENTERS[0] - handle_mass_properties().centre
    bar = bar + HANDLE_HALF_EXTENTS[0] * [1.0, 0.0, 1.0]
    return Tumbling(
        times, THROWN * t + 0.5 * PULL * t**2, THROWN + PULL * t, turned,
        motion.angular_velocity, omega_dot, turned @ bar,
    )  # fmt: skip


def by_velocity(function: Callable[..., Any] = formulas.point_velocity) -> Mark:
    """The mark moves with ``point_velocity``, (v, omega, r)."""

    def mark(body: Tumbling) -> Array:
        rows = zip(body.velocity, body.omega, body.arm, strict=True)
        rate = np.array([asked(function, ((3,),), *row)[0] for row in rows])
        return body.arm[0] + body.position[0] + _summed(rate, body.times)

    return mark


def by_acceleration(
    function: Callable[..., Any] = formulas.free_point_acceleration,
) -> Mark:
    """The mark starts as the handle does, and accelerates with ``free_point_acceleration``."""

    def mark(body: Tumbling) -> Array:
        rows = zip(body.omega_dot, body.omega, body.arm, strict=True)
        rate = [asked(function, ((3,),), PULL, *row)[0] for row in rows]
        start = body.velocity[0] + np.cross(body.omega[0], body.arm[0])
        velocity = start + _summed(np.array(rate), body.times)
        return body.arm[0] + body.position[0] + _summed(velocity, body.times)

    return mark


def cross_lost(a: Array, omega_dot: Array, omega: Array, arm: Array) -> Array:
    """p_ddot with omega_dot for omega_dot x r, as the table prints it (misprint 12)."""
    return a + omega_dot + np.cross(omega, np.cross(omega, arm))


def by_normal_rate(function: Callable[..., Any] = formulas.normal_rate) -> Mark:
    """The direction to the mark is a normal of the handle, body B, and turns with ``normal_rate``.

    Classical Runge-Kutta over two of the times, and a mean between.
    """

    def rate(n: Array, omega: Array) -> Array:
        return asked(function, ((3,),), n, OTHER, omega, "face_b")[0]

    def mark(body: Tumbling) -> Array:
        length = float(np.linalg.norm(body.arm[0]))
        n, step = body.arm[0] / length, 2 * float(body.times[1])
        found = [n]
        for k in range(0, len(body.times) - 2, 2):
            first, middle, last = body.omega[k : k + 3]
            k1 = rate(n, first)
            k2 = rate(n + 0.5 * step * k1, middle)
            k3 = rate(n + 0.5 * step * k2, middle)
            k4 = rate(n + step * k3, last)
            # Halfway by Hermite's cubic, with the rates at both ends.
            after = n + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            between = 0.5 * (n + after) + step / 8 * (k1 - rate(after, last))
            found += [between, after]
            n = after
        return body.position + length * np.clip(found, -1e3, 1e3)

    return mark


def by_turn(function: Callable[..., Any] = formulas.rotate) -> Mark:
    """The arm at the start, turned with ``rotate`` by the rotation vector from the start to now."""

    def mark(body: Tumbling) -> Array:
        turns = Rotation.from_matrix(body.rotation @ body.rotation[0].T).as_rotvec()
        arms = [asked(function, ((3,),), body.arm[0], turn)[0] for turn in turns]
        return body.position + np.array(arms)

    return mark


def _summed(rate: Array, times: Array) -> Array:
    """The integral of (t, 3) rates from the first time on, by Simpson's rule."""
    return np.asarray(cumulative_simpson(rate, x=times, axis=0, initial=0.0))
