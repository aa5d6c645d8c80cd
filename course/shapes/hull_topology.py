"""Corners, faces and edges of the convex hull of points, whatever they span.

Qhull gives triangles and refuses points that span no volume. Here coplanar triangles are
merged into one face, and flat sets are handled in their plane or on their line: a polygon
has two faces, front and back, a segment one edge, a point nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array, IntArray

#: A hull thinner than this fraction of its width is flat.
FLATNESS = 1e-10
#: Triangles whose corners lie this close to one plane, in widths, are one face.
COPLANAR = 1e-12
#: How much of the largest coordinate is taken for rounding of the input.
ROUNDING = 32 * np.finfo(np.float64).eps


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
        normals: (f, 3) unit normals out of the faces in the shape's own axes, where
            they are known beforehand (a box), else None.
    """

    corners: IntArray
    loop: IntArray
    loop_start: IntArray
    edges: IntArray
    edge_faces: IntArray
    normals: Array | None = None


def topology_of_faces(
    corners: IntArray, faces: list[list[int]], normals: Array | None = None
) -> Topology:
    """The topology of a closed surface, from the loop of each face.

    Args:
        corners: (v,) which of the points are corners.
        faces: the corners of each face, counterclockwise seen from outside.
        normals: (f, 3), if known.
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
    return topology_of_faces(np.array([corner], dtype=np.intp), [])


def segment_topology(start: int = 0, end: int = 1) -> Topology:
    """Two corners and the edge between them, beside which there is no face."""
    none = np.empty(0, dtype=np.intp)
    corners = np.array([start, end], dtype=np.intp)
    edge, faces = np.array([[0, 1]], dtype=np.intp), np.array([[-1, -1]], dtype=np.intp)
    return Topology(corners, none, np.zeros(1, dtype=np.intp), edge, faces)


def polygon_topology(corners: IntArray, normals: Array | None = None) -> Topology:
    """A polygon, by its corners in order: a front face and, run backward, a back face."""
    front = list(range(len(corners)))
    return topology_of_faces(corners, [front, front[::-1]], normals)


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
    axes = np.linalg.svd(centred, full_matrices=True)[2]
    local = centred @ axes.T
    widths = np.ptp(local, axis=0)
    dimensions = int(np.sum(widths > FLATNESS * widths.max() + rounding))
    if dimensions == 1:
        ends = int(np.argmin(local[:, 0])), int(np.argmax(local[:, 0]))
        return segment_topology(*ends)
    if dimensions == 2:
        return polygon_topology(convex_polygon(local[:, :2], rounding))
    return _solid_topology(centred, local / widths, COPLANAR + rounding)


def convex_polygon(points: Array, slack: float) -> IntArray:
    """Which points of a plane are the corners of their hull, counterclockwise.

    Andrew's chain: from left to right along the bottom and back along the top, leaving
    out each corner at which the way does not turn left by more than ``slack``.
    Source: Andrew, Information Processing Letters 9, 1979.

    Args:
        points: (n, 2), not all on one line.
        slack: corners nearer than this to the line past them are left out.
    """
    order = np.lexsort((points[:, 1], points[:, 0]))
    ways: list[list[int]] = []
    for run in order, order[::-1]:
        way: list[int] = []
        for i in run.tolist():
            while len(way) > 1 and not _turns_left(points[[*way[-2:], i]], slack):
                way.pop()
            way.append(i)
        ways.append(way[:-1])
    return np.array(ways[0] + ways[1], dtype=np.intp)


def _turns_left(three: Array, slack: float) -> bool:
    (ax, ay), (bx, by) = three[1] - three[0], three[2] - three[0]
    return bool(ax * by - ay * bx > slack * np.hypot(bx, by))


def _solid_topology(points: Array, even: Array, slack: float) -> Topology:
    """Faces of a hull that has a volume: Qhull's triangles, the coplanar ones merged.

    Qhull's tolerances are not those of a stretched hull, so that it sees the points
    with all widths made equal (``even``), which changes no face.
    """
    from scipy.spatial import ConvexHull

    hull = ConvexHull(even)
    triangles = hull.simplices.astype(np.intp)
    a, b, c = (even[triangles[:, i]] for i in range(3))
    inward = np.sum(np.cross(b - a, c - a) * hull.equations[:, :3], axis=1) < 0
    # The axes may be a mirror image of the points' own.
    inside = points.mean(axis=0)
    triangles[inward] = triangles[inward][:, ::-1]
    if _enclosed(points[triangles] - inside) < 0:
        triangles = triangles[:, ::-1]
    faces = _merged_faces(points, triangles, slack)
    if not _is_closed(faces):
        faces = triangles.tolist()
    corners = np.unique([c for face in faces for c in face])
    number = {int(c): i for i, c in enumerate(corners)}
    renamed = [[number[c] for c in face] for face in faces]
    return topology_of_faces(corners.astype(np.intp), renamed)


def _enclosed(corners: Array) -> float:
    """Six times the volume that triangles (t, 3, 3) enclose, below 0 if they face in."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    return float(np.sum(a * np.cross(b, c)))


def _merged_faces(points: Array, triangles: IntArray, slack: float) -> list[list[int]]:
    """One loop for all triangles in one plane, and no corner that only two faces share.

    From the largest triangle on, each takes in the neighbours whose corners lie within
    ``slack`` of its plane and that do not face the other way.
    """
    a, b, c = (points[triangles[:, i]] for i in range(3))
    cross = np.cross(b - a, c - a)
    area = np.linalg.norm(cross, axis=1)
    normal = cross / np.where(area > 0, area, 1.0)[:, None]
    beside = _neighbours(triangles)
    face_of = np.full(len(triangles), -1)
    loops: list[list[int]] = []
    for seed in np.argsort(-area, kind="stable").tolist():
        if face_of[seed] >= 0:
            continue
        height = np.abs((points[triangles] - a[seed]) @ normal[seed]).max(axis=1)
        level = (height <= slack) & (normal @ normal[seed] >= 0) & (face_of < 0)
        group, waiting = [seed], [seed]
        face_of[seed] = len(loops)
        while waiting:
            for other in beside[waiting.pop()]:
                if level[other] and face_of[other] < 0:
                    face_of[other] = len(loops)
                    group.append(other)
                    waiting.append(other)
        loops.append(_outline(triangles[group]))
    meet = np.bincount([c for loop in loops for c in set(loop)], minlength=len(points))
    return [[c for c in loop if meet[c] > 2] for loop in loops]


def _neighbours(triangles: IntArray) -> list[list[int]]:
    """The triangles beyond the edges of each triangle."""
    runs = {
        (a, b): t
        for t, (i, j, k) in enumerate(triangles.tolist())
        for a, b in ((i, j), (j, k), (k, i))
    }
    beside: list[list[int]] = [[] for _ in triangles]
    for (a, b), t in runs.items():
        if (b, a) in runs:
            beside[t].append(runs[b, a])
    return beside


def _outline(triangles: IntArray) -> list[int]:
    """The loop around triangles that share edges; empty where it is not one loop."""
    runs = {
        (a, b) for i, j, k in triangles.tolist() for a, b in ((i, j), (j, k), (k, i))
    }
    onward = {a: b for a, b in runs if (b, a) not in runs}
    if not onward:
        return []
    first = next(iter(onward))
    loop = [first]
    while len(loop) <= len(onward) and (then := onward.get(loop[-1], -1)) != first:
        loop.append(then)
    return loop if len(loop) == len(onward) and -1 not in loop else []


def _is_closed(faces: list[list[int]]) -> bool:
    """Whether loops bound a polyhedron: each edge once each way, V - E + F = 2."""
    runs = [
        (a, b) for face in faces for a, b in zip(face, face[1:] + face[:1], strict=True)
    ]
    once = set(runs)
    corners = {a for a, _ in runs}
    return (
        all(len(face) > 2 for face in faces)
        and len(once) == len(runs)
        and all((b, a) in once for a, b in runs)
        and len(corners) - len(runs) // 2 + len(faces) == 2
    )
