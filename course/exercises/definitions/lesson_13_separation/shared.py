"""What the exercises of this lesson share: values, draws, small algebra."""

from __future__ import annotations

import numpy as np

from course.exercises.definition import Value
from course.exercises.definitions.lesson_12_impulse_and_spin.shared import (
    unit_vector as short_unit_vector,
)

POINT_A = Value("p_a", "(..., 3)", "m", "the point on body A")
POINT_B = Value("p_b", "(..., 3)", "m", "the point on body B")
__all__ = [
    "NORMAL", "OMEGA_A", "OMEGA_B", "POINT_A", "POINT_B", "UP", "ZERO",
    "draw", "short_unit_vector",
]  # fmt: skip

NORMAL = Value("n", "(..., 3)", "", "unit vector out of body B toward body A")
OMEGA_A = Value("omega_a", "(..., 3)", "rad/s", "angular velocity of A")
OMEGA_B = Value("omega_b", "(..., 3)", "rad/s", "angular velocity of B")


def draw(
    rng: np.random.Generator, shape: tuple[int, ...] = (), size: float = 2.0
) -> np.ndarray:
    """Vectors of two decimals: they are shown to students."""
    return np.asarray(np.round(rng.uniform(-size, size, (*shape, 3)), 2))


UP = np.array([0.0, 0.0, 1.0])
ZERO = np.zeros(3)
