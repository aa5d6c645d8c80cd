"""Qhull's triangles made into faces: turned outward, the coplanar ones merged."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, BoolArray, IntArray


def counterclockwise(
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


def merged_faces(
    points: Array,
    triangles: IntArray,
    neighbors: IntArray,
    outward: Array,
    slack: float,
) -> tuple[list[list[int]], list[int]]:
    """One loop for all triangles in one plane, and few corners within straight edges.

    From the largest triangle on, each takes in the neighbours whose corners lie within
    ``slack`` of its plane and that do not face the other way.

    Returns:
        The loops, and the triangle each began with.
    """
    a, b, c = (points[triangles[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)

    def level(which: IntArray, seed: IntArray) -> BoolArray:
        """Which triangles lie in the planes of others."""
        above = (points[triangles[which]] - a[seed, None]) * outward[seed, None]
        near = np.abs(above.sum(axis=-1)).max(axis=-1) <= slack
        return near & (np.sum(outward[which] * outward[seed], axis=-1) > 0)

    # Most triangles of most hulls are faces by themselves: seen at once.
    every = np.arange(len(triangles))
    joins = np.any([level(neighbors[:, k], every) for k in range(3)], axis=0)
    taken = np.zeros(len(triangles), dtype=bool)
    groups: dict[int, list[int]] = {}
    for seed in np.argsort(-area, kind="stable").tolist():
        if taken[seed]:
            continue
        group = waiting = [seed]
        taken[seed] = True
        while joins[seed] and waiting:
            beside = np.unique(neighbors[waiting])
            beside = beside[~taken[beside]]
            waiting = beside[level(beside, np.full(beside.size, seed))].tolist()
            taken[waiting] = True
            group = group + waiting
        groups[seed] = group
    loops = [_outline(triangles[group]) for group in groups.values()]
    meet = np.bincount([c for loop in loops for c in loop], minlength=len(points))
    straight = [_straightened(points, loop, meet > 2, slack) for loop in loops]
    return straight, list(groups)


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
        if between and bulge(points[[kept[-1], corner]], points[between]) > slack:
            kept += between
        kept.append(corner)
        between = []
    return kept[:-1]


def bulge(chord: Array, points: Array) -> float:
    """How far the farthest of points (n, d) lies from a segment (2, d)."""
    along, arms = chord[1] - chord[0], points - chord[0]
    length = float(along @ along)
    part = np.clip(arms @ along / length, 0.0, 1.0) if length else np.zeros(len(arms))
    return float(np.linalg.norm(arms - part[:, None] * along, axis=1).max())


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


def is_closed(faces: list[list[int]]) -> bool:
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
