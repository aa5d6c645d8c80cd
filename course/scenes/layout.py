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
    none = np.zeros((len(position), 3))
    masses = np.broadcast_to(mass, len(position))
    level = rotations.identity(len(position))
    standing = Bodies(masses, inertia, position, level, none, none)
    return Bodies.concatenate([standing, fixed_body(-UP)])


def fixed_body(position: ArrayLike = (0.0, 0.0, 0.0)) -> Bodies:
    """One body that does not move, at (3,) [m]: a ground, a floor, a frame."""
    return Bodies.balls(np.inf, 1.0, np.reshape(position, (1, 3)))


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
