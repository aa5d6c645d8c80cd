"""A falling rod that is hit as somebody's own formulas have it: the mass felt, the impulse, what it does."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.scenes import falling_rods
from course.study.asking import asked, one_number
from course.study.impact_cases import RodLanding

#: The three formulas of lesson 12 that an impact takes, in their order.
STEPS: dict[str, Callable[..., Any]] = {
    "effective_mass": formulas.effective_mass,
    "impulse_at_point": formulas.impulse_at_point,
    "apply_impulse": formulas.apply_impulse,
}


def asked_rod(
    angle: float, restitution: float, place: float, **own: Callable[..., Any]
) -> RodLanding:
    """A rod's landing as ``rod_landing`` has it, by the formulas of lesson 12.

    Args:
        angle, restitution, place: as there.
        own: functions that take the place of a formula, by its name.
    Raises:
        UnusableResult: what one of them gives is no mass, impulse or pair of velocities.
    """
    steps = STEPS | own
    scene = falling_rods(np.radians(angle), place=place)
    rod, n = scene.bodies, scene.contacts.normal[0]
    arm = scene.contacts.point[0] - rod.position[0]
    v, omega, none = rod.velocity[0], rod.angular_velocity[0], np.zeros(3)
    inverse, still = rod.world_inverse_inertia[0], np.zeros((3, 3))
    felt = one_number(steps["effective_mass"], 1.0, 0.0, inverse, still, arm, none, n)
    point = formulas.point_velocity(v, omega, arm)
    p_hat = one_number(steps["impulse_at_point"], point, none, n, felt, restitution)
    after, spin = asked(
        steps["apply_impulse"], ((3,), (3,)), v, omega, 1.0, inverse, arm, n, p_hat
    )
    axis = rod.rotation[0, :, 0]
    arms = 0.5 * np.outer([-1.0, 0.0, 1.0], axis)
    now = after + np.cross(spin, arms)
    kept = _energy(after, spin, inverse, axis) / _energy(v, omega, inverse, axis)
    was = v + np.cross(omega, arms)
    return RodLanding(
        angle, restitution, place, axis, was, now, float(spin[1]), p_hat, felt, kept
    )


def _energy(v: Array, omega: Array, inverse: Array, axis: Array) -> float:
    """Kinetic, of 1 kg [J]; a turn about the rod's own axis is left out."""
    across = omega - (omega @ axis) * axis
    return 0.5 * float(v @ v + across @ np.linalg.solve(inverse, across))
