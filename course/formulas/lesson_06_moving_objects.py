"""Lesson 06, Moving objects: when two moving solids meet, and how often a test at every
step misses it.

Two solids that overlap at the start meet at 0; two that touch meet at 0 if they
approach, and never if they part or slide; inf is never, or after the horizon.
"""

import numpy as np


def meeting_time(a, b, c):
    """When a point first is at distance r of another, as an expression.

    a t^2 + 2 b t + c = 0, first root:  t = (-b - sqrt(b^2 - a c))/a    (syllabus row 12)

    a = v.v [m^2/s^2], b = m.v [m^2/s], c = m.m - r^2 [m^2]; returns [s].
    Source: Ericson, "Real-Time Collision Detection", section 5.3.2.
    """
    import sympy as sp

    return (-b - sp.sqrt(b**2 - a * c)) / a


def swept_spheres_time(
    center_a, radius_a, velocity_a, center_b, radius_b, velocity_b, horizon
):
    """Time of impact of two spheres: a point that flies at a sphere of both radii.

    |m + v t|^2 = r^2 with m = x_A - x_B, v = v_A - v_B, r = r_A + r_B, whose first root is
    t = c/(-b + sqrt(b^2 - a c)),  a = v.v, b = m.v, c = m.m - r^2    (syllabus row 12)

    centres (..., 3) [m], radii (...) [m], velocities (..., 3) [m/s], horizon (...) [s];
    returns (...) [s], inf for those that do not meet.
    Source: Ericson, "Real-Time Collision Detection", sections 5.3.2 and 5.5.5.
    """
    m, v, r = center_a - center_b, velocity_a - velocity_b, radius_a + radius_b
    a, b = np.sum(v * v, axis=-1), np.sum(m * v, axis=-1)
    c = np.sum(m * m, axis=-1) - r**2
    inside_root = b**2 - a * c
    meets = (b < 0) & (inside_root >= 0)
    below = np.where(meets, -b + np.sqrt(np.maximum(inside_root, 0)), 1.0)
    time = np.where(c < 0, 0.0, np.where(meets, c / below, np.inf))
    return np.where(time <= horizon, time, np.inf)


def swept_boxes_time(
    lower_a, upper_a, velocity_a, lower_b, upper_b, velocity_b, horizon
):
    """Time of impact of two axis-aligned boxes: the latest axis on which they come
    together, if none is left before.

    Along each axis they overlap while l_B - u_A <= v t <= u_B - l_A, v = v_A - v_B
    (syllabus row 12)

    corners (..., 3) [m], velocities (..., 3) [m/s], horizon (...) [s]; returns (...) [s],
    inf for those that do not meet.
    Source: Ericson, "Real-Time Collision Detection", section 5.5.8.
    """
    v = velocity_a - velocity_b
    before, after = lower_b - upper_a, upper_b - lower_a
    still, between = v == 0, (before <= 0) & (after >= 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = before / v, after / v
    one = np.where(still, np.where(between, -np.inf, np.inf), one)
    other = np.where(still, np.inf, other)
    enter, leave = np.minimum(one, other), np.maximum(one, other)
    rubs = np.any(still & ((before == 0) | (after == 0)), axis=-1)
    slides = rubs & np.all(between, axis=-1)
    first, last = np.max(enter, axis=-1), np.min(leave, axis=-1)
    meets = (first <= last) & (last > 0) & (first <= horizon) & ~slides
    return np.where(meets, np.maximum(first, 0), np.inf)


def miss_probability(thickness, radius, speed, step):
    """Probability that a ball passes a wall unseen when it is looked at once a step.

    P = 1 - (t + 2 r)/(v h), 0 while v h is no more than t + 2 r    (syllabus row 12)

    thickness t and radius r (...) [m], speed v (...) [m/s], step h (...) [s]; returns
    (...).
    Source: the ball touches the wall on t + 2 r of the way v h from one look to the next.
    """
    seen, way = thickness + 2 * radius, speed * step
    return 1 - seen / np.maximum(way, seen)


def conservative_advancement(pivot, arm, omega, center, radius, horizon, tolerance):
    """Time of impact of a rod that turns about its end and a ball at rest, from below.

    t' = t + d(t)/mu,  mu = |omega| |arm|, until d <= tolerance    (syllabus row 12)

    No point of the rod is faster than mu, so that none reaches the ball before t'.

    pivot, arm from there to the other end, centre (3,) [m], omega (3,) [rad/s], radius
    [m], horizon [s], tolerance [m], above 0: with 0 its steps may never end; returns [s],
    inf if they do not meet.
    Source: Mirtich, "Impulse-based Dynamic Simulation of Rigid Body Systems", 1996.
    """
    rate, way, t = np.linalg.norm(omega), center - pivot, 0.0
    axis = omega / rate if rate > 0 else omega
    while t <= horizon:
        c, s = np.cos(rate * t), np.sin(rate * t)
        rod = c * arm + s * np.cross(axis, arm) + (1 - c) * (axis @ arm) * axis
        along = np.clip(way @ rod / (arm @ arm), 0, 1)
        gap = np.linalg.norm(way - along * rod) - radius
        if gap <= tolerance:
            return t
        t = t + gap / (rate * np.linalg.norm(arm)) if rate > 0 else np.inf
    return np.inf
