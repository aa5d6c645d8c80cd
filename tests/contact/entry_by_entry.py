"""A and b one entry after the other, from the formulas of lessons 13 to 15: slow, and
easy to read."""

import numpy as np

from course import formulas
from course.contact import normal_rate
from course.contact.curved import tangents


def plain(bodies, contacts):
    """Contacts and bodies as the exercises of lesson 15 take them."""
    free = ~bodies.fixed[:, None, None]
    inertia = np.where(free, bodies.inertia, np.eye(3))
    described = contacts.body_a, contacts.body_b, contacts.point, contacts.normal
    inverse = free * np.linalg.inv(inertia)
    return described, (bodies.mass, inverse, bodies.rotation, bodies.position)


def matrix_by_entries(bodies, contacts):
    """A, (c, c); p_A and p_B lie off the point along N, which changes no lever."""
    described, massive = plain(bodies, contacts)
    count = len(contacts)
    a = np.zeros((count, count))
    for i in range(count):
        for j in range(count):
            a[i, j] = formulas.contact_matrix_entry(i, j, described, massive)
    return a


def bias_by_entries(bodies, contacts, force, torque):
    """b, (c,): (p_A_ddot - p_B_ddot).N + 2 (p_A_dot - p_B_dot).N_dot - d |N_dot|^2.

    For two curved surfaces, which must touch here (d = 0), the formula of
    ``course.contact.curved`` as it is written there.
    """
    each = [
        _bias(bodies, contacts[i : i + 1], force, torque) for i in range(len(contacts))
    ]
    return np.array(each)


def _bias(bodies, contact, force, torque):
    (a,), (b,), (n,) = contact.body_a, contact.body_b, contact.normal
    curved = contact.feature is not None and contact.feature[0] == "curved"
    p_a, p_b = (
        contact.point if curved else x for x in (contact.point_a, contact.point_b)
    )
    velocity_a, acceleration_a = _free_motion(bodies, a, p_a[0], force, torque)
    velocity_b, acceleration_b = _free_motion(bodies, b, p_b[0], force, torque)
    relative = velocity_a - velocity_b
    b_i = (acceleration_a - acceleration_b) @ n
    if curved:
        turn = bodies.angular_velocity
        carried = 2 * relative @ np.cross(turn[b], n)
        return b_i + carried + _curvature(contact, relative, turn[a] - turn[b])
    n_dot = normal_rate(bodies, contact)[0]
    return b_i + 2 * relative @ n_dot - contact.separation[0] * (n_dot @ n_dot)


def _free_motion(bodies, body, point, force, torque):
    """Velocity and acceleration of a material point without contact forces."""
    if bodies.fixed[body]:
        return np.zeros(3), np.zeros(3)
    arm, omega = point - bodies.position[body], bodies.angular_velocity[body]
    omega_dot = formulas.angular_acceleration_free(
        bodies.world_inverse_inertia[body],
        bodies.angular_momentum[body],
        omega,
        np.asarray(torque)[body],
    )
    v_dot = np.asarray(force)[body] / bodies.mass[body]
    velocity = formulas.point_velocity(bodies.velocity[body], omega, arm)
    return velocity, formulas.free_point_acceleration(v_dot, omega_dot, omega, arm)


def _curvature(contact, relative, omega):
    """s'K_A s + 2 u.s - (u + K_A s)'(K_A + K_B)^-1 (u + K_A s), omega = omega_A -
    omega_B."""
    plane = tangents(contact.normal)[0]
    k_a, k_b = (
        plane @ k[0] @ plane.T for k in (contact.curvature_a, contact.curvature_b)
    )
    s, u = plane @ relative, plane @ np.cross(omega, contact.normal[0])
    rolled = u + k_a @ s
    return s @ k_a @ s + 2 * u @ s - rolled @ np.linalg.pinv(k_a + k_b) @ rolled
