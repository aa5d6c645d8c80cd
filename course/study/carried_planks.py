"""A loaded plank that is carried for a moment by the contact forces which somebody's own function gives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.scenes import GRAVITY, Scene, loaded_plank
from course.study.asking import UnusableResult, asked, one_number
from course.study.contact_matrices import plain_arrays

#: Sweeps of projected Gauss-Seidel, which its exercise leaves to the caller.
SWEEPS = 60
UP = np.array([0.0, 0.0, 1.0])
#: Forces (2,) [N] at the feet of a scene.
Forces = Callable[[Scene], Array]


@dataclass(frozen=True, eq=False)
class CarriedPlank:
    """Plank and load, one body, under two forces that stay as they are from time 0 on.

    Args:
        times: (t,) [s].
        load_at: y of the load at the start [m].
        feet: y of the feet, (2,) [m].
        force: (2,) [N].
        centre: of both together, (t, 3) [m].
        angle: by which they have turned about x, (t,) [rad].
        gap: height of the plank over each foot, d, (t, 2) [m].
        acceleration: d_ddot at the start, (2,) [m/s^2].
    """

    times: Array
    load_at: float
    feet: Array
    force: Array
    centre: Array
    angle: Array
    gap: Array
    acceleration: Array


def carried_plank(load_at: float, forces: Forces, times: Array) -> CarriedPlank:
    """``course.scenes.loaded_plank`` with its load at y [m], carried by these forces.

    The centre has sum f/M - g, the plank turns with sum (y_i - y) f_i / I: nothing of
    A and b is in it.
    """
    scene = loaded_plank(load_at)
    bodies, feet = scene.bodies, scene.contacts.point[:, 1]
    y = float(bodies.position[0, 1])
    force = forces(scene)
    arm = feet - y
    lift = force.sum() / float(bodies.mass[0]) - GRAVITY
    turning = float(arm @ force) / float(bodies.inertia[0, 0, 0])
    centre = np.outer(0.5 * times**2 * lift, UP) + [0.0, y, 0.0]
    angle = 0.5 * turning * times**2
    # The height, over each foot, of the line that is the plank's lower face.
    bounded = np.clip(angle, -1.4, 1.4)
    gap = centre[:, 2:] + arm * np.tan(bounded)[:, None]
    return CarriedPlank(
        times, load_at, feet, force, centre, angle, gap, lift + arm * turning
    )


def by_solver(solver: Callable[..., Any]) -> Forces:
    """Forces of ``solve_contact_qp`` or ``pivot``, f(A, b)."""

    def forces(scene: Scene) -> Array:
        system = scene.system()
        return asked(solver, ((2,),), system.A.toarray(), system.b)[0]

    return forces


def by_sweeps(sweeps: Callable[..., Any]) -> Forces:
    """Forces of ``projected_gauss_seidel`` from 0 on, f(A, b, start, sweeps)."""
    return by_solver(lambda a, b: sweeps(a, b, np.zeros(len(b)), SWEEPS))


def by_matrix(matrix: Callable[..., Any]) -> Forces:
    """The right forces for the A that ``contact_matrix`` gives, A(contacts, bodies)."""

    def forces(scene: Scene) -> Array:
        (a,) = asked(matrix, ((2, 2),), *plain_arrays(scene))
        if np.diagonal(a).min() <= 0:
            raise UnusableResult("with the A it returned a push along N does not part")
        with np.errstate(all="ignore"):
            f = formulas.projected_gauss_seidel(a, scene.system().b, np.zeros(2), 300)
        if not np.all(np.isfinite(f)) or np.abs(f).max() > 1e6:
            raise UnusableResult("with the A it returned no forces are found")
        return f

    return forces


def by_entries(entry: Callable[..., Any]) -> Forces:
    """As ``by_matrix``, A made entry by entry of ``contact_matrix_entry``."""
    places = [(i, j) for i in range(2) for j in range(2)]

    def matrix(contacts: Any, bodies: Any) -> Array:
        a = [one_number(entry, i, j, contacts, bodies) for i, j in places]
        return np.reshape(a, (2, 2))

    return by_matrix(matrix)


def by_response(response: Callable[..., Any]) -> Forces:
    """As ``by_entries``, a_ij = N_i.(``point_response`` to N_j): the ground does not answer."""

    def entry(i: int, j: int, contacts: Any, bodies: Any) -> float:
        point, normal = contacts[2], contacts[3]
        mass, inverse, _, position = (part[0] for part in bodies)
        arms = point[i] - position, point[j] - position
        (answer,) = asked(response, ((3,),), mass, inverse, *arms, normal[j])
        return float(normal[i] @ answer)

    return by_entries(entry)


def forced(a: Array, b: Array) -> Array:
    """The forces that make every d_ddot 0, as the slide has it (misprint 14): a foot may pull."""
    return np.asarray(np.linalg.solve(a, -b))


def printed_entry(i: int, j: int, contacts: Any, bodies: Any) -> float:
    """a_ij with the bracket as it is printed, p_j - x_A x N_j for (p_j - x_A) x N_j (misprint 11)."""
    point, normal = contacts[2], contacts[3]
    mass, inverse, _, x = (part[0] for part in bodies)
    turned = inverse @ (point[j] - np.cross(x, normal[j]))
    return float(normal[i] @ (normal[j] / mass + np.cross(turned, point[i] - x)))
