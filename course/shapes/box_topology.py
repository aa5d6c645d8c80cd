"""Corners, faces and edges of a box, for each choice of axes in which it is flat."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray
from course.shapes.topology import (
    Topology,
    point_topology,
    polygon_topology,
    segment_topology,
    topology_of_faces,
)

#: The corners as signs of the half extents: corner 4 i + 2 j + k has x, y, z above 0
#: where i, j, k are 1.
CORNERS = np.array(
    [[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)]
)
CORNERS.setflags(write=False)


def which_box(extents: Array) -> IntArray:
    """The number in ``BOXES`` of boxes with these extents, (..., 3): 1, 2 and 4 where x,
    y and z are not 0."""
    return np.asarray((extents > 0) @ np.array([1, 2, 4]), dtype=np.intp)


def _rectangle(axis: int, side: int) -> list[int]:
    """The corners of the face at that side of an axis, counterclockwise from outside."""
    u, v = (
        ((axis + 1) % 3, (axis + 2) % 3) if side else ((axis + 2) % 3, (axis + 1) % 3)
    )
    bits = (4, 2, 1)
    base = side * bits[axis]
    return [base, base + bits[u], base + bits[u] + bits[v], base + bits[v]]


def _topology(solid: int) -> Topology:
    """The topology of boxes that extend along the axes whose bits are set."""
    wide = [axis for axis in range(3) if solid >> axis & 1]
    bits = (4, 2, 1)
    if len(wide) == 3:
        sides = [(axis, side) for axis in range(3) for side in (0, 1)]
        normals = np.array([np.eye(3)[a] * (1 if s else -1) for a, s in sides])
        faces = [_rectangle(axis, side) for axis, side in sides]
        return topology_of_faces(np.arange(8), faces, normals)
    if len(wide) == 2:
        flat = 3 - sum(wide)
        normal = np.eye(3)[flat]
        corners = np.array(_rectangle(flat, 1), dtype=np.intp)
        return polygon_topology(corners, normal)
    if len(wide) == 1:
        return segment_topology(0, bits[wide[0]])
    return point_topology()


#: The topologies of all eight.
BOXES = [_topology(solid) for solid in range(8)]
