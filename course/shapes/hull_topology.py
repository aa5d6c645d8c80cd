"""Corners, faces and edges of the convex hull of points, whatever they span.

Qhull gives triangles and refuses points that span no volume. Here coplanar triangles are
merged into one face, and flat sets are handled in their plane or on their line: a polygon
has two faces, front and back, a segment one edge, a point nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array, BoolArray, IntArray

#: A hull thinner than this fraction of its width is flat.
FLATNESS = 1e-10
#: Triangles whose corners lie this close to one plane, in widths, are one face.
COPLANAR = 1e-12
#: A face with less area than this, in squares of its length, is too slender for a cross
#: product to give its normal.
SLENDER = 1e-6
#: How much of the largest coordinate is taken for rounding of the input.
ROUNDING = 8 * np.finfo(np.float64).eps


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
        if _bulge(points[chord], points[around[skipped]]) > slack:
            kept.append(i)
            skipped = []
    return around[kept]


def _bulge(chord: Array, points: Array) -> float:
    """How far the farthest of points (n, d) lies from a segment (2, d)."""
    along, arms = chord[1] - chord[0], points - chord[0]
    length = float(along @ along)
    part = np.clip(arms @ along / length, 0.0, 1.0) if length else np.zeros(len(arms))
    return float(np.linalg.norm(arms - part[:, None] * along, axis=1).max())


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
    triangles = _counterclockwise(points, hull.simplices, hull.neighbors, outward)
    faces, seeds = _merged_faces(points, triangles, hull.neighbors, outward, slack)
    if not _is_closed(faces):
        faces, seeds = triangles.tolist(), list(range(len(triangles)))
    corners = np.unique([c for face in faces for c in face]).astype(np.intp)
    number = {int(c): i for i, c in enumerate(corners)}
    renamed = [[number[c] for c in face] for face in faces]
    normals = _normals(points[corners], renamed, outward[seeds])
    return topology_of_faces(corners, renamed, normals)


def _counterclockwise(
    points: Array, simplices: Array, neighbors: Array, outward: Array
) -> IntArray:
    """Qhull's triangles, each turned so that its corners run counterclockwise.

    From the largest triangle on, each neighbour is turned so that it runs along the
    common edge the other way: a sliver's own area does not say.
    """
    triangles = simplices.astype(np.intp)
    a, b, c = (points[triangles[:, i]] for i in range(3))
    cross = np.cross(b - a, c - a)
    first = int(np.argmax(np.linalg.norm(cross, axis=1)))
    loops = triangles.tolist()
    if cross[first] @ outward[first] < 0:
        loops[first].reverse()
    done, waiting = {first}, [first]
    while waiting:
        here = waiting.pop()
        i, j, k = loops[here]
        runs = {(i, j), (j, k), (k, i)}
        for there in neighbors[here].tolist():
            if there not in done:
                i, j, k = loops[there]
                if runs & {(i, j), (j, k), (k, i)}:
                    loops[there].reverse()
                done.add(there)
                waiting.append(there)
    return np.array(loops, dtype=np.intp)


def _normals(points: Array, faces: list[list[int]], rough: Array) -> Array:
    """The unit normal of each face by Newell's sum of (x_i - x_0) x (x_i+1 - x_0).

    A face so slender that the sum would be rounding has its ``rough`` normal, one that
    the whole hull lies below.
    """
    normals = np.array(np.broadcast_to(rough, (len(faces), 3)))
    for f, face in enumerate(faces):
        arms = points[face[1:]] - points[face[0]]
        total = np.cross(arms[:-1], arms[1:]).sum(axis=0)
        length = np.linalg.norm(total)
        if length > SLENDER * np.square(arms).sum(axis=1).max() and length > SLENDER:
            normals[f] = total / length
    return normals


def _merged_faces(
    points: Array, triangles: IntArray, neighbors: Array, outward: Array, slack: float
) -> tuple[list[list[int]], list[int]]:
    """One loop for all triangles in one plane, and few corners within straight edges.

    From the largest triangle on, each takes in the neighbours whose corners lie within
    ``slack`` of its plane and that do not face the other way.

    Returns:
        The loops, and the triangle each began with.
    """
    a, b, c = (points[triangles[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    beside = neighbors.tolist()
    taken = np.zeros(len(triangles), dtype=bool)
    loops: list[list[int]] = []
    seeds: list[int] = []
    for seed in np.argsort(-area, kind="stable").tolist():
        if taken[seed]:
            continue
        height = np.abs((points[triangles] - a[seed]) @ outward[seed]).max(axis=1)
        level = (height <= slack) & (outward @ outward[seed] > 0) & ~taken
        group, waiting = [seed], [seed]
        taken[seed] = True
        while waiting:
            for other in beside[waiting.pop()]:
                if level[other] and not taken[other]:
                    taken[other] = True
                    group.append(other)
                    waiting.append(other)
        loops.append(_outline(triangles[group]))
        seeds.append(seed)
    meet = np.bincount([c for loop in loops for c in loop], minlength=len(points))
    return [_straightened(points, loop, meet > 2, slack) for loop in loops], seeds


def _straightened(
    points: Array, loop: list[int], ends: BoolArray, slack: float
) -> list[int]:
    """A loop without the corners inside an edge: those that are no end of an edge, as
    only two faces meet there, where they all lie on the chord between its ends."""
    first = next((i for i, c in enumerate(loop) if ends[c]), None)
    if first is None:
        return loop
    kept: list[int] = []
    between: list[int] = []
    turned = loop[first:] + loop[: first + 1]
    for corner in turned:
        if not ends[corner]:
            between.append(corner)
            continue
        if between and _bulge(points[[kept[-1], corner]], points[between]) > slack:
            kept += between
        kept.append(corner)
        between = []
    return kept[:-1]


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
