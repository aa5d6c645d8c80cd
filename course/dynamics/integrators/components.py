"""Vectors (3, n) and quaternions (4, n) with their components first: the arithmetic inside a step.

With a component a row, one NumPy call treats that component of all bodies,
and no call gathers across rows. Nothing is checked here: what comes in was
checked when the ``Bodies`` were made.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array

_CYCLE = ((0, 1, 2), (1, 2, 0), (2, 0, 1))


def cross(a: Array, b: Array) -> Array:
    """a x b, (3, n)."""
    result = np.empty(b.shape)
    for i, j, k in _CYCLE:
        np.multiply(a[j], b[k], out=result[i])
        result[i] -= a[k] * b[j]
    return result


def multiplied(first: Array, second: Array) -> Array:
    """The product of quaternions, first after second: R(first) R(second), (4, n)."""
    a, b, a_w, b_w = first, second, first[3], second[3]
    result = np.empty(second.shape)
    for i, j, k in _CYCLE:
        row = result[i]
        np.multiply(a_w, b[i], out=row)
        row += b_w * a[i]
        row += a[j] * b[k]
        row -= a[k] * b[j]
    row = result[3]
    np.multiply(a_w, b_w, out=row)
    for i in range(3):
        row -= a[i] * b[i]
    return result


def conjugated(q: Array) -> Array:
    """The opposite turn, (4, n)."""
    result = -q
    result[3] = q[3]
    return result


def rotated(q: Array, v: Array) -> Array:
    """R(q) v for unit quaternions: v + 2 w (u x v) + 2 u x (u x v) with q = (u, w), (3, n)."""
    twice = cross(q, v)
    twice += twice
    result = cross(q, twice)
    twice *= q[3]
    result += twice
    result += v
    return result


def turn_about(rotation_vector: Array) -> Array:
    """A quaternion that turns by |theta| about theta, (theta tan(|theta|/2)/|theta|, 1): of any length but 0, (4, n).

    One trigonometric function instead of two; ``normalized`` after the product makes the length 1.
    """
    half = 0.5 * np.sqrt(np.einsum("in,in->n", rotation_vector, rotation_vector))
    np.maximum(half, 1e-150, out=half)  # where nothing turns the factor below is 1/2
    result = np.empty((4, half.size))
    np.multiply(rotation_vector, 0.5 * np.tan(half) / half, out=result[:3])
    result[3] = 1.0
    return result


def normalized(q: Array) -> Array:
    """q / |q|, (4, n)."""
    return q / np.sqrt(np.einsum("in,in->n", q, q))
