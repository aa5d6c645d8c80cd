"""What the exercises of this lesson share: values, and the slips in half a dot product."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.exercises.definition import Mistake, Value

I_BODY = Value(
    "I_body", "(..., 3, 3)", "kg m²", "inertia about the centre of mass, body axes"
)
ANGULAR_MOMENTUM = Value(
    "L", "(..., 3)", "kg m²/s", "angular momentum about the centre of mass, world axes"
)


def half_a_dot(one: Any, other: Any) -> np.ndarray:
    return 0.5 * np.sum(np.asarray(one) * other, axis=-1)


def energy_mistakes(first: str, second: str) -> tuple[Mistake, ...]:
    """Slips in half a dot product of ``first`` and ``second``."""
    return (
        Mistake(
            "half forgotten",
            lambda a, b: np.sum(np.asarray(a) * b, axis=-1),
            f"Twice too much. {first}.{second} is m v^2 (or I omega^2); the energy is half of it: it is what the "
            "work of bringing the body up to speed adds up to.",
        ),
        Mistake(
            "not summed",
            lambda a, b: 0.5 * np.asarray(a) * b,
            "These are three products, component by component. A dot product is their sum over the last axis: an "
            "energy is one number for each body.",
        ),
        Mistake(
            "summed over the batch",
            lambda a, b: 0.5 * np.sum(np.asarray(a) * b),
            "np.sum without an axis adds up the whole batch. Sum over the last axis only, axis=-1: one energy for "
            "each body.",
        ),
        Mistake(
            "np.dot",
            lambda a, b: 0.5 * np.dot(a, b),
            "np.dot is right for two vectors; of two batches it makes a matrix product. np.sum(a * b, axis=-1) "
            "serves both.",
        ),
    )
