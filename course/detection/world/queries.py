"""What else a world is asked: by a ray, a point, the nearest of all, a shape that moves.

Each answer is worked out by all colliders whose box is met, kind by kind.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.detection.hierarchy import BVH
from course.detection.world.members import LARGEST, Members
from course.detection.world.phases import below
from course.detection.world.rays import enters
from course.overlap import nearest_points, overlaps, time_of_impact
from course.shapes import AABB, Shape, Sphere


@dataclass(frozen=True, eq=False)
class RayHits:
    """What rays of batch (...) hit first.

    Attributes:
        handle: (...), -1 where nothing is hit.
        distance: (...) [m] from the origin; inf where nothing is hit, 0 where it starts inside.
        point: (..., 3) [m]; NaN where nothing is hit.
        normal: (..., 3) unit, out of what is hit; 0 where nothing is hit or it starts inside.
        inside: (...) whether the ray starts inside of it.
    """

    handle: IntArray
    distance: Array
    point: Array
    normal: Array
    inside: BoolArray


@dataclass(frozen=True, eq=False)
class Nearest:
    """The colliders nearest to points of batch (...).

    Attributes:
        handle: (...), -1 in an empty world.
        distance: (...) [m]; below 0 inside; inf in an empty world.
        point: (..., 3) [m], the place of its surface; NaN in an empty world.
    """

    handle: IntArray
    distance: Array
    point: Array


@dataclass(frozen=True, eq=False)
class Index:
    """The rows of a world that a mask wants, and a tree of their boxes.

    Attributes:
        solid, plane: rows that are bounded, and half spaces.
        box: (s, 6) of the solid rows, a little wider than their bounds [m].
        tree: of these boxes.
    """

    members: Members
    solid: IntArray
    plane: IntArray
    box: Array
    tree: BVH

    @classmethod
    def of(cls, members: Members, mask: int) -> Index:
        """The rows whose group a mask has."""
        wanted = (members.group & mask) != 0
        plane = members.is_plane
        solid = np.flatnonzero(wanted & ~plane)
        more = members.slack[solid, None]
        low, high = members.box[solid, :3] - more, members.box[solid, 3:] + more
        tree = BVH.build(AABB(low, high), method="morton")
        box = np.concatenate([low, high], axis=1)
        return cls(members, solid, np.flatnonzero(wanted & plane), box, tree)

    def met(self, boxes: AABB) -> tuple[IntArray, IntArray]:
        """Which rows the boxes (q,) meet: numbers of the boxes, rows."""
        asked, hit = self.tree.query(boxes).T
        bounds = np.concatenate([boxes.lower, boxes.upper], axis=1)
        every = np.arange(len(bounds))
        found = [(asked, self.solid[hit])]
        for row in self.plane:
            which = np.full(every.size, row)
            some = every[below(self.members, bounds, which, 0.0)]
            found.append((some, np.full(some.size, row)))
        q, rows = (np.concatenate(x) for x in zip(*found, strict=True))
        return q, rows

    def by_kind(self, rows: IntArray) -> Iterator[tuple[IntArray, Any]]:
        """Rows kind by kind: which of them, and their shapes."""
        sort = self.members.sort_number[rows]
        for number in np.unique(sort):
            some = np.flatnonzero(sort == number)
            yield some, self.members.shapes(int(number), rows[some])


def hit_by_rays(index: Index, p: Array, u: Array, length: Array) -> RayHits:
    """What rays p + t u, t from 0 to a length each, hit first; (q, 3), (q, 3), (q,)."""
    q, rows = _passed(index, p, u, length)
    distance, normal = np.full(rows.size, np.inf), np.zeros((rows.size, 3))
    inside = np.zeros(rows.size, dtype=bool)
    for some, shapes in index.by_kind(rows):
        found = enters(shapes, p[q[some]], u[q[some]])
        distance[some], normal[some], inside[some] = found
    distance[distance > length[q]] = np.inf
    best, has = _least(q, distance, index.members.handle[rows], len(p))
    t = np.full(len(p), np.inf)
    t[has] = distance[best]
    handle = np.full(len(p), -1)
    handle[has] = index.members.handle[rows[best]]
    point, out = np.full((len(p), 3), np.nan), np.zeros((len(p), 3))
    point[has] = p[has] + t[has, None] * u[has]
    out[has] = normal[best]
    began = np.zeros(len(p), dtype=bool)
    began[has] = inside[best]
    return RayHits(handle, t, point, out, began)


def _passed(index: Index, p: Array, u: Array, length: Array) -> tuple[IntArray, IntArray]:  # fmt: skip
    """Rays and rows whose boxes they pass through; all half spaces."""
    from course.detection.world.ray_loops import ray_pairs

    tree, box = index.tree, index.box
    found = np.empty((0, 2), dtype=np.intp)
    if len(box):
        low, high = box[:, :3].min(axis=0), box[:, 3:].max(axis=0)
        far = np.linalg.norm(np.maximum(np.abs(low - p), np.abs(high - p)), axis=1)
        way = np.minimum(length, 2.0 * far)[:, None] * u
        arrays = (tree.reach, tree.order, tree.right, tree.ranges)
        # Kernels are compiled for one type: in C order, and writable.
        origin, way = np.array(p, order="C"), np.array(way, order="C")
        found = ray_pairs(origin, way, box, *arrays).astype(np.intp)
    every = np.arange(len(p))
    q = np.concatenate([found[:, 0], np.repeat(every, index.plane.size)])
    rows = [index.solid[found[:, 1]], np.tile(index.plane, every.size)]
    return q, np.concatenate(rows)


def _least(q: IntArray, value: Array, handle: IntArray, count: int) -> tuple[IntArray, BoolArray]:  # fmt: skip
    """Of the entries of each asked one the least finite, of equal ones the lowest handle; and who has any."""
    order = np.lexsort((handle, value, q))
    order = order[np.isfinite(value[order])]
    first = order[np.flatnonzero(np.diff(q[order], prepend=-1))]
    has = np.zeros(count, dtype=bool)
    has[q[first]] = True
    return first, has


def containing(index: Index, p: Array) -> IntArray:
    """Which colliders hold which points (q, 3): (m, 2), number of the point and handle, sorted."""
    q, rows = index.met(AABB(p, p))
    holds = np.zeros(rows.size, dtype=bool)
    for some, shapes in index.by_kind(rows):
        holds[some] = overlaps(Sphere(p[q[some]], np.zeros(some.size)), shapes)
    pairs = np.column_stack([q, index.members.handle[rows]])[holds]
    return np.unique(pairs, axis=0)


def nearest_to(index: Index, p: Array) -> Nearest:
    """The nearest collider of each point (q, 3).

    None is further than the middle of the nearest coarse box and its radius; only those
    whose box is within that distance are asked.
    """
    q, rows = index.met(_within(index, p))
    value, spot = np.full(rows.size, np.inf), np.empty((rows.size, 3))
    for some, shapes in index.by_kind(rows):
        found = nearest_points(Sphere(p[q[some]], np.zeros(some.size)), shapes)
        value[some], spot[some] = found.gap, found.point_b
    best, has = _least(q, value, index.members.handle[rows], len(p))
    answer = Nearest(np.full(len(p), -1), np.full(len(p), np.inf), np.full((len(p), 3), np.nan))  # fmt: skip
    answer.handle[has] = index.members.handle[rows[best]]
    answer.distance[has], answer.point[has] = value[best], spot[best]
    return answer


def _within(index: Index, p: Array) -> AABB:
    """Boxes about points that meet the nearest collider's box."""
    from scipy.spatial import cKDTree

    if not index.solid.size:  # half spaces alone: all of them
        return AABB(p - 4 * LARGEST, p + 4 * LARGEST)
    center = index.members.coarse.now["center"][index.solid]
    away, which = cKDTree(center).query(p)
    reach = (away + index.members.radius[index.solid[which]]) * (1 + 1e-12)
    return AABB(p - reach[:, None], p + reach[:, None])


def met_by(index: Index, shape: Shape, velocity: Array, horizon: Array) -> tuple[IntArray, Array]:  # fmt: skip
    """What shapes of batch (q,) that move in straight lines meet first: handle (q,), -1 for none, and time (q,) [s]."""
    whole: Any = shape
    bounds, way = whole.bounds(), velocity * horizon[:, None]
    low, high = bounds.lower + np.minimum(way, 0.0), bounds.upper + np.maximum(way, 0.0)
    q, rows = index.met(AABB(low, high))
    time = np.full(rows.size, np.inf)
    for some, shapes in index.by_kind(rows):
        one = q[some]
        time[some] = time_of_impact(
            shape[one], shapes, velocity[one], np.zeros(3), horizon=horizon[one]
        )
    best, has = _least(q, time, index.members.handle[rows], shape.count)
    handle, first = np.full(shape.count, -1), np.full(shape.count, np.inf)
    handle[has], first[has] = index.members.handle[rows[best]], time[best]
    return handle, first
