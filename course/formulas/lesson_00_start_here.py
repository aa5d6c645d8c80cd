"""Lesson 00, Start here: one dot product over the last axis."""

import numpy as np


def speed_along(velocity, normal):
    """Speed along a normal, above 0 leaving and below 0 coming.

    v.n    (syllabus row 19, whose separation d changes by it)

    velocity and unit normal (..., 3) [m/s, 1]; returns (...) [m/s].
    Source: the definition of a projection.
    """
    return np.sum(velocity * normal, axis=-1)
