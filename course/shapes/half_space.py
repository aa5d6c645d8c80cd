"""The half space: all that lies on one side of a plane, as a floor or a wall."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, NoReturn

import numpy as np

from course.arrays import Array, ArrayLike, failure, scalars, unit_vectors
from course.shapes.aabb import AABB
from course.shapes.shape import Shape, pose, turned


@dataclass(frozen=True, eq=False)
class HalfSpace(Shape):
    """Half spaces n.x <= o, solid below the plane and without end.

    Source: Ericson, *Real-Time Collision Detection*, section 3.6; syllabus row 1.

    Args:
        normal: n, unit vectors out of the solid, (..., 3).
        offset: o, (...) [m].
    Raises:
        ValueError: a normal that is not of unit length, NaN or infinity, a wrong shape.
    """

    normal: Array
    offset: Array

    kind: ClassVar[str] = "half_space"
    core_axes: ClassVar[dict[str, int]] = {"normal": 1, "offset": 0}

    def __post_init__(self) -> None:
        self._keep(
            normal=unit_vectors("normal", self.normal),
            offset=scalars("offset", self.offset),
        )

    def support(self, direction: ArrayLike) -> NoReturn:
        """There is none: a half space has no end.

        Raises:
            ValueError: always.
        """
        raise failure(
            "half_space", "a bounded shape, to have a support", "a half space"
        )

    def bounds(self) -> AABB:
        """Boxes from -inf to +inf."""
        endless = np.full((*self.batch, 3), np.inf)
        return AABB(-endless, endless)

    def moved(self, rotation: ArrayLike, translation: ArrayLike) -> HalfSpace:
        """Each turned about the origin, then shifted: n' = R n, o' = o + n'.t.

        Args:
            rotation: R, (..., 3, 3).
            translation: t, (..., 3) [m].
        """
        turn, shift, batch = pose(self, rotation, translation)
        normal = np.broadcast_to(turned(turn, self.normal), (*batch, 3))
        offset = self.offset + np.sum(normal * shift, axis=-1)
        return self._made(normal=normal, offset=np.broadcast_to(offset, batch))

    def volume(self) -> Array:
        """Infinite, (...) [m^3]."""
        return np.full(self.batch, np.inf)
