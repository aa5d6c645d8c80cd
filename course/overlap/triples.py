"""Vectors as triples of numbers, for kernels: the compiler keeps these in registers, but allocates small arrays.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

from course.arrays import Array
from course.jit import compiled

Triple = tuple[float, float, float]


@compiled
def row(array: Array, i: int) -> Triple:
    """Row i of an array (n, 3)."""
    return array[i, 0], array[i, 1], array[i, 2]


@compiled
def minus(a: Triple, b: Triple) -> Triple:
    """a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@compiled
def along(a: Triple, s: float, u: Triple) -> Triple:
    """a + s u."""
    return a[0] + s * u[0], a[1] + s * u[1], a[2] + s * u[2]


@compiled
def dot(a: Triple, b: Triple) -> float:
    """a.b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def cross(a: Triple, b: Triple) -> Triple:
    """a x b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


@compiled
def length(a: Triple) -> float:
    """|a|."""
    return math.sqrt(dot(a, a))


@compiled
def scaled(s: float, a: Triple) -> Triple:
    """s a."""
    return s * a[0], s * a[1], s * a[2]


@compiled
def across(a: Triple) -> Triple:
    """A unit vector at right angles to a, which is not zero; the same every time."""
    x, y, z = abs(a[0]), abs(a[1]), abs(a[2])
    if x <= y and x <= z:
        side = cross(a, (1.0, 0.0, 0.0))
    elif y <= z:
        side = cross(a, (0.0, 1.0, 0.0))
    else:
        side = cross(a, (0.0, 0.0, 1.0))
    return scaled(1.0 / length(side), side)


def warm() -> None:
    """Compile the kernels."""
    import numpy as np

    a = row(np.ones((1, 3)), 0)
    length(minus(along(a, 2.0, cross(a, across(a))), scaled(2.0, a)))
