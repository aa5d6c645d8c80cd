"""Patches of boxes, straight from centre, axes and half extents.

The same patches, with the same numbers, as ``supporting_patch`` finds from a box's
vertices, faces and edges (a test compares them); a box needs no search: the signs of its
axes along N say which corner is highest, and their sizes what is flat.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.manifold.patches import (
    FLAT_COSINE,
    FLAT_SINE,
    LEAN_BIAS,
    A,
    B,
    desk,
)

#: The bits of a corner's number that say on which side of the axes it lies.
BIT = (4, 2, 1)
#: The corners of each face, counter-clockwise from outside: at the low and high end of
#: x, then of y and of z (``course.shapes.box_topology``).
LOOP = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1),
                 (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])  # fmt: skip
#: The edge that leaves a corner along x, y or z.
EDGE_AT = np.array([(4, 8, 0), (10, 1, 0), (9, 8, 6), (7, 1, 6),
                    (4, 2, 5), (10, 11, 5), (9, 2, 3), (7, 11, 3)])  # fmt: skip


@compiled
def box_patch(
    center: Array,
    axes: Array,
    half: Array,
    p: int,
    side: int,
    origin: Array,
    normal: Array,
    corner: Array,
    vertex: IntArray,
    face_normal: Array,
) -> tuple[int, int]:
    """The patch of box p that looks along N (side B) or against it (side A): as ``supporting_patch``."""
    sign = 1.0 if side == B else -1.0
    top, lean, flat, face = 0, 1.0, -1, -1
    for k in range(3):
        along = sign * (
            normal[0] * axes[p, 0, k]
            + normal[1] * axes[p, 1, k]
            + normal[2] * axes[p, 2, k]
        )
        if along > 0.0:
            top += BIT[k]
        if abs(along) >= FLAT_COSINE:
            face = k
        if abs(along) < lean - LEAN_BIAS:
            lean, flat = abs(along), k
    if face >= 0:
        up = 1 if top & BIT[face] else 0
        for k in range(4):
            place = k if side == B else 3 - k
            put(center, axes, half, p, LOOP[2 * face + up, k], side, place, origin, corner, vertex)  # fmt: skip
        for axis in range(3):
            face_normal[side, axis] = (2 * up - 1) * axes[p, axis, face]
        return 4, 2 * face + up
    if lean < FLAT_SINE - LEAN_BIAS:
        low = top & (7 - BIT[flat])
        put(center, axes, half, p, low, side, 0, origin, corner, vertex)
        put(center, axes, half, p, low + BIT[flat], side, 1, origin, corner, vertex)
        return 2, EDGE_AT[low, flat]
    put(center, axes, half, p, top, side, 0, origin, corner, vertex)
    return 1, top


@compiled
def put(
    center: Array,
    axes: Array,
    half: Array,
    p: int,
    v: int,
    side: int,
    place: int,
    origin: Array,
    corner: Array,
    vertex: IntArray,
) -> None:
    """Corner v of box p becomes a corner of the patch."""
    x = half[p, 0] if v & 4 else -half[p, 0]
    y = half[p, 1] if v & 2 else -half[p, 1]
    z = half[p, 2] if v & 1 else -half[p, 2]
    for axis in range(3):
        corner[side, place, axis] = (
            (center[p, axis] - origin[axis])
            + axes[p, axis, 0] * x
            + axes[p, axis, 1] * y
            + axes[p, axis, 2] * z
        )
    vertex[side, place] = v


@compiled
def box_number(
    kind: int, place: int, corners: int, feature: int, side: int, vertex: IntArray
) -> int:
    """The number of a feature of a box: 8 vertices, then 12 edges, then 6 faces."""
    if kind == 0:
        return vertex[side, place]
    if kind == 2:
        return 20 + feature
    p = vertex[side, place]
    q = vertex[side, place + 1 if place + 1 < corners else 0]
    across = p ^ q
    return 8 + EDGE_AT[p, 0 if across == 4 else (1 if across == 2 else 2)]


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    room, up = desk(4, 4), np.array([0.0, 0.0, 1.0])
    for normal in (up, np.full(3, 0.6)):
        box_patch(np.zeros((1, 3)), np.eye(3)[None], np.ones((1, 3)), 0, A, np.zeros(3),
                  normal, *room[:3])  # fmt: skip
    box_number(1, 0, 4, 0, A, room.vertex)
