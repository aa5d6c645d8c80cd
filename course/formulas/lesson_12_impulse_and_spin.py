"""Lesson 12, Impulse and spin: impulses on bodies that turn, and many contacts.

n is a unit vector out of body 2 toward body 1; arms run from the centre of mass to the
contact; inertia tensors are inverted, in world axes, and zero for a fixed body.
"""

import numpy as np


def rod_impulse(m, v, theta, e, ell):
    """Impulse of the floor on the end of a falling rod, as an expression.

    (1 + e) v / (1/m + (ell/2 cos(theta))^2 / I),  I = m ell^2/12
    (syllabus rows 17 and 22)

    mass m [kg], speed v [m/s], angle theta from the horizontal, length ell [m];
    returns [N s].
    Source: effective_mass, for a rod on a floor.
    """
    import sympy as sp

    return (1 + e) * v / (1 / m + (ell / 2 * sp.cos(theta)) ** 2 / (m * ell**2 / 12))


def point_velocity(velocity, angular_velocity, arm):
    """Velocity of a point of a turning body.

    p_dot = v + omega x r    (syllabus row 22)

    velocity, angular_velocity and arm (..., 3) [m/s, rad/s, m]; returns (..., 3) [m/s].
    Source: Baraff, "Rigid body simulation I", SIGGRAPH 1997 course notes.
    """
    return velocity + np.cross(angular_velocity, arm)


def effective_mass(
    inverse_mass_1,
    inverse_mass_2,
    inverse_inertia_1,
    inverse_inertia_2,
    arm_1,
    arm_2,
    normal,
):
    """Effective mass: what an impulse along n feels at a contact of turning bodies.

    1/mu = 1/m1 + 1/m2 + sum of (r x n).I^-1 (r x n) over both bodies
    (syllabus row 17, the first two terms; row 22, what is behind the others)

    inverse masses (...) [1/kg], inverse inertias (..., 3, 3) [1/(kg m^2)], arms and
    normal (..., 3) [m, 1]; returns (...) [kg].
    Source: Baraff, "Rigid body simulation II", SIGGRAPH 1997 course notes.
    """
    inverse = inverse_mass_1 + inverse_mass_2
    sides = (inverse_inertia_1, arm_1), (inverse_inertia_2, arm_2)
    for inverse_inertia, arm in sides:
        lever = np.cross(arm, normal)
        turned = (inverse_inertia @ lever[..., None])[..., 0]
        inverse = inverse + np.sum(lever * turned, axis=-1)
    return 1 / inverse


def impulse_at_point(
    point_velocity_1, point_velocity_2, normal, mass_felt, restitution
):
    """Impulse at a contact point taken on its own, 0 unless its points approach.

    p_hat = -(1 + e) u mu,  u = (p1_dot - p2_dot).n
    (syllabus rows 17 and 22)

    velocities of the two points and normal (..., 3) [m/s, 1], mass_felt (...) [kg],
    restitution (...); returns (...) [N s].
    Source: Baraff, "Rigid body simulation II", SIGGRAPH 1997 course notes.
    """
    u = np.sum((point_velocity_1 - point_velocity_2) * normal, axis=-1)
    return np.where(u < 0, -(1 + restitution) * u * mass_felt, 0.0)


def apply_impulse(
    velocity, angular_velocity, inverse_mass, inverse_inertia, arm, normal, impulse
):
    """Velocity and angular velocity after an impulse p_hat n at the end of the arm.

    v' = v + p_hat n / m,  omega' = omega + I^-1 (r x p_hat n)
    (syllabus rows 16 and 22)

    velocities, arm and normal (..., 3) [m/s, rad/s, m, 1], inverse_mass (...) [1/kg],
    inverse_inertia (..., 3, 3) [1/(kg m^2)], impulse (...) [N s]; returns two (..., 3).
    Source: Baraff, "Rigid body simulation II", SIGGRAPH 1997 course notes.
    """
    push = np.asarray(impulse)[..., None] * normal
    moved = np.asarray(inverse_mass)[..., None] * push
    turned = (inverse_inertia @ np.cross(arm, push)[..., None])[..., 0]
    return velocity + moved, angular_velocity + turned


def simultaneous_impulses(matrix, normal_velocity, restitution):
    """Simultaneous impulses of all contacts, by projected Gauss-Seidel sweeps.

    p >= 0,  w = A p + (1 + e) u >= 0,  p_i w_i = 0
    (syllabus rows 17 and 21)

    matrix (c, c) [1/kg], normal_velocity (c,) [m/s], restitution a number; returns
    (c,) [N s].
    Source: Cottle, Pang and Stone, "The Linear Complementarity Problem", chapter 5.
    """
    impulse = np.zeros(len(normal_velocity))
    for _ in range(500):
        for i in range(len(impulse)):
            surplus = matrix[i] @ impulse + (1 + restitution) * normal_velocity[i]
            impulse[i] = max(0.0, impulse[i] - surplus / matrix[i, i])
    return impulse
