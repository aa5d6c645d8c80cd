"""Lesson 14: how fast the rate of a separation changes without contact forces, b."""

import numpy as np


def top_acceleration(a_y, alpha, omega, theta, ell):
    """Second rate of the gap between a ladder's top and the wall, as an expression.

    d_ddot of d = -y - (ell/2) cos(theta)    (slide rows 20 and 23)

    a_y [m/s^2], alpha [rad/s^2] and omega [rad/s] the rates of v_y, omega and theta,
    length ell [m]; returns [m/s^2].
    Source: the chain rule.
    """
    import sympy as sp

    return -a_y + ell / 2 * (alpha * sp.sin(theta) + omega**2 * sp.cos(theta))


def free_point_acceleration(acceleration, angular_acceleration, angular_velocity, arm):
    """Acceleration of a point of a turning body.

    p_ddot = v_dot + omega_dot x r + omega x (omega x r)    (slide row 23)

    all (..., 3) [m/s^2, rad/s^2, rad/s, m]; returns (..., 3) [m/s^2].
    Source: Goldstein, "Classical Mechanics", section 4.9, used twice.
    """
    inward = np.cross(angular_velocity, np.cross(angular_velocity, arm))
    return acceleration + np.cross(angular_acceleration, arm) + inward


def contact_bias(p, n, face, body_a, body_b):
    """d_ddot without contact forces, for a contact of a face whose points coincide.

    b = (p_A_ddot - p_B_ddot).N + 2 (p_A_dot - p_B_dot).N_dot
    (slide rows 20, 23 and 24, misprints 7 and 8)

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


def angular_acceleration_free(
    inverse_inertia, angular_momentum, angular_velocity, torque
):
    """Angular acceleration without contact forces.

    omega_dot = I^-1 (tau + L x omega)    (slide row 23, misprint 9)

    I^-1 in world axes (..., 3, 3) [1/(kg m^2)], L, omega and tau (..., 3)
    [kg m^2/s, rad/s, N m]; returns (..., 3) [rad/s^2].
    Source: Goldstein, "Classical Mechanics", section 5.5.
    """
    gyroscopic = np.cross(angular_momentum, angular_velocity)
    return np.einsum("...ij,...j->...i", inverse_inertia, torque + gyroscopic)
