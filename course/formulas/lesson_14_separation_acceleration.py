"""Lesson 14, The acceleration of the separation: d_ddot, and b without contact forces."""

import numpy as np


def top_acceleration(a_y, alpha, omega, theta, ell):
    """Second rate d_ddot of the gap of a ladder's top to the wall, as an expression.

    d_ddot of d = -y - (ell/2) cos(theta)    (syllabus rows 20 and 23)

    a_y [m/s^2], alpha [rad/s^2] and omega [rad/s] the rates of v_y, omega and theta,
    length ell [m]; returns [m/s^2].
    Source: the chain rule.
    """
    import sympy as sp

    return -a_y + ell / 2 * (alpha * sp.sin(theta) + omega**2 * sp.cos(theta))


def free_point_acceleration(acceleration, angular_acceleration, angular_velocity, arm):
    """Acceleration of a point of a turning body.

    p_ddot = v_dot + omega_dot x r + omega x (omega x r)    (syllabus row 23)

    all (..., 3) [m/s^2, rad/s^2, rad/s, m]; returns (..., 3) [m/s^2].
    Source: Goldstein, "Classical Mechanics", section 4.9, used twice.
    """
    inward = np.cross(angular_velocity, np.cross(angular_velocity, arm))
    return acceleration + np.cross(angular_acceleration, arm) + inward


def contact_bias(p, n, face, body_a, body_b):
    """Bias b: d_ddot without contact forces, at a face, where the points coincide.

    b = (p_A_ddot - p_B_ddot).N + 2 (p_A_dot - p_B_dot).N_dot
    (syllabus rows 20, 23 and 24, misprints 7 and 8)

    point p and normal n (..., 3) [m, 1], face "face_b" or "face_a", each body
    (x, v, omega, v_dot, omega_dot) of (..., 3); returns (...) [m/s^2].
    Source: Baraff, "Rigid body simulation II", SIGGRAPH 1997 course notes.
    """
    x_a, v_a, omega_a, v_a_dot, omega_a_dot = body_a
    x_b, v_b, omega_b, v_b_dot, omega_b_dot = body_b
    r_a, r_b = p - x_a, p - x_b
    p_a_dot, p_b_dot = v_a + np.cross(omega_a, r_a), v_b + np.cross(omega_b, r_b)
    p_a_ddot = free_point_acceleration(v_a_dot, omega_a_dot, omega_a, r_a)
    p_b_ddot = free_point_acceleration(v_b_dot, omega_b_dot, omega_b, r_b)
    n_dot = np.cross(omega_b if face == "face_b" else omega_a, n)
    return np.sum((p_a_ddot - p_b_ddot) * n + 2 * (p_a_dot - p_b_dot) * n_dot, axis=-1)


def separation_acceleration(p_a, p_b, body_a, body_b, n, n_dot, n_ddot):
    """Second rate d_ddot of the separation of two points that are fixed to their bodies.

    d_ddot = (p_A - p_B).N_ddot + 2 (p_A_dot - p_B_dot).N_dot + (p_A_ddot - p_B_ddot).N
    (syllabus row 20, misprint 7)

    points (..., 3) [m], each body (x, v, omega, v_dot, omega_dot) of (..., 3), n with
    its rates n_dot and n_ddot (..., 3) [1, 1/s, 1/s^2]; returns (...) [m/s^2].
    Source: the product rule on d = (p_A - p_B).N, twice. No exercise asks for it:
    contact_bias is what is left of it where the points coincide.
    """
    x_a, v_a, omega_a, v_a_dot, omega_a_dot = body_a
    x_b, v_b, omega_b, v_b_dot, omega_b_dot = body_b
    r_a, r_b = p_a - x_a, p_b - x_b
    p_a_dot, p_b_dot = v_a + np.cross(omega_a, r_a), v_b + np.cross(omega_b, r_b)
    p_a_ddot = free_point_acceleration(v_a_dot, omega_a_dot, omega_a, r_a)
    p_b_ddot = free_point_acceleration(v_b_dot, omega_b_dot, omega_b, r_b)
    turning = (p_a - p_b) * n_ddot + 2 * (p_a_dot - p_b_dot) * n_dot
    return np.sum(turning + (p_a_ddot - p_b_ddot) * n, axis=-1)


def angular_acceleration_free(
    inverse_inertia, angular_momentum, angular_velocity, torque
):
    """Angular acceleration without contact forces.

    omega_dot = I^-1 (tau + L x omega)    (syllabus row 23, misprint 9)

    I^-1 in world axes (..., 3, 3) [1/(kg m^2)], L, omega and tau (..., 3)
    [kg m^2/s, rad/s, N m]; returns (..., 3) [rad/s^2].
    Source: Goldstein, "Classical Mechanics", section 5.5.
    """
    gyroscopic = np.cross(angular_momentum, angular_velocity)
    return np.einsum("...ij,...j->...i", inverse_inertia, torque + gyroscopic)
