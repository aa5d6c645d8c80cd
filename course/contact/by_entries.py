"""The contact system entry by entry, as the table of syllabus row 24 has it: to read, and to test the fast form by.

Every function treats one contact, or one pair of contacts, with the letters
of the lecture. ``course.contact.contact_system`` computes the same for all
contacts at once.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike, indices
from course.contact.curved import tangents
from course.contact.separation import normal_rate
from course.dynamics.bodies import Bodies
from course.overlap.contacts import Contacts


def cross(x: ArrayLike, y: ArrayLike) -> Array:
    """x cross y, (3,)."""
    return np.cross(np.asarray(x, dtype=float), np.asarray(y, dtype=float))


def point_response(
    mass: float,
    inverse_inertia: ArrayLike,
    arm: ArrayLike,
    push_arm: ArrayLike,
    push: ArrayLike,
) -> Array:
    """Acceleration that a force at one point of a body gives another of its points.

    F/m + (I^-1 (r_j x F)) x r_i: the force-dependent entry of the table
    (syllabus row 24). The torque is (p_j - x) x F; the slide's
    (p_j - x x N_j) is misprint 11.

    Args:
        mass: m [kg], infinity for a fixed body.
        inverse_inertia: I^-1 in world axes, (3, 3) [1/(kg m^2)].
        arm: r_i, from the centre of mass to the point that answers, (3,) [m].
        push_arm: r_j, from the centre of mass to the point that is pushed, (3,) [m].
        push: F, (3,) [N].
    Returns:
        (3,) [m/s^2].
    """
    omega_dot = np.asarray(inverse_inertia) @ cross(push_arm, push)
    return np.asarray(push) / mass + cross(omega_dot, arm)


def contact_matrix_entry(bodies: Bodies, contacts: Contacts, i: int, j: int) -> float:
    """a_ij: what a unit of force at contact j adds to d_ddot of contact i (syllabus rows 21, 22 and 24).

    The force pushes body A of contact j along +N_j and its body B along
    -N_j. Each of contact i's bodies answers if it is one of these, B with
    the opposite sign, and each with its own arm (misprint 11).

    Args:
        bodies, contacts: as in ``contact_system``.
        i, j: from 0.
    Returns:
        a_ij [1/kg].
    """
    i, j = indices("(i, j)", [i, j], len(contacts))
    inverse, n_i, n_j = (
        bodies.world_inverse_inertia,
        contacts.normal[i],
        contacts.normal[j],
    )
    a_ij = 0.0
    for body, p_i, answer_sign in _sides(contacts, i):
        for pushed, p_j, push_sign in _sides(contacts, j):
            if body == pushed:
                x = bodies.position[body]
                answer = point_response(
                    bodies.mass[body], inverse[body], p_i - x, p_j - x, push_sign * n_j
                )
                a_ij += answer_sign * float(n_i @ answer)
    return a_ij


def contact_matrix_by_entries(bodies: Bodies, contacts: Contacts) -> Array:
    """A, (c, c), from its entries one after the other."""
    count = range(len(contacts))
    a = [[contact_matrix_entry(bodies, contacts, i, j) for j in count] for i in count]
    return np.array(a, dtype=float).reshape(len(contacts), len(contacts))


def angular_acceleration_free(
    inverse_inertia: ArrayLike,
    angular_momentum: ArrayLike,
    angular_velocity: ArrayLike,
    torque: ArrayLike,
) -> Array:
    """omega_dot without contact forces, I^-1 (tau + L x omega), (3,) [rad/s^2] (syllabus row 23, misprint 9)."""
    return np.asarray(inverse_inertia) @ (
        np.asarray(torque) + cross(angular_momentum, angular_velocity)
    )


def free_point_acceleration(
    acceleration: ArrayLike,
    angular_acceleration: ArrayLike,
    angular_velocity: ArrayLike,
    arm: ArrayLike,
) -> Array:
    """p_ddot = v_dot + omega_dot x r + omega x (omega x r), (3,) [m/s^2] (syllabus row 23)."""
    spun = cross(angular_velocity, cross(angular_velocity, arm))
    return np.asarray(acceleration) + cross(angular_acceleration, arm) + spun


def contact_bias(
    bodies: Bodies, contacts: Contacts, i: int, force: ArrayLike, torque: ArrayLike
) -> float:
    """b_i: d_ddot of contact i without contact forces (syllabus rows 20, 23 and 24).

    (p_A_ddot - p_B_ddot).N + 2 (p_A_dot - p_B_dot).N_dot - d |N_dot|^2, and
    for two curved surfaces, which must touch here (d = 0), the formula of
    ``course.contact.curved`` as it is written there.

    Args:
        bodies, contacts: as in ``contact_system``.
        i: from 0.
        force, torque: external, on each body, (n, 3) [N, N m].
    Returns:
        b_i [m/s^2].
    """
    i = int(indices("i", i, len(contacts)))
    contact, n = contacts[i], contacts.normal[i]
    (a, p_a, _), (b, p_b, _) = _sides(contacts, i)
    if contact.feature == "curved":
        p_a = p_b = contacts.point[i]
    velocity_a, acceleration_a = _free_motion(bodies, a, p_a, force, torque)
    velocity_b, acceleration_b = _free_motion(bodies, b, p_b, force, torque)
    relative = velocity_a - velocity_b
    b_i = (acceleration_a - acceleration_b) @ n
    if contact.feature == "curved":
        turn = bodies.angular_velocity
        return float(
            b_i
            + 2 * relative @ cross(turn[b], n)
            + _curvature(contact, relative, turn[a] - turn[b])
        )
    n_dot = normal_rate(bodies, contact)[0]
    return float(b_i + 2 * relative @ n_dot - contacts.separation[i] * (n_dot @ n_dot))


def contact_bias_by_entries(
    bodies: Bodies, contacts: Contacts, force: ArrayLike, torque: ArrayLike
) -> Array:
    """b, (c,), from its entries one after the other."""
    return np.array(
        [
            contact_bias(bodies, contacts, i, force, torque)
            for i in range(len(contacts))
        ],
        dtype=float,
    )


def _sides(
    contacts: Contacts, i: int
) -> tuple[tuple[int, Array, float], tuple[int, Array, float]]:
    """Body, point and sign of both sides of contact i."""
    return (
        (int(contacts.body_a[i]), contacts.point_a[i], +1.0),
        (int(contacts.body_b[i]), contacts.point_b[i], -1.0),
    )


def _free_motion(
    bodies: Bodies, body: int, point: Array, force: ArrayLike, torque: ArrayLike
) -> tuple[Array, Array]:
    """Velocity and acceleration of a material point without contact forces."""
    if bodies.fixed[body]:
        return np.zeros(3), np.zeros(3)
    r, omega = point - bodies.position[body], bodies.angular_velocity[body]
    inverse, spin = bodies.world_inverse_inertia[body], bodies.angular_momentum[body]
    omega_dot = angular_acceleration_free(
        inverse, spin, omega, np.asarray(torque)[body]
    )
    v_dot = np.asarray(force)[body] / bodies.mass[body]
    velocity = bodies.velocity[body] + cross(omega, r)
    return velocity, free_point_acceleration(v_dot, omega_dot, omega, r)


def _curvature(contact: Contacts, relative: Array, omega: Array) -> float:
    """s'K_A s + 2 u.s - (u + K_A s)'(K_A + K_B)^-1 (u + K_A s) of one contact, omega = omega_A - omega_B."""
    assert (
        contact.curvature_a is not None and contact.curvature_b is not None
    )  # Contacts has checked it
    plane = tangents(contact.normal)[0]
    k_a, k_b = (
        plane @ contact.curvature_a[0] @ plane.T,
        plane @ contact.curvature_b[0] @ plane.T,
    )
    s, u = plane @ relative, plane @ cross(omega, contact.normal[0])
    rolled = u + k_a @ s
    return float(s @ k_a @ s + 2 * u @ s - rolled @ np.linalg.pinv(k_a + k_b) @ rolled)
