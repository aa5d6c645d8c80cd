"""What a question of distance finds: the gap of two solids, its direction, and the two nearest points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array

#: Lengths below this are none: their squares have lost digits [m].
TINY = 1e-150


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


def directed(difference: Array, otherwise: Array) -> tuple[Array, Array]:
    """Length (...) and direction (..., 3) of vectors; the other direction where they are zero."""
    length = np.sqrt(np.einsum("...i,...i", difference, difference))
    none = (length <= TINY)[..., None]
    if not none.any():
        return length, difference / length[..., None]
    safe = np.where(none, 1.0, length[..., None])
    return length, np.where(none, otherwise, difference / safe)
