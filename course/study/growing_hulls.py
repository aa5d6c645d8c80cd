"""Separating axes against GJK on polytopes of more and more corners: the work and the seconds of both."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from course import formulas
from course.arrays import Array, IntArray

#: Relative difference of v.v and v.w from which on GJK is done.
DONE = 1e-10


@dataclass(frozen=True, eq=False)
class Hull:
    """A polytope: corners (n, 3) [m], unit normals of its faces (f, 3), edges (e, 3) [m]."""

    vertices: Array
    normals: Array
    edges: Array

    @property
    def arrays(self) -> tuple[Array, Array, Array]:
        """As ``hulls_overlap`` takes them."""
        return self.vertices, self.normals, self.edges


def random_hull(
    rng: np.random.Generator, corners: int, center: Sequence[float]
) -> Hull:
    """A polytope with so many corners on a turned ellipsoid with half axes of 1, 0.8 and 0.6 m."""
    from scipy.spatial.transform import Rotation

    points = rng.normal(size=(corners, 3))
    points *= [1.0, 0.8, 0.6] / np.linalg.norm(points, axis=-1, keepdims=True)
    turn = Rotation.from_quat(rng.normal(size=4)).as_matrix()
    return hull_of(points @ turn.T + np.asarray(center))


def hull_of(points: Array) -> Hull:
    """Faces and edges of the hull of points in general position, by Qhull."""
    from scipy.spatial import ConvexHull

    found = ConvexHull(points)
    sides = np.sort(
        found.simplices[:, [[0, 1], [1, 2], [0, 2]]].reshape(-1, 2), axis=-1
    )
    pairs = np.unique(sides, axis=0)
    return Hull(
        points, found.equations[:, :3], points[pairs[:, 1]] - points[pairs[:, 0]]
    )


def gjk_distance(a: Array, b: Array) -> tuple[float, int]:
    """The distance of two convex hulls by GJK, and how many turns it took.

    Each turn asks both for their support point against v, the point of A - B nearest to
    0 as far as it is known, and keeps the fewest corners whose hull has the new one.
    Source: Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4 (1988);
    van den Bergen, *Collision Detection in Interactive 3D Environments*, chapter 4.

    Args:
        a, b: corners, (n, 3) and (m, 3) [m].
    Returns:
        The distance [m], 0 where they overlap, and the turns.
    """
    v = a[0] - b[0]
    simplex = np.zeros((0, 3))
    for turn in range(1, 100):
        w = a[np.argmin(a @ v)] - b[np.argmax(b @ v)]
        square = float(v @ v)
        if square - v @ w <= DONE * square or len(simplex) == 4:
            break
        v, simplex = nearest_of_simplex(np.concatenate([simplex, w[None]]))
        if v @ v <= 1e-24:
            return 0.0, turn
    return float(np.linalg.norm(v)), turn


def nearest_of_simplex(corners: Array) -> tuple[Array, Array]:
    """The point of a simplex nearest to 0, and the fewest corners whose hull has it.

    Of all subsets of corners: the point of their plane nearest to 0, if it lies among them.
    """
    best: tuple[float, Array, Array] | None = None
    for size in range(1, len(corners) + 1):
        for chosen in combinations(range(len(corners)), size):
            some = corners[list(chosen)]
            # Least |sum l_i w_i| with sum l_i = 1: w_0 plus a step along the edges from it.
            along = (some[1:] - some[0]).T
            step = (
                np.linalg.lstsq(along, -some[0], rcond=None)[0]
                if size > 1
                else np.zeros(0)
            )
            weights = np.array([1.0 - step.sum(), *step])
            if weights.min() < -1e-12:
                continue
            point = weights @ some
            if best is None or point @ point < best[0] - 1e-15:
                best = float(point @ point), point, some
    assert best is not None
    return best[1], best[2]


@dataclass(frozen=True, eq=False)
class HullGrowth:
    """What a verdict costs, over the corners of each polytope.

    Args:
        corners: (k,).
        axes: of the separating axes, (k,).
        sat_products, gjk_products: dot products of a verdict, the mean of the pairs, (k,).
        sat_seconds, gjk_seconds: of a verdict, the mean of the pairs, (k,) [s].
        different: verdicts that are not the same, (k,).
    """

    corners: IntArray
    axes: IntArray
    sat_products: Array
    gjk_products: Array
    sat_seconds: Array
    gjk_seconds: Array
    different: IntArray


def hull_growth(corners: Sequence[int], *, pairs: int = 4, seed: int = 5) -> HullGrowth:
    """Verdicts on pairs of polytopes near touching, half of them overlapping, by both methods.

    Dot products are counted: separating axes need each corner on each axis; GJK each
    corner once a turn. Both are written in NumPy here.
    """
    rng = np.random.default_rng(seed)
    rows = [_measured(rng, count, pairs) for count in corners]
    columns = [np.array(column) for column in zip(*rows, strict=True)]
    return HullGrowth(np.array(corners), *columns)


def _measured(rng: np.random.Generator, count: int, pairs: int) -> tuple[float, ...]:
    axes, products, seconds, different = 0, np.zeros(2), np.zeros(2), 0
    for k in range(pairs):
        a = random_hull(rng, count, (0.0, 0.0, 0.0))
        b = random_hull(rng, count, (1.2 if k % 2 else 2.1, 0.3, 0.2))
        start = time.perf_counter()
        by_axes = bool(formulas.hulls_overlap(*a.arrays, *b.arrays))
        middle = time.perf_counter()
        distance, turns = gjk_distance(a.vertices, b.vertices)
        seconds += [middle - start, time.perf_counter() - middle]
        axes = len(a.normals) + len(b.normals) + len(a.edges) * len(b.edges)
        products += [2 * count * axes, 2 * count * turns]
        different += by_axes != (distance <= 0.0)
    return axes, *(products / pairs), *(seconds / pairs), different
