"""Lesson 15, The contact matrix: A, what contact forces add to d_ddot.

contacts are (body_a, body_b, point, normal): indices (c,), points and normals (c, 3).
bodies are (mass, inverse_inertia, rotation, position): (n,), I^-1 in body axes and
rotations (n, 3, 3), centres of mass (n, 3). A unit of force at contact j pushes its
body A along +N_j and its body B along -N_j.
"""

import numpy as np


def ladder_entry(mass, theta, ell):
    """Contact matrix entry of a ladder's top on its foot, as an expression.

    a_12 = w_1 w_2 / I,  w_1 = -(ell/2) cos(theta),  w_2 = (ell/2) sin(theta)
    (syllabus rows 21 and 24)

    mass [kg], theta from the floor, length ell [m], I = mass ell^2/12; returns [1/kg].
    Source: contact_matrix_entry, for a ladder between floor and wall.
    """
    import sympy as sp

    return -3 * sp.sin(theta) * sp.cos(theta) / mass


def point_response(mass, inverse_inertia, arm, push_arm, push):
    """Acceleration that a force at one point of a body gives another of its points.

    F/m + (I^-1 (r_j x F)) x r_i    (syllabus row 24, misprint 11)

    mass (...) [kg], I^-1 in world axes (..., 3, 3) [1/(kg m^2)], arm r_i of the point
    that answers, push_arm r_j of the one that is pushed, push F, each (..., 3)
    [m, m, N]; returns (..., 3) [m/s^2].
    Source: Baraff, "Rigid body simulation II", SIGGRAPH 1997 course notes.
    """
    omega_dot = np.einsum("...ij,...j->...i", inverse_inertia, np.cross(push_arm, push))
    return push / np.asarray(mass)[..., None] + np.cross(omega_dot, arm)


def contact_matrix_entry(i, j, contacts, bodies):
    """Contact matrix entry a_ij: what a unit of force at j adds to d_ddot of contact i.

    a_ij = the sum over bodies that both contacts share of +-N_i.(point response to
    +-N_j), minus for a body B
    (syllabus rows 21, 22 and 24, misprint 11)

    i and j from 0, contacts and bodies as above; returns [1/kg].
    Source: Baraff, "Rigid body simulation II", SIGGRAPH 1997 course notes.
    """
    body_a, body_b, point, normal = contacts
    mass, inverse_inertia, rotation, position = bodies
    a_ij = 0.0
    for body, sign in ((body_a[i], 1), (body_b[i], -1)):
        for pushed, push_sign in ((body_a[j], 1), (body_b[j], -1)):
            if body == pushed:
                world = rotation[body] @ inverse_inertia[body] @ rotation[body].T
                arm, push_arm = point[i] - position[body], point[j] - position[body]
                push = push_sign * normal[j]
                answer = point_response(mass[body], world, arm, push_arm, push)
                a_ij += sign * normal[i] @ answer
    return a_ij


def contact_matrix(contacts, bodies):
    """Contact matrix A, by the Jacobian J of the separations.

    A = J M^-1 J',  row i of J: +-(N_i, r_i x N_i) in the six columns of each body
    (syllabus rows 21, 22 and 24)

    contacts and bodies as above; returns (c, c) [1/kg].
    Source: Catto, "Iterative Dynamics with Temporal Coherence", 2005.
    """
    body_a, body_b, point, normal = contacts
    mass, inverse_inertia, rotation, position = bodies
    J = np.zeros((len(point), len(mass), 6))
    for body, sign in ((body_a, 1), (body_b, -1)):
        lever = np.cross(point - position[body], normal)
        J[np.arange(len(point)), body] = sign * np.concatenate([normal, lever], axis=-1)
    world = rotation @ inverse_inertia @ np.swapaxes(rotation, -1, -2)
    turned = np.einsum("nij,cnj->cni", world, J[..., 3:])
    weighed = np.concatenate([J[..., :3] / mass[:, None], turned], axis=-1)
    return J.reshape(len(point), -1) @ weighed.reshape(len(point), -1).T
