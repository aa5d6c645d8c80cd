"""Corners, faces and edges of the convex hull of points, whatever they span.

Qhull gives triangles and refuses points that span no volume. Here coplanar triangles are
merged into one face, and flat sets are handled in their plane or on their line.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray
from course.shapes.coplanar_faces import (
    bulge,
    counterclockwise,
    is_closed,
    merged_faces,
)
from course.shapes.topology import (
    Topology,
    onward,
    point_topology,
    polygon_topology,
    segment_topology,
    topology_of_faces,
)

#: A hull thinner than this fraction of its width is flat.
FLATNESS = 1e-10
#: Triangles whose corners lie this close to one plane, in widths, are one face.
COPLANAR = 1e-12
#: A face with less area than this, in squares of its length, is too slender for a cross
#: product to give its normal.
SLENDER = 1e-6
#: How much of the largest coordinate is taken for rounding of the input.
ROUNDING = 8 * np.finfo(np.float64).eps


def hull_topology_of(points: Array) -> Topology:
    """Corners, faces and edges of the convex hull of points.

    The widths of the set along its principal axes say what it spans: those below
    ``FLATNESS`` of the largest, or below the rounding of the coordinates, count as 0.

    Args:
        points: (n, 3), at least one; any may lie inside, or coincide.
    """
    middle = points.mean(axis=0)
    reach = np.abs(points - middle).max()
    if reach <= ROUNDING * np.abs(points).max():
        return point_topology()
    # In a unit near the hull's size, so that no square of a length leaves the range.
    centred = np.ldexp(points - middle, -np.frexp(reach)[1])
    rounding = ROUNDING * np.ldexp(np.abs(points).max(), -np.frexp(reach)[1])
    # Three more points in the middle: SVD then gives all three axes of one or two.
    axes = np.linalg.svd(np.pad(centred, ((0, 3), (0, 0))), full_matrices=False)[2]
    local = centred @ axes.T
    widths = np.ptp(local, axis=0)
    dimensions = int(np.sum(widths > FLATNESS * widths.max() + rounding))
    if dimensions == 1:
        return segment_topology(
            int(np.argmin(local[:, 0])), int(np.argmax(local[:, 0]))
        )
    if dimensions == 2:
        corners = convex_polygon(local[:, :2], widths[:2], COPLANAR + rounding)
        if corners.size < 3:
            return segment_topology(*corners.tolist())
        # Out of which the corners run counterclockwise, whatever SVD's axes are.
        upright = axes[2] * np.linalg.det(axes)
        front = [list(range(len(corners)))]
        return polygon_topology(corners, _normals(centred[corners], front, upright)[0])
    even = local / widths
    # A plane m.y = o of even points y = W^-1 A x is the plane (A' W^-1 m).x = o of x.
    return _solid_topology(centred, even, axes.T / widths, COPLANAR + rounding)


def convex_polygon(points: Array, widths: Array, slack: float) -> IntArray:
    """Which points of a plane are the corners of their hull, counterclockwise.

    Args:
        points: (n, 2), not all on one line.
        widths: (2,) of the set; Qhull sees the points with both made equal.
        slack: corners nearer than this to the line past them are left out.
    """
    from scipy.spatial import ConvexHull

    around = ConvexHull(points / widths).vertices.astype(np.intp)
    around = np.roll(around, -int(np.argmin(points[around, 0])))
    kept, skipped = [0], []
    for i in range(1, len(around)):
        chord = around[[kept[-1], (i + 1) % len(around)]]
        skipped.append(i)
        if bulge(points[chord], points[around[skipped]]) > slack:
            kept.append(i)
            skipped = []
    return around[kept]


def _solid_topology(points: Array, even: Array, back: Array, slack: float) -> Topology:
    """Faces of a hull that has a volume: Qhull's triangles, the coplanar ones merged.

    Qhull's tolerances are not those of a stretched hull, so that it sees the points
    with all widths made equal (``even``), which changes no face; ``back`` (3, 3) takes
    a normal there to a normal here.
    """
    from scipy.spatial import ConvexHull

    hull = ConvexHull(even)
    outward = hull.equations[:, :3] @ back.T
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    triangles = counterclockwise(points, hull.simplices, hull.neighbors, outward)
    faces, seeds = merged_faces(points, triangles, hull.neighbors, outward, slack)
    if not is_closed(faces):
        faces, seeds = triangles.tolist(), list(range(len(triangles)))
    corners = np.unique([c for face in faces for c in face]).astype(np.intp)
    number = {int(c): i for i, c in enumerate(corners)}
    renamed = [[number[c] for c in face] for face in faces]
    normals = _normals(points[corners], renamed, outward[seeds])
    return topology_of_faces(corners, renamed, normals)


def _normals(points: Array, faces: list[list[int]], rough: Array) -> Array:
    """The unit normal of each face by Newell's sum of (x_i - x_0) x (x_i+1 - x_0).

    A face so slender that the sum would be rounding has its ``rough`` normal, one that
    the whole hull lies below.
    """
    length = [len(face) for face in faces]
    start = np.cumsum([0, *length])
    loop = np.array([c for face in faces for c in face], dtype=np.intp)
    arms = points[loop] - np.repeat(points[loop[start[:-1]]], length, axis=0)
    total = np.add.reduceat(np.cross(arms, arms[onward(start)]), start[:-1], axis=0)
    square = np.maximum.reduceat(np.square(arms).sum(axis=1), start[:-1])
    size = np.linalg.norm(total, axis=1)
    good = size > SLENDER * np.maximum(square, SLENDER)
    return np.where(good[:, None], total / np.where(good, size, 1.0)[:, None], rough)
