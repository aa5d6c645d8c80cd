"""How far apart two rounded polytopes are, or how deep in one another: gap, normal and witness points.

A rounded polytope is the Minkowski sum of a polytope (its *core*) and a ball, so that for
two of them

    gap = gap of the cores - r_A - r_B,

and the gap of the cores is their distance, or less the least translation that parts them (G. van den
Bergen, *Collision Detection in Interactive 3D Environments*, sections 2.3 and 4.3).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, ArrayLike, IntArray, failure, indices
from course.overlap.convex.separating_axis import as_kernels_take_it
from course.shapes.rounded_polytopes import Polytopes


@dataclass(frozen=True, eq=False)
class Closest:
    """The gap of pairs of solids and where it is.

    Args:
        gap: (...) [m], the distance, or less the least translation that parts them.
        normal: (..., 3) unit vectors N out of B toward A. Where several are right (equal
            centres, say) one of them, the same every time.
        point_a, point_b: (..., 3) [m], witness points on the two surfaces:
            gap = (point_a - point_b) . N.
    """

    gap: Array
    normal: Array
    point_a: Array
    point_b: Array

    def swapped(self) -> Closest:
        """The same, with B as body A."""
        return Closest(self.gap, -self.normal, self.point_b, self.point_a)

    def __getitem__(self, which: Any) -> Closest:
        """Those that an index of the batch selects."""
        return Closest(*(np.asarray(x)[which] for x in vars(self).values()))

    def flat(self) -> Closest:
        """The batch along one axis, in C order."""
        rows = [
            np.reshape(x, (-1, 3)) for x in (self.normal, self.point_a, self.point_b)
        ]
        return Closest(np.reshape(self.gap, -1), *rows)

    def broadcast_to(self, batch: tuple[int, ...]) -> Closest:
        """The same, repeated along new or single batch axes."""
        rows = (self.normal, self.point_a, self.point_b)
        wide = [np.broadcast_to(x, (*batch, 3)) for x in rows]
        return Closest(np.broadcast_to(self.gap, batch), *wide)

    def nearer(self, other: Closest) -> Closest:
        """Of two of one batch, at each place that with the lesser gap."""
        less = other.gap < self.gap
        mine, theirs = vars(self).values(), vars(other).values()
        return Closest(
            *(
                np.where(less.reshape(*less.shape, *[1] * (x.ndim - less.ndim)), y, x)
                for x, y in zip(mine, theirs, strict=True)
            )
        )


def closest_points(a: Polytopes, b: Polytopes, i: ArrayLike, j: ArrayLike) -> Closest:
    """Gap, normal and witness points of solid i of a and solid j of b, for every pair (i, j).

    Distances by GJK (``gjk``), depths by EPA (``epa``), each as soon as it is certain to
    rounding; what is left, and what nearly touches, by separating axes
    (``separating_axis_loops``) and, very rarely, by all features (``nearest_features``).

    Args:
        a, b: rounded polytopes.
        i, j: which of them, ints of one shape (...).
    Raises:
        ValueError: a number of no solid, or i and j of different shapes.
    """
    from course.overlap.convex.closest_loops import closest_pairs

    first, second = _pairs(a, b, i, j)
    gap, apart = np.empty(first.size), np.empty((3, first.size, 3))
    closest_pairs(
        as_solids(a), as_solids(b), first, second, gap, apart[0], apart[1], apart[2]
    )
    batch = np.shape(i)
    return Closest(gap.reshape(batch), *apart.reshape(3, *batch, 3))


def least_translation(
    a: Polytopes, b: Polytopes, i: ArrayLike, j: ArrayLike
) -> tuple[Array, Array]:
    """The greatest separation along an axis of solid i of a and solid j of b, and that axis, for every pair.

    Where the cores overlap -s is the least translation of A that parts them, along N. Where
    they are apart s is above 0 and a lower bound of their distance (C. Ericson, *Real-Time
    Collision Detection*, section 5.2.1).

    Args:
        a, b: rounded polytopes.
        i, j: which of them, ints of one shape (...).
    Returns:
        s less both radii (...) [m] and N (..., 3), out of B toward A.
    Raises:
        ValueError: a number of no solid, or i and j of different shapes.
    """
    from course.overlap.convex.closest_loops import least_translations

    first, second = _pairs(a, b, i, j)
    separation, normal = np.empty(first.size), np.empty((first.size, 3))
    solids = as_solids(a), as_solids(b)
    least_translations(*solids, first, second, separation, normal)
    batch = np.shape(i)
    return separation.reshape(batch), normal.reshape(*batch, 3)


def _pairs(
    a: Polytopes, b: Polytopes, i: ArrayLike, j: ArrayLike
) -> tuple[IntArray, IntArray]:
    first, second = indices("i", i, len(a)), indices("j", j, len(b))
    if first.shape != second.shape:
        raise failure("j", f"the shape of i, {first.shape}", f"shape {second.shape}")
    return as_kernels_take_it(first.ravel()), as_kernels_take_it(second.ravel())


def as_solids(polytopes: Polytopes) -> Any:
    """The arrays of polytopes as kernels take them, a ``Solids``."""
    from course.overlap.convex.separating_axis_loops import Solids

    arrays: Any = (getattr(polytopes, name) for name in Solids._fields)
    return Solids(*map(as_kernels_take_it, arrays))
