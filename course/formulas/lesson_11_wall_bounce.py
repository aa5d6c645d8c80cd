"""Lesson 11, The wall bounce: a body against a wall at rest, and a bouncing ball."""

import numpy as np


def rest_time(h, e, g):
    """Time from the drop until a bouncing ball rests, as an expression.

    t_0 (1 + 2 e/(1 - e)),  t_0 = sqrt(2 h/g)    (from syllabus rows 17 and 18)

    height h [m], restitution e below 1, gravity g [m/s^2]; returns [s].
    Source: the geometric series of the flights, each e times as long as the one before.
    """
    import sympy as sp

    return sp.sqrt(2 * h / g) * (1 + 2 * e / (1 - e))


def wall_bounce(velocity, normal, restitution):
    """Wall bounce: the velocity after the impact, unchanged unless the body comes in.

    v' = v - (1 + e) (v.n) n while v.n < 0    (syllabus row 18 has e = 1; misprint 4)

    velocity and unit normal out of the wall (..., 3) [m/s, 1], restitution (...);
    returns (..., 3) [m/s].
    Source: the impulse of row 17 with 1/m2 = 0 and v2 = 0.
    """
    along = np.sum(velocity * normal, axis=-1)[..., None]
    after = velocity - (1 + np.asarray(restitution)[..., None]) * along * normal
    return np.where(along < 0, after, velocity)


def bounce_times(height, restitution, count, gravity):
    """Bounce times: those of the first impacts of a dropped ball.

    t_k = t_0 (2 (1 + e + ... + e^k) - 1),  t_0 = sqrt(2 h/g)    (from syllabus row 18)

    Every flight goes up and down, and so counts twice, but the first only falls.

    height (...) [m], restitution (...), count a number, gravity (...) [m/s^2]; returns
    (..., count) [s].
    Source: the geometric series of the flights, each e times as long as the one before.
    """
    fall = np.sqrt(2 * np.asarray(height) / gravity)
    powers = np.asarray(restitution)[..., None] ** np.arange(count)
    return fall[..., None] * (2 * np.cumsum(powers, axis=-1) - 1)


def bouncing_ball_step(height, velocity, step, restitution, gravity):
    """One fixed step of a bouncing ball over a floor: bounce or fall, then move.

    v' = -e v where x < 0 and v < 0, else v - g h;  x' = x + h v'
    (from syllabus row 18)

    height of the lowest point (...) [m], velocity upward (...) [m/s], step [s],
    restitution and gravity [m/s^2] numbers; returns height and velocity.
    Source: Hairer, Lubich and Wanner, "Geometric Numerical Integration", section I.1,
    with the wall law put before the step.
    """
    hits = (height < 0) & (velocity < 0)
    after = np.where(hits, -restitution * velocity, velocity - gravity * step)
    return height + step * after, after
