"""Impulses at the contacts of bodies that turn as well.

n points out of body B toward body A, and an impulse p_hat >= 0 pushes A along +n and B
along -n. Bodies that part, or touch without approaching, exchange no impulse.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from course import formulas
from course.arrays import Array, ArrayLike, broadcast, in_range, scalars, vectors
from course.dynamics.bodies import Bodies
from course.dynamics.contact_points import ContactPoints


def point_velocity(
    velocity: ArrayLike, angular_velocity: ArrayLike, arm: ArrayLike
) -> Array:
    """Velocity of a point of a turning body: v + omega x r (syllabus row 22).

    Args:
        velocity: of the centre of mass, (..., 3) [m/s].
        angular_velocity: omega, (..., 3) [rad/s].
        arm: r, from the centre of mass to the point, (..., 3) [m].
    """
    v, omega = (
        vectors("velocity", velocity),
        vectors("angular_velocity", angular_velocity),
    )
    r = vectors("arm", arm)
    broadcast(velocity=(v, 1), angular_velocity=(omega, 1), arm=(r, 1))
    return formulas.point_velocity(v, omega, r)


def normal_velocity(bodies: Bodies, contacts: ContactPoints) -> Array:
    """Normal velocity of each contact; below 0 the bodies approach there.

    u = (v_A + omega_A x r_A - v_B - omega_B x r_B).n (syllabus rows 20 and 22). It is
    the rate of the separation, d_dot: ``course.contact.separation_rate``.

    Returns:
        u, (c,) [m/s].
    """
    contacts.require_bodies(len(bodies))
    v, omega = bodies.velocity, bodies.angular_velocity
    # The difference comes first: a common velocity then adds no rounding.
    relative = v[contacts.body_a] - v[contacts.body_b]
    for body, point, sign in contacts.sides:
        relative += sign * np.cross(omega[body], point - bodies.position[body])
    return np.sum(relative * contacts.normal, axis=-1)


def effective_mass(bodies: Bodies, contacts: ContactPoints) -> Array:
    """Effective mass: what each contact's impulse feels along n.

    1/mu = 1/m_A + 1/m_B + (r_A x n).I_A^-1 (r_A x n) + (r_B x n).I_B^-1 (r_B x n)
    (D. Baraff, "An introduction to physically based modeling: rigid body
    simulation II", SIGGRAPH 1997 course notes, the impulse of colliding
    contact; without rotation it is the denominator of syllabus row 17).

    Returns:
        mu, (c,) [kg]; infinity between two fixed bodies.
    """
    contacts.require_bodies(len(bodies))
    inverse = np.zeros(contacts.body_a.size)
    for body, point, _ in contacts.sides:
        lever = np.cross(point - bodies.position[body], contacts.normal)
        turning = np.einsum(
            "ci,cij,cj->c", lever, bodies.world_inverse_inertia[body], lever
        )
        inverse += bodies.inverse_mass[body] + turning
    return np.divide(
        1.0, inverse, out=np.full(inverse.shape, np.inf), where=inverse > 0
    )


def impulse_at_point(
    bodies: Bodies, contacts: ContactPoints, restitution: ArrayLike
) -> Array:
    """Impulse of each contact taken on its own, for bodies that turn as well.

    p_hat = -(1 + e) u mu while u < 0, else 0, with the normal velocity u and
    the effective mass mu of the contact (syllabus row 17 with the point
    velocity of row 22). Where contacts share a body their impulses are not
    the answer of all together; ``course.contact.resolve_collisions`` is.

    Args:
        bodies: n bodies.
        contacts: c contacts.
        restitution: e, from 0 to 1, one number or (c,).
    Returns:
        p_hat >= 0, (c,) [N s].
    Raises:
        ValueError: restitution outside 0..1, a contact with a body that is not there.
    """
    e = in_range("restitution", restitution, 0, 1)
    mu, u = effective_mass(bodies, contacts), normal_velocity(bodies, contacts)
    broadcast(contacts=(u, 0), restitution=(e, 0))
    approaching = (u < 0) & np.isfinite(mu)
    return np.where(
        approaching, (1 + e) * np.maximum(-u, 0) * np.where(approaching, mu, 0), 0.0
    )


def apply_impulse(
    bodies: Bodies, contacts: ContactPoints, impulse: ArrayLike
) -> Bodies:
    """The bodies after all these impulses at once.

    p_A' = p_A + p_hat n, L_A' = L_A + r_A x p_hat n, and the opposite for B (syllabus
    rows 16 and 22). Fixed bodies do not change.

    Args:
        impulse: p_hat of each contact, (c,) [N s].
    """
    contacts.require_bodies(len(bodies))
    p_hat = scalars("impulse", impulse)
    broadcast(contacts=(contacts.normal, 1), impulse=(p_hat, 0))
    push = p_hat[..., None] * contacts.normal
    momentum, angular = bodies.momentum.copy(), bodies.angular_momentum.copy()
    for body, point, sign in contacts.sides:
        free = ~bodies.fixed[body]
        lever = np.cross(point - bodies.position[body], push)
        np.add.at(momentum, body[free], sign * push[free])
        np.add.at(angular, body[free], sign * lever[free])
    return replace(bodies, momentum=momentum, angular_momentum=angular)
