"""Which corners bound which faces and edges of a convex polytope, whatever it spans.

A polygon has two faces, front and back; a segment one edge and no face; a point neither.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array, IntArray


@dataclass(frozen=True, eq=False)
class Topology:
    """Which points are corners, and how these bound faces and edges.

    Args:
        corners: (v,) which of the points are corners; all below number these, from 0.
        loop: the corners of each face, counterclockwise seen from outside, end to end.
        loop_start: (f + 1,) where the loop of each face starts.
        edges: (e, 2) the two corners of each edge.
        edge_faces: (e, 2) the face that runs along the edge, and the one that runs
            back; -1 where there is none.
        normals: (f, 3) unit normals out of the faces, in the axes in which the topology
            was found.
    """

    corners: IntArray
    loop: IntArray
    loop_start: IntArray
    edges: IntArray
    edge_faces: IntArray
    normals: Array


def topology_of_faces(
    corners: IntArray, faces: list[list[int]], normals: Array
) -> Topology:
    """The topology of a closed surface, from the loop of each face.

    Args:
        corners: (v,) which of the points are corners.
        faces: the corners of each face, counterclockwise seen from outside.
        normals: (f, 3).
    """
    runs = {
        (a, b): f
        for f, face in enumerate(faces)
        for a, b in zip(face, face[1:] + face[:1], strict=True)
    }
    edges = [(a, b) for a, b in runs if a < b]
    beside = [(runs[a, b], runs[b, a]) for a, b in edges]
    return Topology(
        corners,
        np.array([c for face in faces for c in face], dtype=np.intp),
        np.cumsum([0, *map(len, faces)], dtype=np.intp),
        np.array(edges, dtype=np.intp).reshape(-1, 2),
        np.array(beside, dtype=np.intp).reshape(-1, 2),
        normals,
    )


def point_topology(corner: int = 0) -> Topology:
    """One corner, no edge, no face."""
    return topology_of_faces(np.array([corner], dtype=np.intp), [], np.empty((0, 3)))


def segment_topology(start: int = 0, end: int = 1) -> Topology:
    """Two corners and the edge between them, beside which there is no face."""
    none = np.empty(0, dtype=np.intp)
    corners = np.array([start, end], dtype=np.intp)
    edge, faces = np.array([[0, 1]], dtype=np.intp), np.array([[-1, -1]], dtype=np.intp)
    start_of_none = np.zeros(1, dtype=np.intp)
    return Topology(corners, none, start_of_none, edge, faces, np.empty((0, 3)))


def polygon_topology(corners: IntArray, normal: Array) -> Topology:
    """A polygon, by its corners in order: a front face and, run backward, a back face."""
    front = list(range(len(corners)))
    both = np.array([normal, -normal])
    return topology_of_faces(corners, [front, front[::-1]], both)


def enclosed_volume(points: Array, topology: Topology) -> float:
    """The volume inside the faces [m^3]; 0 for what is flat.

    V = 1/6 sum a.(b x c) over triangles a, b, c, into which each face is split from its
    first corner (divergence theorem; Mirtich, Journal of Graphics Tools 1, 1996).

    Args:
        points: (n, 3) [m], of which the topology names the corners.
        topology: their faces.
    """
    length = np.diff(topology.loop_start)
    if length.size < 4:
        return 0.0
    corners = points[topology.corners] - points[topology.corners[0]]
    # In a unit near its size, so that only the result can leave the range.
    unit = int(np.frexp(np.abs(corners).max())[1])
    corners = np.ldexp(corners, -unit)
    first = np.repeat(topology.loop_start[:-1], length)
    a = corners[topology.loop[first]]
    b, c = corners[topology.loop], corners[topology.loop[onward(topology.loop_start)]]
    inside = max(float(np.sum(a * np.cross(b, c))) / 6, 0.0)
    return float(np.ldexp(inside, 3 * unit))


def onward(loop_start: IntArray) -> IntArray:
    """Where in end-to-end loops the next corner of the same loop stands, (l,)."""
    following = np.arange(1, loop_start[-1] + 1)
    following[loop_start[1:] - 1] = loop_start[:-1]
    return following
