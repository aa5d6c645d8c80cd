"""The separating axis against linear programmes, hulls of differences, samples and closed forms."""

import numpy as np
import pytest
from scipy.optimize import linprog
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from course import formulas

CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1.0)])


def polygon(rng, count, at=0.0):
    """A convex polygon, counter-clockwise: points on an ellipse at drawn angles."""
    angle = np.sort(rng.uniform(0, 2 * np.pi, count))
    points = np.stack([np.cos(angle), rng.uniform(0.3, 1) * np.sin(angle)], axis=-1)
    turn = rng.uniform(0, 2 * np.pi)
    c, s = np.cos(turn), np.sin(turn)
    return points @ np.array([[c, s], [-s, c]]) + at


def box(rng, at):
    return at, Rotation.random(random_state=rng).as_matrix(), rng.uniform(0.2, 1.2, 3)


def corners(center, rotation, half_extents):
    return center + CORNERS * half_extents @ rotation.T


def signed_gap(points_a, points_b):
    """Of two hulls: Qhull's hull of all differences, and how far outside of it 0 lies.

    Below 0 the least shift that parts them, negative; above 0 a bound from below.
    """
    differences = (points_a[:, None] - points_b[None]).reshape(-1, points_a.shape[-1])
    return ConvexHull(differences).equations[:, -1].max()


def common_point(points_a, points_b):
    """Whether a linear programme finds weighted means of both that coincide."""
    n, m = len(points_a), len(points_b)
    equal = np.block([[points_a.T, -points_b.T], [np.ones(n), np.zeros(m)], [np.zeros(n), np.ones(m)]])  # fmt: skip
    wanted = np.concatenate([np.zeros(points_a.shape[1]), [1.0, 1.0]])
    return linprog(np.zeros(n + m), A_eq=equal, b_eq=wanted).status == 0


def test_a_shadow_by_hand_and_by_support():
    triangle = np.array([[1.0, 1.0], [4.0, 2.0], [2.0, 5.0]])
    axes = np.array([[1.0, 0.0], [0.6, 0.8]])
    lower, upper = formulas.project(triangle, axes)
    assert np.allclose(lower, [1.0, 1.4]) and np.allclose(upper, [4.0, 5.2])
    weights = np.random.default_rng(0).dirichlet(np.ones(3), 4000)
    inside = weights @ triangle @ axes.T
    assert np.all(inside >= lower - 1e-12) and np.all(inside <= upper + 1e-12)
    assert np.allclose(inside.min(axis=0), lower, atol=0.1)


def test_the_gap_of_two_intervals_by_sampling_their_points():
    rng = np.random.default_rng(1)
    for _ in range(200):
        a, b = np.sort(rng.integers(0, 12, (2, 2)), axis=-1)
        gap = formulas.shadow_gap(*a, *b)
        common = set(range(a[0], a[1] + 1)) & set(range(b[0], b[1] + 1))
        assert (gap <= 0) == bool(common)
        # The least whole shift of A after which no point of one is inside the other.
        halves = np.arange(-80, 81) / 2
        in_b = (halves > b[0]) & (halves < b[1])
        shifts = np.arange(-30, 31)[:, None]
        in_a = (halves > a[0] + shifts) & (halves < a[1] + shifts)
        least = np.abs(shifts[~np.any(in_a & in_b, axis=-1)]).min()
        assert least == (max(0, -gap) if common and a[0] < a[1] and b[0] < b[1] else 0)


def test_normals_are_across_their_edges_and_outward():
    rng = np.random.default_rng(2)
    vertices = np.stack([polygon(rng, 5) for _ in range(40)])
    normals = formulas.edge_normals(vertices)
    following = vertices[:, [1, 2, 3, 4, 0]]
    along = np.sum(normals * (following - vertices), axis=-1)
    assert np.abs(along).max() < 1e-12
    assert np.linalg.norm(normals, axis=-1) == pytest.approx(1.0)
    middle = vertices.mean(axis=1, keepdims=True)
    assert np.sum(normals * (vertices - middle), axis=-1).min() > 0


@pytest.mark.parametrize("count", [3, 4, 7])
@pytest.mark.slow
def test_polygons_overlap_where_a_linear_programme_finds_a_common_point(count):
    rng, seen = np.random.default_rng(count), set()
    for _ in range(60):
        a, b = polygon(rng, count), polygon(rng, 5, rng.uniform(-1.6, 1.6, 2))
        if abs(signed_gap(a, b)) > 1e-9:
            verdict = bool(formulas.polygons_overlap(a, b))
            assert verdict == common_point(a, b)
            seen.add(verdict)
    assert seen == {True, False}


def test_polygons_in_a_batch_are_those_one_by_one():
    rng = np.random.default_rng(5)
    a = np.stack([polygon(rng, 3) for _ in range(30)]).reshape(5, 6, 3, 2)
    b = np.stack([polygon(rng, 4, rng.uniform(-1, 1, 2)) for _ in range(30)])
    b = b.reshape(5, 6, 4, 2)
    got = formulas.polygons_overlap(a, b)
    assert got.shape == (5, 6)
    one_by_one = [[formulas.polygons_overlap(a[i, j], b[i, j]) for j in range(6)] for i in range(5)]  # fmt: skip
    assert np.array_equal(got, one_by_one)


def test_half_a_shadow_is_the_farthest_corner():
    rng = np.random.default_rng(6)
    for _ in range(50):
        _, rotation, e = box(rng, np.zeros(3))
        n = rng.normal(size=3)
        n /= np.linalg.norm(n)
        farthest = (corners(np.zeros(3), rotation, e) @ n).max()
        assert formulas.half_shadow(*e, *(n @ rotation)) == pytest.approx(farthest)


def test_the_15_axes_are_3_and_3_and_the_products_of_edges():
    rng = np.random.default_rng(7)
    a, b = (Rotation.random(4, random_state=rng).as_matrix() for _ in range(2))
    axes = formulas.box_axes(a, b)
    assert axes.shape == (4, 15, 3)
    for k in range(4):
        wanted = [*a[k].T, *b[k].T]
        wanted += [np.cross(p, q) for p in a[k].T for q in b[k].T]
        assert np.allclose(axes[k], wanted)


def test_boxes_overlap_where_a_linear_programme_finds_a_common_point():
    rng, seen = np.random.default_rng(8), set()
    for _ in range(120):
        a, b = box(rng, np.zeros(3)), box(rng, rng.uniform(-1.5, 1.5, 3))
        points = corners(*a), corners(*b)
        if abs(signed_gap(*points)) > 1e-9:
            verdict = bool(formulas.oriented_boxes_overlap(*a, *b))
            assert verdict == common_point(*points)
            assert verdict == (signed_gap(*points) <= 0)
            seen.add(verdict)
    assert seen == {True, False}


@pytest.mark.parametrize("height", [2.0, 2.82, 2.83, 3.0, 3.8, 3.83, 5.0])
def test_crossed_cubes_are_apart_from_2_sqrt_2_on_and_faces_see_it_from_1_plus_2_sqrt_2(
    height,
):
    """Half extents 1, one turned by 45 degrees about x, one about y, one above the other."""
    a = Rotation.from_rotvec([np.pi / 4, 0, 0]).as_matrix()
    b = Rotation.from_rotvec([0, np.pi / 4, 0]).as_matrix()
    pair = np.zeros(3), a, np.ones(3), np.array([0, 0, height]), b, np.ones(3)
    assert formulas.oriented_boxes_overlap(*pair) == (height <= 2 * np.sqrt(2))
    faces = formulas.box_axes(a, b)[:6]
    at = corners(*pair[:3]), corners(*pair[3:])
    gap = formulas.shadow_gap(*formulas.project(at[0], faces), *formulas.project(at[1], faces))  # fmt: skip
    assert gap.max() == pytest.approx(height / np.sqrt(2) - (2 + 1 / np.sqrt(2)))
    assert (gap.max() > 0) == (height > 1 + 2 * np.sqrt(2))


def test_parallel_boxes_are_compared_by_their_extents():
    """Nine of the axes are 0; touching counts as overlapping."""
    rng = np.random.default_rng(9)
    center = rng.integers(-6, 7, (500, 3)) / 2
    e = rng.integers(1, 5, (2, 500, 3)) / 2
    turn = np.broadcast_to(np.eye(3)[[1, 2, 0]], (500, 3, 3))
    got = formulas.oriented_boxes_overlap(0 * center, turn, e[0], center, turn, e[1])
    reach = (e[0] + e[1]) @ np.eye(3)[[1, 2, 0]].T
    assert np.array_equal(got, np.all(np.abs(center) <= reach, axis=-1))
    assert np.any(np.abs(center) == reach) and 20 < got.sum() < 480


def test_the_least_translation_parts_them_and_none_shorter_does():
    rng, count = np.random.default_rng(10), 0
    for _ in range(80):
        a, b = polygon(rng, 4), polygon(rng, 5, rng.uniform(-1, 1, 2))
        shift = formulas.least_translation(a, b)
        depth = signed_gap(a, b)
        assert np.linalg.norm(shift) == pytest.approx(max(0.0, -depth), abs=1e-12)
        if depth < -1e-6:
            count += 1
            assert signed_gap(a + shift, b) == pytest.approx(0.0, abs=1e-9)
    assert count > 20


def test_hulls_overlap_where_a_linear_programme_finds_a_common_point():
    rng, seen = np.random.default_rng(11), set()
    for _ in range(40):
        a, b = (
            rng.normal(size=(8, 3)),
            rng.normal(size=(6, 3)) + rng.normal(size=3) * 1.2,
        )
        if abs(signed_gap(a, b)) > 1e-9:
            verdict = bool(formulas.hulls_overlap(*hull(a), *hull(b)))
            assert verdict == common_point(a, b)
            seen.add(verdict)
    assert seen == {True, False}


def hull(points):
    found = ConvexHull(points)
    pairs = {tuple(sorted(p)) for t in found.simplices for p in ((t[0], t[1]), (t[1], t[2]), (t[0], t[2]))}  # fmt: skip
    edges = np.array([points[j] - points[i] for i, j in pairs])
    return points, found.equations[:, :3], edges
