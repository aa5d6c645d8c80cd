"""Shapes of one kind that stand in a world: as they were given, and where they are now."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.arrays import Array, BoolArray, IntArray
from course.shapes import AABB, KDOP, Compound, ConvexHull, HalfSpace, Shape

#: What shapes must have in common to stand on one shelf: the kind, and how many numbers one has.
Sort = tuple[str, int]


def sort_of(shape: Shape) -> Sort:
    """The sort of shapes without parts."""
    if isinstance(shape, ConvexHull):
        return shape.kind, shape.vertices.shape[-2]
    if isinstance(shape, KDOP):
        return shape.kind, shape.directions.shape[-2]
    return shape.kind, 0


def convex_parts(shape: Shape) -> list[Shape]:
    """The parts of shapes of batch (k,), each a batch (k,); one that has none is its only part.

    Hulls repeat their last vertex until there are 1, 2, 4, 8, ... of them: so they stand on
    few shelves, and a pair of kinds is one call.
    """
    parts = shape.parts if isinstance(shape, Compound) else (shape,)
    return [_padded(part) if isinstance(part, ConvexHull) else part for part in parts]


def _padded(hull: ConvexHull) -> ConvexHull:
    count = hull.vertices.shape[-2]
    more = (1 << (count - 1).bit_length()) - count
    vertices = np.pad(hull.vertices, ((0, 0), (0, more), (0, 0)), "edge")
    return ConvexHull.unchecked(vertices=vertices, forms=hull.forms, axes=hull.axes)


@dataclass(eq=False)
class Shelf:
    """k shapes of one sort.

    Attributes:
        given: batch (k,), as they were added.
        kind: what they are once they have been moved: an AABB is then an OBB.
        now: the arrays of those, written to when they are moved.
    """

    given: Any
    kind: type[Any]
    now: dict[str, NDArray[Any]]

    @classmethod
    def of(cls, given: Any) -> Shelf:
        """A shelf of shapes that are where they were given."""
        now = given.moved(np.eye(3), np.zeros(3))
        arrays = {n: np.array(getattr(now, n), order="C") for n in now.core_axes}
        return cls(given, type(now), arrays)

    def joined(self, more: Shelf) -> Shelf:
        """These and others of the same sort behind them."""
        given = type(self.given).concatenate([self.given, more.given])
        now = {n: np.concatenate([a, more.now[n]]) for n, a in self.now.items()}
        return Shelf(given, self.kind, now)

    def kept(self, keep: BoolArray | IntArray) -> Shelf:
        """Those of a mask (k,), or of indices in their order."""
        now = {name: array[keep] for name, array in self.now.items()}
        return Shelf(self.given[keep], self.kind, now)

    def standing(self, rows: IntArray) -> Any:
        """The shapes of some rows where they are now."""
        return self.kind.unchecked(**{n: a[rows] for n, a in self.now.items()})

    def put(self, rows: IntArray, moved: Any) -> None:
        """Write shapes of some rows where they are now."""
        for name, array in self.now.items():
            array[rows] = getattr(moved, name)


def coarse_boxes(shape: Any) -> tuple[Array, Array, Array]:
    """Centre (k, 3), axes (k, 3, 3) and half extents (k, 3) of a box around each shape of batch (k,).

    A box's own; of every other kind the one along the axes it was given in. Of half spaces
    zeros, which nobody reads.
    """
    count = shape.count
    axes = np.broadcast_to(np.eye(3), (count, 3, 3))
    if isinstance(shape, HalfSpace):
        return np.zeros((count, 3)), axes, np.zeros((count, 3))
    if shape.kind == "obb":
        return shape.center, shape.rotation, shape.half_extents
    box: AABB = shape.bounds()
    return box.center, axes, box.half_extents


def bounds_array(shape: Any) -> Array:
    """l and u of shapes of batch (k,) side by side, (k, 6)."""
    box = shape.bounds()
    return np.concatenate([box.lower, box.upper], axis=-1)
