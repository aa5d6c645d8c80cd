"""A mug and what can stand for it: how tight, at what cost, and what goes wrong for a marble."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray, choice
from course.overlap import gap, overlaps
from course.shapes import (
    Compound,
    HalfSpace,
    Mesh,
    Shape,
    Sphere,
    bounding_box,
    bounding_sphere,
    hull_around,
    mesh_colliders,
    polytopes,
)
from course.shapes.mesh_makers import mug_mesh
from course.study.box_verdicts import random_turns
from course.study.engines import installed_engines
from course.study.precision import Method, Problem, WorkPrecision, work_precision

COLLIDERS = ("sphere", "box", "hull", "compound")
MARBLE = 0.008  # radius [m]


@cache  # read-only, and asked for at each turn of a knob
def mug() -> Mesh:
    """The visual: 10 cm high, 8 cm wide, its walls 5 mm thick, in 17 convex parts."""
    return mug_mesh()


def mug_collider(kind: str) -> Any:
    """A collider of the mug.

    Args:
        kind: "sphere", "box", "hull", or "compound": a hull around each of its parts.
    """
    choice("kind", kind, COLLIDERS)
    return _fitted(kind)


@cache
def _fitted(kind: str) -> Any:
    visual = mug()
    if kind == "compound":
        return mesh_colliders(visual)
    fits: dict[str, Callable[..., Shape]] = {
        "sphere": bounding_sphere, "box": bounding_box, "hull": hull_around
    }  # fmt: skip
    return fits[kind](visual.vertices)


def filled(mesh: Mesh, points: Array) -> BoolArray:
    """Whether points (p, 3) are within a mesh: the solid angle under which they see it.

    A point inside sees the surface all around, 4 pi, one outside 0; tan(angle/2) of a
    triangle after Van Oosterom and Strackee (1983), its products written out so that
    points meet triangles in products of matrices only.
    """
    a, b, c = np.moveaxis(mesh.vertices[mesh.triangles], 1, 0)
    square = np.sum(points**2, axis=-1)[:, None]

    def product(x: Array, y: Array) -> Array:
        """(x - p).(y - p), (p, t)."""
        return np.asarray(np.sum(x * y, axis=-1) - points @ (x + y).T + square)

    lengths = [np.sqrt(product(x, x)) for x in (a, b, c)]
    sides = np.cross(a, b) + np.cross(b, c) + np.cross(c, a)
    volume = np.sum(a * np.cross(b, c), axis=-1) - points @ sides.T
    below = lengths[0] * lengths[1] * lengths[2]
    for (x, y), z in zip(((a, b), (b, c), (c, a)), (2, 0, 1), strict=True):
        below += product(x, y) * lengths[z]
    angle = 2.0 * np.arctan2(volume, below).sum(axis=-1)
    return np.asarray(angle > 2.0 * np.pi)


def probes(count: int, *, seed: int) -> Array:
    """Points drawn evenly in the box around the mug's bounding sphere, (count, 3) [m]."""
    around = mug_collider("sphere").bounds()
    rng = np.random.default_rng(seed)
    return rng.uniform(around.lower, around.upper, (count, 3))


def comparisons(shape: Shape) -> int:
    """Inequalities that decide whether a point is inside: one a face, one for a sphere."""
    if isinstance(shape, Compound):
        return sum(comparisons(part) for part in shape.parts)
    return 1 if isinstance(shape, Sphere) else len(polytopes(shape).normals)


def inside(shape: Shape, points: Array) -> BoolArray:
    """Whether points (p, 3) are in a collider: n.x <= o for each face, or near a centre."""
    return _question(shape)(points)


def _question(shape: Shape) -> Callable[[Array], BoolArray]:
    """``inside`` of one collider, its faces looked up beforehand."""
    if isinstance(shape, Compound):
        parts = [_question(part) for part in shape.parts]
        return lambda points: np.any([part(points) for part in parts], axis=0)
    if isinstance(shape, Sphere):
        center, square = shape.center, shape.radius**2
        return lambda points: np.sum((points - center) ** 2, axis=-1) <= square
    found = polytopes(shape)
    normals, offsets = found.normals.T, found.offsets
    return lambda points: np.all(points @ normals <= offsets, axis=-1)


def mug_costs(points: Array, *, library: bool = True) -> WorkPrecision:
    """Air in what each collider calls the mug, against the cost of asking about all points.

    The unit of work is one comparison. ``course.overlap`` and the peers where they are
    installed have a count of 0: what they do inside is not counted.

    Args:
        points: (p, 3) [m].
        library: whether these are asked as well.
    """
    truth = filled(mug(), points)

    def air(called: BoolArray) -> float:
        return float(1.0 - np.mean(truth[called]))

    problem = Problem(
        f"{len(points)} points asked about", air, "", "the solid angle of the mesh"
    )
    shapes = {kind: mug_collider(kind) for kind in COLLIDERS}
    methods = [
        Method(kind, _by_faces(shape, points), (1,)) for kind, shape in shapes.items()
    ]
    if library:
        methods += [
            Method(f"{kind}, course.overlap", _by_library(shape, points), (1,))
            for kind, shape in shapes.items()
        ]
        methods += [
            Method(f"box, {name}", _by_peer(asked, points), (1,))
            for name, asked in installed_engines().items()
        ]
    return work_precision(problem, methods, count_unit="comparisons a point")


def _by_faces(shape: Shape, points: Array) -> Callable[[float], tuple[BoolArray, int]]:
    count, asked = comparisons(shape), _question(shape)
    return lambda _: (asked(points), count)


def _by_library(
    shape: Shape, points: Array
) -> Callable[[float], tuple[BoolArray, int]]:
    small = Sphere(points, np.full(len(points), 1e-9))
    overlaps(small[:2], shape)  # what is compiled at the first call is not timed
    return lambda _: (overlaps(small, shape), 0)


def _by_peer(
    asked: Callable[..., BoolArray], points: Array
) -> Callable[[float], tuple[BoolArray, int]]:
    box = mug_collider("box").bounds()
    count, even = len(points), np.broadcast_to(np.eye(3), (len(points), 3, 3))
    middle = np.broadcast_to(0.5 * (box.lower + box.upper), (count, 3))
    half = np.broadcast_to(0.5 * (box.upper - box.lower), (count, 3))
    small = np.full((count, 3), 1e-9)
    return lambda _: (asked(points, even, small, middle, even, half), 0)


def marble_height(kind: str) -> float:
    """How high over the table a marble stops that is let down into the mug, by a collider [m].

    Its lowest point: over the middle of a mug that stands on the table.
    """
    return _stop(kind, np.array([0.0, 0.0, 1.0]), np.zeros(3)) - MARBLE


def marble_distance(kind: str) -> float:
    """How far from the mug's axis a marble stops that rolls toward its side, 5 cm high [m].

    Its nearest point; the way leads to the middle of a side.
    """
    angle = np.pi / 16  # half the turn from one of the 16 staves to the next
    way = np.array([np.cos(angle), np.sin(angle), 0.0])
    return _stop(kind, way, np.array([0.0, 0.0, 0.05])) - MARBLE


def _stop(kind: str, way: Array, foot: Array) -> float:
    """Where on a ray toward a foot the marble first touches: it goes on by its own gap."""
    shape, far = mug_collider(kind), 0.3
    for _ in range(200):
        nearest = float(gap(Sphere(foot + far * way, np.array(MARBLE)), shape))
        if nearest < 1e-9 or far <= 0.0:
            break
        far -= nearest
    return max(far, 0.0)


def floor_errors(kind: str, count: int = 500, *, seed: int = 1) -> Array:
    """How much too near the floor a collider is, in poses drawn at random, (count,) [m].

    Against the lowest corner of the mesh itself.
    """
    turns = random_turns(np.random.default_rng(seed), count)
    floor = HalfSpace(np.array([0.0, 0.0, 1.0]), np.array(-1.0))
    said = gap(mug_collider(kind).moved(turns, np.zeros(3)), floor)
    lowest = (mug().vertices @ np.swapaxes(turns, -1, -2))[..., 2].min(axis=-1)
    return np.asarray(lowest + 1.0 - said)
