"""Time of impact of what turns: closed forms, and proofs by how fast a gap can change."""

from itertools import combinations_with_replacement

import numpy as np
import pytest
from campaigns import drawn_of
from overlap.drawn_shapes import DRAW
from overlap.moving_shapes import (
    STILL,
    drawn_pair,
    gaps,
    middle,
    speed_bound,
    stays_above,
)
from scipy.optimize import brentq

from course.overlap import time_of_impact
from course.overlap.moving.advancement import follow, inscribed
from course.shapes import (
    AABB,
    OBB,
    Capsule,
    Compound,
    ConvexHull,
    HalfSpace,
    Sphere,
    polytopes,
)

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

CUBE = AABB(-np.ones(3), np.ones(3))
Z = np.array([0, 0, 1.0])


def meets(a, b, *, horizon=10.0, velocity=STILL, **turning):
    return float(time_of_impact(a, b, velocity, STILL, horizon=horizon, **turning))


@pytest.mark.long
def test_a_rod_that_turns_about_its_end_meets_a_ball():
    """Where the ball's centre is as far from the rod as both radii: pi/2 - asin((r + s)/1)."""
    for r, s in ((0.0, 0.1), (0.05, 0.1), (1e-8, 1e-8), (1e-4, 0.0)):
        rod, ball = Capsule(STILL, (2.0, 0, 0), r), Sphere((0.0, 1, 0), s)
        found = meets(rod, ball, spin_a=Z, pivot_a=STILL)
        assert found == pytest.approx(np.pi / 2 - np.arcsin(r + s), abs=1e-12)
        found = meets(ball, rod, spin_b=-2 * Z, pivot_b=STILL)
        expected = (3 * np.pi / 2 - np.arcsin(r + s)) / 2
        assert found == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("turn", [Z, -3 * Z])
def test_the_corner_of_a_turning_cube_meets_a_wall(turn):
    """cos(theta) + sin(theta) = 1.25 at the first touch."""
    wall = AABB((1.25, -9, -9), (9, 9, 9))
    angle = brentq(lambda x: np.cos(x) + np.sin(x) - 1.25, 0, np.pi / 4, xtol=1e-15)
    for b in (
        wall,
        OBB((5.0, 0, 0), np.eye(3), (3.75, 9, 9)),
        HalfSpace((-1.0, 0, 0), -1.25),
    ):
        found = meets(CUBE, b, spin_a=turn)
        assert found == pytest.approx(angle / np.linalg.norm(turn), abs=1e-12)


def test_a_cube_next_to_a_wall_that_it_does_not_reach():
    for gap in 1e-1, 1e-3, 1e-5:
        wall = AABB((np.sqrt(2) + gap, -9, -9), (9, 9, 9))
        assert meets(CUBE, wall, spin_a=5 * Z) == np.inf
    deeper = AABB((np.sqrt(2) - 1e-5, -9, -9), (9, 9, 9))
    assert 0.15 < meets(CUBE, deeper, spin_a=5 * Z) < 0.16
    # Shallower than the tolerance: it may be missed, and this one is.
    assert meets(CUBE, deeper, spin_a=5 * Z, tolerance=1e-3) == np.inf


def test_a_wall_that_turns_meets_a_ball():
    """n(theta).x = r with n = (-sin, cos): sqrt(10) cos(theta + atan 3) = 1/2."""
    wall, ball = HalfSpace((0.0, 1, 0), 0.0), Sphere((3.0, 1, 0), 0.5)
    angle = np.arccos(0.5 / np.sqrt(10)) - np.arctan(3)
    found = meets(ball, wall, spin_b=0.1 * Z, pivot_b=STILL, horizon=20.0)
    assert found == pytest.approx(10 * angle, abs=1e-11)
    found = meets(wall, ball, spin_a=0.1 * Z, pivot_a=STILL, horizon=20.0)
    assert found == pytest.approx(10 * angle, abs=1e-11)


def test_what_rolls_or_slides_on_a_floor_does_not_meet_it():
    slab, floor = AABB((-9, -9, -2), (9, 9, -1)), HalfSpace(Z, -1.0)
    lying, x = Capsule((0, -1.0, 0), (0, 1.0, 0), 1.0), np.array([1.0, 0, 0])
    for b in slab, floor:
        assert meets(CUBE, b, spin_a=Z) == np.inf
        assert meets(CUBE, b, spin_a=Z, velocity=x) == np.inf
        assert meets(CUBE, b, spin_a=Z, velocity=x + 0.1 * Z) == np.inf
        assert meets(Sphere(STILL, 1.0), b, spin_a=(0, 1.0, 0), velocity=x) == np.inf
        assert meets(lying, b, spin_a=(0, 1.0, 0), velocity=x) == np.inf
        assert meets(CUBE, b, spin_a=Z, velocity=x - 1e-3 * Z) == 0.0
        assert meets(CUBE, b, spin_a=(0, 1.0, 0)) == 0.0


def test_a_box_that_tips_over_an_edge_lands_on_its_side():
    """The edge stays on the floor all the time; a quarter of a turn later the side is down."""
    for b in AABB((-9, -9, -2), (9, 9, -1)), HalfSpace(Z, -1.0):
        found = meets(CUBE, b, spin_a=(0, 1.0, 0), pivot_a=(1.0, 0, -1.0))
        assert found == pytest.approx(np.pi / 2, abs=1e-9)


def test_half_spaces_that_turn():
    floor, roof = HalfSpace(Z, 0.0), HalfSpace(-Z, -3.0)
    up = {"velocity": Z, "pivot_a": STILL}
    assert meets(floor, roof, spin_a=Z, **up) == pytest.approx(3.0, abs=1e-12)
    # Planes that do not stay parallel meet at once, far away.
    assert meets(floor, roof, spin_a=(0, 1.0, 0), **up) == 0.0
    both = {"spin_a": (1.0, 0, 0), "spin_b": (1.0, 0, 0), "pivot_b": STILL}
    # Alike they stay parallel, and 3 - t cos t apart: t cos t = 3 only after 4 pi/2.
    angle = brentq(lambda t: t * np.cos(t) - 3, 4.8, 6.2, xtol=1e-14)
    assert meets(floor, roof, **both, **up) == pytest.approx(angle, abs=1e-9)


def test_solids_without_thickness_are_not_passed():
    """Two rods of radius 0, a sheet and a rod: to the tolerance of 1e-6 of their size."""
    rod, post = (
        Capsule(STILL, (2.0, 0, 0), 0.0),
        Capsule((0, 1, -1.0), (0, 1, 1.0), 0.0),
    )
    found = meets(rod, post, spin_a=Z, pivot_a=STILL)
    assert found == pytest.approx(np.pi / 2, abs=5e-6)
    sheet = AABB((-3.0, 1, -1), (-0.1, 1, 1))
    found = meets(rod, sheet, spin_a=Z, pivot_a=STILL)
    assert found == pytest.approx(np.pi / 2 + np.arctan(0.1), abs=1e-5)


def test_the_pivot_is_the_middle_of_the_bounds_if_none_is_given():
    hull = ConvexHull(np.array([(0, 0, 0), (4, 0, 0), (0, 1, 0), (0, 0, 1.0)]))
    wall = AABB((-9.0, 2.0, -9), (9, 9, 9))
    found = meets(hull, wall, spin_a=Z)
    assert found == meets(hull, wall, spin_a=Z, pivot_a=(2.0, 0.5, 0.5))
    two = Compound((Sphere(STILL, 0.5), Sphere((4.0, 0, 0), 0.5)))
    found = meets(two, wall, spin_a=Z)
    assert found == pytest.approx(np.arcsin(1.5 / 2), abs=1e-12)


def test_a_body_that_turns_and_one_that_does_not_share_a_batch():
    spin = np.array([Z, STILL, Z])
    walls = AABB([(1.25, -9, -9), (2.5, -9, -9), (3.0, -9, -9)], np.full((3, 3), 9.0))
    velocity = np.array([STILL, (0.5, 0, 0), STILL])
    found = time_of_impact(CUBE, walls, velocity, STILL, horizon=9.0, spin_a=spin)
    assert found[0] == meets(CUBE, walls[0], spin_a=Z)
    assert found[1:].tolist() == [3.0, np.inf]


@pytest.mark.slow
def test_a_pair_that_takes_too_many_steps_is_said_to_meet_where_it_was_left():
    """Never silently missed: a corner that keeps passing a wall at 1e-5, for 800 turns."""
    wall = AABB((np.sqrt(2) + 1e-5, -9, -9), (9, 9, 9))
    found = meets(CUBE, wall, spin_a=10 * Z, horizon=500.0)
    assert 10 < found < 500


def turning_pair(kind_a, kind_b, rng, count):
    """Pairs that mostly meet, each turning about a pivot near its middle."""
    a, b, v, w = drawn_pair(kind_a, kind_b, rng, count)
    turning = {}
    for name, shape in ("a", a), ("b", b):
        spin = rng.normal(0, 1.5, (count, 3))
        turning[f"spin_{name}"] = 0 * spin if shape.kind == "half_space" else spin
        turning[f"pivot_{name}"] = middle(shape) + rng.normal(0, 0.3, (count, 3))
    return a, b, v, w, turning


def check_turning_pairs(kind_a, kind_b, seed, count):
    """Before the impact the gap is proved to be above minus the tolerance, there it is 0;
    without one it stays above that all the time."""
    rng, horizon = np.random.default_rng(seed), 2.5
    a, b, v, w, turning = turning_pair(kind_a, kind_b, rng, count)
    time = time_of_impact(a, b, v, w, horizon=horizon, tolerance=1e-5, **turning)
    back = {key[:-1] + "ba"[key[-1] == "b"]: x for key, x in turning.items()}
    swapped = time_of_impact(b, a, w, v, horizon=horizon, tolerance=1e-5, **back)
    np.testing.assert_allclose(swapped, time, rtol=1e-8, atol=1e-9)
    for i in range(count):
        motions = [
            (u[i], turning[f"spin_{x}"][i], turning[f"pivot_{x}"][i])
            for u, x in ((v, "a"), (w, "b"))
        ]
        pair, t = (a[i], b[i], *motions), time[i]
        if t == 0:
            assert gaps(*pair, [0.0])[0] <= 1e-9
            continue
        if t < np.inf:
            assert abs(gaps(*pair, [t])[0]) <= 1e-9
        if "half_space" in (kind_a, kind_b):
            every = gaps(*pair, np.linspace(0, min(t, horizon), 129)[:-1])
            assert every.min() > -1e-5
        else:
            assert stays_above(-1e-5, *pair, min(t * (1 - 1e-9), horizon))
    return time


BOUNDED = [kind for kind in DRAW if kind != "half_space"]
TURNING = [*combinations_with_replacement(BOUNDED, 2), *((k, "half_space") for k in BOUNDED)]  # fmt: skip


@pytest.mark.parametrize("kind_a, kind_b", TURNING)
def test_random_pairs_that_turn_meet_where_the_gap_closes(kind_a, kind_b):
    check_turning_pairs(kind_a, kind_b, 11, 2)


@pytest.mark.long
@pytest.mark.parametrize("kind_a, kind_b", TURNING)
def test_many_random_pairs_that_turn_meet_where_the_gap_closes(kind_a, kind_b):
    count = drawn_of(60, 12)
    time = check_turning_pairs(kind_a, kind_b, 12, count)
    assert count / 6 < np.sum((time > 0) & (time < np.inf))


def test_a_spin_of_almost_nothing_is_straight_motion():
    rng = np.random.default_rng(13)
    for kinds in ("obb", "obb"), ("capsule", "convex_hull"), ("sphere", "sphere"):
        a, b, v, w = drawn_pair(*kinds, rng, 20)
        straight = time_of_impact(a, b, v, w, horizon=4.0)
        almost = time_of_impact(a, b, v, w, horizon=4.0, spin_a=1e-12 * Z)
        np.testing.assert_allclose(almost, straight, rtol=1e-9)


def test_the_textbook_s_loop_comes_to_the_same_time_from_below():
    """``follow``, with the greatest speed there can be."""
    rng = np.random.default_rng(14)
    found = []
    while len(found) < 4:
        a, b, v, w, turning = turning_pair("obb", "capsule", rng, 1)
        t = time_of_impact(a, b, v, w, horizon=4.0, **turning)[0]
        if not 0 < t < np.inf:
            continue
        motions = [
            (u[0], turning[f"spin_{x}"][0], turning[f"pivot_{x}"][0])
            for u, x in ((v, "a"), (w, "b"))
        ]
        pair = (a[0], b[0], *motions)
        slow = follow(lambda t, p=pair: gaps(*p, [t])[0], speed_bound(*pair), 4.0, 1e-5, 500)  # fmt: skip
        found.append((slow, t))
    slow, time = np.array(found).T
    assert np.all(slow <= time) and np.all(slow > time - 1e-3)
    assert follow(lambda t: 1.0, 1.0, 5.0, 1e-3, 100) == np.inf
    assert follow(lambda t: 1.0, 1.0, 5.0, 1e-3, 3) == 3.0


def test_the_ball_inside_is_inside():
    cube = polytopes(CUBE)
    assert inscribed(cube) == pytest.approx([1.0])
    flat = polytopes(AABB((0, 0, 0.0), (1, 1, 0)))
    rod = polytopes(Capsule(STILL, Z, 0.5))
    assert inscribed(flat).tolist() == inscribed(rod).tolist() == [0.0]
