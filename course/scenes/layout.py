"""What the makers of scenes share: a ground, contacts that touch, inertias of boxes."""

from __future__ import annotations

import numpy as np

from course import rotations
from course.arrays import Array, ArrayLike
from course.dynamics import Bodies
from course.overlap import Contacts

UP = np.array([0.0, 0.0, 1.0])


def with_ground(mass: ArrayLike, inertia: Array, position: Array) -> Bodies:
    """Bodies at rest and, last, a fixed one."""
    n = len(position) + 1
    return Bodies(
        np.append(mass, np.inf),
        np.concatenate([inertia, np.eye(3)[None]]),
        np.concatenate([position, -UP[None]]),
        rotations.identity(n),
        np.zeros((n, 3)),
        np.zeros((n, 3)),
    )


def contacts_at(
    point: Array, normal: ArrayLike = UP, *, a: ArrayLike = 0, b: ArrayLike = 1
) -> Contacts:
    """Touching contacts on faces of B, at points (c, 3); normals and bodies broadcast."""
    count = len(point)
    return Contacts(
        np.broadcast_to(np.asarray(a, dtype=int), count),
        np.broadcast_to(np.asarray(b, dtype=int), count),
        point,
        np.broadcast_to(normal, (count, 3)),
        np.zeros(count),
    )


def box_inertia(mass: ArrayLike, size: ArrayLike) -> Array:
    """m/12 (y^2 + z^2, x^2 + z^2, x^2 + y^2) on the diagonal, (n, 3, 3) [kg m^2]."""
    square = np.square(np.asarray(size, dtype=float))
    moments = np.asarray(mass)[:, None] / 12 * (np.sum(square) - square)
    return np.asarray(moments[:, :, None] * np.eye(3))
