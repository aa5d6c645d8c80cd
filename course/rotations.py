"""Orientations as unit quaternions, scalar last: a thin layer over SciPy's Rotation.

SciPy is imported where it is called, so that ``import course.dynamics`` costs
little more than ``import numpy``.
"""

from __future__ import annotations

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    rotations,
    unit_quaternions,
    vectors,
)

__all__ = [
    "from_matrix",
    "from_rotation_vector",
    "identity",
    "rotate",
    "to_matrix",
    "turned",
]


def identity(*batch: int) -> Array:
    """The identity quaternion, shape (*batch, 4)."""
    return np.broadcast_to(np.array([0.0, 0.0, 0.0, 1.0]), (*batch, 4)).copy()


def to_matrix(orientation: ArrayLike) -> Array:
    """The rotation matrix of each unit quaternion: columns are the body's axes in the
    world.

    Args:
        orientation: unit quaternions (x, y, z, w), shape (..., 4).
    Returns:
        Rotation matrices, shape (..., 3, 3).
    Raises:
        ValueError: orientation is not of unit length or of the wrong shape.
    """
    from scipy.spatial.transform import Rotation

    q = unit_quaternions("orientation", orientation)
    if not q.size:
        return np.empty((*q.shape[:-1], 3, 3))
    return Rotation.from_quat(q.reshape(-1, 4)).as_matrix().reshape(*q.shape[:-1], 3, 3)


def from_matrix(rotation: ArrayLike) -> Array:
    """The unit quaternion of each rotation matrix, (..., 3, 3) -> (..., 4), sign as
    SciPy's.
    """
    from scipy.spatial.transform import Rotation

    matrix = rotations("rotation", rotation)
    if not matrix.size:
        return np.empty((*matrix.shape[:-2], 4))
    return (
        Rotation.from_matrix(matrix.reshape(-1, 3, 3))
        .as_quat()
        .reshape(*matrix.shape[:-2], 4)
    )


def from_rotation_vector(rotation_vector: ArrayLike) -> Array:
    """The unit quaternion of a turn by ``|theta|`` about ``theta``: (sin(|theta|/2)
    theta/|theta|, cos(|theta|/2)).

    Args:
        rotation_vector: axis times angle [rad], shape (..., 3).
    """
    from scipy.spatial.transform import Rotation

    theta = vectors("rotation_vector", rotation_vector)
    if not theta.size:
        return np.empty((*theta.shape[:-1], 4))
    return (
        Rotation.from_rotvec(theta.reshape(-1, 3))
        .as_quat()
        .reshape(*theta.shape[:-1], 4)
    )


def rotate(orientation: ArrayLike, vector: ArrayLike) -> Array:
    """Body axes to world axes: R(q) x, broadcast over both, shape (..., 3)."""
    matrix, x = to_matrix(orientation), vectors("vector", vector)
    broadcast(orientation=(matrix, 2), vector=(x, 1))
    return np.einsum("...ij,...j->...i", matrix, x)


def turned(orientation: ArrayLike, rotation_vector: ArrayLike) -> Array:
    """The exponential map: each orientation turned further by a rotation vector in
    world axes.

    q' = exp(theta/2) q, which is exact while omega stays constant, with
    theta = omega h. The product is brought back to unit length, so that
    rounding does not add up over many steps.

    Args:
        orientation: unit quaternions, shape (..., 4).
        rotation_vector: axis times angle [rad], world axes, shape (..., 3).
    Returns:
        Unit quaternions, the shapes broadcast.
    """
    q = unit_quaternions("orientation", orientation)
    turn = from_rotation_vector(rotation_vector)
    broadcast(orientation=(q, 1), rotation_vector=(turn, 1))
    turn, q = np.broadcast_arrays(turn, q)
    axis, w = turn[..., :3], turn[..., 3:]
    product = np.empty(q.shape)
    product[..., :3] = w * q[..., :3] + q[..., 3:] * axis + np.cross(axis, q[..., :3])
    product[..., 3:] = w * q[..., 3:] - np.sum(
        axis * q[..., :3], axis=-1, keepdims=True
    )
    return product / np.linalg.norm(product, axis=-1, keepdims=True)


def angle_between(one: Array, other: Array) -> Array:
    """The angle of the turn that takes one rotation matrix to the other, (...) [rad]; exact for small ones too.

    With Q = other' one: tan angle = |Q - Q'|/(2 sqrt 2) over (tr Q - 1)/2.

    Args:
        one, other: (..., 3, 3).
    """
    apart = np.swapaxes(other, -1, -2) @ one
    skew = np.linalg.norm(apart - np.swapaxes(apart, -1, -2), axis=(-2, -1))
    cosine = 0.5 * (np.trace(apart, axis1=-2, axis2=-1) - 1.0)
    return np.asarray(np.arctan2(0.5 * skew / np.sqrt(2.0), cosine))
