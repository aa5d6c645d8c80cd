"""Vectors (3, n) and quaternions (4, n) with their components first: the arithmetic inside a step.

With a component a row, one NumPy call treats that component of all bodies,
and no call gathers across rows. Nothing is checked here: what comes in was
checked when the ``Bodies`` were made.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array


def cross(a: Array, b: Array) -> Array:
    """a x b, (3, n)."""
    result = np.empty(b.shape)
    result[0] = a[1] * b[2] - a[2] * b[1]
    result[1] = a[2] * b[0] - a[0] * b[2]
    result[2] = a[0] * b[1] - a[1] * b[0]
    return result


def multiplied(first: Array, second: Array) -> Array:
    """The product of quaternions, first after second: R(first) R(second), (4, n)."""
    ax, ay, az, aw = first
    bx, by, bz, bw = second
    result = np.empty(second.shape)
    result[0] = aw * bx + bw * ax + ay * bz - az * by
    result[1] = aw * by + bw * ay + az * bx - ax * bz
    result[2] = aw * bz + bw * az + ax * by - ay * bx
    result[3] = aw * bw - ax * bx - ay * by - az * bz
    return result


def conjugated(q: Array) -> Array:
    """The opposite turn, (4, n)."""
    result = -q
    result[3] = q[3]
    return result


def rotated(q: Array, v: Array) -> Array:
    """R(q) v for unit quaternions: v + 2 w (u x v) + 2 u x (u x v) with q = (u, w), (3, n)."""
    u = q[:3]
    twice = cross(u, v)
    twice += twice
    return v + q[3] * twice + cross(u, twice)


def exponential(rotation_vector: Array) -> Array:
    """The unit quaternion of a turn by |theta| about theta, (4, n)."""
    half = 0.5 * np.sqrt(np.einsum("in,in->n", rotation_vector, rotation_vector))
    result = np.empty((4, half.size))
    result[:3] = rotation_vector * (0.5 * np.sinc(half / np.pi))
    result[3] = np.cos(half)
    return result


def normalized(q: Array) -> Array:
    """q / |q|, (4, n)."""
    return q / np.sqrt(np.einsum("in,in->n", q, q))
