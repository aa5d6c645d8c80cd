"""Vectors (3, n) and quaternions (4, n), components first: the arithmetic inside a
step.

With one component per row, a NumPy call handles that component of all bodies, and no
call gathers across rows. Nothing is checked here: the input was checked when the
``Bodies`` were made.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array

_SECOND, _THIRD = np.array([1, 2, 0]), np.array([2, 0, 1])

#: Up to this size a NumPy call costs more than its arithmetic: fewer calls matter, not
#: fewer copies.
_FEW = 256


def cross(a: Array, b: Array) -> Array:
    """a x b of the first three components, (3, n)."""
    if b.shape[1] <= _FEW:
        return a[_SECOND] * b[_THIRD] - a[_THIRD] * b[_SECOND]
    result = np.empty((3, b.shape[1]))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.multiply(a[j], b[k], out=result[i])
        result[i] -= a[k] * b[j]
    return result


def multiplied(first: Array, second: Array) -> Array:
    """The product of quaternions, R(first) R(second), (4, n)."""
    result = first[3] * second
    vector = result[:3]
    vector += second[3] * first[:3]
    vector += cross(first, second)
    result[3] -= np.einsum("in,in->n", first[:3], second[:3])
    return result


def conjugated(q: Array) -> Array:
    """The inverse rotation, (4, n)."""
    result = -q
    result[3] = q[3]
    return result


def rotated(q: Array, v: Array) -> Array:
    """R(q) v for unit quaternions: v + 2 w (u x v) + 2 u x (u x v) with q = (u, w), (3,
    n).
    """
    twice = cross(q, v)
    twice += twice
    result = cross(q, twice)
    twice *= q[3]
    result += twice
    result += v
    return result


def turn_about(rotation_vector: Array) -> Array:
    """A quaternion that turns by |theta| about theta, of any length but 0, (4, n).

    (theta tan(|theta|/2)/|theta|, 1): one trigonometric function instead of two;
    ``normalized`` after the product makes the length 1.
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
