"""Lesson 13, Separation: the gap d = (p_A - p_B).N of two bodies, and its rate.

N is a unit vector out of body B toward body A; d > 0 apart, 0 touching, < 0
penetrating.
"""

import numpy as np


def top_rate(v_y, omega, theta, ell):
    """Rate d_dot of the gap between a ladder's top and the wall, as an expression.

    d_dot of d = -y - (ell/2) cos(theta)    (syllabus rows 19 and 20)

    v_y [m/s] and omega [rad/s] the rates of y and theta, length ell [m]; returns [m/s].
    Source: the chain rule.
    """
    import sympy as sp

    return -v_y + ell / 2 * omega * sp.sin(theta)


def separation(p_a, p_b, n):
    """Separation (gap, signed distance) d of two points along the normal.

    d = (p_A - p_B).N    (syllabus row 19, misprint 5)

    points and unit normal (..., 3) [m, 1]; returns (...) [m].
    Source: Baraff, "Rigid body simulation II", SIGGRAPH 1997 course notes.
    """
    return np.sum((p_a - p_b) * n, axis=-1)


def normal_rate(n, omega_a, omega_b, face):
    """Rate N_dot of a normal that a face of one of the bodies carries.

    N_dot = omega x N, with the omega of the face's body    (syllabus row 20)

    n (..., 3), omega_a and omega_b (..., 3) [rad/s], face "face_b" or "face_a"; returns
    (..., 3) [1/s].
    Source: Baraff, "Rigid body simulation II", SIGGRAPH 1997 course notes.
    """
    omega_of_face = omega_b if face == "face_b" else omega_a
    return np.cross(omega_of_face, n)


def separation_rate(p_a, p_b, body_a, body_b, n, n_dot):
    """Rate d_dot of the separation of two points that are fixed to their bodies.

    d_dot = (p_A_dot - p_B_dot).N + (p_A - p_B).N_dot
    (syllabus rows 20 and 22)

    points (..., 3) [m], each body (x, v, omega) of (..., 3) [m, m/s, rad/s], n and
    n_dot (..., 3) [1, 1/s]; returns (...) [m/s].
    Source: Baraff, "Rigid body simulation II", SIGGRAPH 1997 course notes.
    """
    x_a, v_a, omega_a = body_a
    x_b, v_b, omega_b = body_b
    p_a_dot = v_a + np.cross(omega_a, p_a - x_a)
    p_b_dot = v_b + np.cross(omega_b, p_b - x_b)
    return np.sum((p_a_dot - p_b_dot) * n + (p_a - p_b) * n_dot, axis=-1)


def edge_normal_rate(e_a, e_b, omega_a, omega_b, n):
    """Rate N_dot of the normal that two crossing edges carry together.

    N = +-q/|q|,  q = e_A x e_B;  N_dot is the part of +-q_dot/|q| across N
    (syllabus row 20)

    unit directions e_a and e_b, omega_a and omega_b, n, each (..., 3) [1, rad/s, 1];
    returns (..., 3) [1/s].
    Source: Baraff, "Rigid body simulation II", SIGGRAPH 1997 course notes.
    """
    e_a_dot, e_b_dot = np.cross(omega_a, e_a), np.cross(omega_b, e_b)
    q = np.cross(e_a, e_b)
    q_dot = np.cross(e_a_dot, e_b) + np.cross(e_a, e_b_dot)
    side = np.sign(np.sum(q * n, axis=-1))[..., None]
    rate = side * q_dot / np.linalg.norm(q, axis=-1)[..., None]
    return rate - np.sum(rate * n, axis=-1)[..., None] * n
