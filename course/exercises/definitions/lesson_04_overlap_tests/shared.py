"""What the exercises of this lesson share: values, and spheres and segments with a gap that was chosen.

Gaps are at least ``CLEAR`` from 0, so that no verdict hangs on rounding; touching itself is tried in numbers that
are exact. Everything lies away from the origin, or a place that is not subtracted would not be missed.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array
from course.exercises.definition import Value
from course.exercises.definitions.vectors import unit_vector

CLEAR = 0.02  # [m]
Given = dict[str, Array]


def gaps(rng: np.random.Generator, shape: tuple[int, ...] = ()) -> Array:
    """Gaps of either sign, some just clear of 0, some not, (...) [m]."""
    size = CLEAR + rng.uniform(0.0, 1.0, shape) ** 3
    sign = np.where(np.arange(size.size).reshape(shape) % 2, -1.0, 1.0)
    return np.asarray(sign * size)


def place(rng: np.random.Generator, shape: tuple[int, ...] = ()) -> Array:
    """Places away from the origin, (..., 3) [m]."""
    sign = np.where(rng.uniform(size=(*shape, 3)) < 0.5, -1.0, 1.0)
    return np.asarray(np.round(sign * rng.uniform(1.0, 4.0, (*shape, 3)), 2))


def radius(rng: np.random.Generator, shape: tuple[int, ...] = ()) -> Array:
    """Radii below and above 1 m, (...)."""
    return np.asarray(np.round(rng.uniform(0.2, 1.7, shape), 2))


def segment(
    rng: np.random.Generator, shape: tuple[int, ...] = ()
) -> tuple[Array, Array]:
    """Start and end, (..., 3) each, 0.5 to 3 m apart."""
    start = place(rng, shape)
    length = rng.uniform(0.5, 3.0, (*shape, 1))
    return start, np.round(start + length * unit_vector(rng, shape), 2)


def beside(
    rng: np.random.Generator, start: Array, end: Array, distance: Array
) -> Array:
    """Points at a distance from a segment: beside it, beyond its end, before its start, in turn; (..., 3)."""
    way = end - start
    length = np.linalg.norm(way, axis=-1, keepdims=True)
    along = way / np.where(length == 0, 1.0, length)
    across = np.cross(along, unit_vector(rng, start.shape[:-1]))
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    which = np.arange(length.size).reshape(length.shape) % 3
    share = np.where(which == 0, rng.uniform(0.1, 0.9, length.shape), 2.0 - which)
    outward = np.where(which == 0, 0.0, 3.0 - 2.0 * which)
    aside = across + rng.uniform(0.3, 1.5, length.shape) * outward * along
    aside /= np.linalg.norm(aside, axis=-1, keepdims=True)
    return np.asarray(start + share * way + distance[..., None] * aside)


def center(name: str, body: str) -> Value:
    """The centre of a sphere."""
    return Value(name, "(..., 3)", "m", f"centre of {body}")


def point(name: str, what: str) -> Value:
    """A place."""
    return Value(name, "(..., 3)", "m", what)


def length(name: str, what: str) -> Value:
    """A radius."""
    return Value(name, "(...)", "m", what)
