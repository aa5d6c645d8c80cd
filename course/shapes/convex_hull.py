"""The convex hull of points (syllabus row 6)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from course.arrays import Array, ArrayLike, failure, vectors
from course.shapes.aabb import AABB
from course.shapes.hull_topology import hull_topology_of
from course.shapes.shape import (
    Shape,
    directions,
    farthest,
    lazy,
    one_axis,
    pose,
    unturned,
)
from course.shapes.topology import Topology, enclosed_volume


class HullForm:
    """The topology of one hull, found when first asked for and kept as the hull moves."""

    def __init__(self, vertices: Array, index: int) -> None:
        self._vertices, self._index = vertices, index

    @cached_property
    def topology(self) -> Topology:
        """Corners, faces and edges, as numbers of the hull's vertices."""
        return hull_topology_of(self._vertices[self._index])

    @cached_property
    def volume(self) -> float:
        """What the faces enclose [m^3]."""
        return enclosed_volume(self._vertices[self._index], self.topology)


@dataclass(frozen=True, eq=False)
class ConvexHull(Shape):
    """Convex hulls: all weighted means of n points.

    Points inside, coincident, on one line or in one plane are allowed: the hull of
    coplanar points is a polygon, of volume 0.
    Source: Ericson, *Real-Time Collision Detection*, section 3.8; syllabus row 6.

    Args:
        vertices: (..., n, 3) [m], n >= 1.
    Attributes:
        forms: (...) the ``HullForm`` of each, which goes along when it moves.
        axes: (..., 3, 3) how far each has been turned since its form was made.
    Raises:
        ValueError: no vertices, NaN or infinity, a wrong shape.
    """

    vertices: Array
    forms: NDArray[Any] = field(init=False, repr=False)
    axes: Array = field(init=False, repr=False)

    kind: ClassVar[str] = "convex_hull"
    core_axes: ClassVar[dict[str, int]] = {"vertices": 2, "forms": 0, "axes": 2}

    def __post_init__(self) -> None:
        points = vectors("vertices", self.vertices)
        if points.ndim < 2 or points.shape[-2] == 0:
            expected = "at least 1 vertex, shape (..., n, 3)"
            raise failure("vertices", expected, f"shape {points.shape}")
        self._keep(vertices=points)
        flat = self.vertices.reshape(-1, *points.shape[-2:])
        forms = lazy(points.shape[:-2], lambda i: HullForm(flat, i))
        object.__setattr__(self, "forms", forms)
        object.__setattr__(self, "axes", unturned(points.shape[:-2]))

    def support(self, direction: ArrayLike) -> Array:
        """The vertex farthest along a direction.

        Args:
            direction: (..., 3), not zero; broadcast with the batch.
        Returns:
            (..., 3) [m].
        """
        u, _ = directions(self, direction)
        return farthest(self.vertices, u)

    def bounds(self) -> AABB:
        """The least axis-aligned box around each: least and largest coordinates."""
        return AABB(self.vertices.min(axis=-2), self.vertices.max(axis=-2))

    def moved(self, rotation: ArrayLike, translation: ArrayLike) -> ConvexHull:
        """Each hull turned about the origin, then shifted: x' = R x + t for its vertices.

        Args:
            rotation: R, (..., 3, 3).
            translation: t, (..., 3) [m].
        """
        turn, shift, batch = pose(self, rotation, translation)
        points = self.vertices @ np.swapaxes(turn, -1, -2) + shift[..., None, :]
        return self._made(
            vertices=np.broadcast_to(points, (*batch, *points.shape[-2:])),
            forms=np.broadcast_to(self.forms, batch),
            axes=np.broadcast_to(turn @ self.axes, (*batch, 3, 3)),
        )

    def volume(self) -> Array:
        """The sum of the pyramids over the faces, (...) [m^3]; 0 for a flat hull."""
        volumes = [form.volume for form in self.forms.ravel()]
        return np.array(volumes, dtype=np.float64).reshape(self.batch)

    @classmethod
    def concatenate(cls, parts: Iterable[ConvexHull]) -> ConvexHull:
        """All hulls of all parts, in order; those with fewer vertices repeat their last."""
        given: list[ConvexHull] = one_axis(cls, parts)
        most = max(part.vertices.shape[-2] for part in given)
        padded = [
            np.pad(
                p.vertices, ((0, 0), (0, most - p.vertices.shape[-2]), (0, 0)), "edge"
            )
            for p in given
        ]
        return cls._made(
            vertices=np.concatenate(padded),
            forms=np.concatenate([part.forms for part in given]),
            axes=np.concatenate([part.axes for part in given]),
        )
