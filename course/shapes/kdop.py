"""The discrete oriented polytope: slabs along fixed directions (syllabus row 5)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from course.arrays import Array, ArrayLike, IntArray, failure, scalars, unit_vectors
from course.shapes.aabb import AABB, require_ordered
from course.shapes.hull_topology import ROUNDING, hull_topology_of
from course.shapes.shape import (
    Shape,
    directions,
    farthest,
    lazy,
    one_axis,
    pose,
    turned,
    unturned,
)
from course.shapes.topology import Topology, enclosed_volume

#: How far outside a plane a corner may lie, in widths of the solid.
OUTSIDE = 1e-12


class KDOPForm:
    """The corners of one k-DOP as planes that meet, found when first asked for."""

    def __init__(self, normals: Array, offsets: Array, index: int) -> None:
        self._normals, self._offsets, self._index = normals, offsets, index

    @cached_property
    def _found(self) -> tuple[IntArray, Topology, float]:
        normals, offsets = self._normals[self._index], self._offsets[self._index]
        planes, points = corners_of_planes(normals, offsets, self._index)
        found = hull_topology_of(points)
        # Each face lies in one of the planes, whose normal is known exactly.
        nearest = np.argmax(found.normals @ normals.T, axis=1)
        every = np.arange(len(found.corners))
        topology = replace(found, corners=every, normals=normals[nearest])
        return planes[found.corners], topology, enclosed_volume(points, found)

    @property
    def planes(self) -> IntArray:
        """(v, 3) the three planes that meet in each corner, by number."""
        return self._found[0]

    @property
    def topology(self) -> Topology:
        """Faces and edges, as numbers of the corners."""
        return self._found[1]

    @property
    def volume(self) -> float:
        """What the faces enclose [m^3]."""
        return self._found[2]


@dataclass(frozen=True, eq=False)
class KDOP(Shape):
    """k-DOPs: l_i <= x.d_i <= u_i for k/2 directions, a pair of planes each.

    Source: Klosowski, Held, Mitchell, Sowizral, Zikan, IEEE TVCG 4, 1998; Ericson,
    *Real-Time Collision Detection*, section 4.6; syllabus row 5.

    Args:
        directions: d, unit vectors that span space, (..., k/2, 3).
        lower, upper: l <= u, (..., k/2) [m].
    Attributes:
        forms: (...) the ``KDOPForm`` of each, which goes along when it moves.
        axes: (..., 3, 3) how far each has been turned since its form was made.
    Raises:
        ValueError: lower > upper, directions not of unit length or all in one plane
            (the solid would be endless), NaN or infinity, a wrong shape. Slabs that
            have no point in common are refused where corners are first needed.
    """

    directions: Array
    lower: Array
    upper: Array
    forms: NDArray[Any] = field(init=False, repr=False)
    axes: Array = field(init=False, repr=False)

    kind: ClassVar[str] = "kdop"
    core_axes: ClassVar[dict[str, int]] = {
        "directions": 2,
        "lower": 1,
        "upper": 1,
        "forms": 0,
        "axes": 2,
    }

    def __post_init__(self) -> None:
        d = unit_vectors("directions", self.directions)
        lower, upper = scalars("lower", self.lower), scalars("upper", self.upper)
        if d.ndim < 2 or d.shape[-2] < 3:
            expected = "at least 3 directions, shape (..., k, 3)"
            raise failure("directions", expected, f"shape {d.shape}")
        for name, array in ("lower", lower), ("upper", upper):
            if array.ndim == 0 or array.shape[-1] != d.shape[-2]:
                expected = f"one number a direction, shape (..., {d.shape[-2]})"
                raise failure(name, expected, f"shape {array.shape}")
        _require_spanning(d)
        self._keep(directions=d, lower=lower, upper=upper)
        require_ordered(self.lower, self.upper)
        normals, offsets = self._flat_planes()
        forms = lazy(self.batch, lambda i: KDOPForm(normals, offsets, i))
        object.__setattr__(self, "forms", forms)
        object.__setattr__(self, "axes", unturned(self.batch))

    def planes(self) -> tuple[Array, Array]:
        """All planes n.x <= o: n = d then -d, (..., k, 3); o = u then -l, (..., k)."""
        normals = np.concatenate([self.directions, -self.directions], axis=-2)
        offsets = np.concatenate([self.upper, -self.lower], axis=-1)
        return normals, offsets

    def _flat_planes(self) -> tuple[Array, Array]:
        normals, offsets = self.planes()
        flat = normals.reshape(-1, *normals.shape[-2:])
        return flat, offsets.reshape(-1, offsets.shape[-1])

    def corners(self) -> Array:
        """The corners, (..., v, 3) [m]; where a batch's numbers differ, with repeats.

        Each is where three planes meet.
        Raises:
            ValueError: slabs that have no point in common.
        """
        forms = self.forms.ravel().tolist()
        most = max((len(form.planes) for form in forms), default=1)
        meeting = np.empty((self.count, most, 3), dtype=np.intp)
        for i, form in enumerate(forms):
            found = form.planes
            meeting[i, : len(found)], meeting[i, len(found) :] = found, found[-1]
        normals, offsets = self._flat_planes()
        every = np.arange(self.count)[:, None, None]
        points = meeting_points(normals[every, meeting], offsets[every, meeting])
        return points.reshape(*self.batch, most, 3)

    def support(self, direction: ArrayLike) -> Array:
        """The corner farthest along a direction.

        Args:
            direction: (..., 3), not zero; broadcast with the batch.
        Returns:
            (..., 3) [m].
        """
        u, _ = directions(self, direction)
        return farthest(self.corners(), u)

    def bounds(self) -> AABB:
        """The least axis-aligned box around each: that of the corners."""
        points = self.corners()
        return AABB(points.min(axis=-2), points.max(axis=-2))

    def moved(self, rotation: ArrayLike, translation: ArrayLike) -> KDOP:
        """Each turned about the origin, then shifted: d' = R d, l' = l + d'.t, u' = u + d'.t.

        Args:
            rotation: R, (..., 3, 3).
            translation: t, (..., 3) [m].
        """
        turn, shift, batch = pose(self, rotation, translation)
        d = self.directions @ np.swapaxes(turn, -1, -2)
        along = turned(d, shift)
        k = d.shape[-2]
        return self._made(
            directions=np.broadcast_to(d, (*batch, k, 3)),
            lower=np.broadcast_to(self.lower + along, (*batch, k)),
            upper=np.broadcast_to(self.upper + along, (*batch, k)),
            forms=np.broadcast_to(self.forms, batch),
            axes=np.broadcast_to(turn @ self.axes, (*batch, 3, 3)),
        )

    def volume(self) -> Array:
        """The sum of the pyramids over the faces, (...) [m^3]; 0 for a flat one."""
        volumes = [form.volume for form in self.forms.ravel()]
        return np.array(volumes, dtype=np.float64).reshape(self.batch)

    @classmethod
    def concatenate(cls, parts: Iterable[KDOP]) -> KDOP:
        """All k-DOPs of all parts, in order, each with the same number of directions."""
        given: list[KDOP] = one_axis(cls, parts)
        k = given[0].directions.shape[-2]
        for i, part in enumerate(given):
            if part.directions.shape[-2] != k:
                got = f"{part.directions.shape[-2]} directions"
                raise failure(f"parts[{i}]", f"{k} directions, as parts[0] has", got)
        return super().concatenate(given)


def corners_of_planes(
    normals: Array, offsets: Array, index: int
) -> tuple[IntArray, Array]:
    """The points where three planes meet and none is exceeded, each once.

    Every three of the planes are tried: for the 14 to 26 of a k-DOP that is quick, and
    no flat or touching case is special.

    Args:
        normals: (k, 3).
        offsets: (k,).
        index: of the solid, for the message.
    Returns:
        The planes of each corner, (v, 3), and the corners, (v, 3).
    """
    triples = np.array(list(combinations(range(len(normals)), 3)), dtype=np.intp)
    volume = np.linalg.det(normals[triples])
    triples = triples[np.abs(volume) > 1e-6]
    triples = triples[np.argsort(-np.abs(np.linalg.det(normals[triples])))]
    # From a point near the solid, so that far from the origin nothing is lost.
    half = len(normals) // 2
    middle = 0.5 * (offsets[:half] - offsets[half:])
    near = np.linalg.lstsq(normals[:half], middle, rcond=None)[0]
    room = offsets - normals @ near
    points = meeting_points(normals[triples], room[triples])
    size = np.abs(room).max()
    slack = OUTSIDE * size + ROUNDING * np.abs(offsets).max()
    inside = (points @ normals.T <= room + slack).all(axis=-1)
    if not np.any(inside):
        raise failure(
            "lower, upper", "slabs that have a point in common", "none", (index,)
        )
    once = _distinct(points[inside], 2 * slack)
    return triples[inside][once], near + points[inside][once]


def _distinct(points: Array, slack: float) -> IntArray:
    """The first of the points at each place: where the planes meet most steeply."""
    once: list[int] = []
    rest = np.arange(len(points))
    while rest.size:
        once.append(int(rest[0]))
        rest = rest[np.abs(points[rest] - points[rest[0]]).max(axis=1) > slack]
    return np.array(once, dtype=np.intp)


def meeting_points(normals: Array, offsets: Array) -> Array:
    """Where three planes n.x = o meet, by Cramer's rule; (..., 3, 3) and (..., 3).

    x = (o_1 n_2 x n_3 + o_2 n_3 x n_1 + o_3 n_1 x n_2) / n_1.(n_2 x n_3)
    Source: Ericson, *Real-Time Collision Detection*, section 5.4.5.
    """
    a, b, c = (normals[..., i, :] for i in range(3))
    crosses = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=-2)
    volume = np.sum(a * crosses[..., 0, :], axis=-1)
    weighted = np.sum(offsets[..., None] * crosses, axis=-2)
    return np.asarray(weighted / volume[..., None])


def _require_spanning(d: Array) -> None:
    least = np.linalg.svd(d, compute_uv=False)[..., 2]
    if np.any(least < 1e-6):
        index = tuple(np.argwhere(least < 1e-6)[0])
        expected = "directions that span space"
        raise failure("directions", expected, "directions in one plane", index)
