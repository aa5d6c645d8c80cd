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
from course.shapes.hull_topology import Topology, point_topology, segment_topology
from course.shapes.kdop import KDOP
from course.shapes.obb import OBB
from course.shapes.shape import Shape
from course.shapes.sphere import Sphere

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

    points (m, n, 3); which (m,) numbers the topologies; rotation (m, 3, 3) of the
    normals that these give in the shape's own axes, if they do.
    """

    points: Array
    which: IntArray
    topologies: list[Topology]
    rotation: Array | None = None


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
        forms = Forms(flat.center[:, None], point, [point_topology()])
        return _assembled(forms, flat.radius)
    if isinstance(flat, Capsule):
        ends = np.stack([flat.start, flat.end], axis=1)
        long = np.any(flat.start != flat.end, axis=-1).astype(np.intp)
        forms = Forms(ends, long, [point_topology(), segment_topology()])
        return _assembled(forms, flat.radius)
    if isinstance(flat, AABB | OBB):
        forms = _boxes(flat)
    elif isinstance(flat, KDOP):
        forms = Forms(flat.corners(), *_distinct(flat.forms))
    elif isinstance(flat, ConvexHull):
        forms = Forms(flat.vertices, *_distinct(flat.forms))
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
        turn = np.broadcast_to(np.eye(3), (box.count, 3, 3))
        return Forms(points, which_box(box.upper - box.lower), BOXES, turn)
    arms = CORNERS * box.half_extents[:, None]
    points = box.center[:, None] + arms @ np.swapaxes(box.rotation, -1, -2)
    return Forms(points, which_box(box.half_extents), BOXES, box.rotation)


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
    return which, [form.topology for form in once]


def _assembled(forms: Forms, radius: Array) -> Polytopes:
    """All solids end to end: each topology's blocks are put in their places at once."""
    points, which, topologies, _ = forms

    def start(lengths: list[int]) -> IntArray:
        each = np.array(lengths, dtype=np.intp)[which]
        return np.concatenate([[0], np.cumsum(each)]).astype(np.intp)

    vertex_start = start([t.corners.size for t in topologies])
    face_start = start([t.loop_start.size - 1 for t in topologies])
    loop_place = start([t.loop.size for t in topologies])
    edge_start = start([len(t.edges) for t in topologies])
    vertices = np.empty((vertex_start[-1], 3))
    known = np.empty((face_start[-1], 3))
    loop = np.empty(loop_place[-1], dtype=np.intp)
    loop_start = np.empty(face_start[-1] + 1, dtype=np.intp)
    loop_start[-1] = loop.size
    edges, edge_faces = np.empty((2, edge_start[-1], 2), dtype=np.intp)
    groups = _groups(which, len(topologies))
    for topology, solids in zip(topologies, groups, strict=True):
        if not solids.size:
            continue
        vertex, face = vertex_start[solids, None], face_start[solids, None]
        vertices[vertex + np.arange(topology.corners.size)] = points[
            solids[:, None], topology.corners
        ]
        row = face + np.arange(topology.loop_start.size - 1)
        loop_start[row] = loop_place[solids, None] + topology.loop_start[:-1]
        place = loop_place[solids, None] + np.arange(topology.loop.size)
        loop[place] = vertex + topology.loop
        if topology.normals is not None and forms.rotation is not None:
            turn = np.swapaxes(forms.rotation[solids], -1, -2)
            known[row] = topology.normals @ turn
        place = edge_start[solids, None] + np.arange(len(topology.edges))
        edges[place] = vertex[..., None] + topology.edges
        beside = topology.edge_faces
        edge_faces[place] = np.where(beside < 0, -1, face[..., None] + beside)
    normals = known
    if forms.rotation is None:
        normals = _loop_normals(vertices, loop, loop_start)
    starts = vertex_start, face_start
    offsets = _offsets(vertices, normals, starts, groups)
    return Polytopes(
        vertices, vertex_start, np.array(radius), normals, offsets, face_start,
        loop, loop_start, edges, edge_faces, edge_start,
    )  # fmt: skip


def _groups(which: IntArray, count: int) -> list[IntArray]:
    """The solids of each topology."""
    order = np.argsort(which, kind="stable").astype(np.intp)
    return np.split(order, np.searchsorted(which[order], np.arange(1, count)))


def _loop_normals(vertices: Array, loop: IntArray, loop_start: IntArray) -> Array:
    """The unit normal of each face by Newell's sum of (x_i - x_0) x (x_i+1 - x_0)."""
    if loop_start.size == 1:
        return np.empty((0, 3))
    first, length = loop_start[:-1], np.diff(loop_start)
    onward = np.arange(1, loop.size + 1)
    onward[loop_start[1:] - 1] = first
    origin = np.repeat(vertices[loop[first]], length, axis=0)
    here, there = vertices[loop] - origin, vertices[loop[onward]] - origin
    # In the size of the face, so that no square of a length leaves the range.
    reach = np.maximum.reduceat(np.abs(here).max(axis=1), first)
    unit = np.repeat(reach, length)[:, None]
    total = np.add.reduceat(np.cross(here / unit, there / unit), first, axis=0)
    return np.asarray(total / np.linalg.norm(total, axis=1, keepdims=True))


def _offsets(
    vertices: Array,
    normals: Array,
    starts: tuple[IntArray, IntArray],
    groups: list[IntArray],
) -> Array:
    """The most n.x over all vertices of a face's solid.

    Not of the face alone: a sliver's normal may be so rough that another vertex lies
    beyond its plane.
    """
    vertex_start, face_start = starts
    offsets = np.empty(len(normals))
    for solids in groups:
        if not solids.size:
            continue
        corners = int(vertex_start[solids[0] + 1] - vertex_start[solids[0]])
        faces = int(face_start[solids[0] + 1] - face_start[solids[0]])
        points = vertices[vertex_start[solids, None] + np.arange(corners)]
        across = np.swapaxes(points, -1, -2)
        step = max(1, AT_ONCE // (solids.size * corners))
        for some in range(0, faces, step):
            row = face_start[solids, None] + np.arange(some, min(some + step, faces))
            offsets[row] = (normals[row] @ across).max(axis=-1)
    return offsets


def polytope_volumes(solids: Polytopes) -> Array:
    """The volume that the faces of each solid enclose, (m,) [m^3]; the radius is not read.

    The sum over the faces of area times height above a vertex of the solid, a third of
    it: V = 1/6 sum a.(b x c) over fans of triangles (divergence theorem).
    Source: Mirtich, Journal of Graphics Tools 1, 1996.
    """
    length = np.diff(solids.loop_start)
    face_of = np.repeat(np.arange(length.size), length)
    solid_of = np.repeat(np.arange(len(solids)), np.diff(solids.face_start))[face_of]
    origin = solids.vertices[solids.vertex_start[solid_of]]
    first = solids.loop_start[face_of]
    onward = np.arange(1, solids.loop.size + 1)
    onward[solids.loop_start[1:] - 1] = solids.loop_start[:-1]
    corner = solids.vertices[solids.loop]
    a, b = solids.vertices[solids.loop[first]] - origin, corner - origin
    c = corner[onward] - origin
    six = np.sum(a * np.cross(b, c), axis=-1)
    volume = np.bincount(solid_of, six, minlength=len(solids)) / 6
    return np.where(np.diff(solids.face_start) > 2, np.maximum(volume, 0.0), 0.0)
