"""The capsule: all points within a radius of a segment (syllabus row 3)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from course.arrays import Array, ArrayLike, non_negative, vectors
from course.shapes.aabb import AABB
from course.shapes.shape import Shape, directions, pose, turned


@dataclass(frozen=True, eq=False)
class Capsule(Shape):
    """Capsules: spheres of radius r swept along the segment from a to b.

    Source: Ericson, *Real-Time Collision Detection*, section 4.5; syllabus row 3.

    Args:
        start, end: a and b, (..., 3) [m]; where they are equal it is a sphere.
        radius: r >= 0, (...) [m]; 0 is a segment.
    Raises:
        ValueError: a negative radius, NaN or infinity, a wrong shape.
    """

    start: Array
    end: Array
    radius: Array

    kind: ClassVar[str] = "capsule"
    core_axes: ClassVar[dict[str, int]] = {"start": 1, "end": 1, "radius": 0}

    def __post_init__(self) -> None:
        self._keep(
            start=vectors("start", self.start),
            end=vectors("end", self.end),
            radius=non_negative("radius", self.radius),
        )

    def support(self, direction: ArrayLike) -> Array:
        """The point farthest along a direction: the farther end, and r u/|u| beyond.

        Args:
            direction: u, (..., 3), not zero; broadcast with the batch.
        Returns:
            (..., 3) [m].
        """
        u, _ = directions(self, direction)
        along = np.sum((self.end - self.start) * u, axis=-1, keepdims=True)
        unit = u / np.linalg.norm(u, axis=-1, keepdims=True)
        farther: Array = np.where(along > 0, self.end, self.start)
        return farther + self.radius[..., None] * unit

    def bounds(self) -> AABB:
        """The least axis-aligned box around each: both ends, and r beyond."""
        reach = self.radius[..., None]
        return AABB(
            np.minimum(self.start, self.end) - reach,
            np.maximum(self.start, self.end) + reach,
        )

    def moved(self, rotation: ArrayLike, translation: ArrayLike) -> Capsule:
        """Each capsule turned about the origin, then shifted: a' = R a + t, b' = R b + t.

        Args:
            rotation: R, (..., 3, 3).
            translation: t, (..., 3) [m].
        """
        turn, shift, batch = pose(self, rotation, translation)
        return self._made(
            start=np.broadcast_to(turned(turn, self.start) + shift, (*batch, 3)),
            end=np.broadcast_to(turned(turn, self.end) + shift, (*batch, 3)),
            radius=np.broadcast_to(self.radius, batch),
        )

    def volume(self) -> Array:
        """pi r^2 |b - a| + 4/3 pi r^3, (...) [m^3]."""
        length = np.linalg.norm(self.end - self.start, axis=-1)
        return np.asarray(np.pi * self.radius**2 * (length + 4 / 3 * self.radius))
