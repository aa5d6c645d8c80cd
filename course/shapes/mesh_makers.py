"""Visual meshes made in code, for the lessons: what is seen, beside its colliders.

Those of several parts are put together of convex ones that touch and do not overlap: the
volumes of the parts add up to that of the whole.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray, failure, scalar, whole_number, written
from course.shapes.hull_topology import hull_topology_of
from course.shapes.meshes import Mesh


def convex_mesh(points: Array) -> Mesh:
    """The surface of the convex hull of points (n, 3), its faces split into fans."""
    found = hull_topology_of(points)
    loops = np.split(found.loop, found.loop_start[1:-1])
    rows = [
        [loop[0], loop[i], loop[i + 1]]
        for loop in loops
        for i in range(1, len(loop) - 1)
    ]
    return Mesh(points[found.corners], np.array(rows, dtype=np.intp))


def rod_mesh(length: float = 1.0, radius: float = 0.005, *, sides: int = 24) -> Mesh:
    """A rod along x about the origin: a prism whose sides are inside the cylinder.

    Args:
        length, radius: [m].
        sides: of the prism, at least 3.
    """
    _require_positive(length=length, radius=radius)
    y, z = radius * _circle(sides).T
    ends = [np.stack([np.full(sides, x), y, z], 1) for x in (-length / 2, length / 2)]
    return convex_mesh(np.concatenate(ends))


def box_mesh(lower: Array, upper: Array) -> Mesh:
    """A box along the axes.

    Args:
        lower, upper: (3,) [m].
    """
    bits = [[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    ends = np.array([lower, upper], dtype=np.float64)
    return convex_mesh(ends[np.array(bits), np.arange(3)])


def icosphere_mesh(radius: float = 1.0, *, subdivisions: int = 2) -> Mesh:
    """A ball: an icosahedron, each triangle cut in four again and again, corners on the sphere.

    Args:
        radius: [m].
        subdivisions: 0 for the icosahedron; 20 4^s triangles.
    """
    _require_positive(radius=radius)
    if whole_number("subdivisions", subdivisions) > 6:
        raise failure("subdivisions", "at most 6", written(subdivisions))
    golden = (1 + 5**0.5) / 2
    signs = [(a, b * golden) for a in (-1, 1) for b in (-1, 1)]
    corners = [np.roll([0.0, a, b], turn) for turn in range(3) for a, b in signs]
    mesh = convex_mesh(np.array(corners))
    points, rows = mesh.vertices, mesh.triangles
    for _ in range(subdivisions):
        points, rows = _quartered(points, rows)
        points = points / np.linalg.norm(points, axis=1, keepdims=True)
    return Mesh(radius * points / np.linalg.norm(points, axis=1, keepdims=True), rows)


def torus_mesh(
    ring_radius: float = 1.0,
    tube_radius: float = 0.3,
    *,
    around: int = 32,
    across: int = 16,
) -> Mesh:
    """A ring about z, in one part, which no convex collider follows.

    Args:
        ring_radius: of the circle in the middle of the tube [m].
        tube_radius: [m], below ring_radius.
        around, across: how many pieces the two circles have, at least 3.
    """
    _require_positive(ring_radius=ring_radius, tube_radius=tube_radius)
    if tube_radius >= ring_radius:
        raise failure("tube_radius", "a number below ring_radius", written(tube_radius))
    big, small = _circle(around), _circle(across)
    away = ring_radius + tube_radius * small[:, 0]
    flat = big[:, None, :] * away[:, None]
    height = np.broadcast_to(tube_radius * small[:, 1], (around, across))
    points = np.concatenate([flat, height[..., None]], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    here, aside = i * across + j, (i + 1) % around * across + j
    up, both = (
        i * across + (j + 1) % across,
        (i + 1) % around * across + (j + 1) % across,
    )
    rows = [np.stack([here, aside, both], -1), np.stack([here, both, up], -1)]
    return Mesh(points, np.concatenate(rows).reshape(-1, 3))


def dumbbell_mesh(
    length: float = 0.4,
    ball_radius: float = 0.1,
    bar_radius: float = 0.03,
    *,
    sides: int = 24,
) -> Mesh:
    """Two balls at the ends of a bar along x, in three parts: each ball is cut off flat
    where the bar begins.

    Args:
        length: between the balls' centres [m], above twice ball_radius.
        ball_radius, bar_radius: [m], the bar's below the balls'.
        sides: of the bar and of the balls, at least 3.
    """
    _require_positive(length=length, ball_radius=ball_radius, bar_radius=bar_radius)
    if bar_radius >= ball_radius:
        raise failure("bar_radius", "a number below ball_radius", written(bar_radius))
    if length <= 2 * ball_radius:
        raise failure("length", "a number above 2 ball_radius", written(length))
    start = np.arcsin(bar_radius / ball_radius)
    angle = np.linspace(start, np.pi, sides // 2 + 2)
    # From the cut, a circle as wide as the bar, to the pole.
    profile = ball_radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    y, z = _circle(sides).T
    rings = [
        np.stack([np.full(sides, x), r * y, r * z], axis=1) for x, r in profile[:-1]
    ]
    ball = np.concatenate([*rings, [[-ball_radius, 0, 0]]]) - [length / 2, 0, 0]
    right = ball * [-1, 1, 1]
    bar = np.concatenate([rings[0] - [length / 2, 0, 0], right[:sides]])
    return Mesh.joined([convex_mesh(ball), convex_mesh(bar), convex_mesh(right)])


def bracket_mesh(arm: float = 0.2, width: float = 0.1, thickness: float = 0.02) -> Mesh:
    """An L-bracket of two plates: one lies along x, one stands along z; in two parts.

    Args:
        arm: the outer length of both [m], above thickness.
        width: along y [m].
        thickness: of the plates [m].
    """
    _require_positive(arm=arm, width=width, thickness=thickness)
    if thickness >= arm:
        raise failure("thickness", "a number below arm", written(thickness))
    lying = box_mesh(np.zeros(3), np.array([arm, width, thickness]))
    standing = box_mesh(np.array([0, 0, thickness]), np.array([thickness, width, arm]))
    return Mesh.joined([lying, standing])


def mug_mesh(
    radius: float = 0.04,
    height: float = 0.1,
    thickness: float = 0.005,
    *,
    staves: int = 16,
) -> Mesh:
    """A mug open at the top: a round bottom and a ring of staves, each convex.

    Args:
        radius, height: outer [m].
        thickness: of wall and bottom [m], below both.
        staves: how many parts the wall has, at least 3.
    """
    _require_positive(radius=radius, height=height, thickness=thickness)
    if thickness >= min(radius, height):
        got = written(thickness)
        raise failure("thickness", "a number below radius and height", got)
    rim = _circle(staves)
    outer, inner = radius * rim, (radius - thickness) * rim
    parts = [_prism(outer, 0.0, thickness)]
    for i in range(staves):
        j = (i + 1) % staves
        stave = np.array([outer[i], outer[j], inner[j], inner[i]])
        parts.append(_prism(stave, thickness, height))
    return Mesh.joined(parts)


def _prism(outline: Array, bottom: float, top: float) -> Mesh:
    """A convex outline (k, 2) in x and y, from one height to another."""
    levels = [np.insert(outline, 2, z, axis=1) for z in (bottom, top)]
    return convex_mesh(np.concatenate(levels))


def _circle(count: int) -> Array:
    """Points of the unit circle, (count, 2)."""
    angle = 2 * np.pi * np.arange(whole_number("sides", count, minimum=3)) / count
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def _quartered(points: Array, rows: IntArray) -> tuple[Array, IntArray]:
    """Each triangle cut into four at the middles of its edges."""
    edges = np.sort(np.concatenate([rows[:, [0, 1]], rows[:, [1, 2]], rows[:, [2, 0]]]))
    once, number = np.unique(edges, axis=0, return_inverse=True)
    middle = len(points) + number.reshape(3, -1)
    a, b, c = rows.T
    ab, bc, ca = middle
    cut = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    quarters = np.concatenate([np.stack(three, axis=1) for three in cut])
    return np.concatenate([points, points[once].mean(axis=1)]), quarters


def _require_positive(**lengths: float) -> None:
    for name, value in lengths.items():
        if scalar(name, value) <= 0:
            raise failure(name, "a positive number", written(value))
