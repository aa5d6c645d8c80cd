"""Half spaces: against any bounded shape by its support, against each other only where they face each other."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from course.arrays import Array
from course.overlap.closest import Closest
from course.shapes import HalfSpace

#: Normals that add up to less than this are opposite to each other, but for rounding.
OPPOSITE = 1e-12


class Bounded(Protocol):
    """A shape with a farthest point in every direction."""

    def support(self, direction: Array) -> Array:
        """The point farthest along a direction, (..., 3) [m]."""
        ...


def closest_to_half_space(a: Bounded, b: HalfSpace) -> Closest:
    """The nearest points of a bounded shape and a half space n.x <= o.

    p_A is the support of A along -n, N = n, d = n.p_A - o (C. Ericson, *Real-Time
    Collision Detection*, sections 5.2.2 and 5.2.3).
    """
    point = a.support(-b.normal)
    gap = np.einsum("...i,...i", point, b.normal) - b.offset
    return Closest(
        gap=gap,
        normal=np.broadcast_to(b.normal, point.shape),
        point_a=point,
        point_b=point - gap[..., None] * b.normal,
    )


def half_spaces_gap(a: HalfSpace, b: HalfSpace) -> Array:
    """The signed gap of two half spaces, -inf unless their normals are opposite.

    Planes that are not parallel meet, and no translation parts the half spaces; nor
    does one where the normals agree. Facing each other, A is n.x <= o_A and B is
    n.x >= -o_B, so d = -o_A - o_B.
    """
    facing = np.linalg.norm(a.normal + b.normal, axis=-1) <= OPPOSITE
    return np.where(facing, -(a.offset + b.offset), -np.inf)
