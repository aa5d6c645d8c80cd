"""A box that comes down on its four corners, and leaves with the impulses of somebody's own function."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas, rotations
from course.arrays import Array, BoolArray
from course.scenes import box_on_corners
from course.study.asking import asked
from course.study.spinning_impacts import normal_response


@dataclass(frozen=True, eq=False)
class LandedBox:
    """A box before and after four impulses at once; it turns evenly before and after, there is no gravity.

    Args:
        times: (t,) [s]; the moment of the impact stands twice.
        position: of its centre, (t, 3) [m].
        orientation: (t, 4).
        corners: its lower ones, (t, 4, 3) [m].
        impulse: (4,) [N s].
        before, after: how fast the corners rise, (4,) [m/s].
        kept: kinetic energy after over before.
    """

    times: Array
    position: Array
    orientation: Array
    corners: Array
    impulse: Array
    before: Array
    after: Array
    kept: float


def landed_box(
    spin: tuple[float, float],
    restitution: float,
    times: Array,
    late: BoolArray,
    *,
    meeting: float,
    function: Callable[..., Any] = formulas.simultaneous_impulses,
) -> LandedBox:
    """A box of 1 kg that comes at 1 m/s, all corners touching the floor at the same moment.

    Args:
        spin: omega about the two level axes [rad/s].
        restitution: e.
        times, late: of the film (t,) [s], and which are after the impact.
        meeting: the moment of the impact [s].
        function: (matrix, normal_velocity, restitution) -> impulses.
    Raises:
        UnusableResult: what it gives is not four impulses.
    """
    scene = box_on_corners(spin=(*spin, 0.0))
    box, inverse = scene.bodies, scene.bodies.world_inverse_inertia[0]
    arm = scene.contacts.point - box.position[0]
    v, omega = box.velocity[0], box.angular_velocity[0]
    matrix = normal_response(box, scene.contacts)
    before = (v + np.cross(omega, arm))[:, 2]
    (impulse,) = asked(function, ((4,),), matrix, before, restitution)
    push = impulse[:, None] * [0.0, 0.0, 1.0]
    left = v + push.sum(axis=0)
    turned = omega + inverse @ np.cross(arm, push).sum(axis=0)
    since = (times - meeting)[:, None]
    place = box.position[0] + since * np.where(late[:, None], left, v)
    angle = since * np.where(late[:, None], turned, omega)
    turn = rotations.from_rotation_vector(angle)
    corners = place[:, None] + rotations.rotate(turn[:, None], arm)
    inertia = np.linalg.inv(inverse)
    whole, rest = (
        float(u @ u + w @ inertia @ w) for u, w in ((v, omega), (left, turned))
    )
    after = (left + np.cross(turned, arm))[:, 2]
    return LandedBox(times, place, turn, corners, impulse, before, after, rest / whole)
