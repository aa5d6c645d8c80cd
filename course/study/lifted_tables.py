"""A table on the ground that somebody pushes up from below: its feet's forces, or how they lift."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array
from course.contact import contact_system, solve
from course.scenes import table

WEIGHTLESS = 1e-9  # accelerations below this many g are none


@dataclass(frozen=True, eq=False)
class LiftedTable:
    """A table of 1 kg at rest on four feet at the moment at which it is pushed.

    Args:
        place, centre: of the push and of the centre of mass, (2,) [m].
        feet: (4, 3) [m].
        force: f of the ground at each foot, (4,) [N]; of those that solve it, the
            shortest.
        acceleration: d_ddot of each foot, (4,) [m/s^2].
        response: of each foot to 1 N at the place, were there no ground, (4,)
            [m/s^2]; at a foot's place this is the foot's row of A.
        rise, slope: the acceleration of the table's point (x, y) is
            rise + slope.(x, y) [m/s^2], (2,) [1/s^2].
    """

    place: Array
    centre: Array
    feet: Array
    force: Array
    acceleration: Array
    response: Array
    rise: float
    slope: Array

    @property
    def lifting(self) -> Array:
        """Which feet leave the ground, (4,) bools."""
        return np.asarray(self.acceleration > WEIGHTLESS * 9.81)


def lifted_table(
    x: float, y: float, push: float, offset_x: float = 0.1, offset_y: float = 0.05
) -> LiftedTable:
    """The table with its weight and a push straight up [N] at (x, y), its centre of mass at the offsets [m].

    w = A f + b >= 0, f >= 0, f.w = 0, with b of weight and push (syllabus rows 21 and 25).
    """
    scene = table(offset=(offset_x, offset_y))
    bodies, feet = scene.bodies, scene.contacts.point
    arm = np.array([x, y, 0.0]) - bodies.position[0]
    up = np.zeros((len(bodies), 3))
    up[0, 2] = 1.0
    turning = np.zeros_like(up)
    turning[0] = np.cross(arm, up[0])
    weight = scene.force
    system = contact_system(
        bodies, scene.contacts, weight + push * up, push * turning
    )  # fmt: skip
    unit = contact_system(bodies, scene.contacts, up, turning)
    solution = solve(system)
    matrix = system.A.toarray()
    f = _shortest(solution.force)
    w = np.where(
        np.abs(solution.acceleration) < WEIGHTLESS * 9.81, 0.0, matrix @ f + system.b
    )
    rise, *slope = np.linalg.lstsq(np.column_stack([np.ones(4), feet[:, :2]]), w)[0]
    return LiftedTable(
        np.array([x, y]), bodies.position[0, :2], feet, f, w, unit.b,
        float(rise), np.array(slope),
    )  # fmt: skip


def _shortest(force: Array) -> Array:
    """The shortest of the forces f + t (1, -1, 1, -1) >= 0, which all do the same to the table."""
    swap = np.array([1.0, -1.0, 1.0, -1.0])
    low, high = -float(force[::2].min()), float(force[1::2].min())
    return np.asarray(
        force + np.clip(-float(force @ swap) / 4, low, high) * swap
    )  # fmt: skip
