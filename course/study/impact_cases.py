"""One impact worked out for a picture whose numbers stand on sliders: two balls, a ball and a wall, a rod."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array
from course.contact import resolve_collisions
from course.dynamics import (
    effective_mass,
    impulse_central,
    kinetic_energy_lost,
    point_velocity,
    total_energy,
    wall_bounce,
)
from course.scenes import falling_rods


@dataclass(frozen=True, eq=False)
class CentralImpact:
    """Two bodies on one line, body 2 on the left, body 1 on the right, n to the right.

    Args:
        mass, before, after: of body 1 and body 2, (2,) [kg], [m/s], [m/s].
        impulse, lost: p_hat [N s] and the kinetic energy lost [J].
    """

    mass: Array
    before: Array
    after: Array
    impulse: float
    lost: float


def central_impact(
    mass_1: float,
    mass_2: float,
    velocity_1: float,
    velocity_2: float,
    restitution: float,
) -> CentralImpact:
    """A central impact along x; speeds along n [m/s], masses [kg]."""
    n = np.array([1.0, 0.0, 0.0])
    given = (mass_1, mass_2, velocity_1 * n, velocity_2 * n, n, restitution)
    p_hat, lost = float(impulse_central(*given)), float(kinetic_energy_lost(*given))
    mass, before = np.array([mass_1, mass_2]), np.array([velocity_1, velocity_2])
    after = before + p_hat * np.array([1, -1]) / mass
    return CentralImpact(mass, before, after, p_hat, lost)


@dataclass(frozen=True, eq=False)
class WallReflection:
    """A ball that comes at 1 m/s and a wall, in the plane of x and y.

    Args:
        wall_angle, incoming_angle: from the horizontal [degrees].
        restitution: e.
        normal, along: unit vectors out of the wall and along it, (3,).
        before, after: velocities, (3,) [m/s].
    """

    wall_angle: float
    incoming_angle: float
    restitution: float
    normal: Array
    along: Array
    before: Array
    after: Array


def wall_reflection(
    wall_angle: float, incoming_angle: float, restitution: float
) -> WallReflection:
    """A bounce; angles of the wall's surface and of the velocity the ball comes with [degrees]."""
    (c, going_c), (s, going_s) = (
        f(np.radians([wall_angle, incoming_angle])) for f in (np.cos, np.sin)
    )
    normal, along = np.array([-s, c, 0.0]), np.array([c, s, 0.0])
    before = np.array([going_c, going_s, 0.0])
    after = wall_bounce(before, normal, restitution)
    given = wall_angle, incoming_angle, restitution
    return WallReflection(*given, normal, along, before, after)


@dataclass(frozen=True, eq=False)
class RodLanding:
    """A rod of 1 kg and 1 m that falls at 1 m/s, before and after the floor hits it at one point.

    Args:
        angle: from the horizontal [degrees]; the lower end is on the right.
        restitution, place: e, and where it is hit, 1 the lower end, -1 the upper.
        axis: along it, toward the lower end, (3,).
        before, after: velocities of its upper end, middle and lower end, (3, 3) [m/s].
        spin: omega_y after [rad/s].
        impulse: of the floor, upward [N s].
        felt: effective mass at the point [kg].
        kept: kinetic energy after over before.
    """

    angle: float
    restitution: float
    place: float
    axis: Array
    before: Array
    after: Array
    spin: float
    impulse: float
    felt: float
    kept: float


def rod_landing(angle: float, restitution: float, place: float) -> RodLanding:
    """A rod's landing; the angle in degrees, the place from -1 to 1, 0 the middle."""
    scene = falling_rods(np.radians(angle), place=place)
    before, after = (
        scene.bodies,
        resolve_collisions(scene.bodies, scene.contacts, restitution),
    )
    axis = before.rotation[0, :, 0]
    arms = 0.5 * np.outer([-1.0, 0.0, 1.0], axis)
    was, now = (
        point_velocity(s.velocity[0], s.angular_velocity[0], arms)
        for s in (before, after)
    )
    return RodLanding(
        angle,
        restitution,
        place,
        axis,
        was,
        now,
        spin=float(after.angular_velocity[0, 1]),
        impulse=float(after.momentum[0, 2] - before.momentum[0, 2]),
        felt=float(effective_mass(before, scene.contacts)[0]),
        kept=float(total_energy(after) / total_energy(before)),
    )
