"""The oriented bounding box (syllabus row 4)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from course.arrays import Array, ArrayLike, non_negative, rotations, vectors
from course.shapes.aabb import AABB
from course.shapes.shape import Shape, directions, pose, turned


@dataclass(frozen=True, eq=False)
class OBB(Shape):
    """Oriented boxes c + R y with |y_i| <= e_i.

    Source: Ericson, *Real-Time Collision Detection*, section 4.4; syllabus row 4.

    Args:
        center: c, (..., 3) [m].
        rotation: R, whose columns are the box's axes, (..., 3, 3).
        half_extents: e >= 0, (..., 3) [m].
    Raises:
        ValueError: a negative extent, axes that are not orthonormal, NaN or infinity,
            a wrong shape.
    """

    center: Array
    rotation: Array
    half_extents: Array

    kind: ClassVar[str] = "obb"
    core_axes: ClassVar[dict[str, int]] = {
        "center": 1,
        "rotation": 2,
        "half_extents": 1,
    }

    def __post_init__(self) -> None:
        e = vectors("half_extents", self.half_extents)
        self._keep(
            center=vectors("center", self.center),
            rotation=rotations("rotation", self.rotation),
            half_extents=non_negative("half_extents", e),
        )

    def support(self, direction: ArrayLike) -> Array:
        """The corner farthest along a direction: c + sum of +-e_i r_i, by the sign of u.r_i.

        Args:
            direction: u, (..., 3), not zero; broadcast with the batch.
        Returns:
            (..., 3) [m].
        """
        u, _ = directions(self, direction)
        along = turned(np.swapaxes(self.rotation, -1, -2), u)
        corner = np.where(along >= 0, self.half_extents, -self.half_extents)
        return self.center + turned(self.rotation, corner)

    def bounds(self) -> AABB:
        """The least axis-aligned box around each: c - |R| e to c + |R| e."""
        reach = turned(np.abs(self.rotation), self.half_extents)
        return AABB(self.center - reach, self.center + reach)

    def moved(self, rotation: ArrayLike, translation: ArrayLike) -> OBB:
        """Each box turned about the origin, then shifted: c' = Q c + t, R' = Q R.

        Args:
            rotation: Q, (..., 3, 3).
            translation: t, (..., 3) [m].
        """
        turn, shift, batch = pose(self, rotation, translation)
        return self._made(
            center=np.broadcast_to(turned(turn, self.center) + shift, (*batch, 3)),
            rotation=np.broadcast_to(turn @ self.rotation, (*batch, 3, 3)),
            half_extents=np.broadcast_to(self.half_extents, (*batch, 3)),
        )

    def volume(self) -> Array:
        """8 e_1 e_2 e_3, (...) [m^3]."""
        return 8 * np.prod(self.half_extents, axis=-1)
