"""The axis-aligned bounding box (syllabus row 4)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from course.arrays import Array, ArrayLike, failure, vectors, written
from course.shapes.shape import Shape, directions, pose, turned

if TYPE_CHECKING:
    from course.shapes.obb import OBB


@dataclass(frozen=True, eq=False)
class AABB(Shape):
    """Axis-aligned boxes l <= x <= u, in each coordinate.

    Source: Ericson, *Real-Time Collision Detection*, section 4.2; syllabus row 4.

    Args:
        lower, upper: l and u, (..., 3) [m], l <= u. A lower bound may be -inf and an
            upper one +inf, as the bounds of a half space are: such a box has no
            support and cannot be turned.
    Raises:
        ValueError: lower > upper, NaN, infinity on the wrong side, a wrong shape.
    """

    lower: Array
    upper: Array

    kind: ClassVar[str] = "aabb"
    core_axes: ClassVar[dict[str, int]] = {"lower": 1, "upper": 1}

    def __post_init__(self) -> None:
        lower = vectors("lower", self.lower, infinite=True)
        upper = vectors("upper", self.upper, infinite=True)
        self._keep(lower=lower, upper=upper)
        require_ordered(self.lower, self.upper)
        for name, array, wrong in ("lower", lower, np.inf), ("upper", upper, -np.inf):
            if np.any(array == wrong):
                index = tuple(np.argwhere(array == wrong)[0])
                expected = f"finite numbers or {-wrong}"
                raise failure(name, expected, written(wrong), index)

    @property
    def is_finite(self) -> bool:
        """Whether no box of the batch reaches to infinity."""
        return bool(np.all(np.isfinite(self.lower)) and np.all(np.isfinite(self.upper)))

    @property
    def center(self) -> Array:
        """(l + u)/2, (..., 3) [m]; of finite boxes."""
        self.require_finite()
        return self.lower + 0.5 * (self.upper - self.lower)

    @property
    def half_extents(self) -> Array:
        """(u - l)/2, (..., 3) [m]; of finite boxes."""
        self.require_finite()
        return 0.5 * (self.upper - self.lower)

    def require_finite(self) -> None:
        """Refuse boxes that reach to infinity, where only finite ones make sense."""
        if not self.is_finite:
            finite = np.isfinite(self.lower) & np.isfinite(self.upper)
            index = tuple(np.argwhere(~finite.all(axis=-1))[0])
            raise failure("aabb", "finite boxes", "one that reaches to infinity", index)

    def support(self, direction: ArrayLike) -> Array:
        """The corner farthest along a direction, chosen in each coordinate by its sign.

        Args:
            direction: (..., 3), not zero; broadcast with the batch.
        Returns:
            (..., 3) [m].
        Raises:
            ValueError: a zero direction, a box that reaches to infinity.
        """
        self.require_finite()
        u, _ = directions(self, direction)
        return np.where(u >= 0, self.upper, self.lower)

    def bounds(self) -> AABB:
        """The boxes themselves."""
        return self

    def moved(self, rotation: ArrayLike, translation: ArrayLike) -> OBB:
        """Each box turned about the origin, then shifted: no longer along the axes.

        Args:
            rotation: R, (..., 3, 3).
            translation: t, (..., 3) [m].
        Returns:
            The oriented boxes with centre R c + t and axes R.
        """
        from course.shapes.obb import OBB

        turn, shift, batch = pose(self, rotation, translation)
        return OBB._made(
            center=np.broadcast_to(turned(turn, self.center) + shift, (*batch, 3)),
            rotation=np.array(np.broadcast_to(turn, (*batch, 3, 3))),
            half_extents=np.broadcast_to(self.half_extents, (*batch, 3)),
        )

    def volume(self) -> Array:
        """The product of the extents, (...) [m^3]; 0 where one of them is 0."""
        extents = self.upper - self.lower
        flat = np.any(extents == 0, axis=-1)
        return np.prod(np.where(flat[..., None], 0.0, extents), axis=-1)


def require_ordered(lower: Array, upper: Array) -> None:
    """Refuse a lower bound above its upper bound."""
    if np.any(lower > upper):
        index = tuple(np.argwhere(lower > upper)[0])
        got = f"{written(lower[index])} above upper {written(upper[index])}"
        raise failure("lower", "numbers at or below upper", got, index)
