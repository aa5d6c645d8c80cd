"""Cuts of space: against points tried one by one, and by hand."""

import numpy as np
import pytest

from course.formulas.lesson_08_spatial_partitioning import (
    expected_cells,
    grid_cells,
    sphere_tree_levels,
    split_bsp,
    split_kd,
)


def drawn(seed, n):
    rng = np.random.default_rng(seed)
    lower = rng.uniform(-5, 5, (n, 3))
    return lower, lower + rng.uniform(0, 3, (n, 3))


def test_cells_by_hand():
    cells = grid_cells(np.array([-0.5, 0.2, 1.0]), np.array([0.5, 0.9, 2.5]), 1.0)
    assert cells.tolist() == [[-1, 0, 1], [-1, 0, 2], [0, 0, 1], [0, 0, 2]]
    assert grid_cells(np.full(3, 0.3), np.full(3, 0.3), 0.5).tolist() == [[0, 0, 0]]


def test_points_of_a_box_lie_in_its_cells_and_each_cell_holds_one():
    boxes = zip(*drawn(4, 40), np.linspace(0.3, 4, 40), strict=True)
    for lower, upper, size in boxes:
        cells = grid_cells(lower, upper, size)
        share = np.random.default_rng(1).uniform(size=(2000, 3))
        inside = lower + share * (upper - lower)
        of_points = {tuple(k) for k in np.floor(inside / size).astype(int)}
        assert of_points <= {tuple(k) for k in cells}
        low, high = cells * size, (cells + 1) * size
        assert np.all((low <= upper) & (lower < high + 1e-12))
        assert cells.tolist() == sorted(cells.tolist())


def test_the_mean_number_of_cells_is_what_dice_say():
    import sympy as sp

    s, c = sp.symbols("s c", positive=True)
    expected = sp.lambdify((s, c), expected_cells(s, c))
    rng = np.random.default_rng(6)
    for side, size in ((0.5, 1.0), (2.5, 1.0)):
        at = rng.uniform(0, size, (4000, 3))
        count = [len(grid_cells(a, a + side, size)) for a in at]
        assert np.mean(count) == pytest.approx(expected(side, size), rel=0.03)


def test_a_cut_across_an_axis_is_a_plane_along_it():
    lower, upper = drawn(7, 50)
    for axis in range(3):
        for at in (-20.0, 0.4, lower[3, axis], upper[8, axis], 20.0):
            below, above = split_kd(lower, upper, axis, at)
            assert below.tolist() == [i for i in range(50) if lower[i, axis] <= at]
            assert above.tolist() == [i for i in range(50) if upper[i, axis] >= at]
            assert set(below) | set(above) == set(range(50))


def test_sides_of_a_plane_are_those_of_the_corners():
    lower, upper = drawn(8, 60)
    signs = np.array(np.meshgrid([0, 1], [0, 1], [0, 1])).reshape(3, 8).T
    corners = lower[:, None] + signs * (upper - lower)[:, None]
    rng = np.random.default_rng(9)
    for _ in range(20):
        normal = rng.normal(size=3)
        normal /= np.linalg.norm(normal)
        offset = rng.uniform(-4, 4)
        along = corners @ normal - offset
        behind, before = split_bsp(lower, upper, normal, offset)
        assert behind.tolist() == np.flatnonzero(along.min(axis=1) <= 0).tolist()
        assert before.tolist() == np.flatnonzero(along.max(axis=1) >= 0).tolist()


def test_each_sphere_holds_its_two_and_touches_both_from_within():
    rng = np.random.default_rng(10)
    n = 16
    centers, radii = rng.uniform(-5, 5, (n, 3)), rng.uniform(0.1, 4, n)
    c, r = sphere_tree_levels(centers, radii)
    assert c.shape == (2 * n - 1, 3) and r.shape == (2 * n - 1,)
    assert np.array_equal(c[:n], centers) and np.array_equal(r[:n], radii)
    start, count, above = 0, n, n
    while count > 1:
        for k in range(count // 2):
            one, two = start + 2 * k, start + 2 * k + 1
            slack = [r[above] - r[i] - np.linalg.norm(c[above] - c[i]) for i in (one, two)]  # fmt: skip
            assert min(slack) == pytest.approx(0, abs=1e-12)
            holds = np.linalg.norm(c[one] - c[two]) <= abs(r[one] - r[two])
            assert holds or max(slack) == pytest.approx(0, abs=1e-12), "the smallest"
            above += 1
        start, count = start + count, count // 2


def test_one_sphere_within_another_and_two_alike():
    c, r = sphere_tree_levels(np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([5.0, 1.0]))
    assert c[2].tolist() == [0, 0, 0] and r[2] == 5
    c, r = sphere_tree_levels(np.zeros((2, 3)), np.ones(2))
    assert c[2].tolist() == [0, 0, 0] and r[2] == 1
