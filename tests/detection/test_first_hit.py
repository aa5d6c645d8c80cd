"""Which bodies of a world meet first: closed forms, and dense sampling of all pairs."""

from itertools import combinations

import numpy as np
import pytest
from detection.worlds import drawn_world
from scipy.spatial.transform import Rotation

from course.detection import CollisionWorld
from course.detection.world.flights import first_root
from course.overlap import gap
from course.shapes import AABB, OBB, Compound, HalfSpace, Sphere

STILL = np.eye(3)


def test_a_ball_that_falls_meets_the_floor():
    """h = 5 m, radius 1: t = sqrt(2 (h - r)/g); thrown up first, v/g + sqrt((v/g)^2 + 2 (h - r)/g)."""
    world = CollisionWorld()
    ball = world.add(Sphere((0, 0, 5.0), 1.0), body=0)
    floor = world.add(HalfSpace((0, 0, 1.0), 0.0), body=1, fixed=True)
    gravity = np.array([0, 0, -9.81])
    found = world.first_hit(np.zeros(3), acceleration=gravity, horizon=3.0)
    assert found.time == pytest.approx(np.sqrt(8 / 9.81), rel=1e-8)
    assert found.handles.tolist() == [[ball, floor]] and found.bodies.tolist() == [[0, 1]]  # fmt: skip
    up = world.first_hit((0, 0, 6.0), acceleration=gravity, horizon=3.0)
    t = 6 / 9.81
    assert up.time == pytest.approx(t + np.sqrt(t**2 + 8 / 9.81), rel=1e-8)
    assert world.first_hit(np.zeros(3), acceleration=gravity, horizon=0.9).time == np.inf  # fmt: skip


def test_both_roots_in_one_step_are_not_lost():
    """x = 4 t - t^2 reaches 3 at t = 1 and is back there at t = 3: at the end of the horizon of 4 s
    the ball is where it began, and its way has gone through the wall."""
    world = CollisionWorld()
    world.add(Sphere((0.0, 0, 0), 1.0), body=0)
    world.add(AABB((4.0, -9, -9), (4.0, 9, 9)), body=1, fixed=True)
    fly = {"acceleration": (-2.0, 0, 0)}
    assert world.first_hit((4.0, 0, 0), **fly, horizon=4.0).time == pytest.approx(1.0, rel=1e-8)  # fmt: skip
    assert (
        world.first_hit((3.4, 0, 0), **fly, horizon=4.0).time == np.inf
    )  # turns at 2.89
    graze = world.first_hit((np.sqrt(12), 0, 0), **fly, horizon=4.0).time
    assert graze == pytest.approx(np.sqrt(3), abs=1e-3)


def test_what_lies_falls_no_further_and_what_is_thrown_up_comes_back():
    world = CollisionWorld()
    world.add(Sphere((0, 0, 1.0), 1.0), body=0)
    world.add(HalfSpace((0, 0, 1.0), 0.0), body=1, fixed=True)
    fall = {"acceleration": (0, 0, -10.0)}
    assert world.first_hit(np.zeros(3), **fall, horizon=1.0).time == 0.0
    assert world.first_hit((0, 0, -1.0), **fall, horizon=1.0).time == 0.0
    assert world.first_hit((0, 0, 5.0), **fall, horizon=2.0).time == pytest.approx(1.0, rel=1e-8)  # fmt: skip
    assert world.first_hit((0, 0, 5.0), **fall, horizon=0.9).time == np.inf
    assert world.first_hit((1.0, 0, 0), horizon=2.0).time == np.inf  # it slides


def test_two_that_fall_alike_meet_as_without_weight():
    world = CollisionWorld()
    world.add(Sphere([(0, 0, 0), (10.0, 0, 0)], 1.0), body=[0, 1])
    found = world.first_hit([(4.0, 0, 0), (0, 0, 0)], acceleration=(0, 0, -9.81), horizon=5.0)  # fmt: skip
    assert found.time == pytest.approx(2.0, rel=1e-14)


def test_a_bullet_goes_through_no_wall():
    world = CollisionWorld()
    world.add(Sphere((-5.0, 0, 0), 0.002), body=0)
    world.add(AABB((0.0, -5, -5), (0.001, 5, 5)), body=1, fixed=True)
    found = world.first_hit((900.0, 0, 0), acceleration=(0, 0, -9.81), horizon=1.0)
    assert found.time == pytest.approx((5 - 0.002) / 900, rel=1e-7)


def test_all_pairs_that_meet_at_once_are_told():
    world = CollisionWorld()
    x = np.array([-5.0, 0, 5])
    world.add(Sphere(x[:, None] * (1, 0, 0), 1.0), body=[0, 1, 2])
    found = world.first_hit([(1.0, 0, 0), (0, 0, 0), (-1.0, 0, 0)], horizon=9.0)
    assert found.time == pytest.approx(3.0) and found.handles.tolist() == [[0, 1], [1, 2]]  # fmt: skip
    world.remove(2)
    assert world.first_hit([(1.0, 0, 0), (0, 0, 0)], horizon=9.0).bodies.tolist() == [[0, 1]]  # fmt: skip


def test_a_turning_rod_sweeps_what_stands_beside_it():
    """Half 2 long, 1 rad/s about its middle: a ball of radius .1 at (0, 1.5, 0) is reached at 90 degrees,
    less the angle at which rod and ball touch; the rod is .1 thick."""
    world = CollisionWorld()
    rod = world.add(OBB(np.zeros(3), STILL, (2.0, 0.05, 0.05)), body=0)
    world.move(rod, STILL, (0, 0, 7.0))
    world.add(Sphere((0, 1.5, 7.0), 0.1), body=1)
    spin = [(0, 0, 1.0), (0, 0, 0)]
    expected = np.pi / 2 - np.arcsin(0.15 / 1.5)
    found = world.first_hit(np.zeros(3), spin=spin, horizon=2.0)
    assert found.time == pytest.approx(expected, abs=1e-5)
    lift = [(0, 0, 1e-3), (0, 0, 0)]
    found = world.first_hit(np.zeros(3), spin=spin, acceleration=lift, horizon=2.0)
    assert found.time == pytest.approx(expected, abs=1e-4)


def standing(told, at, v, omega, a, t):
    if told.fixed:
        return told.standing
    turn = Rotation.from_rotvec(omega * t).as_matrix()
    return told.shape.moved(turn, at + v * t + 0.5 * a * t * t)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_nothing_meets_before_and_the_pair_meets_then(seed):
    """A sparse world of all kinds, with spins in half of the cases: at 20 times before the hit no pair
    penetrates by more than the tolerance, and at the hit that pair touches."""
    rng = np.random.default_rng(seed)
    world, told = drawn_world(rng, count=1, planes=0)
    while True:
        at = rng.uniform(-6, 6, (len(told), 3))
        world.move(world.handles, STILL, at)
        if not len(world.contacts(margin=0.1)):
            break
    v, a = (
        rng.normal(0, 2, at.shape) - at,
        rng.normal(0, 8, at.shape),
    )  # toward the middle
    omega = rng.normal(0, 2, at.shape) * (seed % 2)
    found = world.first_hit(v, spin=omega, acceleration=a, horizon=2.0)
    assert found.time < np.inf

    def gaps(t):
        shapes = [standing(c, at[c.body], v[c.body], omega[c.body], a[c.body], t) for c in told.values()]  # fmt: skip
        pairs = combinations(range(len(shapes)), 2)
        return {(i, j): float(gap(shapes[i], shapes[j])) for i, j in pairs}

    for t in np.linspace(0, found.time, 20, endpoint=False):
        assert min(gaps(t).values()) > -1e-7
    assert abs(gaps(found.time)[tuple(found.handles[0])]) < 1e-5


def test_a_compound_flies_as_one():
    world = CollisionWorld()
    world.add(Compound((Sphere((0, 0, 0.0), 0.5), Sphere((3.0, 0, 0), 0.5))), body=0)
    world.add(Sphere((7.0, 0, 0), 0.5), body=1)
    assert world.first_hit([(1.0, 0, 0), (0, 0, 0)], horizon=9.0).time == 3.0


@pytest.mark.parametrize(
    "said, wrong",
    [
        ("velocity: expected shape", lambda w: w.first_hit(np.zeros((1, 3)), horizon=1.0)),
        ("velocity: expected finite", lambda w: w.first_hit((np.nan, 0, 0), horizon=1.0)),
        ("velocity: expected numbers up to", lambda w: w.first_hit((1e60, 0, 0), horizon=1.0)),
        ("acceleration: expected", lambda w: w.first_hit(np.zeros(3), acceleration=np.zeros(2), horizon=1.0)),
        ("spin: expected 0 of .*entry 2", lambda w: w.first_hit(np.zeros(3), spin=np.ones(3), horizon=1.0)),
        ("horizon: expected", lambda w: w.first_hit(np.zeros(3), horizon=-1.0)),
        ("horizon: expected finite", lambda w: w.first_hit(np.zeros(3), horizon=np.inf)),
    ],
)  # fmt: skip
def test_wrong_flights_are_refused_by_name(said, wrong):
    world = CollisionWorld()
    world.add(Sphere(np.zeros((2, 3)), 1.0), body=[0, 1])
    world.add(HalfSpace((0, 0, 1.0), -5.0), body=2)
    with pytest.raises(ValueError, match=said):
        wrong(world)


def test_nothing_meets_in_an_empty_world():
    found = CollisionWorld().first_hit(np.zeros(3), horizon=1.0)
    assert found.time == np.inf and found.handles.shape == found.bodies.shape == (0, 2)


def test_the_first_root_keeps_its_digits():
    """(h - 1)(h - 1e9)/1e9 and its likes; never below 0, none where there is none."""
    d = np.array([1.0, 1.0, 0.0, 1.0, 2.0, 1e-12])
    b = np.array([-1 - 1e-9, 1.0, 3.0, 0.0, -1.0, -1.0])
    c = np.array([1e-9, 1.0, -1.0, -1.0, 5.0, 0.0])
    expected = [1.0, np.inf, 3.0, 1.0, np.inf, 1e-12]
    np.testing.assert_allclose(first_root(d, b, c), expected, rtol=1e-12)
