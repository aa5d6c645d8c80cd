"""A ladder on a smooth wall and a smooth floor, in closed form: gaps, forces, and where it lets go.

Seen from the side in the plane of y (to the right) and z (up), x toward the
reader, so that a turn against the clock is a positive omega_x. The floor is
z = 0, the wall y = 0 with the ladder left of it: the foot is on the left, the
top on the right, the angle theta between ladder and floor. A ladder of length
l with its centre at (y, z) has the gaps

    foot and floor   d_1 = z - (l/2) sin theta      N_1 = (0, 0, 1)
    top and wall     d_2 = -y - (l/2) cos theta     N_2 = (0, -1, 0)

and, as a flat thin body, the moment m l^2/12 about x. ``course.scenes.ladder``
has it as bodies and contacts.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike, broadcast, in_range, positive, scalars


def ladder_gaps(
    y: ArrayLike, z: ArrayLike, angle: ArrayLike, *, length: ArrayLike = 4.0
) -> Array:
    """The gaps of a ladder anywhere: foot to floor and top to wall (syllabus row 19).

    Args:
        y, z: centre, (...) [m].
        angle: theta, (...) [rad].
        length: l, (...) [m].
    Returns:
        (d_1, d_2) on the last axis, (..., 2) [m].
    Raises:
        ValueError: numbers that are not finite, a length that is not positive, shapes that do not fit.
    """
    y, z, theta = scalars("y", y), scalars("z", z), scalars("angle", angle)
    half = 0.5 * positive("length", length)
    batch = broadcast(y=(y, 0), z=(z, 0), angle=(theta, 0), length=(half, 0))
    foot, top = z - half * np.sin(theta), -y - half * np.cos(theta)
    return np.stack(
        [np.broadcast_to(foot, batch), np.broadcast_to(top, batch)], axis=-1
    )


def sliding_ladder_forces(
    angle: ArrayLike,
    *,
    rate: ArrayLike = 0.0,
    length: float = 4.0,
    mass: float = 10.0,
    gravity: float = 9.81,
) -> Array:
    """What floor and wall push with while the ladder slides down both.

    theta_ddot = -(3 g/(2 l)) cos theta, and from the centre's acceleration
    f_1 = m (g - (3 g/4) cos^2 theta - (l/2) theta_dot^2 sin theta) and
    f_2 = m ((3 g/4) sin theta cos theta - (l/2) theta_dot^2 cos theta)
    (Lagrange's equation for a rod; L. D. Landau, E. M. Lifshitz, *Mechanics*,
    section 5). Let go at theta_0 it leaves the wall, f_2 = 0, at
    sin theta = (2/3) sin theta_0.

    Args:
        angle, rate: theta and theta_dot, (...) [rad], [rad/s].
        length, mass, gravity: [m], [kg], [m/s^2].
    Returns:
        (f_1, f_2) on the last axis, (..., 2) [N]; f_2 below 0 where the wall would have to pull.
    """
    theta, omega = in_range("angle", angle, 0.0, np.pi / 2), scalars("rate", rate)
    broadcast(angle=(theta, 0), rate=(omega, 0))
    sine, cosine, inward = np.sin(theta), np.cos(theta), 0.5 * length * omega**2
    floor = gravity - 0.75 * gravity * cosine**2 - inward * sine
    wall = 0.75 * gravity * sine * cosine - inward * cosine
    return mass * np.stack(np.broadcast_arrays(floor, wall), axis=-1)


def standing_ladder_forces(
    angle: ArrayLike, *, mass: float = 10.0, gravity: float = 9.81
) -> Array:
    """What floor, wall and kerb push with while the ladder stands: m g, m g/(2 tan theta) twice, (..., 3) [N].

    The moments about the foot balance: f_2 l sin theta = m g (l/2) cos theta.
    """
    theta = in_range("angle", angle, 0.0, np.pi / 2)
    wall = 0.5 * mass * gravity / np.tan(theta)
    return np.stack([np.full(theta.shape, mass * gravity), wall, wall], axis=-1)


def ladder_leaving_angle(start: ArrayLike) -> Array:
    """Where a ladder let go at theta_0 leaves the wall: arcsin((2/3) sin theta_0), (...) [rad]."""
    return np.arcsin(2 / 3 * np.sin(in_range("start", start, 0.0, np.pi / 2)))
