"""Lesson 01, Contact and colliders: what two bodies are to each other, and what stands for them.

A program that steps through time asks how far two bodies are apart, and how fast that
changes, and answers with a word. It asks colliders, simple shapes that are carried along
with the pictures they stand for.
"""

import numpy as np


def hidden_drop(s, g):
    """The highest drop whose landing a tolerance of speed takes for rest, as an expression.

    y = s^2/(2 g): after a fall from y at rest the speed is s    (syllabus row 1)

    s tolerance [m/s], g [m/s^2], both above 0; returns [m].
    Source: s = g t and y = g t^2/2, without t.
    """
    return s**2 / (2 * g)


def contact_state(gap, gap_rate, slip_speed, tolerance):
    """What two bodies are to each other, in a word.

    by the gap d: "apart" above the distance, "penetrating" below its negative; else they
    touch, and by d_dot: "colliding" below minus the speed, "separating" above it; else
    "sliding" where they slip faster than the speed, or "resting"    (syllabus row 1)

    gap d (...) [m], gap_rate d_dot (...) [m/s], slip_speed (...) [m/s], not below 0;
    tolerance: a distance [m] and a speed [m/s]; returns (...) of str. What lies on a
    tolerance is within it. A step h of gravity g makes at least g h of the speed due.
    Source: Baraff, "Physically Based Modeling", SIGGRAPH 1997 course notes, section G8.
    """
    distance, speed = tolerance
    asked = [
        gap > distance,
        gap < -distance,
        gap_rate < -speed,
        gap_rate > speed,
        slip_speed > speed,
    ]
    words = ["apart", "penetrating", "colliding", "separating", "sliding"]
    return np.select(asked, words, default="resting")


def place(points, rotation, translation):
    """Points of a body where the body is: turned about its origin, then shifted.

    p = R q + x_A    (syllabus row 2)

    points q (..., m, 3) in body axes [m], rotation R (..., 3, 3), whose columns are the
    body's axes, translation x_A (..., 3) [m]; returns p (..., m, 3) [m].
    Source: Goldstein, Poole, Safko, "Classical Mechanics", chapter 4.
    """
    turned = points @ np.swapaxes(rotation, -1, -2)
    return turned + translation[..., None, :]


def tightness(collider_volume, visual_volume):
    """The share of a collider that is filled by what it stands for.

    tightness = V_visual/V_collider: 1 without any air    (syllabus row 1)

    volumes (...) [m^3], above 0, of a collider that encloses the visual; returns (...)
    from 0 to 1.
    Source: Ericson, "Real-Time Collision Detection", section 4.1.
    """
    return visual_volume / collider_volume
