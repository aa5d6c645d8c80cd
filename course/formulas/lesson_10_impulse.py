"""Lesson 10, Impulse: central impacts of two bodies that do not turn.

n is a unit vector out of body 2 toward body 1; p_hat >= 0 pushes body 1 along +n and
body 2 along -n. The bodies approach while (v1 - v2).n < 0.
"""

import numpy as np


def p_hat(m_1, m_2, v_1, v_2, e):
    """Impulse of a central impact on a line, as an expression.

    p_hat = (1 + e) (v2 - v1) / (1/m1 + 1/m2)    (syllabus row 17, misprint 3)

    m_1, m_2 [kg], v_1, v_2 [m/s] along n, e from 0 to 1; returns [N s].
    Source: the momenta of row 16 put into Newton's law of restitution.
    """
    return (1 + e) * (v_2 - v_1) / (1 / m_1 + 1 / m_2)


def momentum_after(momentum_1, momentum_2, impulse, normal):
    """Momenta after an impulse: what one body gains, the other loses.

    p1' = p1 + p_hat n,  p2' = p2 - p_hat n    (syllabus row 16)

    momenta and normal (..., 3) [kg m/s, 1], impulse (...) [N s]; returns two (..., 3).
    Source: Newton's third law over the instant of an impact.
    """
    change = np.asarray(impulse)[..., None] * normal
    return momentum_1 + change, momentum_2 - change


def separation_speed(velocity_1, velocity_2, normal, restitution):
    """Separation speed after a central impact, by the law of restitution.

    (v1' - v2').n = -e (v1 - v2).n while they approach, else unchanged
    (syllabus row 17, misprint 3)

    velocities and normal (..., 3) [m/s, 1], restitution (...); returns (...) [m/s].
    Source: Newton's law of restitution, "Principia", scholium to the laws of motion.
    """
    u = np.sum((velocity_1 - velocity_2) * normal, axis=-1)
    return np.where(u < 0, -restitution * u, u)


def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
    """Impulse of a central impact, of bodies that do not turn; 0 unless they approach.

    p_hat = (1 + e) (v2 - v1).n / (1/m1 + 1/m2)    (syllabus row 17, misprint 3)

    masses (...) [kg], one may be infinite; velocities and normal (..., 3) [m/s, 1],
    restitution (...); returns (...) [N s].
    Source: Baraff, "Rigid body simulation II", SIGGRAPH 1997 course notes, without
    the rotational terms.
    """
    closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)
    impulse = (1 + restitution) * closing / (1 / mass_1 + 1 / mass_2)
    return np.where(closing > 0, impulse, 0.0)


def kinetic_energy_lost(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
    """Kinetic energy that a central impact takes away, 0 unless the bodies approach.

    T_lost = mu (1 - e^2) ((v2 - v1).n)^2 / 2,  1/mu = 1/m1 + 1/m2
    (syllabus rows 15 and 17, misprint 2)

    arguments as in impulse_central; returns (...) [J].
    Source: the energy line of the slide, with the velocities after the impact put in.
    """
    closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)
    mu = 1 / (1 / mass_1 + 1 / mass_2)
    lost = 0.5 * mu * (1 - restitution**2) * closing**2
    return np.where(closing > 0, lost, 0.0)
