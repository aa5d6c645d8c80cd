"""Manifolds: which points, where, how deep, under which names, and that shaking does not change them."""

from fractions import Fraction

import numpy as np
import pytest
from overlap.feature_gaps import feature, separation_and_normal
from overlap.manifolds import TURNED, box, polygon_area, prism, regular, touching
from scipy.spatial import ConvexHull as Qhull

from course import rotations
from course.shapes import OBB, Capsule, Sphere
from course.shapes.rounded_polytopes import polytopes

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

CUBE = [0.5, 0.5, 0.5]


def exact_area(one, other):
    """The area that two convex polygons with whole coordinates share, in fractions.

    Every vertex of the common part is a crossing of two of all border lines that lies
    inside all of them: no clipping in turn.
    """
    lines = []
    for polygon in (one, other):
        for p, q in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
            a, b = int(p[1] - q[1]), int(q[0] - p[0])
            lines.append((a, b, a * int(p[0]) + b * int(p[1])))
    corners = set()
    for k, (a, b, c) in enumerate(lines):
        for d, e, f in lines[:k]:
            if det := a * e - b * d:
                x, y = Fraction(c * e - b * f, det), Fraction(a * f - c * d, det)
                if all(u * x + v * y >= w for u, v, w in lines):
                    corners.add((x, y))
    if len(corners) < 3:
        return 0.0
    return float(
        Qhull(np.array([(float(x), float(y)) for x, y in corners]), "QJ").volume
    )


def drawn_polygon(rng):
    points = rng.integers(-100, 100, size=(rng.integers(3, 12), 2)) + rng.integers(
        -60, 60, 2
    )
    return points[Qhull(points).vertices]


@pytest.mark.parametrize("seed", range(40))
def test_area_is_that_of_the_common_polygon(seed):
    rng = np.random.default_rng(seed)
    one, other = drawn_polygon(rng), drawn_polygon(rng)
    a, b = prism(one / 100, 0, 1, TURNED), prism(other / 100, -1, 0.001, TURNED)
    area = exact_area(one, other) / 1e4
    contacts = touching(a, b)
    if area == 0:
        assert len(contacts) == 0
        return
    assert polygon_area(contacts.point, TURNED[:, 2]) == pytest.approx(area, abs=1e-12)
    np.testing.assert_allclose(contacts.separation, -0.001, atol=1e-14)
    np.testing.assert_allclose(contacts.normal - TURNED[:, 2], 0, atol=1e-14)


def float_area(one, other):
    """The area that two convex polygons share, by clipping in turn without any tolerance."""
    for p, q in zip(other, np.roll(other, -1, axis=0), strict=True):
        height = (one - p) @ np.array([p[1] - q[1], q[0] - p[0]])
        after, there = np.roll(height, -1), np.roll(one, -1, axis=0)
        kept = []
        for k in range(len(one)):
            kept += [one[k]] if height[k] >= 0 else []
            if (height[k] >= 0) != (after[k] >= 0):
                t = height[k] / (height[k] - after[k])
                kept.append(one[k] + t * (there[k] - one[k]))
        one = np.array(kept).reshape(-1, 2)
        if len(one) < 3:
            return 0.0
    x, y = one.T
    return 0.5 * abs(x @ np.roll(y, -1) - y @ np.roll(x, -1))


@pytest.mark.parametrize("seed", range(6))
def test_polygons_that_nearly_coincide_lose_no_area(seed):
    """Moved, grown and turned by about the bias, 1e-6 of the size: the area is right to its border times that."""
    rng = np.random.default_rng(seed)
    for _ in range(50):
        corners = int(rng.integers(3, 9))
        one = regular(corners, 1.0, rng.uniform(0, 6))
        small = rng.choice([0, 1e-9, 0.5e-6, 0.9e-6, 1.1e-6, 2e-6, 5e-6, 2e-5])
        turn = rng.choice([0, 1]) * 10.0 ** rng.uniform(-9, -2)
        c, s = np.cos(turn), np.sin(turn)
        other = one @ np.array([[c, s], [-s, c]]) * (1 + small * rng.choice([-1, 0, 1]))
        other = other + small * rng.normal(size=2)
        other += rng.choice([0, 0.5, 1]) * (one[0] - one[corners // 2])
        contacts = touching(prism(one, 0, 1), prism(other, -1, 1e-7))
        n = np.array([0, 0, 1.0])
        area = polygon_area(contacts.point, n) if len(contacts) > 2 else 0.0
        assert area == pytest.approx(float_area(one, other), abs=2e-5)
        apart = np.linalg.norm(contacts.point[:, None] - contacts.point, axis=-1)
        assert (apart + np.eye(len(contacts))).min(initial=1) > 1e-6


def test_bars_side_by_side_through_a_corner():
    """An edge of one runs along an edge of the other and ends at its corner, sunk by less than the bias."""
    a = prism(regular(7, 1.0, 0.3), 0, 1)
    away = 2 * np.append(regular(7, 1.0, 0.3)[2], 0.0) * np.cos(np.pi / 7)
    for by in (0.999997, 0.9999985, 1.0):
        b = prism(regular(7, 1.0, 0.3 + np.pi), -1, 1e-3).moved(np.eye(3), by * away)
        contacts = touching(a, b, margin=1e-6)
        assert np.isfinite(contacts.point).all()


def test_an_octagon_keeps_all_its_corners_and_four_of_them_are_70_percent():
    a, b = prism(regular(8), 0, 1), box([0, 0, -1], [2, 2, 1])
    whole, four = touching(a, b, margin=1e-9), touching(a, b, margin=1e-9, limit=4)
    assert len(whole) == 8 and set(whole.feature) == {"face_b"}
    assert len(four) == 4 and {tuple(k) for k in four.key} <= {
        tuple(k) for k in whole.key
    }
    up = np.array([0, 0, 1.0])
    order = np.argsort(np.arctan2(four.point[:, 1], four.point[:, 0]))
    # Areas of a regular octagon and a square in one circle: 2 sqrt(2) and 2.
    assert polygon_area(whole.point, up) == pytest.approx(2 * np.sqrt(2), rel=1e-12)
    assert polygon_area(four.point[order], up) == pytest.approx(2, rel=1e-12)


def test_a_limit_keeps_the_deepest_first():
    turn = rotations.to_matrix(
        rotations.from_rotation_vector(np.array([3e-3, 5e-3, 0]))
    )
    a = prism(regular(12), 0, 1).moved(turn, np.array([0, 0, -0.1]))
    b = box([0, 0, -1], [2, 2, 1])
    whole = touching(a, b)
    for limit in range(1, 13):
        few = touching(a, b, limit=limit)
        assert len(few) == limit
        deepest = few if limit < 12 else few[[int(np.argmin(few.separation))]]
        assert deepest.separation[0] == whole.separation.min()
        assert len({tuple(k) for k in few.key}) == limit


def test_an_edge_has_two_points_and_a_vertex_one():
    lean = rotations.to_matrix(
        rotations.from_rotation_vector(np.array([np.pi / 4, 0, 0]))
    )
    edge = OBB(np.zeros((1, 3)), lean[None], np.array([CUBE]))
    floor = box([0, 0, -0.5 * np.sqrt(2) - 0.9], [2, 2, 1])
    found = touching(edge, floor)
    assert found.feature.tolist() == ["face_b"] * 2
    np.testing.assert_allclose(np.sort(found.point_a[:, 0]), [-0.5, 0.5], atol=1e-15)
    axis = np.arccos(3**-0.5) * np.array([1, -1, 0]) / np.sqrt(2)
    upright = rotations.to_matrix(rotations.from_rotation_vector(axis))
    corner = OBB(np.zeros((1, 3)), upright[None], np.array([CUBE]))
    low = corner.support([0, 0, -1.0])[0]
    found = touching(corner, box([0, 0, low[2] - 0.9], [2, 2, 1]))
    assert found.feature.tolist() == ["face_b"]
    np.testing.assert_allclose(found.point_a[0], low, atol=1e-15)


def test_each_point_has_the_normal_and_the_separation_of_its_own_features():
    rng = np.random.default_rng(5)
    seen = set()
    for _ in range(150):
        turn, lean = rng.uniform(0, 7), 10.0 ** rng.uniform(-9, -2)
        tilt = rotations.to_matrix(
            rotations.from_rotation_vector(lean * rng.normal(size=3))
        )
        a = box([*rng.uniform(-0.6, 0.6, 2), 0.98], rng.uniform(0.3, 0.5, 3), turn)
        a, b = a.moved(tilt, np.zeros(3)), box([0, 0, 0], CUBE)
        contacts, solids = touching(a, b, margin=0.05), (polytopes(a), polytopes(b))
        for k in range(len(contacts)):
            parts = [
                feature(s, n) for s, n in zip(solids, contacts.key[k, 2:], strict=True)
            ]
            d, n = separation_and_normal(*parts, np.array([0, 0, 1.0]))
            if contacts.feature[k] != "edges" and parts[0][0] == parts[1][0]:
                continue  # edges that cross at no angle to speak of
            assert contacts.separation[k] == pytest.approx(d, abs=1e-14)
            np.testing.assert_allclose(contacts.normal[k], n, atol=1e-12)
            seen.add(contacts.feature[k])
    assert seen == {"face_a", "face_b", "edges"}


def sides_exchanged(contacts):
    """Rows that are the same however A and B are named, but for rounding."""
    return sorted(map(tuple, contacts.key[:, [1, 0, 3, 2]]))


def test_exchanging_a_and_b_exchanges_the_sides():
    rng = np.random.default_rng(8)
    n = 300
    turns = [
        rotations.to_matrix(q / np.linalg.norm(q, axis=1, keepdims=True))
        for q in rng.normal(size=(2, n, 4))
    ]
    a = OBB(rng.uniform(-0.6, 0.6, (n, 3)), turns[0], rng.uniform(0.2, 0.6, (n, 3)))
    b = OBB(np.zeros((n, 3)), turns[1], rng.uniform(0.2, 0.6, (n, 3)))
    one, other = touching(a, b, margin=0.1), touching(b, a, margin=0.1)
    assert len(one) == len(other) > 250
    back = {"face_a": "face_b", "face_b": "face_a"}
    for p in np.unique(one.pair):
        x, y = one[one.pair == p], other[other.pair == p]
        x, y = (
            x[np.lexsort(x.key[:, ::-1].T)],
            y[np.lexsort(y.key[:, [3, 2, 1, 0]][:, [1, 0, 2, 3]].T)],
        )
        np.testing.assert_array_equal(x.key[:, [2, 3]], y.key[:, [3, 2]])
        np.testing.assert_allclose(x.point, y.point, atol=1e-12)
        np.testing.assert_allclose(x.normal, -y.normal, atol=1e-12)
        np.testing.assert_allclose(x.separation, y.separation, atol=1e-13)
        assert x.feature.tolist() == [back.get(f, f) for f in y.feature]


#: A's centre, half extents and turn over a cube of side 1, and how many points are right.
STACKS = {
    "on itself": ([0, 0, 1], CUBE, 0, 4),
    "half over": ([0.5, 0, 1], CUBE, 0, 4),
    "a quarter over": ([0.5, 0.5, 1], CUBE, 0, 4),
    "edge on edge": ([1, 0, 1], CUBE, 0, 2),
    "half an edge": ([1, 0.5, 1], CUBE, 0, 2),
    "corner on corner": ([1, 1, 1], CUBE, 0, 1),
    "small in the corner": ([0.25, 0.25, 0.75], [0.25] * 3, 0, 4),
    "small at the side": ([0.25, 0, 0.75], [0.25] * 3, 0, 4),
    "large": ([0, 0, 1.5], [1, 1, 1], 0, 4),
    "large in the corner": ([0.5, 0.5, 1.5], [1, 1, 1], 0, 4),
    "across": ([0, 0, 1], [0.5, 1, 0.5], np.pi / 2, 4),
    "turned by 30 degrees": ([0, 0, 1], CUBE, np.pi / 6, 8),
    "turned by 45 degrees": ([0, 0, 1], CUBE, np.pi / 4, 8),
    "turned, its corners in the sides": ([0, 0, 1], [0.5**0.5 / 2] * 2 + [0.5], np.pi / 4, 4),
    "turned, corner on a side": ([0.5 + 0.5**0.5, 0, 1], CUBE, np.pi / 4, 1),
    "side on side": ([1, 0, 0], CUBE, 0, 4),
    "as deep along x as along z": ([0.9, 0, 0.9], CUBE, 0, 4),
    "as deep along all": ([0.9, 0.9, 0.9], CUBE, 0, 4),
}  # fmt: skip


@pytest.mark.parametrize("base", [np.eye(3), TURNED], ids=["upright", "askew"])
@pytest.mark.parametrize("name", STACKS)
def test_shaking_changes_no_key(name, base):
    center, half, turn, count = STACKS[name]
    frames, rng = 1000, np.random.default_rng(3)
    a, b = box(center, half, turn, base), box([0, 0, 0], CUBE, 0.0, base)

    def shaken(shape):
        jitter = rotations.to_matrix(
            rotations.from_rotation_vector(1e-9 * rng.normal(size=(frames, 3)))
        )
        centre = shape.center + 1e-9 * rng.normal(size=(frames, 3))
        return OBB(
            centre,
            jitter @ shape.rotation,
            np.broadcast_to(shape.half_extents, (frames, 3)),
        )

    a, b = shaken(a), shaken(b)
    contacts, exchanged = touching(a, b, margin=1e-7), touching(b, a, margin=1e-7)
    assert contacts.key.shape == (frames * count, 4)
    keys = contacts.key.reshape(frames, count, 4)
    assert (keys == keys[0]).all() and (keys[0, :, :2] == [10, 20]).all()
    again = exchanged.key.reshape(frames, count, 4)
    assert sorted(map(tuple, again[0][:, [3, 2]])) == sorted(map(tuple, keys[0][:, 2:]))
    assert np.isfinite(contacts.point).all()


@pytest.mark.parametrize("away", [0.0, 1e8])
@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_sizes_and_places(size, away):
    """A box of that size on one of size 1, far from the origin too."""
    far = away * np.array([1.0, -0.7, 0.3])
    rounding = 32 * np.spacing(max(abs(far).max(), 2 * size, 2.0))
    a = box(
        [0.1 * size, 0.05 * size, 0.5 + size],
        np.array([1, 0.8, 1]) * size,
        0.6,
        TURNED,
        far,
    )
    b = box([0, 0, 0], CUBE, 0, TURNED, far)
    contacts = touching(a, b, margin=1e-9 + rounding)
    assert np.abs(contacts.separation).max() <= 1e-9 + rounding
    assert np.isfinite(contacts.point).all() and len(contacts) >= 1
    apart = (
        contacts.point[:, None]
        - contacts.point[None]
        + np.eye(len(contacts))[:, :, None]
    )
    if away == 0.0 or size == 1e6:
        assert len(contacts) == 4
        assert np.linalg.norm(apart, axis=-1).min() > 1e-7 * min(size, 1.0)


@pytest.mark.parametrize(
    "half", [(0, 1, 1), (1, 1, 0), (0, 0, 1), (1, 0, 0), (0, 0, 0)]
)
def test_flat_boxes(half):
    """A rectangle, a segment or a point on a cube, in it and in one another."""
    a = box([0, 0, half[2] * 0.3 + 0.5], 0.3 * np.array(half), 0.2)
    for b in (box([0, 0, 0], CUBE), a):
        contacts = touching(a, b, margin=1e-9)
        assert 1 <= len(contacts) <= 4 and np.isfinite(contacts.normal).all()
        assert len({tuple(k) for k in contacts.key}) == len(contacts)


def test_spheres_and_capsules():
    ground = box([0, 0, -1], [2, 2, 1])
    ball = touching(
        Sphere(np.array([[0, 0, 0.1]]), np.array([0.1])), ground, margin=1e-9
    )
    assert ball.feature.tolist() == ["curved"]
    np.testing.assert_allclose(ball.curvature_a[0], np.diag([10, 10, 0]), atol=1e-12)
    assert not ball.curvature_b.any()
    lying = Capsule(
        np.array([[-1.0, 0, 0.1]]), np.array([[1.0, 0, 0.1]]), np.array([0.1])
    )
    two = touching(lying, ground, margin=1e-9)
    assert two.feature.tolist() == ["curved"] * 2
    np.testing.assert_allclose(np.sort(two.point[:, 0]), [-1, 1], atol=1e-15)
    overhanging = touching(
        lying.moved(np.eye(3), np.array([1.5, 0, 0])), ground, margin=1e-9
    )
    np.testing.assert_allclose(np.sort(overhanging.point[:, 0]), [0.5, 2], atol=1e-12)
    # At the border 1/r across the axis, and of the edge almost an infinite curvature.
    k = int(np.argmax(overhanging.point[:, 0]))
    np.testing.assert_allclose(
        overhanging.curvature_a[k], np.diag([0, 10, 0]), atol=1e-12
    )
    assert (
        overhanging.curvature_b[k, 0, 0] > 1e8 and overhanging.curvature_b[k, 1, 1] == 0
    )
    crossed = Capsule(
        np.array([[0.2, -1, 0.3]]), np.array([[0.2, 1, 0.3]]), np.array([0.1])
    )
    one = touching(crossed, lying, margin=1e-9)
    assert len(one) == 1
    np.testing.assert_allclose(one.point[0], [0.2, 0, 0.2], atol=1e-15)


def test_no_pair_and_no_contact_are_valid_answers():
    a, b = box([0, 0, 3], CUBE), box([0, 0, 0], CUBE)
    assert len(touching(a, b)) == 0
    assert len(touching(a[:0], b[:0])) == 0
