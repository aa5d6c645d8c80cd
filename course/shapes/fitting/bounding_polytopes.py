"""k-DOPs, hulls and compounds around points."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from course.arrays import Array, ArrayLike, choice, failure, written
from course.shapes.compound import Compound
from course.shapes.convex_hull import ConvexHull
from course.shapes.fitting.bounding_boxes import bounding_box, oriented_box
from course.shapes.fitting.bounding_capsules import capsule_around
from course.shapes.fitting.bounding_spheres import bounding_sphere
from course.shapes.fitting.point_sets import checked_sets
from course.shapes.hull_topology import hull_topology_of
from course.shapes.kdop import KDOP
from course.shapes.shape import Shape

#: How many sides the k-DOPs have: 6 across the axes, 8 across a cube's diagonals, 12
#: across the diagonals of its faces.
K_DOPS = (14, 18, 26)


def k_dop_directions(count: int) -> Array:
    """The directions of the k-DOPs with 14, 18 and 26 sides, one a pair of sides.

    The three axes, then the 4 diagonals of a cube (14 and 26), then the 6 of its faces (18
    and 26).
    Source: Klosowski et al., IEEE TVCG 4, 1998; syllabus row 5.

    Args:
        count: k, one of ``K_DOPS``.
    Returns:
        Unit vectors, (k/2, 3).
    Raises:
        ValueError: another count.
    """
    if count not in K_DOPS:
        raise failure("count", f"one of {written(K_DOPS)}", written(count))
    axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    corners = [[1, 1, 1], [1, 1, -1], [1, -1, 1], [-1, 1, 1]]
    edges = [[1, 1, 0], [1, -1, 0], [1, 0, 1], [1, 0, -1], [0, 1, 1], [0, 1, -1]]
    rows = {14: axes + corners, 18: axes + edges, 26: axes + corners + edges}[count]
    return np.array(rows) / np.linalg.norm(rows, axis=1, keepdims=True)


def k_dop(points: ArrayLike, count: int = 14) -> KDOP:
    """The least k-DOP around each set of points: its extent along each direction.

    Source: Klosowski et al., IEEE TVCG 4, 1998; Ericson, *Real-Time Collision Detection*,
    section 4.6; syllabus row 5.

    Args:
        points: (..., n, 3) [m], n >= 1.
        count: k, 14, 18 or 26.
    Returns:
        k-DOPs of the batch.
    Raises:
        ValueError: no points, NaN or infinity, another count.
    """
    given, d = checked_sets(points), k_dop_directions(count)
    along = given @ d.T
    return KDOP(d, along.min(axis=-2), along.max(axis=-2))


def hull_around(points: ArrayLike) -> ConvexHull:
    """The convex hull of each set of points, with its corners alone as vertices.

    Corners by Qhull (Barber, Dobkin, Huhdanpaa, ACM TOMS 22, 1996); coplanar points give a
    polygon, collinear ones a segment, coincident ones a point.

    Args:
        points: (..., n, 3) [m], n >= 1.
    Returns:
        Hulls of the batch; those with fewer corners than others repeat their last.
    Raises:
        ValueError: no points, NaN or infinity.
    """
    given = checked_sets(points)
    flat = given.reshape(-1, *given.shape[-2:])
    if not len(flat):
        return ConvexHull(given)
    hulls = [ConvexHull(p[None, hull_topology_of(p).corners]) for p in flat]
    return ConvexHull.concatenate(hulls).reshaped(*given.shape[:-2])


#: How a collider of each kind is fitted to points.
FITS: dict[str, Callable[..., Any]] = {
    "sphere": bounding_sphere,
    "capsule": capsule_around,
    "aabb": bounding_box,
    "obb": oriented_box,
    "kdop": k_dop,
    "convex_hull": hull_around,
}


def compound_around(
    parts: Iterable[ArrayLike], *, kind: str = "convex_hull"
) -> Compound:
    """A compound with one collider of a kind around each part of a mesh.

    Source: Ericson, *Real-Time Collision Detection*, section 4.1; syllabus row 7.

    Args:
        parts: the points of each part, (n, 3) [m] or batches of them.
        kind: "sphere", "capsule", "aabb", "obb", "kdop" or "convex_hull".
    Raises:
        ValueError: no parts, a part without points, another kind.
    """
    fit = FITS[choice("kind", kind, tuple(FITS))]
    sets = list(parts)
    if not sets:
        raise failure("parts", "at least one set of points", "none")
    fitted: list[Shape] = []
    for i, points in enumerate(sets):
        try:
            fitted.append(fit(points))
        except ValueError as error:
            raise ValueError(f"parts[{i}]: {error}") from None
    return Compound(tuple(fitted))
