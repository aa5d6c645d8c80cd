"""Supports, boxes, k-DOPs and spheres against corners, samples, Qhull, closed forms and a programme."""

import numpy as np
import pytest
import sympy as sp
from scipy.optimize import linprog, minimize_scalar
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from course import formulas

CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1.0)])


def test_the_box_of_points_by_sorting():
    rng = np.random.default_rng(0)
    points = rng.normal(size=(4, 5, 20, 3))
    lower, upper = formulas.bounding_box(points)
    ordered = np.sort(points, axis=-2)
    assert np.array_equal(lower, ordered[..., 0, :])
    assert np.array_equal(upper, ordered[..., -1, :])


def growth(e_1, e_2, theta):
    a, b, c = sp.symbols("a b c", positive=True)
    found = formulas.box_growth(a, b, c).subs({a: e_1, b: e_2, c: theta})
    return float(sp.N(found))


@pytest.mark.parametrize("degrees", [0, 17, 45, 90, 130, 200, 300])
def test_the_growth_is_that_of_the_turned_corners(degrees):
    e = np.array([0.5, 0.005])
    theta = np.radians(degrees)
    c, s = np.cos(theta), np.sin(theta)
    corners = CORNERS[:, :2] * e @ np.array([[c, s], [-s, c]])
    area = np.prod(np.ptp(corners, axis=0))
    assert growth(*e, theta) == pytest.approx(area / np.prod(2 * e))


def test_a_rod_of_1_m_by_1_cm_grows_51_fold_and_most_of_all_at_45_degrees():
    """(1 + 0.01)^2 / (2 * 1 * 0.01) = 1.0201 / 0.02 = 51.005."""
    assert growth(0.5, 0.005, np.pi / 4) == pytest.approx(51.005)
    a, b, c = sp.symbols("a b c", positive=True)
    of = sp.lambdify(c, formulas.box_growth(a, b, c).subs({a: 0.5, b: 0.005}))
    most = minimize_scalar(lambda t: -of(t), bounds=(0.1, 1.4), method="bounded")
    assert most.x == pytest.approx(np.pi / 4, abs=1e-4)
    assert growth(0.5, 0.005, 0.0) == pytest.approx(1.0)
    assert growth(1.0, 1.0, np.pi / 4) == pytest.approx(2.0), "a square"


def test_the_support_is_the_answer_of_a_linear_programme():
    """max d.x over weighted means of the points: never beyond the farthest point."""
    rng = np.random.default_rng(1)
    for _ in range(30):
        points, d = rng.normal(size=(12, 3)), rng.normal(size=3)
        best = linprog(-(points @ d), A_eq=np.ones((1, 12)), b_eq=[1.0])
        found = formulas.support(points, d)
        assert found @ d == pytest.approx(-best.fun)
        assert np.any(np.all(found == points, axis=-1))


def test_supports_of_a_batch_are_those_one_by_one_and_do_not_ask_for_length():
    rng = np.random.default_rng(2)
    points, d = rng.normal(size=(4, 5, 9, 3)), rng.normal(size=(4, 5, 3))
    found = formulas.support(points, d)
    one_by_one = [
        [formulas.support(points[i, j], d[i, j]) for j in range(5)] for i in range(4)
    ]
    assert np.array_equal(found, one_by_one)
    assert np.array_equal(found, formulas.support(points, 1e-3 * d))


def test_the_extents_of_a_turned_box_are_those_of_its_corners():
    rng = np.random.default_rng(3)
    rotation = Rotation.random(300, random_state=rng).as_matrix()
    e = rng.uniform(0.01, 2.0, (300, 3))
    corners = np.einsum("bij,bcj->bci", rotation, CORNERS * e[:, None])
    found = formulas.rotated_box_extents(e, rotation)
    assert np.allclose(found, np.abs(corners).max(axis=1), atol=1e-14)


def test_a_box_turned_by_quarters_has_the_same_extents_in_another_order():
    quarter = np.eye(3)[[1, 2, 0]]
    found = formulas.rotated_box_extents(np.array([1.0, 2.0, 3.0]), quarter)
    assert np.array_equal(found, [2.0, 3.0, 1.0])


def test_a_k_dop_holds_its_points_and_each_side_touches_one():
    rng = np.random.default_rng(4)
    n = rng.normal(size=(7, 3))
    n /= np.linalg.norm(n, axis=-1, keepdims=True)
    points = rng.normal(size=(3, 30, 3))
    lower, upper = formulas.k_dop(points, n)
    slack = np.einsum("bnd,kd->bnk", points, n)
    assert np.all(slack >= lower[:, None] - 1e-12) and np.all(slack <= upper[:, None] + 1e-12)  # fmt: skip
    assert np.allclose((slack - lower[:, None]).min(axis=1), 0.0, atol=1e-12)
    assert np.allclose((upper[:, None] - slack).min(axis=1), 0.0, atol=1e-12)


def test_a_k_dop_along_the_axes_is_the_box_and_of_a_ball_the_ball_s_width():
    points = np.random.default_rng(5).normal(size=(40, 3))
    for one, other in zip(
        formulas.k_dop(points, np.eye(3)), formulas.bounding_box(points), strict=True
    ):
        assert np.allclose(one, other)
    around = np.random.default_rng(6).normal(size=(40000, 3))
    around /= np.linalg.norm(around, axis=-1, keepdims=True)
    n = np.array([[1.0, 1, 1], [1, -1, 0]]) / np.sqrt([[3.0], [2.0]])
    lower, upper = formulas.k_dop(around, n)
    assert np.allclose(lower, -1, atol=1e-3) and np.allclose(upper, 1, atol=1e-3)


def test_the_support_of_a_compound_is_that_of_all_its_corners_in_the_world():
    rng = np.random.default_rng(7)
    points = rng.normal(size=(6, 4, 10, 3))
    rotation = Rotation.random(24, random_state=rng).as_matrix().reshape(6, 4, 3, 3)
    shift, d = rng.normal(size=(6, 4, 3)), rng.normal(size=(6, 3))
    found = formulas.compound_support(points, rotation, shift, d)
    world = np.einsum("bmij,bmnj->bmni", rotation, points) + shift[:, :, None]
    for k in range(6):
        every = world[k].reshape(-1, 3)
        assert found[k] @ d[k] == pytest.approx((every @ d[k]).max())
        # Its support is that of the hull of all parts, as Qhull has it.
        hull = ConvexHull(every)
        assert np.linalg.norm(every[hull.vertices] - found[k], axis=-1).min() < 1e-12


def test_ritter_s_sphere_holds_the_points_and_is_at_most_a_few_times_too_large():
    rng = np.random.default_rng(8)
    for _ in range(60):
        points = rng.normal(size=(25, 3)) * rng.uniform(0.1, 2.0, 3)
        center, radius = formulas.bounding_sphere(points)
        away = np.linalg.norm(points - center, axis=-1)
        assert away.max() <= radius + 1e-12
        widest = np.linalg.norm(points[:, None] - points, axis=-1).max()
        assert 0.5 * widest <= radius + 1e-12, "no sphere is smaller than that"
        assert radius < widest, "the sphere about any point of the set"


def test_ritter_s_sphere_of_two_points_and_of_a_box():
    center, radius = formulas.bounding_sphere(np.array([[1.0, 0, 0], [5.0, 0, 0]]))
    assert np.allclose(center, [3, 0, 0]) and radius == 2.0
    center, radius = formulas.bounding_sphere(CORNERS * [3.0, 2.0, 1.0])
    assert radius >= np.sqrt(14.0) - 1e-12


def test_a_principal_box_is_right_handed_and_tight():
    rng = np.random.default_rng(9)
    turn = Rotation.random(random_state=rng).as_matrix()
    grid = np.stack(np.meshgrid(*[np.linspace(-1, 1, 5)] * 3), axis=-1).reshape(-1, 3)
    points = grid * [3.0, 2.0, 1.0] @ turn.T + [5.0, 6.0, 7.0]
    center, rotation, e = formulas.principal_box(points)
    assert np.allclose(center, [5, 6, 7]) and np.allclose(sorted(e), [1, 2, 3])
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    assert np.allclose(np.abs(rotation.T @ turn) @ [3.0, 2.0, 1.0], e)
