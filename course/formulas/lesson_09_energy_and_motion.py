"""Lesson 09, Energy and motion: kinetic energy, how bodies turn, and steps in time.

L is the angular momentum about the centre of mass. I, L and omega are in world axes,
I_body and l in those of the body; the columns of R are the body's axes in the world.
"""

import numpy as np


def sigma(I_1, I_2, I_3, Omega):
    """Growth rate of a wobble about the middle principal axis, as an expression.

    sigma = Omega sqrt((I_2 - I_1) (I_3 - I_2) / (I_1 I_3))    (syllabus row 14)

    I_1 < I_2 < I_3 [kg m^2], spin Omega [rad/s]; returns [1/s].
    Source: Landau and Lifshitz, "Mechanics", section 37.
    """
    import sympy as sp

    return Omega * sp.sqrt((I_2 - I_1) * (I_3 - I_2) / (I_1 * I_3))


def linear_kinetic_energy(p, v):
    """Linear kinetic energy, that of the motion of the centre of mass.

    T_linear = p.v / 2    (syllabus row 14)

    momentum p (..., 3) [kg m/s], velocity v (..., 3) [m/s]; returns (...) [J].
    Source: Goldstein, "Classical Mechanics", section 1.2.
    """
    return 0.5 * np.sum(p * v, axis=-1)


def angular_kinetic_energy(L, omega):
    """Angular kinetic energy, that of turning about the centre of mass.

    T_angular = L.omega / 2    (syllabus row 14)

    L (..., 3) [kg m^2/s], omega (..., 3) [rad/s]; returns (...) [J].
    Source: Goldstein, "Classical Mechanics", section 5.3.
    """
    return 0.5 * np.sum(L * omega, axis=-1)


def world_inertia(R, I_body):
    """Inertia tensor in world axes.

    I = R I_body R'    (syllabus rows 14 and 22)

    rotation R and I_body (..., 3, 3) [1, kg m^2]; returns (..., 3, 3) [kg m^2].
    Source: Baraff, "Rigid body simulation I", SIGGRAPH 1997 course notes.
    """
    return R @ I_body @ np.swapaxes(R, -1, -2)


def angular_acceleration(I, L, torque):
    """Angular acceleration by Euler's equation, in world axes.

    omega_dot = I^-1 (torque + L x omega),  omega = I^-1 L
    (syllabus row 23, misprint 10)

    I (..., 3, 3) [kg m^2], L (..., 3) [kg m^2/s], torque (..., 3) [N m]; returns
    (..., 3) [rad/s^2].
    Source: Goldstein, "Classical Mechanics", section 5.5.
    """
    omega = np.linalg.solve(I, L[..., None])[..., 0]
    return np.linalg.solve(I, (torque + np.cross(L, omega))[..., None])[..., 0]


def symplectic_euler_step(x, R, p, L, mass, I_body, force, torque, h):
    """Symplectic Euler step: the momenta, then place and orientation with the new ones.

    p' = p + h F,  L' = L + h torque,  x' = x + h p'/m,  R' = exp(h omega') R
    (the equations of motion of syllabus rows 14 and 22)

    x, p, L, force, torque (..., 3) [m, kg m/s, kg m^2/s, N, N m], R and I_body
    (..., 3, 3) [1, kg m^2], mass (...) [kg], h [s]; returns x', R', p', L'.
    Source: Hairer, Lubich and Wanner, "Geometric Numerical Integration", section I.1.
    """
    from scipy.spatial.transform import Rotation

    p, L = p + h * force, L + h * torque
    I = R @ I_body @ np.swapaxes(R, -1, -2)
    omega = np.linalg.solve(I, L[..., None])[..., 0]
    turn = Rotation.from_rotvec(h * omega).as_matrix()
    return x + h * p / np.asarray(mass)[..., None], turn @ R, p, L


def rotate(v, theta):
    """Rotation of a vector by the angle |theta| about the axis u = theta/|theta|.

    v' = cos v + sin u x v + (1 - cos) (u.v) u    (the turning of syllabus row 14)

    v (..., 3), theta (..., 3) [rad]; returns (..., 3).
    Source: Goldstein, "Classical Mechanics", section 4.7 (Rodrigues' formula).
    """
    angle = np.linalg.norm(theta, axis=-1, keepdims=True)
    u = theta / np.where(angle > 0, angle, 1.0)
    cos, sin = np.cos(angle), np.sin(angle)
    along = np.sum(u * v, axis=-1, keepdims=True) * u
    return cos * v + sin * np.cross(u, v) + (1 - cos) * along


def rk4_step(l, I_body, h):
    """Classical Runge-Kutta step (RK4) of a top that no torque acts on.

    l' = l + h/6 (k1 + 2 k2 + 2 k3 + k4),  l_dot = l x I_body^-1 l    (syllabus row 14)

    l (..., 3) [kg m^2/s] and I_body (..., 3, 3) [kg m^2] in body axes, h [s]; returns
    (..., 3) [kg m^2/s].
    Source: Hairer, Norsett and Wanner, "Solving Ordinary Differential Equations I",
    section II.1.
    """

    def rate_of(l):
        return np.cross(l, np.linalg.solve(I_body, l[..., None])[..., 0])

    k1 = rate_of(l)
    k2 = rate_of(l + h / 2 * k1)
    k3 = rate_of(l + h / 2 * k2)
    k4 = rate_of(l + h * k3)
    return l + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
