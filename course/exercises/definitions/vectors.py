"""Two things that the exercises of many lessons need: a drawn direction, and the dot
product of batches.
"""

from __future__ import annotations

from typing import Any

import numpy as np


def unit_vector(rng: np.random.Generator, shape: tuple[int, ...] = ()) -> np.ndarray:
    """Unit vectors (*shape, 3), every direction alike."""
    vector = rng.normal(size=(*shape, 3))
    return np.asarray(vector / np.linalg.norm(vector, axis=-1, keepdims=True))


def dot(a: Any, b: Any) -> Any:
    """a . b over the last axis."""
    return np.sum(np.asarray(a) * b, axis=-1)
