"""The sphere: all points within a radius of a centre (syllabus row 3)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from course.arrays import Array, ArrayLike, non_negative, vectors
from course.shapes.aabb import AABB
from course.shapes.shape import Shape, directions, pose, turned


@dataclass(frozen=True, eq=False)
class Sphere(Shape):
    """Spheres |x - c| <= r.

    Source: Ericson, *Real-Time Collision Detection*, section 4.3; syllabus row 3.

    Args:
        center: c, (..., 3) [m].
        radius: r >= 0, (...) [m]; 0 is a point.
    Raises:
        ValueError: a negative radius, NaN or infinity, a wrong shape.
    """

    center: Array
    radius: Array

    kind: ClassVar[str] = "sphere"
    core_axes: ClassVar[dict[str, int]] = {"center": 1, "radius": 0}

    def __post_init__(self) -> None:
        self._keep(
            center=vectors("center", self.center),
            radius=non_negative("radius", self.radius),
        )

    def support(self, direction: ArrayLike) -> Array:
        """The point farthest along a direction: c + r u/|u|.

        Args:
            direction: u, (..., 3), not zero; broadcast with the batch.
        Returns:
            (..., 3) [m].
        """
        u, _ = directions(self, direction)
        unit = u / np.linalg.norm(u, axis=-1, keepdims=True)
        return self.center + self.radius[..., None] * unit

    def bounds(self) -> AABB:
        """The least axis-aligned box around each: c - r to c + r."""
        reach = self.radius[..., None]
        return AABB(self.center - reach, self.center + reach)

    def moved(self, rotation: ArrayLike, translation: ArrayLike) -> Sphere:
        """Each sphere turned about the origin, then shifted: c' = R c + t.

        Args:
            rotation: R, (..., 3, 3).
            translation: t, (..., 3) [m].
        """
        turn, shift, batch = pose(self, rotation, translation)
        center = np.broadcast_to(turned(turn, self.center) + shift, (*batch, 3))
        return self._made(center=center, radius=np.broadcast_to(self.radius, batch))

    def volume(self) -> Array:
        """4/3 pi r^3, (...) [m^3]."""
        return np.asarray(4 / 3 * np.pi * self.radius**3)
