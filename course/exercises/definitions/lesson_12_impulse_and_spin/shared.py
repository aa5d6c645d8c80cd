"""What the exercises of this lesson share: values, draws, small algebra."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.exercises.definition import Value

NORMAL = Value("normal", "(..., 3)", "", "unit vector out of body 2 toward body 1")


# Inputs. Normals off the axes, inertia tensors that are not diagonal, and two unlike
# bodies: each of them tells apart two mistakes that agree where it is missing. Numbers
# are short, because counterexamples print them.

UNIT = np.array([[0.48, 0.6, 0.64], [0.36, 0.48, 0.8]])  # exactly of length 1


def unit_vector(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """Unit vectors of two decimals: one of UNIT, its entries in any order and of any
    sign.
    """
    chosen = rng.permuted(UNIT[rng.integers(0, 2, shape)], axis=-1)
    return chosen * rng.choice([-1.0, 1.0], (*shape, 3))


def drawn_vector(
    rng: np.random.Generator, shape: tuple[int, ...], size: float = 1.0
) -> np.ndarray:
    """Vectors of two decimals, no entry near 0."""
    return np.round(
        rng.uniform(0.3, 1.5, (*shape, 3))
        * size
        * rng.choice([-1.0, 1.0], (*shape, 3)),
        2,
    )


def drawn_number(
    rng: np.random.Generator, shape: tuple[int, ...], low: float, high: float
) -> Any:
    drawn = rng.uniform(low, high, shape)
    return np.round(drawn, 2) if shape else round(float(drawn), 2)


def drawn_inverse_inertia(
    rng: np.random.Generator, shape: tuple[int, ...], size: float = 1.0
) -> np.ndarray:
    """Of long bodies that lie aslant: full matrices far from diagonal, two decimals
    [1/(kg m^2)].

    I = tr(S) 1 - S of second moments S = u u' + v v'/10 + 1/4 (Goldstein, section 5.3):
    a positive matrix drawn as I or its inverse may have a principal moment above the
    sum of the other two, and no body has that. The 1/4 keeps them far enough from it
    that the rounding of the smallest (``size`` 0.2) does not reach it.
    """
    u, v = rng.uniform(0.5, 1.0, (2, *shape, 3)) * rng.choice(
        [-1.0, 1.0], (2, *shape, 3)
    )
    second = (
        u[..., :, None] * u[..., None, :]
        + 0.1 * v[..., :, None] * v[..., None, :]
        + 0.25 * np.eye(3)
    )
    inertia = np.trace(second, axis1=-2, axis2=-1)[..., None, None] * np.eye(3) - second
    return np.asarray(np.round(2.8 * size * np.linalg.inv(inertia), 2))


def times(matrix: Any, vector: Any) -> Any:
    return np.einsum("...ij,...j->...i", matrix, vector)


def scaled(number: Any, vector: Any) -> Any:
    return np.asarray(number)[..., None] * vector


#: A and b, contacts that no exchange of all at once solves: to add all that sink and
#: take out all that pull goes round for ever. Found by drawing small whole numbers.
CYCLING = np.array([[2.7, -0.2, 1.3, -1.2, -0.6], [-0.2, 1.4, 0.0, 0.0, 0.5], [1.3, 0.0, 1.3, -0.8, 0.3],
                    [-1.2, 0.0, -0.8, 1.0, 0.7], [-0.6, 0.5, 0.3, 0.7, 1.9]]), (-3, -5, -7, 4, -5)  # fmt: skip
