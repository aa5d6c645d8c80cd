"""GJK and EPA as their textbooks have them, alone, and the slow way by all features."""

import math

import numpy as np
import pytest
from polytope_truths import core, drawn
from scipy.optimize import nnls

from course.overlap.convex import epa as epa_loops
from course.overlap.convex import gjk as loops
from course.overlap.convex.closest import as_solids, closest_points, least_translation
from course.overlap.convex.nearest_features import nearest_of_all
from course.shapes import ConvexHull, polytopes


def run(a, b, reach=math.inf, start=None):
    """GJK of two sets of vertices: how it ended, v, the lower bound, the simplex."""
    v = np.array(a.mean(axis=0) - b.mean(axis=0) if start is None else start, dtype=float)  # fmt: skip
    w, pick, share = np.zeros((4, 3)), np.zeros((4, 2), np.intp), np.zeros(4)
    ended, count, lower = loops.gjk_distance(a, len(a), b, len(b), v, reach, w, pick, share, np.zeros(4))  # fmt: skip
    return ended, v, lower, (w[:count], pick[:count], share[:count])


def least_squares_distance(a, b):
    """min |A'x - B'y| with x, y >= 0, sums 1, by non-negative least squares; the sums are held by a large weight."""
    weight = 1e4
    m, n = len(a), len(b)
    of_a = np.arange(m + n) < m
    rows = np.concatenate([np.concatenate([a, -b]).T, weight * np.stack([of_a, ~of_a])])
    x, _ = nnls(rows, np.array([0, 0, 0, weight, weight]))
    x[:m] /= x[:m].sum()
    x[m:] /= x[m:].sum()
    return np.linalg.norm(x[:m] @ a - x[m:] @ b)


def test_distance_is_that_of_a_least_squares_solve():
    rng = np.random.default_rng(1)
    for _ in range(40):
        a, b = rng.normal(size=(7, 3)), rng.normal(size=(9, 3)) + [4, 1, 0]
        ended, v, lower, (w, _, share) = run(a, b)
        if ended == loops.INSIDE:
            continue
        truth = least_squares_distance(a, b)
        assert np.linalg.norm(v) == pytest.approx(truth, abs=1e-7)
        assert lower == pytest.approx(np.linalg.norm(v), abs=1e-14)
        np.testing.assert_allclose(share @ w, v, atol=1e-14)


@pytest.mark.parametrize("count", [1, 2, 3, 4])
def test_the_nearest_point_of_a_simplex(count):
    """Against points of the simplex on a fine grid: none is nearer, and the best is hardly further."""
    rng = np.random.default_rng(count)
    grid = rng.dirichlet(np.full(count, 0.5), 4000)
    for _ in range(50):
        w = np.zeros((4, 3))
        w[:count] = rng.normal(size=(count, 3)) + rng.normal(size=3)
        share = np.zeros(4)
        square = loops.on_simplex(w, count, share)
        if square < 0:
            assert share.min() > 0 and np.linalg.norm(share @ w) < 1e-14
            continue
        assert share.min() >= 0 and share.sum() == pytest.approx(1, abs=1e-14)
        assert np.linalg.norm(share @ w) == pytest.approx(math.sqrt(square), abs=1e-14)
        on_grid = np.linalg.norm(grid @ w[:count], axis=1).min()
        assert math.sqrt(square) - 1e-12 <= on_grid <= math.sqrt(square) + 0.5


FLAT = [
    np.zeros((4, 3)),
    np.array([[1.0, 0, 0], [1, 0, 0], [1, 0, 0], [1, 0, 0]]),
    np.array([[-1.0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]),
    np.array([[-1.0, -1, 0], [1, -1, 0], [0, 1, 0], [0, 3, 0]]),
    np.array([[-1.0, -1, 1], [1, -1, 1], [0, 1, 1], [0, 3, 1 + 1e-16]]),
]


@pytest.mark.parametrize("w", FLAT)
@pytest.mark.parametrize("order", [[0, 1, 2, 3], [3, 2, 1, 0], [2, 0, 3, 1]])
def test_flat_simplices(w, order):
    """Point, segment and triangles given as tetrahedra: distance 0 or 1, never inside."""
    share = np.zeros(4)
    square = loops.on_tetrahedron(np.ascontiguousarray(w[order]), share)
    assert square == pytest.approx(w[0, 2] ** 2 if w[3, 2] else float(w.min() >= 0 and w.any()), abs=1e-15)  # fmt: skip
    assert share.min() >= 0 and share.sum() == pytest.approx(1)


def test_it_stops_beyond_the_reach():
    a, b = np.zeros((1, 3)), np.array([[5.0, 0, 0]])
    assert run(a, b, reach=4.9)[0] == loops.BEYOND
    assert run(a, b, reach=5.1)[0] == loops.APART


@pytest.mark.parametrize("start", [[0, 0, 0], [1e-300, 0, 0], [1e3, -1e3, 1.0]])
def test_any_start_will_do(start):
    rng = np.random.default_rng(2)
    a, b = rng.normal(size=(8, 3)), rng.normal(size=(8, 3)) + [5, 0, 0]
    np.testing.assert_allclose(run(a, b, start=start)[1], run(a, b)[1], atol=1e-14)


@pytest.mark.parametrize("order", [[0, 1, 2, 3], [1, 0, 2, 3]])
def test_epa_begins_with_faces_turned_outward(order):
    """Around the origin: each .2 below a side, and (1 - .6)/sqrt 3 below the slanting one; by hand."""
    corners = np.array([[0, 0, 0], [1.0, 0, 0], [0, 1, 0], [0, 0, 1]])[order] - 0.2
    _, corner, plane, _ = epa_loops.epa_room()
    assert epa_loops.tetrahedron(corners, corner, plane) == 4
    slant = 0.4 / math.sqrt(3)
    np.testing.assert_allclose(np.sort(plane[:4, 3]), [0.2, 0.2, 0.2, slant], atol=1e-15)  # fmt: skip
    heights = plane[:4, :3] @ corners.T
    np.testing.assert_allclose(heights.max(axis=1), plane[:4, 3], atol=1e-15)


def test_epa_from_the_simplex_of_gjk():
    """Two cubes of side 2, the one .3 .4 .5 from the other: they part along z, by 1.5; by hand."""
    box = np.array([[x, y, z] for x in (-1.0, 1) for y in (-1.0, 1) for z in (-1.0, 1)])
    other = box + [0.3, 0.41, 0.5]
    ended, _, _, (w, _, _) = run(other, box, start=[0.1, 0.2, 0.3])
    assert ended == loops.INSIDE
    normal = np.zeros(3)
    depth = epa_loops.epa_depth(other, 8, box, 8, w, *epa_loops.epa_room(), normal)
    assert depth == pytest.approx(1.5, abs=1e-14)
    np.testing.assert_allclose(normal, [0, 0, 1], atol=1e-14)


def test_epa_finds_the_depth_or_says_that_it_is_not_certain():
    rng = np.random.default_rng(3)
    certain = 0
    for _ in range(60):
        a, b = rng.normal(size=(8, 3)), rng.normal(size=(10, 3))
        ended, _, _, (w, _, _) = run(a, b)
        if ended != loops.INSIDE:
            continue
        normal = np.zeros(3)
        depth = epa_loops.epa_depth(a, 8, b, 10, w, *epa_loops.epa_room(), normal)
        solids = polytopes(ConvexHull(a)), polytopes(ConvexHull(b))
        s, axis = (x[0] for x in least_translation(*solids, [0], [0]))
        if depth >= 0:
            certain += 1
            assert depth == pytest.approx(-s, abs=1e-13)
            np.testing.assert_allclose(normal, axis, atol=1e-9)
    assert certain > 30


@pytest.mark.parametrize(
    "kinds",
    [
        ("hulls", "boxes"),
        ("points", "hulls"),
        ("segments", "flat hulls"),
        ("points", "lattice segments"),
    ],
)
def test_all_features_find_the_same_distance(kinds):
    rng = np.random.default_rng(4)
    a, b = (polytopes(drawn(kind, 6, rng)) for kind in kinds)
    i, j = np.indices((6, 6)).reshape(2, -1)
    found = closest_points(a, b, i, j)
    cores = found.gap + a.radius[i] + b.radius[j]
    for p in np.flatnonzero(cores > 0)[:12]:
        x, y = core(a, i[p])[0].copy(), core(b, j[p])[0].copy()
        pick, share = np.zeros((4, 2), np.intp), np.zeros(4)
        square = nearest_of_all(x, y, as_solids(a), i[p], as_solids(b), j[p], pick, share)  # fmt: skip
        assert math.sqrt(square) == pytest.approx(cores[p], abs=1e-14)
