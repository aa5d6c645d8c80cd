"""Inputs and small algebra for exercises on bodies that turn.

Turned bodies whose inertia is not diagonal, L off omega, a step that is not small: each
of them tells apart mistakes that agree where it is missing. Rotations have few
decimals: those of whole quaternions of squared length 25.
"""

from __future__ import annotations

from typing import Any

import numpy as np

_WHOLE = np.array(
    [(1, 2, 2, 4), (2, 1, 4, 2), (4, 2, 1, 2), (2, 4, 2, 1), (2, 2, 4, 1), (4, 1, 2, 2)]
)


def rotation_matrices(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    q = rng.choice(_WHOLE, shape) * rng.choice([-1, 1], (*shape, 4))
    w, x, y, z = np.moveaxis(q, -1, 0)
    rows = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1)) / 25.0


# An inertia is drawn by its second moments S, positive definite: I = tr(S) 1 - S
# (Goldstein, section 5.3). A positive matrix drawn as I itself may have a principal
# moment above the sum of the other two, and no body has that.


def inertias(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """Symmetric, two decimals, unlike moments of 1.3 to 3.7 and products that are not
    zero.
    """
    upper = np.triu(rng.uniform(0.1, 0.3, (*shape, 3, 3)), 1).round(2)
    second = (np.array([1.8, 0.9, 0.4]) + rng.uniform(0.0, 0.5, (*shape, 3))).round(2)
    return (
        upper + np.swapaxes(upper, -1, -2) + _moments(second)[..., None] * np.eye(3)
    ).round(2)


def inverse_moments(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """1/I about three principal axes, two decimals, from about 0.5 to 2, all unlike."""
    return np.asarray(
        np.round(
            1 / _moments(rng.uniform([0.1, 0.4, 0.8], [0.2, 0.6, 1.2], (*shape, 3))), 2
        )
    )


def _moments(second: np.ndarray) -> np.ndarray:
    return np.asarray(second.sum(axis=-1, keepdims=True) - second)


def drawn_vectors(
    rng: np.random.Generator, shape: tuple[int, ...], size: float = 1.0
) -> np.ndarray:
    return (
        size * rng.uniform(0.3, 1.5, (*shape, 3)) * rng.choice([-1, 1], (*shape, 3))
    ).round(2)


def times(matrix: Any, vector: Any) -> np.ndarray:
    return np.einsum("...ij,...j->...i", np.asarray(matrix), np.asarray(vector))


def solved(matrix: Any, vector: Any) -> np.ndarray:
    return np.linalg.solve(np.asarray(matrix), np.asarray(vector)[..., None])[..., 0]


def turned_inertia(rotation: Any, inertia: Any) -> np.ndarray:
    return rotation @ inertia @ np.swapaxes(rotation, -1, -2)


def transposed(matrix: Any) -> np.ndarray:
    return np.swapaxes(matrix, -1, -2)


def exponential(theta: Any) -> np.ndarray:
    """The rotation matrix of a turn by |theta| about theta, by Rodrigues' formula."""
    theta = np.asarray(theta, dtype=float)
    angle = np.linalg.norm(theta, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(theta, -1, 0)
    none = np.zeros(x.shape)
    cross = np.moveaxis(
        np.array([[none, -z, y], [z, none, -x], [-y, x, none]]), (0, 1), (-2, -1)
    )
    return (
        np.eye(3)
        + np.sinc(angle / np.pi) * cross
        + 0.5 * np.sinc(angle / (2 * np.pi)) ** 2 * cross @ cross
    )
