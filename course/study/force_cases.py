"""Contact forces of one case for a picture whose numbers stand on sliders: two contacts, a plank, a table."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course import formulas
from course.arrays import Array, ArrayLike
from course.contact import ContactSystem, solve
from course.scenes import loaded_plank, table


@dataclass(frozen=True, eq=False)
class TwoForces:
    """Two contacts in the plane of their forces.

    Args:
        matrix, bias: A (2, 2) [1/kg] and b (2,) [m/s^2].
        forced: where both d_ddot are 0, whatever the signs, (2,) [N].
        force, acceleration: of the solution, (2,) [N], [m/s^2].
        sweeps: forces after each step of projected Gauss-Seidel from 0, (k, 2) [N].
    """

    matrix: Array
    bias: Array
    forced: Array
    force: Array
    acceleration: Array
    sweeps: Array

    def distance(self, force: ArrayLike) -> Array:
        """((f - f_0).A (f - f_0))^(1/2) from the unrestricted minimum f_0 of q = f'A f/2 + b.f, (...) [J^(1/2)/s].

        q is its square over 2 plus a constant, so both have the same level sets.

        Args:
            force: f, (..., 2) [N].
        """
        off = np.asarray(force, dtype=float) - self.forced
        square = np.einsum("...i,ij,...j->...", off, self.matrix, off)
        return np.asarray(np.sqrt(square))


def two_forces(a: ArrayLike, b: ArrayLike, *, sweeps: int = 3) -> TwoForces:
    """Solve for two contact forces, and sweep a few times: A (2, 2) [1/kg], b (2,) [m/s^2]."""
    matrix, bias = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    force = solve(ContactSystem(matrix, bias)).force
    path = [np.zeros(2)]
    for i in [0, 1] * sweeps:
        f = path[-1].copy()
        f[i] = max(0.0, f[i] - (matrix[i] @ f + bias[i]) / matrix[i, i])
        path.append(f)
    forced = np.linalg.solve(matrix, -bias)
    return TwoForces(matrix, bias, forced, force, matrix @ force + bias, np.array(path))


@dataclass(frozen=True, eq=False)
class PlankForces:
    """The loaded plank: y of load, centre of mass and feet (2,) [m], and the forces at the feet."""

    load_at: float
    centre: float
    feet: Array
    forces: TwoForces


def plank_forces(load_at: float) -> PlankForces:
    """``course.scenes.loaded_plank`` with its load at y [m], solved."""
    scene = loaded_plank(load_at)
    system = scene.system()
    centre, feet = float(scene.bodies.position[0, 1]), scene.contacts.point[:, 1]
    return PlankForces(load_at, centre, feet, two_forces(system.A.toarray(), system.b))


@dataclass(frozen=True, eq=False)
class PushedTable:
    """A table of 1 kg that is pushed up from below with 1 N.

    Args:
        place, centre: of the push and of the centre of mass, (2,) [m].
        feet: (4, 3) [m].
        response: upward acceleration of each foot, (4,) [m/s^2].
        still: two points of the line that does not move at first, (2, 2) [m]; None where
            the push is under the centre of mass.
    """

    place: Array
    centre: Array
    feet: Array
    response: Array
    still: Array | None


def pushed_table(
    x: float = 0.5, y: float = 0.3, offset_x: float = 0.1, offset_y: float = 0.05
) -> PushedTable:
    """The table pushed at (x, y) with its centre of mass at the offsets from the middle [m].

    Nothing moves at first where 1/m + r_y p_y/I_x + r_x p_x/I_y = 0, x and y being
    principal axes.
    """
    scene = table(offset=(offset_x, offset_y))
    bodies, feet, place = scene.bodies, scene.contacts.point, np.array([x, y])
    mass, inverse = bodies.mass[0], bodies.world_inverse_inertia[0]
    arms, push_arm = (p - bodies.position[0] for p in (feet, np.array([x, y, 0.0])))
    up = np.array([0.0, 0.0, 1.0])
    lift = [formulas.point_response(mass, inverse, r, push_arm, up)[2] for r in arms]
    centre, still = bodies.position[0, :2], None
    slope = (place - centre) * np.array([inverse[1, 1], inverse[0, 0]])
    size = float(slope @ slope)
    if size >= 1e-9:
        along = np.array([-slope[1], slope[0]]) / np.sqrt(size)
        still = centre - slope / (mass * size) + np.array([[-3.0], [3.0]]) * along
    return PushedTable(place, centre, feet, np.array(lift), still)
