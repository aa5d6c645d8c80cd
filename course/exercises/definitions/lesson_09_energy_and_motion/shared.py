"""What this lesson's exercises share: values, and the slips in half a dot product."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from course.exercises.definition import Mistake, Value
from course.exercises.slips import slip

I_BODY = Value(
    "I_body", "(..., 3, 3)", "kg m²", "inertia about the centre of mass, body axes"
)
ANGULAR_MOMENTUM = Value(
    "L", "(..., 3)", "kg m²/s", "angular momentum about the centre of mass, world axes"
)


def energy_mistakes(
    formula: Callable[..., Any], first: str, second: str
) -> tuple[Mistake, ...]:
    """Slips in half a dot product of ``first`` and ``second``."""
    product = f"{first} * {second}"
    total = f"np.sum({product}, axis=-1)"
    return (
        Mistake(
            "half forgotten",
            slip(formula, "0.5 * ", ""),
            f"Twice too much. {first}.{second} is m v^2 (or I omega^2); the energy is half of it: it is what the "
            "work of bringing the body up to speed adds up to.",
        ),
        Mistake(
            "not summed",
            slip(formula, total, product),
            "These are three products, component by component. A dot product is their sum over the last axis: an "
            "energy is one number for each body.",
        ),
        Mistake(
            "summed over the batch",
            slip(formula, total, f"np.sum({product})"),
            "Your sum goes over the whole batch. Take it over the last axis only, axis=-1: one energy for each body.",
        ),
        Mistake(
            "np.dot",
            slip(formula, total, f"np.dot({first}, {second})"),
            "np.dot is right for two vectors; of two batches it makes a matrix product. np.sum(a * b, axis=-1) "
            "serves both.",
        ),
    )
