"""What the exercises of this lesson share: values, draws, small algebra."""

from __future__ import annotations

from typing import Any

import numpy as np

ZERO = np.zeros(3)


def draw(
    rng: np.random.Generator, shape: tuple[int, ...] = (), size: float = 2.0
) -> np.ndarray:
    """Vectors of two decimals: they are shown to students."""
    return np.asarray(np.round(rng.uniform(-size, size, (*shape, 3)), 2))


def apply(matrix: Any, vector: Any) -> Any:
    return np.einsum("...ij,...j->...i", matrix, vector)
