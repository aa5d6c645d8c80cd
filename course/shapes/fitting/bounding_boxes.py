"""Boxes around points: along the axes, and turned."""

from __future__ import annotations

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    choice,
    non_negative,
    rotations,
    vectors,
)
from course.shapes.aabb import AABB
from course.shapes.fitting.point_sets import checked_sets, each_set, principal_axes
from course.shapes.hull_topology import COPLANAR, convex_polygon, hull_topology_of
from course.shapes.obb import OBB


def bounding_box(points: ArrayLike) -> AABB:
    """The least axis-aligned box around each set of points: least and largest coordinates.

    Source: Ericson, *Real-Time Collision Detection*, section 4.2; syllabus row 4.

    Args:
        points: (..., n, 3) [m], n >= 1.
    Returns:
        Boxes of the batch.
    Raises:
        ValueError: no points, NaN or infinity.
    """
    given = checked_sets(points)
    return AABB(given.min(axis=-2), given.max(axis=-2))


def rotated_box_extents(half_extents: ArrayLike, rotation: ArrayLike) -> Array:
    """Half the extents, along the world's axes, of a box that has been turned: |R| e.

    Each axis of the box reaches |R_ij| e_j along the world's axis i, and one corner has
    all three.
    Source: Ericson, *Real-Time Collision Detection*, section 4.2.6; syllabus row 4.

    Args:
        half_extents: e >= 0, (..., 3) [m].
        rotation: R, whose columns are the box's axes, (..., 3, 3).
    Returns:
        (..., 3) [m], the batches broadcast.
    Raises:
        ValueError: a negative extent, axes that are not orthonormal, a wrong shape.
    """
    e = non_negative("half_extents", vectors("half_extents", half_extents))
    turn = rotations("rotation", rotation)
    broadcast(half_extents=(e, 1), rotation=(turn, 2))
    return np.asarray((np.abs(turn) @ e[..., None])[..., 0])


def oriented_box(points: ArrayLike, *, method: str = "principal_axes") -> OBB:
    """A turned box around each set of points.

    "principal_axes": along the axes of the points' covariance. Quick; where points crowd,
    they pull the axes with them, and the box may be far from the least.
    "face_directions": the least of the boxes with one side in a face of the hull, and
    another along an edge of the hull's outline seen from there. A bound: the least of all
    boxes need not have a face in a side (it has an edge of the hull in each of two).
    Source: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996; O'Rourke, "Finding minimal
    enclosing boxes", 1985; Ericson, *Real-Time Collision Detection*, section 4.4; syllabus
    row 4.

    Args:
        points: (..., n, 3) [m], n >= 1.
        method: "principal_axes" or "face_directions".
    Returns:
        Boxes of the batch.
    Raises:
        ValueError: no points, NaN or infinity, another method.
    """
    given = checked_sets(points)
    method = choice("method", method, ("principal_axes", "face_directions"))
    if method == "principal_axes":
        axes = principal_axes(given)
    else:
        (axes,) = each_set(given, _face_axes, (3, 3))
    first = given[..., :1, :]
    local = (given - first) @ axes
    lower, upper = local.min(axis=-2), local.max(axis=-2)
    middle = (axes @ (0.5 * (lower + upper))[..., None])[..., 0]
    return OBB(first[..., 0, :] + middle, axes, 0.5 * (upper - lower))


def _face_axes(points: Array) -> tuple[Array]:
    """The axes of the least box that has a side in a face of the hull, as columns."""
    found = hull_topology_of(points)
    corners = points[found.corners] - points[found.corners[0]]
    least, best = np.inf, principal_axes(points)
    for normal in found.normals:
        u, v = _across(normal)
        flat = corners @ np.stack([u, v], axis=1)
        turn, area = _least_rectangle(flat)
        size = area * np.ptp(corners @ normal) if len(found.normals) > 2 else area
        if size < least:
            along = turn[0] * u + turn[1] * v
            least, best = size, np.stack([along, np.cross(normal, along), normal], 1)
    return (best,)


def _across(normal: Array) -> tuple[Array, Array]:
    """Two unit vectors that make right-handed axes with a normal: u x v = n."""
    u = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    u /= np.linalg.norm(u)
    return u, np.cross(normal, u)


def _least_rectangle(points: Array) -> tuple[Array, float]:
    """The direction of a side of the least rectangle around points of a plane, (n, 2), and its area.

    A side of it runs along an edge of the hull (Freeman and Shapira, 1975).
    """
    widths = np.ptp(points, axis=0)
    around = points[convex_polygon(points, widths, COPLANAR * widths.max())]
    edges = np.roll(around, -1, axis=0) - around
    along = edges / np.linalg.norm(edges, axis=1, keepdims=True)
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    area = np.ptp(around @ along.T, axis=0) * np.ptp(around @ across.T, axis=0)
    best = int(np.argmin(area))
    return along[best], float(area[best])
