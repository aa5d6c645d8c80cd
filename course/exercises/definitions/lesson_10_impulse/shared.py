"""What the exercises of this lesson share: values, draws, small algebra."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.exercises.definition import Case, Value
from course.exercises.definitions.vectors import unit_vector

MASS_1 = Value("mass_1", "(...)", "kg", "mass of body 1")
MASS_2 = Value("mass_2", "(...)", "kg", "mass of body 2; infinity for a wall")
VELOCITY_1 = Value(
    "velocity_1", "(..., 3)", "m/s", "velocity of body 1 before the impact"
)
VELOCITY_2 = Value(
    "velocity_2", "(..., 3)", "m/s", "velocity of body 2 before the impact"
)
NORMAL = Value("normal", "(..., 3)", "", "unit vector out of body 2 toward body 1")
RESTITUTION = Value("restitution", "(...)", "", "e, from 0 to 1")


# Inputs. A normal off the axes, a sliding part in every velocity, e inside (0, 1) and
# unequal masses: each of them tells apart two mistakes that agree where it is missing.


def _velocities(
    rng: np.random.Generator, shape: tuple[int, ...], normal: np.ndarray, closing: Any
) -> tuple[np.ndarray, np.ndarray]:
    """Velocities with (v2 - v1).n = closing and a sliding part across the normal."""
    velocity_2 = rng.normal(size=(*shape, 3))
    slide = np.cross(normal, rng.normal(size=(*shape, 3)))
    return velocity_2 - np.asarray(closing)[..., None] * normal + slide, velocity_2


def _pair(
    rng: np.random.Generator,
    shape: tuple[int, ...] = (),
    *,
    closing: Any = None,
    **fixed: Any,
) -> dict[str, Any]:
    normal = unit_vector(rng, shape)
    closing = rng.uniform(0.5, 3.0, shape) if closing is None else closing
    velocity_1, velocity_2 = _velocities(rng, shape, normal, closing)
    pair = {
        "mass_1": rng.uniform(0.5, 2.0, shape),
        "mass_2": rng.uniform(3.0, 6.0, shape),
        "velocity_1": velocity_1,
        "velocity_2": velocity_2,
        "normal": normal,
        "restitution": rng.uniform(0.3, 0.8, shape),
    }
    # Three decimals where it does no harm: these numbers are shown to students.
    pair = {
        name: value if name == "normal" else np.round(value, 3)
        for name, value in pair.items()
    }
    pair.update(fixed)
    return {name: value.item() if isinstance(value, np.ndarray) and value.ndim == 0 else value
            for name, value in pair.items()}  # fmt: skip


ALONG_X = {
    "mass_1": 2.0,
    "mass_2": 1.0,
    "velocity_1": np.array([-3.0, 0.0, 0.0]),
    "velocity_2": np.array([1.0, 0.0, 0.0]),
    "normal": np.array([1.0, 0.0, 0.0]),
    "restitution": 0.5,
}


def impacts(rng: np.random.Generator) -> Sequence[Case]:
    mixed = rng.uniform(-2.0, 2.0, 6)
    mixed[:2] = 1.0, -1.0
    at_rest = {
        "velocity_1": np.array([1.0, 2.0, 0.5]),
        "velocity_2": np.array([1.0, 2.0, 0.5]),
    }
    return [
        Case("head-on along x", ALONG_X),
        Case("off the axes", _pair(rng)),
        Case("off the axes again", _pair(rng)),
        Case("they already part", _pair(rng, closing=-1.5), "edge"),
        Case("they move together", {**_pair(rng), **at_rest}, "edge"),
        Case("nothing lost, e = 1", _pair(rng, restitution=1.0), "edge"),
        Case("they stay together, e = 0", _pair(rng, restitution=0.0), "edge"),
        Case(
            "body 2 is a wall",
            _pair(rng, mass_2=np.inf, velocity_2=np.zeros(3), **_toward_wall(rng)),
            "edge",
        ),
        Case(
            "three pairs, as many as a vector has components", _pair(rng, (3,)), "batch"
        ),
        Case("six pairs", _pair(rng, (6,)), "batch"),
        Case("a 2 by 4 batch", _pair(rng, (2, 4)), "batch"),
        Case("some approach, some part", _pair(rng, (6,), closing=mixed), "batch"),
        Case("they approach slowly", _pair(rng, closing=0.1)),
        Case("they part slowly", _pair(rng, closing=-0.1), "edge"),
    ]


def _toward_wall(rng: np.random.Generator) -> dict[str, Any]:
    normal = unit_vector(rng, ())
    return {
        "normal": normal,
        "velocity_1": -2.0 * normal + np.cross(normal, rng.normal(size=3)),
    }
