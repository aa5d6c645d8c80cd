"""Pairs of shapes worked out for a picture: their shadows on all axes, and how far one gets until they overlap."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas, rotations
from course.arrays import Array, IntArray
from course.study.asking import asked

TRIANGLE = np.array([[-0.9, -0.55], [1.0, -0.35], [-0.2, 0.85]])
PENTAGON = np.array([[-0.9, -0.3], [-0.1, -0.9], [0.9, -0.5], [0.7, 0.6], [-0.4, 0.8]])
#: Whether shapes overlap; the second, always the same one, is in the function.
Verdict = Callable[..., bool]


@dataclass(frozen=True, eq=False)
class PolygonShadows:
    """Two convex polygons and their shadows on the normals of all their edges.

    Args:
        a, b: vertices, (n, 2) and (m, 2) [m].
        axes: (n + m, 2), A's first.
        shadow_a, shadow_b: lower and upper ends, (n + m, 2) [m].
        gap: (n + m,) [m].
    """

    a: Array
    b: Array
    axes: Array
    shadow_a: Array
    shadow_b: Array
    gap: Array

    @property
    def best(self) -> int:
        """The axis of the greatest gap."""
        return int(np.argmax(self.gap))

    @property
    def overlap(self) -> bool:
        """Whether no axis has a gap."""
        return bool(self.gap.max() <= 0)


def polygon_shadows(a: Array, b: Array) -> PolygonShadows:
    """The shadows of two convex polygons, counter-clockwise, (n, 2) and (m, 2) [m]."""
    axes = np.concatenate([formulas.edge_normals(a), formulas.edge_normals(b)])
    shadows = formulas.project(a, axes), formulas.project(b, axes)
    gap = formulas.shadow_gap(*shadows[0], *shadows[1])
    shadow_a, shadow_b = (np.stack(ends, axis=-1) for ends in shadows)
    return PolygonShadows(a, b, axes, shadow_a, shadow_b, gap)


@dataclass(frozen=True, eq=False)
class TurningAxis:
    """Shadows on an axis that turns.

    Args:
        axis: (t, 2).
        shadow_a, shadow_b: lower and upper ends, (t, 2) [m].
        gap: (t,) [m].
        bounding: the polygon, and the numbers of its corners (t,), at the lower and the
            upper end of A's, then of B's shadow.
    """

    axis: Array
    shadow_a: Array
    shadow_b: Array
    gap: Array
    bounding: tuple[tuple[Array, IntArray], ...]


def turning_axis(found: PolygonShadows, degrees: Array) -> TurningAxis:
    """Shadows on the axis of the greatest gap, turned on by these angles (t,)."""
    first = found.axes[found.best]
    angle = np.arctan2(first[1], first[0]) + np.radians(degrees)
    axis = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    ends = formulas.project(found.a, axis), formulas.project(found.b, axis)
    bounding = tuple(
        (polygon, pick(polygon @ axis.T, axis=0))
        for polygon in (found.a, found.b)
        for pick in (np.argmin, np.argmax)
    )
    shadow_a, shadow_b = (np.stack(e, axis=-1) for e in ends)
    gap = formulas.shadow_gap(*ends[0], *ends[1])
    return TurningAxis(axis, shadow_a, shadow_b, gap, bounding)


def common(shadow_a: Array, shadow_b: Array) -> Array:
    """Between which two places the gap lies, or what is in common, (k, 2) [m]."""
    lower = np.maximum(shadow_a[:, 0], shadow_b[:, 0])
    upper = np.minimum(shadow_a[:, 1], shadow_b[:, 1])
    return np.sort(np.stack([lower, upper], axis=-1), axis=-1)


def turned(polygon: Array, degrees: float, place: tuple[float, float]) -> Array:
    """A polygon turned about its origin and put at a place."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.asarray(polygon @ np.array([[c, s], [-s, c]]) + place)


# How an exercise's function decides: the rest of the verdict is the right one.


def by_verdict(function: Callable[..., Any]) -> Verdict:
    """Of ``polygons_overlap``."""
    return lambda a, b: bool(asked(function, [()], a, b)[0])


def by_gap(function: Callable[..., Any]) -> Verdict:
    """Of ``shadow_gap``, on the right axes."""

    def verdict(a: Array, b: Array) -> bool:
        found = polygon_shadows(a, b)
        ends = (*found.shadow_a.T, *found.shadow_b.T)
        (gap,) = asked(function, [(len(found.gap),)], *ends)
        return bool(gap.max() <= 0)

    return verdict


def stopped_at(overlap: Callable[[float], bool], way: Array) -> tuple[float, bool]:
    """The place on a way at which a verdict first is overlap, and whether it ever is.

    The way's places are tried in turn, and between two of them the change is found by
    halving.
    """
    for k, place in enumerate(way):
        if not overlap(float(place)):
            continue
        if k == 0:
            return float(place), True
        free, met = float(way[k - 1]), float(place)
        for _ in range(24):
            middle = 0.5 * (free + met)
            free, met = (free, middle) if overlap(middle) else (middle, met)
        return met, True
    return float(way[-1]), False


# Two cubes, one turned by 45 degrees about x, the other about y, and the other sinks.


@dataclass(frozen=True, eq=False)
class SinkingBoxes:
    """A box that sinks onto another until a verdict stops it.

    Args:
        times: (t,) [s].
        height: of its centre over that of the lower box, (t,) [m].
        rotation: of both, (2, 3, 3).
        place: (2,) x and y of the upper one [m].
        half_extents: of both, (2, 3) [m].
        faces, edges: the greatest gap on the six face normals, and on the nine products
            of edges, (t,) [m].
        stopped: whether the verdict stopped it.
    """

    times: Array
    height: Array
    rotation: Array
    place: Array
    half_extents: Array
    faces: Array
    edges: Array
    stopped: bool


def sinking_boxes(
    turn: float, aside: float, times: Array, function: Callable[..., Any]
) -> SinkingBoxes:
    """The upper cube, half a side of 1 m, sinks from 4.4 m at 1 m/s.

    Args:
        turn: by which it is turned about z against the lower one [degrees].
        aside: x of its centre [m].
        function: ``oriented_boxes_overlap``, asked at each moment.
    """
    quarter = np.pi / 4
    lower = rotations.from_rotation_vector(np.array([quarter, 0.0, 0.0]))
    upper = rotations.from_rotation_vector(np.array([0.0, quarter, 0.0]))
    about_z = rotations.from_rotation_vector(np.array([0.0, 0.0, np.radians(turn)]))
    rotation = np.stack([
        rotations.to_matrix(lower), rotations.to_matrix(about_z) @ rotations.to_matrix(upper),
    ])  # fmt: skip
    e = np.ones((2, 3))
    place = np.array([aside, 0.0])
    way = 4.4 - times

    def pair(height: float) -> tuple[Array, ...]:
        at = np.array([*place, height])
        return np.zeros(3), rotation[0], e[0], at, rotation[1], e[1]

    def overlap(height: float) -> bool:
        return bool(asked(function, [()], *pair(height))[0])

    stop, met = stopped_at(overlap, way)
    height = np.maximum(way, stop)
    gaps = np.array([_gaps(rotation, e, np.array([*place, h])) for h in height])
    faces, edges = gaps[:, 0], gaps[:, 1]
    return SinkingBoxes(times, height, rotation, place, e, faces, edges, met)


def _gaps(rotation: Array, e: Array, between: Array) -> tuple[float, float]:
    """The greatest gap on the face normals, and on the products of edges that are not parallel."""
    axes = formulas.box_axes(*rotation)
    length = np.linalg.norm(axes, axis=-1)
    axes = axes / np.maximum(length, 1e-9)[:, None]
    half = [np.abs(axes @ r) @ s for r, s in zip(rotation, e, strict=True)]
    gap = np.abs(axes @ between) - half[0] - half[1]
    gap[length < 1e-9] = -np.inf
    return float(gap[:6].max()), float(gap[6:].max())


def crossed_gaps(height: float) -> tuple[float, float]:
    """The greatest gap on faces and on edges of the two crossed cubes, B's centre this high [m]."""
    high = 4.4 - height
    sunk = sinking_boxes(0.0, 0.0, np.array([high]), lambda *boxes: False)
    return float(sunk.faces[0]), float(sunk.edges[0])


@dataclass(frozen=True, eq=False)
class DifferenceBody:
    """All differences a - b of two convex polygons, a convex polygon again.

    Args:
        a, b: vertices, (n, 2) and (m, 2) [m].
        corners: (n + m, 2) [m], counter-clockwise.
        owner: of the edge from each corner on, "A" or "B".
        distance: of 0 from it, below 0 inside: the greatest gap [m].
        beyond: the ends of the edge that 0 is farthest beyond, (2, 2) [m].
    """

    a: Array
    b: Array
    corners: Array
    owner: tuple[str, ...]
    distance: float
    beyond: Array


def difference_body(a: Array, b: Array) -> DifferenceBody:
    """The hull of all differences of corners, by Qhull, and whose edge each of its edges is."""
    from scipy.spatial import ConvexHull

    differences = (a[:, None] - b[None]).reshape(-1, 2)
    corners = differences[ConvexHull(differences).vertices]
    normals = formulas.edge_normals(corners)
    alike = normals @ formulas.edge_normals(a).T
    owner = tuple("A" if row.max() > 1 - 1e-9 else "B" for row in alike)
    outside = -np.sum(normals * corners, axis=-1)
    k = int(np.argmax(outside))
    beyond = corners[[k, (k + 1) % len(corners)]]
    gap = float(polygon_shadows(a, b).gap.max())
    return DifferenceBody(a, b, corners, owner, gap, beyond)
