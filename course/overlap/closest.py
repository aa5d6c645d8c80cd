"""What a question of distance finds: the gap of two solids, its direction, and the two nearest points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array


@dataclass(frozen=True, eq=False)
class Closest:
    """The nearest points of two solids, or those that are deepest in one another.

    gap = (p_A - p_B).N, so that A moved by -gap N, where the gap is negative, only
    touches B (syllabus row 19; G. van den Bergen, *Collision Detection in Interactive
    3D Environments*, section 2.3.4).

    Args:
        gap: (...) [m]; above 0 apart, 0 touching, below 0 penetrating.
        normal: (..., 3) unit vectors out of B toward A; where more than one direction
            is right, one of them, the same every time.
        point_a, point_b: (..., 3) [m], p_A and p_B, on the surfaces of A and B.
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
