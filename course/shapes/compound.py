"""The compound shape: several convex parts that move as one (syllabus row 7)."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from course.arrays import Array, ArrayLike, broadcast, failure
from course.shapes.aabb import AABB
from course.shapes.capsule import Capsule
from course.shapes.convex_hull import ConvexHull
from course.shapes.kdop import KDOP
from course.shapes.obb import OBB
from course.shapes.shape import Shape, directions, one_axis
from course.shapes.sphere import Sphere

#: The kinds that are convex and bounded.
CONVEX = (Sphere, Capsule, AABB, OBB, KDOP, ConvexHull)


@dataclass(frozen=True, eq=False)
class Compound(Shape):
    """Compounds: the union of convex parts.

    Source: Ericson, *Real-Time Collision Detection*, section 4.1; syllabus row 7.

    Args:
        parts: shapes of any convex bounded kind, whose batches broadcast.
    Raises:
        ValueError: no parts, a part of another kind (a compound, a half space), an
            endless box, batches that do not fit.
    """

    parts: tuple[Shape, ...]

    kind: ClassVar[str] = "compound"
    core_axes: ClassVar[dict[str, int]] = {}

    def __post_init__(self) -> None:
        if isinstance(self.parts, Shape):
            raise failure("parts", "a tuple of shapes", f"one {self.parts.kind}")
        parts = tuple(self.parts)
        if not parts:
            raise failure("parts", "at least one convex shape", "none")
        for i, part in enumerate(parts):
            if not isinstance(part, CONVEX):
                got = getattr(part, "kind", type(part).__name__)
                raise failure(f"parts[{i}]", "a convex bounded shape", f"a {got}")
            if isinstance(part, AABB):
                part.require_finite()
        batch = broadcast(
            **{f"parts[{i}]": (np.empty(p.batch, bool), 0) for i, p in enumerate(parts)}
        )
        wide = tuple(part.broadcast_to(batch) for part in parts)
        object.__setattr__(self, "parts", wide)

    @property
    def batch(self) -> tuple[int, ...]:
        """The shape of the batch, () for one compound."""
        return self.parts[0].batch

    def support(self, direction: ArrayLike) -> Array:
        """The farthest of the parts' farthest points along a direction.

        Args:
            direction: u, (..., 3), not zero; broadcast with the batch.
        Returns:
            (..., 3) [m].
        """
        u, batch = directions(self, direction)
        points = [np.broadcast_to(p.support(u), (*batch, 3)) for p in self._convex()]
        stacked = np.stack(points, axis=-2)
        along = ((stacked - stacked[..., :1, :]) @ u[..., None])[..., 0]
        best = np.argmax(along, axis=-1)[..., None, None]
        farther: Array = np.take_along_axis(stacked, best, axis=-2)[..., 0, :]
        return farther

    def bounds(self) -> AABB:
        """The least axis-aligned box around all parts."""
        boxes = [part.bounds() for part in self._convex()]
        return AABB(
            np.min([box.lower for box in boxes], axis=0),
            np.max([box.upper for box in boxes], axis=0),
        )

    def moved(self, rotation: ArrayLike, translation: ArrayLike) -> Compound:
        """Each part turned about the origin, then shifted; boxes become oriented.

        Args:
            rotation: R, (..., 3, 3).
            translation: t, (..., 3) [m].
        """
        moved = tuple(part.moved(rotation, translation) for part in self._convex())
        return self._made_of(moved)

    def volume(self) -> Array:
        """The sum of the parts' volumes, (...) [m^3]; where parts overlap, that counts twice."""
        return np.asarray(sum(part.volume() for part in self._convex()))

    @classmethod
    def concatenate(cls, parts: Iterable[Compound]) -> Compound:
        """All compounds, in order; each made of the same kinds of parts, in one order."""
        given: list[Compound] = one_axis(cls, parts)
        kinds = [part.kind for part in given[0].parts]
        for i, other in enumerate(given):
            got = [part.kind for part in other.parts]
            if got != kinds:
                expected = f"a compound of {', '.join(kinds)}, as parts[0] is"
                raise failure(f"parts[{i}]", expected, f"one of {', '.join(got)}")
        columns = zip(*(compound.parts for compound in given), strict=True)
        return cls._made_of(
            tuple(type(column[0]).concatenate(column) for column in columns)
        )

    def _convex(self) -> tuple[Any, ...]:
        return self.parts

    def _each(self, change: Callable[..., Any]) -> Compound:
        return self._made_of(tuple(part._each(change) for part in self.parts))

    @classmethod
    def _made_of(cls, parts: tuple[Shape, ...]) -> Compound:
        made = object.__new__(cls)
        object.__setattr__(made, "parts", parts)
        return made
