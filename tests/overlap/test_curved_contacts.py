"""Contacts of spheres, capsules and half spaces: points, keys, curvature; a few of many."""

import numpy as np
import pytest
from overlap.drawn_shapes import hulls, turns

from course.overlap import contacts, gap
from course.overlap.fewer_points import spread
from course.shapes import AABB, OBB, Capsule, HalfSpace, Sphere, polytopes

FLOOR = HalfSpace([0, 0, 1], 0.0)


def test_two_spheres():
    """Radii 1 and 2, 4 apart: one point in the middle of the gap of 1, both curvatures."""
    found = contacts(Sphere([0, 0, 0], 1.0), Sphere([0, 0, 4], 2.0), margin=1.0)
    assert found.separation.tolist() == [1.0] and found.normal.tolist() == [[0, 0, -1]]
    assert found.point.tolist() == [[0, 0, 1.5]] and found.feature.tolist() == [
        "curved"
    ]
    np.testing.assert_array_equal(found.curvature_a[0], np.diag([1, 1, 0]))
    np.testing.assert_array_equal(found.curvature_b[0], np.diag([0.5, 0.5, 0]))
    assert len(contacts(Sphere([0, 0, 0], 1.0), Sphere([0, 0, 4], 2.0))) == 0


def test_a_sphere_on_the_side_and_on_the_end_of_a_capsule():
    """On the side 1/r across the axis and 0 along it, at the end a sphere's."""
    rod = Capsule([0, 0, 0], [2, 0, 0], 0.5)
    found = contacts(Sphere([[1, 0, 1], [3, 0, 0], [-1, 0, 0]], 0.5), rod)
    np.testing.assert_allclose(found.separation, 0, atol=1e-15)
    np.testing.assert_allclose(found.curvature_a[0], np.diag([2, 2, 0]))
    np.testing.assert_allclose(found.curvature_b[0], np.diag([0, 2, 0]))
    np.testing.assert_allclose(found.curvature_b[1], np.diag([0, 2, 2]))
    assert found.key[:, 3].tolist() == [2, 1, 0] and not found.key[:, 2].any()


def test_round_shapes_on_a_floor():
    """A ball; a rod that lies, one that stands, one that leans by .1 over 2 m."""
    ball = contacts(Sphere([1, 2, 0.4], 0.5), FLOOR)
    assert ball.separation[0] == pytest.approx(-0.1) and not ball.curvature_b.any()
    np.testing.assert_allclose(ball.curvature_a[0], np.diag([2, 2, 0]))
    ends = np.array([[0, 0, 0.5], [2, 0, 0.5]]), np.array([[2, 0, 0.5], [2, 0, 2.5]])
    found = contacts(Capsule(*np.swapaxes(ends, 0, 1), 0.5), FLOOR)
    assert found.pair.tolist() == [0, 0, 1]
    assert found.point.tolist() == [[0, 0, 0], [2, 0, 0], [2, 0, 0]]
    assert found.key[:, 2].tolist() == [0, 1, 0]
    lean = Capsule([0, 0, 0.5], [2, 0, 0.6], 0.5)
    assert (
        len(contacts(lean, FLOOR)) == 1 and len(contacts(lean, FLOOR, margin=0.2)) == 2
    )


def test_the_floor_first():
    """It is body A then: N points into it, and its rows come first in the key."""
    box = AABB([-1, -1, -0.25], [1, 1, 1])
    one, other = contacts(box, FLOOR), contacts(FLOOR, box, body_a=4, body_b=9)
    assert len(one) == len(other) == 4 and set(other.body_a) == {4}
    np.testing.assert_array_equal(one.point, other.point)
    np.testing.assert_array_equal(one.normal, -other.normal)
    assert set(one.feature) == {"face_b"} and set(other.feature) == {"face_a"}
    np.testing.assert_array_equal(one.key, other.key[:, [1, 0, 3, 2]])
    assert len({tuple(k) for k in one.key.tolist()}) == 4


def test_rods_side_by_side_touch_at_the_ends_of_what_they_share():
    """From x = .5 to 2, with an end at one side and the middle of a side at the other."""
    a, b = Capsule([0, 0, 1], [2, 0, 1], 0.5), Capsule([0.5, 0, 0], [4, 0, 0], 0.5)
    for turn in (0.0, 1e-12, 1e-9):
        leaning = Capsule([0, 0, 1], [2, 0, 1 + turn], 0.5)
        found = contacts(leaning, b, margin=1e-6)
        order = np.argsort(found.point[:, 0])
        np.testing.assert_allclose(found.point[order, 0], [0.5, 2.0], atol=1e-6)
        np.testing.assert_allclose(found.separation, 0, atol=1e-8)
        assert len({tuple(k) for k in found.key.tolist()}) == 2
    crossed = contacts(a, Capsule([1, -1, 0], [1, 1, 0], 0.5))
    np.testing.assert_allclose(crossed.point, [[1, 0, 0.5]])
    np.testing.assert_allclose(crossed.curvature_a[0], np.diag([0, 2, 0]), atol=1e-12)
    np.testing.assert_allclose(crossed.curvature_b[0], np.diag([2, 0, 0]), atol=1e-12)


def test_a_rod_on_a_table():
    """Whole on it: its ends. Over its border: one end, and the border's edge, which is sharp."""
    table = OBB([0, 0, -0.5], np.eye(3), [1, 1, 0.5])
    rod = Capsule(
        [[-0.5, 0, 0.25], [0.5, 0, 0.25]], [[0.5, 0, 0.25], [1.5, 0, 0.25]], 0.25
    )
    found = contacts(rod, table, margin=1e-9)
    assert found.pair.tolist() == [0, 0, 1, 1]
    np.testing.assert_allclose(found.normal, [[0, 0, 1]] * 4, atol=1e-12)
    assert sorted(np.round(found.point[:2, 0], 9)) == [-0.5, 0.5]
    assert sorted(np.round(found.point[2:, 0], 9)) == [0.5, 1.0]
    np.testing.assert_allclose(found.separation, 0, atol=1e-12)
    assert set(found.feature) == {"curved"}


def test_a_ball_on_a_face_an_edge_and_a_corner():
    """B's curvature is 0 on the face; across the edge, and in all directions on the corner, large but finite."""
    box = AABB([-1, -1, -1], [1, 1, 1])
    way = np.array([[0, 0, 1.0], [0, 1, 1], [1, 1, 1]])
    way /= np.linalg.norm(way, axis=1, keepdims=True)
    at = np.array([[0.2, 0.1, 1], [0.2, 1, 1], [1, 1, 1]])
    found = contacts(Sphere(at + 0.5 * way, 0.5), box, margin=1e-9)
    assert len(found) == 3 and set(found.feature) == {"curved"}
    np.testing.assert_allclose(found.normal, way, atol=1e-12)
    flat, edge, corner = found.curvature_b
    assert not flat.any()
    assert np.linalg.matrix_rank(edge, tol=1) == 1 and edge[0, 0] == pytest.approx(
        0, abs=1
    )
    assert np.linalg.matrix_rank(corner, tol=1) == 2
    assert 1e6 < edge.max() < np.inf and 1e6 < corner.max() < np.inf


def test_points_and_segments_have_a_finite_curvature():
    found = contacts(Sphere([0, 0, 0], 0.0), Sphere([0, 0, 0.5], 0.5), margin=0.1)
    assert np.isfinite(found.curvature_a).all() and found.curvature_a.max() > 1e6


def test_vertices_on_a_plane():
    """All within the margin; with a limit the deepest first, and others far from it."""
    rng = np.random.default_rng(4)
    many = hulls(rng, 5)
    d = gap(many, FLOOR)
    found = contacts(many, FLOOR, margin=1.0)
    solids = polytopes(many)  # without the points inside
    for i in range(5):
        heights = np.sort(solids.vertices[slice(*solids.vertex_start[i : i + 2]), 2])
        mine = np.sort(found.separation[found.pair == i])
        np.testing.assert_allclose(mine, heights[heights <= 1.0])
        assert not mine.size or mine[0] == pytest.approx(d[i])
    few = contacts(many, FLOOR, margin=50.0, limit=3)
    assert np.bincount(few.pair).tolist() == [3] * 5
    for i in range(5):
        assert few.separation[few.pair == i].min() == pytest.approx(d[i])
    square = AABB([-1, -1, 0], [1, 1, 1])
    two = contacts(square, FLOOR, limit=2)
    assert np.linalg.norm(two.point[1] - two.point[0]) == pytest.approx(np.sqrt(8))


def test_what_is_kept_of_many_points_spans_them():
    """A deep point beside the middle of a square's corners and its centre: it, and the corners farthest from it."""
    point = np.array(
        [[0.1, 0, 0], [1, 1, 0], [-1, 1, 0], [-1, -1, 0], [1, -1, 0], [0, 0, 0]]
    )
    depth = np.array([-0.2, 0, 0, 0, 0, -0.1])
    assert spread(point, depth, 1).tolist() == [0]
    assert spread(point, depth, 3).tolist() == [0, 2, 3]
    assert spread(point, depth, 5).tolist() == [0, 1, 2, 3, 4]


def test_spheres_sunk_as_deep_as_they_are_round():
    """Then no point moves over both: the normal is B's."""
    found = contacts(Sphere([0, 0, 0.1], 1.0), Sphere([[0, 0, 0.0], [0, 0, -1.2]], 1.0))
    assert found.feature.tolist() == ["face_b", "curved"]


def test_what_rounding_lifts_off_the_floor_still_touches():
    """A turned box and rod that rest on a turned floor: four corners and two ends, each time."""
    rng, touched = np.random.default_rng(8), 0
    for _ in range(50):
        turn, shift = turns(rng, 1)[0], rng.normal(0, 3, 3)
        box = OBB([0.3, 0.2, 0.5], np.eye(3), [1, 2, 0.5]).moved(turn, shift)
        rod = Capsule([0.1, 0.3, 0.2], [1.7, -2, 0.2], 0.2).moved(turn, shift)
        for shape, points in (box, 4), (rod, 2):
            found = contacts(shape, FLOOR.moved(turn, shift))
            assert len(found) in (0, points)  # rounding may lift the lowest too
            touched += len(found) > 0
    assert touched > 30
    assert len(contacts(Capsule([0, 0, 1], [0, 0, 1], 1.0), FLOOR)) == 1
