"""Curvature tensors of spheres and capsules: what N_dot and d_ddot of curved contacts need.

A surface turns its outward normal by K x when one moves by x over it
(``course.contact.curved``): K = (1 - N N')/r on a sphere and on the ends of a capsule, and
1/r across a capsule's axis, 0 along it, on its side. A plane has K = 0.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, BoolArray

#: Curvature of a sphere or a capsule of radius 0, which is none that is finite [1/m].
POINTED = 1e9


def of_radius(radius: Array) -> Array:
    """1/r, (...) [1/m]; ``POINTED`` where r is 0."""
    return np.where(radius > 0, 1.0 / np.where(radius > 0, radius, 1.0), POINTED)


def of_sphere(radius: Array, normal: Array) -> Array:
    """(1 - N N')/r, (..., 3, 3) [1/m].

    Args:
        radius: (...) [m].
        normal: N, (..., 3) unit.
    """
    tangent = np.eye(3) - normal[..., :, None] * normal[..., None, :]
    return np.asarray(of_radius(radius)[..., None, None] * tangent)


def of_capsule(radius: Array, axis: Array, normal: Array, at_end: BoolArray) -> Array:
    """A sphere's at the ends; elsewhere c c'/r with c the unit vector along N x axis; (..., 3, 3) [1/m].

    Args:
        radius: (...) [m].
        axis: (..., 3), not along N; not read at the ends.
        normal: N, (..., 3) unit.
        at_end: (...).
    """
    side = np.where(at_end[..., None], 1.0, np.cross(normal, axis))
    side = side / np.linalg.norm(side, axis=-1, keepdims=True)
    across = (
        of_radius(radius)[..., None, None] * side[..., :, None] * side[..., None, :]
    )
    return np.where(at_end[..., None, None], of_sphere(radius, normal), across)
