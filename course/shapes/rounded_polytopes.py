"""What every bounded convex shape is to the algorithms: corners, faces, edges and a radius.

A sphere is a point with a radius, a capsule a segment with one; boxes, k-DOPs and hulls
have radius 0. All solids of a batch stand end to end in flat arrays, which is what
compiled loops take.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from course.arrays import Array, IntArray, failure, instances
from course.shapes.aabb import AABB
from course.shapes.box_topology import BOXES, CORNERS, which_box
from course.shapes.capsule import Capsule
from course.shapes.convex_hull import ConvexHull
from course.shapes.kdop import KDOP
from course.shapes.obb import OBB
from course.shapes.shape import Shape, unturned
from course.shapes.sphere import Sphere
from course.shapes.topology import Topology, point_topology, segment_topology

#: How many products of normals and points are formed at once.
AT_ONCE = 4_000_000


@dataclass(frozen=True, eq=False)
class Polytopes:
    """m rounded polytopes, each the hull of its vertices and all within a radius of it.

    Numbers of vertices, faces and edges count through all solids; those of solid i are
    ``start[i]`` to ``start[i + 1]``. A polygon has two faces, front and back; a segment
    one edge and no face; a point neither.

    Attributes:
        vertices: (V, 3) [m], corners only.
        vertex_start: (m + 1,).
        radius: (m,) [m].
        normals: (F, 3) unit normals out of the faces.
        offsets: (F,) the most n.x of the solid's vertices [m].
        face_start: (m + 1,).
        loop: (L,) the vertices of each face, counterclockwise seen from outside.
        loop_start: (F + 1,).
        edges: (E, 2) vertices.
        edge_faces: (E, 2) the face along which the edge runs from its first vertex to
            its second, and the one along which it runs back; -1 where there is none.
        edge_start: (m + 1,).
    """

    vertices: Array
    vertex_start: IntArray
    radius: Array
    normals: Array
    offsets: Array
    face_start: IntArray
    loop: IntArray
    loop_start: IntArray
    edges: IntArray
    edge_faces: IntArray
    edge_start: IntArray

    def __post_init__(self) -> None:
        for array in vars(self).values():
            array.setflags(write=False)

    def __len__(self) -> int:
        return self.radius.size

    @staticmethod
    def concatenate(parts: Iterable[Polytopes]) -> Polytopes:
        """All solids of all parts, in order."""
        given = instances("parts", parts, Polytopes)
        vertex = np.cumsum([0, *(len(p.vertices) for p in given)])
        face = np.cumsum([0, *(len(p.normals) for p in given)])
        edge = np.cumsum([0, *(len(p.edges) for p in given)])
        corner = np.cumsum([0, *(p.loop.size for p in given)])

        def starts(name: str, first: IntArray) -> IntArray:
            shifted = [
                getattr(p, name)[:-1] + f
                for p, f in zip(given, first[:-1], strict=True)
            ]
            return np.concatenate([*shifted, first[-1:]])

        def joined(name: str, first: IntArray | None = None) -> NDArray[Any]:
            arrays = [getattr(p, name) for p in given]
            if first is None:
                return np.concatenate(arrays)
            pairs = zip(arrays, first[:-1], strict=True)
            return np.concatenate([np.where(a < 0, a, a + f) for a, f in pairs])

        return Polytopes(
            joined("vertices"), starts("vertex_start", vertex), joined("radius"),
            joined("normals"), joined("offsets"), starts("face_start", face),
            joined("loop", vertex), starts("loop_start", corner),
            joined("edges", vertex), joined("edge_faces", face),
            starts("edge_start", edge),
        )  # fmt: skip


class Forms(NamedTuple):
    """m solids by the topology of each.

    points (m, n, 3); which (m,) numbers the topologies; axes (m, 3, 3) turn the
    normals that these give.
    """

    points: Array
    axes: Array
    which: IntArray
    topologies: list[Topology]


def polytopes(shape: Shape) -> Polytopes:
    """The rounded polytopes of a batch of convex bounded shapes, in C order.

    Source: van den Bergen, *Collision Detection in Interactive 3D Environments*,
    chapter 2 (convex shapes as Minkowski sums).

    Args:
        shape: of any kind but compound (ask for its parts) and half space.
    Raises:
        ValueError: another kind, an endless box, slabs without a point in common.
    """
    flat: Any = shape.reshaped(shape.count) if isinstance(shape, Shape) else shape
    if isinstance(flat, Sphere):
        point = np.zeros(flat.count, dtype=np.intp)
        axes = unturned(flat.batch)
        forms = Forms(flat.center[:, None], axes, point, [point_topology()])
        return _assembled(forms, flat.radius)
    if isinstance(flat, Capsule):
        ends = np.stack([flat.start, flat.end], axis=1)
        long = np.any(flat.start != flat.end, axis=-1).astype(np.intp)
        topologies = [point_topology(), segment_topology()]
        forms = Forms(ends, unturned(flat.batch), long, topologies)
        return _assembled(forms, flat.radius)
    if isinstance(flat, AABB | OBB):
        forms = _boxes(flat)
    elif isinstance(flat, KDOP):
        forms = Forms(flat.corners(), flat.axes, *_distinct(flat.forms))
    elif isinstance(flat, ConvexHull):
        forms = Forms(flat.vertices, flat.axes, *_distinct(flat.forms))
    else:
        got = getattr(shape, "kind", type(shape).__name__)
        raise failure("shape", "a convex bounded shape", f"a {got}")
    return _assembled(forms, np.zeros(flat.count))


def _boxes(box: AABB | OBB) -> Forms:
    """The corners of boxes; one that is flat in some axes has those of a rectangle,
    a segment or a point."""
    if isinstance(box, AABB):
        box.require_finite()
        ends = np.stack([box.lower, box.upper], axis=-1)
        points = ends[:, np.arange(3), (CORNERS > 0).astype(np.intp)]
        which = which_box(box.upper - box.lower)
        return Forms(points, unturned(box.batch), which, BOXES)
    arms = CORNERS * box.half_extents[:, None]
    points = box.center[:, None] + arms @ np.swapaxes(box.rotation, -1, -2)
    return Forms(points, box.rotation, which_box(box.half_extents), BOXES)


def _distinct(forms: NDArray[Any]) -> tuple[IntArray, list[Topology]]:
    """Each form once, and which of them every solid has."""
    number: dict[int, int] = {}
    once: list[Any] = []
    which = np.empty(forms.size, dtype=np.intp)
    for i, form in enumerate(forms.tolist()):
        if id(form) not in number:
            number[id(form)] = len(once)
            once.append(form)
        which[i] = number[id(form)]
    return which, [form.topology for form in once] or [point_topology()]


class Places(NamedTuple):
    """Where the rows of each solid start in the flat arrays, (m + 1,) each."""

    vertex: IntArray
    face: IntArray
    corner: IntArray  # of a face's loop
    edge: IntArray


def _places(which: IntArray, topologies: list[Topology]) -> Places:
    """Solids end to end, in order."""

    def starts(lengths: list[int]) -> IntArray:
        each = np.array(lengths, dtype=np.intp)[which]
        return np.concatenate([[0], np.cumsum(each)]).astype(np.intp)

    return Places(
        starts([t.corners.size for t in topologies]),
        starts([len(t.normals) for t in topologies]),
        starts([t.loop.size for t in topologies]),
        starts([len(t.edges) for t in topologies]),
    )


def _assembled(forms: Forms, radius: Array) -> Polytopes:
    """All solids end to end: the blocks of one topology are put in their places at once."""
    start = _places(forms.which, forms.topologies)
    vertices, normals = np.empty((start.vertex[-1], 3)), np.empty((start.face[-1], 3))
    offsets = np.empty(start.face[-1])
    loop = np.empty(start.corner[-1], dtype=np.intp)
    loop_start = np.full(start.face[-1] + 1, loop.size, dtype=np.intp)
    edges, edge_faces = np.empty((2, start.edge[-1], 2), dtype=np.intp)
    groups = _groups(forms.which, len(forms.topologies))
    for topology, solids in zip(forms.topologies, groups, strict=True):
        vertex, face, corner, edge = (each[solids, None] for each in start)
        points = forms.points[solids[:, None], topology.corners]
        turn = np.swapaxes(forms.axes[solids], -1, -2)
        outward = topology.normals @ turn
        outward /= np.linalg.norm(outward, axis=-1, keepdims=True)
        faces = face + np.arange(len(topology.normals))
        vertices[vertex + np.arange(topology.corners.size)] = points
        normals[faces], offsets[faces] = outward, _farthest_along(outward, points)
        loop[corner + np.arange(topology.loop.size)] = vertex + topology.loop
        loop_start[faces] = corner + topology.loop_start[:-1]
        rows = edge + np.arange(len(topology.edges))
        edges[rows] = vertex[..., None] + topology.edges
        beside = topology.edge_faces
        edge_faces[rows] = np.where(beside < 0, -1, face[..., None] + beside)
    return Polytopes(
        vertices, start.vertex, np.array(radius), normals, offsets, start.face,
        loop, loop_start, edges, edge_faces, start.edge,
    )  # fmt: skip


def _groups(which: IntArray, count: int) -> list[IntArray]:
    """The solids of each topology."""
    order = np.argsort(which, kind="stable").astype(np.intp)
    return np.split(order, np.searchsorted(which[order], np.arange(1, count)))


def _farthest_along(normals: Array, points: Array) -> Array:
    """The most n.x over all points of a solid, (k, f), for normals (k, f, 3), points (k, v, 3).

    Not over those of the face alone: a sliver's normal may be so rough that another
    corner lies beyond its plane.
    """
    across = np.swapaxes(points, -1, -2)
    step = max(1, AT_ONCE // max(1, points.shape[0] * points.shape[1]))
    some = [
        (normals[:, i : i + step] @ across).max(axis=-1)
        for i in range(0, normals.shape[1], step)
    ]
    return np.concatenate(some, axis=1) if some else np.empty(normals.shape[:2])
