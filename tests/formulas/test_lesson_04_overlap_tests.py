"""Overlap tests against samples, minimisers, lattice counts and published cases."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.optimize import minimize, minimize_scalar

from course.formulas import lesson_04_overlap_tests as formulas


def ends(rng, count):
    """Segments, some of them only a point: start, end (count, 3)."""
    start, end = rng.normal(size=(2, count, 3))
    end[::7] = start[::7]
    return start, end


def distance_along(point, start, end):
    """The least distance of a point to a segment, by a minimiser along it."""
    found = minimize_scalar(
        lambda s: np.linalg.norm(start + s * (end - start) - point),
        bounds=(0.0, 1.0), method="bounded", options={"xatol": 1e-12},
    )  # fmt: skip
    both = [np.linalg.norm(e - point) for e in (start, end)]
    return min(found.fun, *both)


def in_box(places, lower, upper):
    return np.all((places >= lower) & (places <= upper), axis=-1)


def test_points_of_a_lattice_in_a_sphere_are_as_many_as_are_known():
    """Gauss' circle problem in space: 1, 7, 33, 123, 257, 515 (OEIS A000605)."""
    steps = np.arange(-6, 7)
    lattice = np.stack(np.meshgrid(steps, steps, steps), axis=-1) + [5.0, -2.0, 1.0]
    centre = np.array([5.0, -2.0, 1.0])
    counts = [np.sum(formulas.point_in_sphere(lattice, centre, r)) for r in range(6)]
    assert counts == [1, 7, 33, 123, 257, 515]


def test_spheres_overlap_where_a_point_between_the_centres_lies_in_both():
    rng = np.random.default_rng(1)
    x_a, x_b = rng.uniform(-2, 2, (2, 400, 3))
    r_a, r_b = rng.uniform(0.1, 2, (2, 400))
    share = np.linspace(0, 1, 4001)[:, None, None]
    between = x_a + share * (x_b - x_a)
    in_a = np.linalg.norm(between - x_a, axis=-1) <= r_a
    in_b = np.linalg.norm(between - x_b, axis=-1) <= r_b
    verdict = formulas.spheres_overlap(x_a, r_a, x_b, r_b)
    assert np.array_equal(verdict, np.any(in_a & in_b, axis=0))
    assert 50 < verdict.sum() < 350


def test_spheres_that_pass_each_other_hit_where_libccd_says():
    """Its test "spheresphere": radii .35 and .5, the first at x = -5 + i/10."""
    x = np.zeros((100, 3))
    x[:, 0] = -5 + 0.1 * np.arange(100)
    hit = np.flatnonzero(formulas.spheres_overlap(x, 0.35, np.zeros(3), 0.5))
    assert hit.tolist() == list(range(42, 59))


def test_whole_numbers_are_decided_exactly_touching_included():
    rng = np.random.default_rng(2)
    x_a, x_b = rng.integers(-4, 5, (2, 4000, 3)).astype(float)
    r_a, r_b = rng.integers(0, 5, (2, 4000)).astype(float)
    exact = [
        sum((Fraction(p) - Fraction(q)) ** 2 for p, q in zip(a, b, strict=True))
        - (Fraction(r) + Fraction(s)) ** 2
        for a, b, r, s in zip(x_a, x_b, r_a, r_b, strict=True)
    ]
    verdict = formulas.spheres_overlap(x_a, r_a, x_b, r_b)
    assert verdict.tolist() == [e <= 0 for e in exact]
    assert sum(e == 0 for e in exact) > 20


def test_boxes_overlap_where_they_have_a_lattice_point_in_common():
    """Corners are whole numbers: then a common point is there exactly where a whole one is."""
    rng = np.random.default_rng(3)
    drawn = np.sort(rng.integers(0, 6, (2, 500, 2, 3)), axis=2).astype(float)
    (l_a, u_a), (l_b, u_b) = (d.transpose(1, 0, 2) for d in drawn)
    lattice = np.stack(np.meshgrid(*3 * [np.arange(7)]), axis=-1).reshape(-1, 1, 3)
    common = np.any(in_box(lattice, l_a, u_a) & in_box(lattice, l_b, u_b), axis=0)
    assert np.array_equal(formulas.boxes_overlap(l_a, u_a, l_b, u_b), common)
    assert 100 < common.sum() < 400


def test_boxes_that_pass_each_other_hit_where_libccd_says():
    """Its test "boxbox": sides (1, 2, 1) and (2, 1, 2); at 35 and 65 they touch."""
    x = np.zeros((101, 3))
    x[:, 0] = (np.arange(101) - 50) / 10
    e_a, e_b = np.array([0.5, 1.0, 0.5]), np.array([1.0, 0.5, 1.0])
    hit = np.flatnonzero(formulas.boxes_overlap(x - e_a, x + e_a, -e_b, e_b))
    assert hit.tolist() == list(range(35, 66))


def test_the_share_of_the_way_is_where_the_squared_distance_is_least():
    rng = np.random.default_rng(4)
    for p, b in rng.normal(size=(40, 2, 3)):
        squared = np.polyfit([0, 1, 2], [np.sum((p - s * b) ** 2) for s in range(3)], 2)
        least = -squared[1] / (2 * squared[0])
        assert formulas.foot_share(*p, *b) == pytest.approx(least, abs=1e-9)


def test_the_closest_point_is_what_a_minimiser_finds():
    rng = np.random.default_rng(5)
    start, end = ends(rng, 150)
    point = rng.normal(size=(150, 3)) * 2
    nearest = formulas.closest_point_on_segment(point, start, end)
    distance = np.linalg.norm(nearest - point, axis=-1)
    for k in range(150):
        assert distance[k] == pytest.approx(distance_along(point[k], start[k], end[k]))
        on = [np.linalg.norm(nearest[k] - e[k]) for e in (start, end)]
        assert sum(on) == pytest.approx(np.linalg.norm(end[k] - start[k]), abs=1e-12)
    assert np.array_equal(nearest[::7], start[::7])


def test_a_batch_of_segments_is_those_one_by_one():
    rng = np.random.default_rng(6)
    point, start, end = rng.normal(size=(3, 4, 5, 3))
    got = formulas.closest_point_on_segment(point, start, end)
    for i in range(4):
        for j in range(5):
            one = formulas.closest_point_on_segment(point[i, j], start[i, j], end[i, j])
            np.testing.assert_allclose(got[i, j], one, rtol=1e-14)


def test_a_sphere_and_a_capsule_by_hand():
    a, b = np.zeros(3), np.array([4.0, 0.0, 0.0])
    centres = np.array([[1.0, 3, 4], [-3.0, 0, 4], [7.0, 4, 0], [2.0, 0, 0]])
    gap = formulas.sphere_capsule_gap(centres, 1.5, a, b, 0.5)
    assert gap == pytest.approx([3.0, 3.0, 3.0, -2.0])


def test_a_capsule_is_all_spheres_along_its_segment():
    rng = np.random.default_rng(7)
    (start, end), centre = ends(rng, 200), rng.normal(size=(200, 3))
    r, big = rng.uniform(0.1, 0.5, (2, 200))
    share = np.linspace(0, 1, 2001)[:, None, None]
    along = start + share * (end - start)
    sampled = np.linalg.norm(centre - along, axis=-1).min(axis=0) - r - big
    gap = formulas.sphere_capsule_gap(centre, r, start, end, big)
    assert np.all(gap <= sampled + 1e-12) and np.abs(gap - sampled).max() < 3e-3


def test_two_capsules_are_as_far_apart_as_a_minimiser_finds():
    rng = np.random.default_rng(8)
    (a, b), (c, d) = ends(rng, 60), ends(rng, 60)
    c[:6], d[:6] = a[:6] + 0.7, b[:6] + 0.7  # parallel
    gap = formulas.capsule_gap(a, b, 0.1, c, d, 0.2)
    for k in range(60):
        u, v = b[k] - a[k], d[k] - c[k]

        def apart(x, k=k, u=u, v=v):
            return np.linalg.norm(a[k] + x[0] * u - c[k] - x[1] * v)

        # A convex function on a square: one minimum, to be found from the middle.
        found = minimize(apart, [0.5, 0.5], bounds=[(0, 1), (0, 1)], tol=1e-14).fun
        assert gap[k] == pytest.approx(found - 0.3, abs=2e-6)


@pytest.mark.parametrize("angle", [0.0, 1e-17, 1e-12, 1e-8, 1e-5])
def test_nearly_parallel_capsules_are_neither_too_near_nor_too_far(angle):
    rng = np.random.default_rng(9)
    a, way = rng.normal(size=(2, 50, 3))
    across = np.cross(way, rng.normal(size=(50, 3)))
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    turned = way + angle * np.cross(across, way)
    c = a + 0.3 * way + 0.5 * across
    gap = formulas.capsule_gap(a, a + way, 0.0, c, c + turned, 0.0)
    assert gap == pytest.approx(0.5, abs=1e-5)


def test_a_sphere_and_a_box_as_fcl_has_them():
    """FCL's test_sphere_box: a centre inside is as deep as it is below the face, and r."""
    lower, upper = -np.ones(3), np.ones(3)
    centre = np.array([[0.0, 0, 0.75], [0.0, 0, 1.5], [2.0, 2.0, 0], [0.0, 0, 0]])
    gap = formulas.sphere_box_gap(centre, 0.25, lower, upper)
    assert gap == pytest.approx([-0.5, 0.25, np.sqrt(2) - 0.25, -1.25])


def test_a_sphere_moved_out_of_a_box_by_its_depth_only_touches():
    rng = np.random.default_rng(10)
    centre = rng.uniform(-1, 1, (300, 3))
    e = rng.uniform(0.5, 2.0, (300, 3))
    gap = formulas.sphere_box_gap(centre, 0.3, -e, e)
    ways = np.concatenate([np.eye(3), -np.eye(3)])[:, None]
    inside = in_box(centre, -e, e)
    moved = formulas.sphere_box_gap(centre - gap[:, None] * ways, 0.3, -e, e)
    assert moved[:, inside].max(axis=0) == pytest.approx(0.0, abs=1e-12)
    shorter = formulas.sphere_box_gap(centre - 0.99 * gap[:, None] * ways, 0.3, -e, e)
    assert shorter[:, inside].max() < 0
    assert 50 < inside.sum() < 250
