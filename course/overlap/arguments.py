"""What the questions are asked with: two shapes, checked, and their convex parts."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from course.arrays import Array, broadcast, failure, written
from course.overlap.pairs import KINDS
from course.shapes import Compound, Shape

#: Coordinates and lengths may be as large as this, so that no product overflows [m].
LARGEST = 1e50


def checked(a: Shape, b: Shape) -> tuple[int, ...]:
    """The broadcast batch of two shapes that can be asked."""
    for name, shape in ("a", a), ("b", b):
        if not isinstance(shape, Shape):
            raise TypeError(f"{name}: expected a shape; got {type(shape).__name__}")
        if shape.kind not in (*KINDS, Compound.kind):
            known = ", ".join((*KINDS, Compound.kind))
            raise failure(name, f"a shape of a kind among {known}", written(shape.kind))
        for array in _arrays(shape):
            row = array.ravel()
            if row @ row <= LARGEST:  # the squares, so that each is far below
                continue
            largest = np.abs(row).max()
            if largest > LARGEST:
                expected = f"coordinates up to {LARGEST:g}"
                raise failure(name, expected, written(largest))
    ones = [np.empty(shape.batch, dtype=bool) for shape in (a, b)]
    return broadcast(a=(ones[0], 0), b=(ones[1], 0))


def _arrays(shape: Shape) -> Iterator[Array]:
    if isinstance(shape, Compound):
        for part in shape.parts:
            yield from _arrays(part)
    for name in shape.core_axes:
        array = getattr(shape, name)
        if array.dtype == np.float64:
            yield array


def convex_parts(a: Shape, b: Shape) -> Iterator[tuple[int, int, Shape, Shape]]:
    """Number and shape of every part of a with every part of b."""
    for i, first in enumerate(_parts(a)):
        for j, second in enumerate(_parts(b)):
            yield i, j, first, second


def _parts(shape: Shape) -> list[Shape]:
    if not isinstance(shape, Compound):
        return [shape]
    return [part.broadcast_to(shape.batch) for part in shape.parts]
