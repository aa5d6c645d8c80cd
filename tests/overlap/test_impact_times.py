"""Time of impact in straight motion: conventions, figures, every pair of kinds against what the gap proves."""

from itertools import combinations_with_replacement, product

import numpy as np
import pytest
from campaigns import drawn_of
from overlap.drawn_shapes import DRAW
from overlap.moving_shapes import STILL, at, drawn_pair, gaps, least_gap
from scipy.spatial.transform import Rotation

from course.overlap import overlaps, swept_bounds, time_of_impact
from course.shapes import (
    AABB,
    KDOP,
    OBB,
    Capsule,
    Compound,
    ConvexHull,
    HalfSpace,
    Sphere,
)

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)  # fmt: skip
#: Shapes that reach from -1 to 1 along x.
UNIT = {
    "sphere": Sphere(np.zeros(3), 1.0),
    "capsule": Capsule((0, -1.0, 0), (0, 1.0, 0), 1.0),
    "aabb": AABB(-np.ones(3), np.ones(3)),
    "obb": OBB(np.zeros(3), np.eye(3), np.ones(3)),
    "kdop": KDOP(np.eye(3), -np.ones(3), np.ones(3)),
    "convex_hull": ConvexHull(CORNERS),
    "compound": Compound((Sphere((0.2, 0, 0), 0.8), AABB((-1, -1.0, -1), (0, 1, 1)))),
    "half_space": HalfSpace((1.0, 0, 0), 1.0),
}
KINDS = list(UNIT)
each_pair = pytest.mark.parametrize("kind_a, kind_b", list(product(KINDS, repeat=2)))
X = np.array([1.0, 0, 0])
#: Spins about x, which move nothing of these shapes along x.
SPINS = [{}, {"spin_a": 2.0 * X, "spin_b": -3.0 * X, "pivot_a": STILL, "pivot_b": STILL}]  # fmt: skip


def side_by_side(kind_a, kind_b, distance):
    """A at the origin, B mirrored beyond it along x, its middle at the distance."""
    a, b = UNIT[kind_a], UNIT[kind_b]
    return a, b.moved(np.diag([-1.0, -1.0, 1.0]), distance * X)


@pytest.mark.parametrize("spins", SPINS, ids=["straight", "turning"])
@each_pair
def test_the_conventions_hold_for_every_pair_of_kinds(kind_a, kind_b, spins):
    def time(distance, velocity):
        a, b = side_by_side(kind_a, kind_b, distance)
        found = time_of_impact(a, b, velocity, 0.5 * X, horizon=4.0, **spins)
        assert found.shape == ()
        return found

    slow, fast = 0.5 * X, 2.5 * X
    assert time(2.0, fast) == 0.0  # touching, approaching
    assert time(2.0, fast + (0, 0.1, 0)) == 0.0
    assert time(2.0, -X) == np.inf  # touching, parting
    assert time(2.0, slow) == np.inf  # touching, at rest
    if "sphere" not in (kind_a, kind_b) and "compound" not in (kind_a, kind_b):
        assert time(2.0, slow + (0, 0.01, 0.02)) == np.inf  # touching, sliding
    assert time(1.5, -X) == time(1.5, slow) == time(1.5, fast) == 0.0  # penetrating
    assert time(3.0, fast) == pytest.approx(0.5, rel=1e-12)
    assert time(3.0, -X) == time(3.0, slow) == np.inf
    assert time(11.0, fast) == np.inf  # after the horizon


def test_published_figures():
    """Half extents 1 and 1, centres 10 apart, speed 2: 4 s. Spheres of radius .35 and .5,
    0.1 a step from x = -5: touching after 41.5 steps (libccd's spheresphere: hits from 42).
    Boxes (1, 2, 1) and (2, 1, 2) there: after 35 steps (its boxbox: 35 touches)."""
    boxes = [
        AABB(np.array(c) - 1.0, np.array(c) + 1.0) for c in ((0, 0, 0), (10, 0, 0))
    ]
    assert time_of_impact(*boxes, 2 * X, STILL, horizon=10.0) == 4.0
    ball, other = Sphere(-5 * X, 0.35), Sphere(STILL, 0.5)
    found = time_of_impact(ball, other, 0.1 * X, STILL, horizon=100.0)
    assert found == pytest.approx(41.5, rel=1e-14)
    box, second = np.array([0.5, 1, 0.5]), np.array([1, 0.5, 1.0])
    one = OBB(-5 * X, np.eye(3), box)
    for b in AABB(-second, second), OBB(STILL, np.eye(3), second):
        found = time_of_impact(one, b, 0.1 * X, STILL, horizon=100.0)
        assert found == pytest.approx(35.0, rel=1e-13)


def test_no_fast_thin_object_is_missed():
    """A bullet of 4 mm at 900 m/s and a wall of 10 cm within a sixtieth of a second; a
    sheet without thickness as well, for a bullet, a needle and a point."""
    wall = AABB((0.05, -5, -5), (0.15, 5, 5))
    sheet = AABB((0.05, -5, -5), (0.05, 5, 5))
    turn = Rotation.from_euler("z", 0.3).as_matrix()
    tips = {
        0.002: Sphere(STILL, 0.002),
        0.0: Sphere(STILL, 0.0),
        0.01: Capsule(-0.01 * X, 0.01 * X, 0.0),
        0.001: OBB(STILL, np.eye(3), (0.001, 0.0, 0.0)),
    }
    for reach, bullet in tips.items():
        for b in wall, sheet, wall.moved(np.eye(3), STILL):
            found = time_of_impact(bullet, b, 900 * X, STILL, horizon=1 / 60)
            assert found == pytest.approx((0.05 - reach) / 900, rel=1e-12)
        leaning = sheet.moved(turn, STILL)
        found = time_of_impact(bullet, leaning, 900 * X, STILL, horizon=1 / 60)
        assert 0 < found < 1e-3


def test_two_spheres_close_a_small_gap_exactly():
    gap = 10.0 ** -np.arange(0, 13)
    a, b = Sphere(STILL, 1.0), Sphere((2.0 + gap)[:, None] * X, 1.0)
    real_gap = b.center[:, 0] - 2.0
    found = time_of_impact(a, b, 3.0 * X, STILL, horizon=1.0)
    np.testing.assert_allclose(found, real_gap / 3.0, rtol=1e-13)


def test_those_that_graze_meet():
    """Solids are closed: where they only touch in passing, that is when they meet."""
    ball = Sphere((-3.0, 2.0, 0), 1.0)
    assert time_of_impact(ball, Sphere(STILL, 1.0), X, STILL, horizon=9.0) == 3.0
    box = AABB((-4.0, 1, 0), (-2, 2, 1))
    for b in UNIT["aabb"], UNIT["obb"], UNIT["convex_hull"]:
        assert time_of_impact(box, b, X, STILL, horizon=9.0) == 1.0
    higher = AABB((-4.0, 1 + 1e-9, 0), (-2, 2, 1))
    for b in UNIT["aabb"], UNIT["obb"], UNIT["convex_hull"]:
        assert time_of_impact(higher, b, X, STILL, horizon=9.0) == np.inf


@pytest.mark.parametrize("lean", [0.0, 0.4])
def test_a_box_that_slides_on_a_floor_does_not_meet_it(lean):
    turn = Rotation.from_euler("xyz", [lean, 2 * lean, 0.1]).as_matrix()
    down = turn @ (0, 0, -1.0)
    box = OBB(turn @ (0, 0, 0.3), turn, (0.1, 0.2, 0.3))
    slab = OBB(turn @ (0, 0, -1.0), turn, (5, 5, 1.0))
    floors = (
        slab,
        HalfSpace(-down, 0.0),
        ConvexHull(CORNERS * (5, 5, 1) @ turn.T + down),
    )
    for floor, along in product(floors, (turn[:, 0], turn @ (0.6, -0.8, 0))):
        assert time_of_impact(box, floor, along, STILL, horizon=3.0) == np.inf
        assert time_of_impact(box, floor, STILL, along, horizon=3.0) == np.inf
        assert time_of_impact(box, floor, along - 1e-3 * down, STILL, horizon=3.0) == np.inf  # fmt: skip
        assert time_of_impact(box, floor, along + 1e-3 * down, STILL, horizon=3.0) == 0.0  # fmt: skip


def test_boxes_that_touch_along_an_edge_part_if_one_axis_parts():
    a = UNIT["convex_hull"]
    for b in (
        ConvexHull(CORNERS + (2.0, 2, 0)),
        AABB((1.0, 1, -1), (3, 3, 1)),
        OBB((2.0, 2, 0), np.eye(3), np.ones(3)),
    ):
        assert time_of_impact(a, b, (1.0, -0.5, 0), STILL, horizon=9.0) == np.inf
        assert time_of_impact(a, b, (1.0, 0.5, 0), STILL, horizon=9.0) == 0.0


def prove(a, b, v, w, time, horizon):
    """The gap is 0 at the time and above it before; never at or below it if there is none."""
    for i in range(len(time)):
        one, other = a[i], b[i]
        if time[i] == 0:
            assert gaps(one, other, (v[i],), (w[i],), [0.0])[0] <= 1e-9
        elif time[i] < np.inf:
            before = [0.0, 0.9 * time[i], (1 - 1e-6) * time[i], time[i]]
            found = gaps(one, other, (v[i],), (w[i],), before)
            assert abs(found[-1]) <= 1e-9 and np.all(found[:-1] > 0)
        elif {one.kind, other.kind} & {"half_space", "compound"}:
            every = gaps(one, other, (v[i],), (w[i],), np.linspace(0, horizon, 65))
            assert every.min() > 0
        else:
            assert least_gap(one, other, v[i], w[i], horizon) > 0


def check_random_pairs(kind_a, kind_b, seed, count):
    rng = np.random.default_rng(seed)
    a, b, v, w = drawn_pair(kind_a, kind_b, rng, count)
    time = time_of_impact(a, b, v, w, horizon=2.5)
    if kind_a != "half_space" or kind_b != "half_space":
        prove(a, b, v, w, time, 2.5)
    swapped = time_of_impact(b, a, w, v, horizon=2.5)
    np.testing.assert_allclose(swapped, time, rtol=1e-9, atol=1e-12)
    return time


@pytest.mark.parametrize("kind_a, kind_b", list(combinations_with_replacement(DRAW, 2)))
def test_random_pairs_meet_where_the_gap_closes(kind_a, kind_b):
    check_random_pairs(kind_a, kind_b, 1, 4)


@pytest.mark.long
@pytest.mark.parametrize("kind_a, kind_b", list(combinations_with_replacement(DRAW, 2)))
def test_many_random_pairs_meet_where_the_gap_closes(kind_a, kind_b):
    count = drawn_of(300, 60)
    time = check_random_pairs(kind_a, kind_b, 2, count)
    if "half_space" not in (kind_a, kind_b):
        assert count / 5 < np.sum((time > 0) & (time < np.inf))
        assert np.any(time == np.inf)


@pytest.mark.parametrize(
    "kind_a, kind_b",
    [
        ("obb", "obb"),
        ("capsule", "convex_hull"),
        ("kdop", "kdop"),
        ("sphere", "sphere"),
        ("obb", "capsule"),
    ],
)
def test_the_time_is_the_same_however_it_is_looked_at(kind_a, kind_b):
    """Turned, shifted, seen from a moving place, in other units of length and time."""
    rng = np.random.default_rng(3)
    a, b, v, w = drawn_pair(kind_a, kind_b, rng, 20)
    time = time_of_impact(a, b, v, w, horizon=4.0)
    assert 5 < np.sum((time > 0) & (time < np.inf))

    def same(found, **tolerance):
        np.testing.assert_allclose(found, time, **tolerance)

    turn, shift = Rotation.from_rotvec([1.0, 2, 3]).as_matrix(), np.array([5.0, 6, 7])
    moved = [shape.moved(turn, shift) for shape in (a, b)]
    same(time_of_impact(*moved, v @ turn.T, w @ turn.T, horizon=4.0), rtol=1e-9)
    wind = np.array([10.0, -20, 30])
    same(time_of_impact(a, b, v + wind, w + wind, horizon=4.0), rtol=1e-9)
    same(time_of_impact(a, b, 8 * v, 8 * w, horizon=0.5) * 8, rtol=1e-12)
    far = [shape.moved(np.eye(3), np.array([1e8, -1e8, 1e8])) for shape in (a, b)]
    same(time_of_impact(*far, v, w, horizon=4.0), atol=2e-6)


def test_tiny_on_huge():
    for tiny in (
        Sphere(1e-3 * X, 1e-4),
        AABB(1e-3 * X - 1e-4, 1e-3 * X + 1e-4),
        OBB(1e-3 * X, np.eye(3), np.full(3, 1e-4)),
        Capsule(1e-3 * X, 1e-3 * X + (0, 1e-4, 0), 1e-4),
    ):
        for huge in (
            Sphere(-1e3 * X, 1e3),
            AABB((-1e3, -1e3, -1e3), (0, 1e3, 1e3)),
            OBB(-1e3 * X, np.eye(3), np.full(3, 1e3)),
            HalfSpace(X, 0.0),
        ):
            found = time_of_impact(tiny, huge, -X, STILL, horizon=1.0)
            assert found == pytest.approx(9e-4, abs=1e-11)


def test_parts_of_compounds_the_earliest_counts():
    parts = Sphere((1.0, 0, 0), 0.5), Sphere((-1.0, 0, 0), 0.5)
    pair = Compound(parts)
    ball = Sphere((5.0, 0, 0), 0.5)
    assert time_of_impact(pair, ball, X, STILL, horizon=9.0) == pytest.approx(3.0)
    slid = Compound((AABB((-1.0, -1, 0), (1, 1, 1)), Sphere((3.0, 0, 0.5), 0.25)))
    floor = AABB((-9.0, -9, -1), (9, 9, 0))
    post = Compound((floor, AABB((8.0, -1, 0), (9, 1, 1))))
    assert time_of_impact(slid, post, X, STILL, horizon=9.0) == 8 - 3.25


def test_batches_broadcast():
    balls = Sphere(np.array([[[4.0, 0, 0]], [[6.0, 0, 0]], [[8.0, 0, 0]]]), 1.0)
    speed = np.array([1.0, 2.0])[:, None] * X
    found = time_of_impact(Sphere(STILL, 1.0), balls, speed, STILL, horizon=[5.0, 2.0])
    assert found.tolist() == [[2.0, 1.0], [4.0, 2.0], [np.inf, np.inf]]
    boxes = AABB(np.zeros((0, 3)), np.ones((0, 3)))
    for b in UNIT["sphere"], UNIT["obb"], UNIT["aabb"], UNIT["half_space"]:
        for spin in None, X:
            args = dict(horizon=1.0, spin_a=spin)
            assert time_of_impact(boxes, b, X, X, **args).shape == (0,)


def test_an_endless_horizon_serves_straight_motion_alone():
    a, b = UNIT["sphere"], Sphere((1e6, 0, 0), 1.0)
    assert time_of_impact(a, b, X, STILL, horizon=np.inf) == 1e6 - 2
    assert time_of_impact(a, b, -X, STILL, horizon=np.inf) == np.inf
    with pytest.raises(ValueError, match="horizon: expected finite numbers"):
        time_of_impact(a, b, X, STILL, horizon=np.inf, spin_a=X)


@pytest.mark.parametrize(
    "change, said",
    [
        ({"horizon": -1.0}, "horizon: expected numbers at or above 0"),
        ({"velocity_a": [1.0, 2]}, "velocity_a: expected vectors"),
        ({"velocity_b": [1.0, 2, np.nan]}, "velocity_b: expected finite"),
        ({"velocity_b": [1.0, 2, 1e60]}, "velocity_b: expected numbers up to 1e"),
        ({"spin_a": [[1.0, 2], [2, 3]]}, "spin_a: expected vectors"),
        ({"spin_b": [np.inf, 0, 0]}, "spin_b: expected finite"),
        ({"pivot_b": [1.0]}, "pivot_b: expected vectors"),
        ({"tolerance": 0.0, "spin_a": X}, "tolerance: expected positive"),
        ({"b": HalfSpace(X, 0.0), "spin_b": X}, "pivot_b: expected what a half space"),
        ({"velocity_a": np.ones((3, 3)), "velocity_b": np.ones((2, 3))}, "velocity_b: expected a batch"),
    ],
)  # fmt: skip
def test_bad_arguments_are_named(change, said):
    arguments = {
        "a": UNIT["obb"],
        "b": UNIT["sphere"],
        "velocity_a": X,
        "velocity_b": X,
    }
    with pytest.raises(ValueError, match=said):
        time_of_impact(**{**arguments, "horizon": 1.0, **change})


@pytest.mark.parametrize("kind", list(DRAW))
def test_swept_bounds_hold_all_places_and_no_more(kind):
    rng = np.random.default_rng(5)
    shape, v = DRAW[kind](rng, 5), rng.normal(size=(5, 3))
    box = swept_bounds(shape, v, 2.0)
    for i in range(5):
        each = at(shape[i], np.linspace(0, 2, 9), v[i]).bounds()
        np.testing.assert_allclose(box.lower[i], each.lower.min(axis=0), rtol=1e-12)
        np.testing.assert_allclose(box.upper[i], each.upper.max(axis=0), rtol=1e-12)
    assert swept_bounds(shape, STILL, [[1.0], [2.0]]).batch == (2, 5)
    with pytest.raises(ValueError, match="horizon: expected finite"):
        swept_bounds(shape, STILL, np.inf)


def test_what_meets_overlaps_and_what_does_not_does_not():
    """With ``overlaps``, a hair before and after."""
    rng = np.random.default_rng(6)
    a, b, v, w = drawn_pair("obb", "obb", rng, 60)
    time = time_of_impact(a, b, v, w, horizon=4.0)
    meets = (time > 0) & (time < np.inf)
    turn = np.eye(3)
    for later, verdict in (-1e-7, False), (1e-7, True):
        t = np.where(meets, time + later, 0.0)[:, None]
        found = overlaps(a.moved(turn, v * t), b.moved(turn, w * t))
        # A corner that grazes may be out again: none of these is.
        assert np.all(found[meets] == verdict)
