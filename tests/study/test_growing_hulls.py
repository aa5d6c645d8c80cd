"""GJK as it is written for the second notebook of lesson 05, against quadratic programmes and Qhull."""

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial import ConvexHull

from course.study import gjk_distance, hull_growth, random_hull
from course.study.growing_hulls import nearest_of_simplex


def closest(a, b):
    """Distance of two hulls as a bounded least-squares problem in their weights."""
    n, m = len(a), len(b)

    def square(x):
        return np.sum((x[:n] @ a - x[n:] @ b) ** 2)

    sums = [
        {"type": "eq", "fun": lambda x: x[:n].sum() - 1},
        {"type": "eq", "fun": lambda x: x[n:].sum() - 1},
    ]
    start = np.concatenate([np.full(n, 1 / n), np.full(m, 1 / m)])
    options = {"ftol": 1e-14, "maxiter": 500}
    found = minimize(
        square, start, bounds=[(0, 1)] * (n + m), constraints=sums, options=options
    )
    return np.sqrt(found.fun)


@pytest.mark.parametrize("seed", range(6))
def test_distances_are_those_of_a_quadratic_programme(seed):
    rng = np.random.default_rng(seed)
    a, b = (
        random_hull(rng, 8, (0, 0, 0)),
        random_hull(rng, 7, (2.0 + 0.2 * seed, 0.4, 0)),
    )
    distance, turns = gjk_distance(a.vertices, b.vertices)
    assert distance == pytest.approx(closest(a.vertices, b.vertices), abs=1e-5)
    assert 1 <= turns < 30


def test_hulls_overlap_where_qhull_s_hull_of_all_differences_holds_0():
    rng, seen = np.random.default_rng(7), set()
    for _ in range(60):
        a, b = (
            random_hull(rng, 9, (0, 0, 0)),
            random_hull(rng, 12, rng.uniform(-1.5, 1.5, 3)),
        )
        differences = (a.vertices[:, None] - b.vertices[None]).reshape(-1, 3)
        outside = ConvexHull(differences).equations[:, -1].max()
        if abs(outside) > 1e-6:
            assert (gjk_distance(a.vertices, b.vertices)[0] <= 0) == (outside < 0)
            seen.add(outside < 0)
    assert seen == {True, False}


def test_the_nearest_point_of_a_simplex_is_no_farther_than_drawn_points_of_it():
    rng = np.random.default_rng(8)
    for size in (1, 2, 3, 4):
        for _ in range(20):
            corners = rng.normal(size=(size, 3)) + rng.normal(size=3)
            point, kept = nearest_of_simplex(corners)
            drawn = rng.dirichlet(np.ones(size), 500) @ corners
            assert point @ point <= np.sum(drawn**2, axis=-1).min() + 1e-12
            assert 1 <= len(kept) <= size


def test_counts_follow_euler_and_verdicts_agree():
    growth = hull_growth((6, 12), pairs=2)
    n = growth.corners
    assert np.array_equal(growth.axes, 2 * (2 * n - 4) + (3 * n - 6) ** 2)
    assert growth.sat_products == pytest.approx(2 * n * growth.axes)
    assert growth.different.sum() == 0 and np.all(
        growth.gjk_products < growth.sat_products
    )
