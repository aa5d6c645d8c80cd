"""Curvature tensors of the two sides of a contact: what N_dot and d_ddot of curved contacts need.

A surface turns its outward normal by K x when one moves by x over it
(``course.contact.curved``). A face has K = 0; an edge and a corner have none that is
finite, and are taken for rounded off.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, BoolArray

#: Curvature of an edge or a corner, in curvatures of the round surface that it meets: it
#: counts as rounded with 1e-10 of that one's radius. Far above 1, and far below the 1e14
#: at which ``course.contact.curved`` takes the other surface for flat.
SHARP = 1e10
#: Curvature of a sphere or capsule of radius 0 [1/m].
POINTED = 1e10


def of_radius(radius: Array) -> Array:
    """1/r, (...) [1/m]; ``POINTED`` where r is 0."""
    return np.where(radius > 0, 1.0 / np.where(radius > 0, radius, 1.0), POINTED)


def in_all_directions(curvature: Array, normal: Array) -> Array:
    """k (1 - N N'): a sphere's, with k = 1/r, or a corner's; (...) and (..., 3) to (..., 3, 3)."""
    across = np.eye(3) - normal[..., :, None] * normal[..., None, :]
    return np.asarray(curvature[..., None, None] * across)


def across_axis(curvature: Array, axis: Array, normal: Array) -> Array:
    """k c c' with c = N x axis, made a unit vector: a capsule's side, with k = 1/r, or an edge's."""
    side = np.cross(normal, axis)
    side = side / np.linalg.norm(side, axis=-1, keepdims=True)
    return np.asarray(curvature[..., None, None] * side[..., :, None] * side[..., None, :])


def of_segment(curvature: Array, axis: Array, normal: Array, at_end: BoolArray) -> Array:
    """A capsule's or an edge's: in all directions at its ends, across its axis elsewhere.

    Args:
        curvature: (k,) [1/m].
        axis: (k, 3), not read at ends.
        normal: (k, 3) unit.
        at_end: (k,).
    """
    straight = np.where(at_end[:, None], perpendicular(normal), axis)
    return np.where(
        at_end[:, None, None],
        in_all_directions(curvature, normal),
        across_axis(curvature, straight, normal),
    )


def perpendicular(normal: Array) -> Array:
    """Some vector that is not along the normal, (k, 3)."""
    return np.asarray(np.eye(3)[np.argmin(np.abs(normal), axis=-1)])
