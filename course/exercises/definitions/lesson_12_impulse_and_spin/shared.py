"""What the exercises of this lesson share: values, draws, small algebra."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.exercises.definition import Value

NORMAL = Value("normal", "(..., 3)", "", "unit vector out of body 2 toward body 1")


# Inputs. Normals off the axes, inertia tensors that are not diagonal, and two unlike bodies: each of them tells apart
# two mistakes that agree where it is missing. Numbers are short, because counterexamples print them.

UNIT = np.array([[0.48, 0.6, 0.64], [0.36, 0.48, 0.8]])  # exactly of length 1


def unit_vector(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """Unit vectors of two decimals: one of UNIT, its entries in any order and of any sign."""
    chosen = rng.permuted(UNIT[rng.integers(0, 2, shape)], axis=-1)
    return chosen * rng.choice([-1.0, 1.0], (*shape, 3))


def drawn_vector(rng: np.random.Generator, shape: tuple[int, ...], size: float = 1.0) -> np.ndarray:
    """Vectors of two decimals, no entry near 0."""
    return np.round(rng.uniform(0.3, 1.5, (*shape, 3)) * size * rng.choice([-1.0, 1.0], (*shape, 3)), 2)


def drawn_number(rng: np.random.Generator, shape: tuple[int, ...], low: float, high: float) -> Any:
    drawn = rng.uniform(low, high, shape)
    return np.round(drawn, 2) if shape else round(float(drawn), 2)


def drawn_inverse_inertia(rng: np.random.Generator, shape: tuple[int, ...], size: float = 1.0) -> np.ndarray:
    """Symmetric, positive definite, far from diagonal, two decimals [1/(kg m^2)]."""
    root = rng.uniform(0.4, 1.0, (*shape, 3, 3)) * rng.choice([-1.0, 1.0], (*shape, 3, 3))
    return np.round(size * (root @ np.swapaxes(root, -1, -2) + 0.5 * np.eye(3)), 2)


# The formula's parts, which mistakes change one at a time.


def times(matrix: Any, vector: Any) -> Any:
    return np.einsum("...ij,...j->...i", matrix, vector)


def undone(matrix: Any, vector: Any) -> Any:
    return np.linalg.solve(matrix, np.asarray(vector)[..., None])[..., 0]


def diagonal(matrix: Any, vector: Any) -> Any:
    return np.diagonal(matrix, axis1=-2, axis2=-1) * vector


def scaled(number: Any, vector: Any) -> Any:
    return np.asarray(number)[..., None] * vector


def at_once(matrix: Any, normal_velocity: Any, restitution: Any) -> Any:
    from course.contact.solvers.nnls import solve_nnls

    return solve_nnls(matrix, (1 + restitution) * np.asarray(normal_velocity)).force
