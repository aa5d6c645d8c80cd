"""d, d_dot, N_dot and d_ddot against motion that is integrated to 1e-13, its geometry in closed form at each moment."""

import numpy as np
import pytest
from contact.moving_geometry import (
    EYE,
    KINDS,
    Flight,
    ball_in_bowl,
    capsules,
    draw_numbers,
    edges,
    rod,
    sphere_sphere,
)

from course import rotations
from course.contact import (
    normal_rate,
    resting,
    separation,
    separation_acceleration,
    separation_acceleration_terms,
    separation_rate,
)
from course.dynamics import Bodies
from course.overlap import Contacts

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

SEEDS = (1, pytest.param(2, marks=pytest.mark.slow))


class Motion:
    """Two flying bodies with one contact; its gap at t = 0 is chosen."""

    def __init__(self, kind, seed, gap=0.0):
        rng = np.random.default_rng([seed, KINDS.index(kind)])
        self.kind, self.numbers, self.flight = kind, draw_numbers(rng), Flight(rng, 2)
        self.bodies, self.wrench, self.at, self.start = (
            getattr(self.flight, name) for name in ("bodies", "wrench", "at", "start")
        )
        touch = self.touch(self.start)
        self.start[:3] += (gap - touch.gap) * touch.normal

    def touch(self, state):
        return self.flight.touch(self.kind, self.numbers, state)

    def acceleration(self):
        contacts = self.touch(self.start).contacts()
        return separation_acceleration(
            self.bodies(self.start), contacts, *self.wrench(0)
        )[0]

    def rate_at(self, t):
        state = self.at(t)
        return separation_rate(self.bodies(state), self.touch(state).contacts())[0]


def by_kind_seed_gap(test):
    test = pytest.mark.parametrize("kind", KINDS, ids=lambda k: k.__name__)(test)
    test = pytest.mark.parametrize("seed", SEEDS)(test)
    return pytest.mark.parametrize("gap", [0.0, 0.05, -0.02])(test)


@by_kind_seed_gap
def test_acceleration_is_the_rate_of_the_rate(kind, seed, gap):
    motion = Motion(kind, seed, gap)
    assert abs(motion.touch(motion.start).gap - gap) < 1e-14
    # The smaller step for the seeds in which the gap changes fast: the error of these differences grows as h^2.
    central = [
        (motion.rate_at(h) - motion.rate_at(-h)) / (2 * h) for h in (5e-6, 1.5e-6)
    ]
    assert min(np.abs(np.array(central) - motion.acceleration())) < 1e-9


@by_kind_seed_gap
def test_acceleration_is_the_second_difference_of_the_gap(kind, seed, gap):
    motion = Motion(kind, seed, gap)
    errors = []
    for h in (1e-3, 5e-4):
        d = [motion.touch(motion.at(k * h)).gap for k in (-2, -1, 0, 1, 2)]
        five = (-d[0] + 16 * d[1] - 30 * d[2] + 16 * d[3] - d[4]) / (12 * h * h)
        errors.append(abs(five - motion.acceleration()))
    assert min(errors) < 1e-8


@by_kind_seed_gap
def test_rates_of_gap_and_normal(kind, seed, gap):
    motion, h = Motion(kind, seed, gap), 1e-5
    before, after = (motion.touch(motion.at(t)) for t in (-h, h))
    contacts = motion.touch(motion.start).contacts()
    bodies = motion.bodies(motion.start)
    assert (
        abs(separation_rate(bodies, contacts)[0] - (after.gap - before.gap) / (2 * h))
        < 1e-8
    )
    turning = normal_rate(bodies, contacts)[0]
    np.testing.assert_allclose(
        turning, (after.normal - before.normal) / (2 * h), rtol=0, atol=1e-8
    )
    assert abs(turning @ contacts.normal[0]) < 1e-13


def test_error_of_differences_is_a_v_over_the_step():
    """Truncation grows as h^2 (central, of d_dot) and h^4 (five points, of d), rounding as 1/h and 1/h^2."""
    motion = Motion(sphere_sphere, 1)
    exact = motion.acceleration()
    steps = 10.0 ** np.arange(-8, -0.9, 0.5)
    central = [
        abs((motion.rate_at(h) - motion.rate_at(-h)) / (2 * h) - exact) for h in steps
    ]
    d = np.array(
        [[motion.touch(motion.at(k * h)).gap for k in (-2, -1, 0, 1, 2)] for h in steps]
    )
    five = np.abs(d @ [-1, 16, -30, 16, -1] / (12 * steps**2) - exact)
    for error, order, best in ((np.array(central), 2, 1e-9), (five, 4, 1e-9)):
        least = int(np.argmin(error))
        assert 0 < least < len(steps) - 1 and error[least] < best
        assert error[0] > 10 * error[least] and error[-1] > 100 * error[least]
        slope = np.polyfit(np.log(steps[-3:]), np.log(error[-3:]), 1)[0]
        assert abs(slope - order) < 0.3


def test_printed_formula_fails_on_a_dome():
    """Particle on a fixed sphere, N turning with the radius: misprint 8 counts 2 v^2/R, the truth is v^2/R."""
    radius, theta, speed = 2.0, 0.4, 1.3
    out = np.array([np.sin(theta), 0, np.cos(theta)])
    along = np.array([np.cos(theta), 0, -np.sin(theta)])
    centres, velocities = (
        [(radius + 1e-3) * out, np.zeros(3)],
        [speed * along, np.zeros(3)],
    )
    bodies = Bodies.balls([1.0, np.inf], [1e-3, radius], centres, velocities)
    k = np.stack([EYE / 1e-3, EYE / radius])[:, None]
    contacts = Contacts(np.array([0]), np.array([1]), (radius * out)[None], out[None], np.zeros(1),
                        np.array(["curved"]), curvature_a=k[0], curvature_b=k[1])  # fmt: skip
    gravity = np.array([[0, 0, -9.81], [0, 0, 0]])
    d_ddot = separation_acceleration(bodies, contacts, gravity, np.zeros((2, 3)))[0]
    assert d_ddot == pytest.approx(
        speed**2 / (radius + 1e-3) - 9.81 * np.cos(theta), abs=1e-12
    )


def test_leaves_the_sphere_at_two_thirds():
    """A particle from rest at theta_0 leaves where d_ddot without a force turns positive: cos = 2/3 cos theta_0."""
    theta_0, r, radius = 0.3, 1e-9, 1.0

    def free(theta):
        speed = np.sqrt(2 * 9.81 * (radius + r) * (np.cos(theta_0) - np.cos(theta)))
        out, along = (
            np.array([np.sin(theta), 0, np.cos(theta)]),
            np.array([np.cos(theta), 0, -np.sin(theta)]),
        )
        centres, velocities = (
            [(radius + r) * out, np.zeros(3)],
            [speed * along, np.zeros(3)],
        )
        bodies = Bodies.balls([1.0, np.inf], [r, radius], centres, velocities)
        contacts = Contacts(np.array([0]), np.array([1]), (radius * out)[None], out[None], np.zeros(1),
                            np.array(["curved"]), None, None, EYE[None] / r, EYE[None] / radius)  # fmt: skip
        return separation_acceleration(
            bodies, contacts, [[0, 0, -9.81], [0, 0, 0]], np.zeros((2, 3))
        )[0]

    lower, upper = theta_0, np.pi / 2
    for _ in range(60):
        middle = 0.5 * (lower + upper)
        lower, upper = (middle, upper) if free(middle) < 0 else (lower, middle)
    assert np.cos(lower) == pytest.approx(2 / 3 * np.cos(theta_0), abs=1e-9)


def test_terms_add_up_and_only_two_depend_on_the_wrench():
    motion = Motion(capsules, 2, 0.05)
    bodies, contacts = (
        motion.bodies(motion.start),
        motion.touch(motion.start).contacts(),
    )
    loaded = separation_acceleration_terms(bodies, contacts, *motion.wrench(0))
    free = separation_acceleration_terms(
        bodies, contacts, np.zeros((2, 3)), np.zeros((2, 3))
    )
    assert [name for name in loaded if loaded[name] != free[name]] == [
        "force",
        "torque",
    ]
    assert free["force"] == 0 and free["torque"] == 0
    assert sum(loaded.values())[0] == pytest.approx(motion.acceleration(), rel=1e-15)


def test_a_capsule_may_lie_on_a_plane_but_not_tip():
    k_a, k_b = rod(0.3, np.array([1.0, 0, 0])), np.zeros((3, 3))
    contacts = Contacts(np.array([0]), np.array([1]), np.array([[0, 0, 0.0]]), np.array([[0, 0, 1.0]]), np.zeros(1),
                        np.array(["curved"]), curvature_a=k_a[None], curvature_b=k_b[None])  # fmt: skip

    def bodies(spin):
        return Bodies([1.0, np.inf], np.stack([EYE, EYE]), [[0, 0, 0.3], [0, 0, -1.0]], rotations.identity(2),
                      np.zeros((2, 3)), [spin, [0, 0, 0]])  # fmt: skip

    zero = np.zeros((2, 3))
    for spin in (
        [0, 0, 0],
        [2.0, 0, 0],
        [0, 0, 3.0],
    ):  # still, rolling, turning about the vertical
        assert separation_acceleration(bodies(spin), contacts, zero, zero)[
            0
        ] == pytest.approx(0, abs=1e-14)
    with pytest.raises(ValueError, match="two ends"):
        separation_acceleration(bodies([0, 1.0, 0]), contacts, zero, zero)


def test_parallel_capsules_may_roll_and_turn_but_not_tip():
    """TRUTHS: K_A + K_B is singular along their common line; crossed ones have an answer for every spin."""

    def d_ddot(spin, axis_b):
        bodies = Bodies([1.0, np.inf], np.stack([EYE, EYE]), [[0, 0, 0.3], [0, 0, -0.4]], rotations.identity(2),
                        np.zeros((2, 3)), [spin, [0, 0, 0]])  # fmt: skip
        k_a, k_b = rod(0.3, np.array([1.0, 0, 0])), rod(0.4, np.array(axis_b))
        contacts = Contacts(np.array([0]), np.array([1]), np.zeros((1, 3)), np.array([[0, 0, 1.0]]), np.zeros(1),
                            np.array(["curved"]), curvature_a=k_a[None], curvature_b=k_b[None])  # fmt: skip
        return separation_acceleration(
            bodies, contacts, np.zeros((2, 3)), np.zeros((2, 3))
        )[0]

    for spin in ([0, 0, 0], [2.0, 0, 0], [0, 0, 3.0]):
        assert d_ddot(spin, [1.0, 0, 0]) == pytest.approx(0, abs=1e-14)
    with pytest.raises(ValueError, match="parallel"):
        d_ddot([0, 1.0, 0], [1.0, 0, 0])
    # Crossed, A tips over B by theta = 1 rad/s t: the axes are .7 cos(theta) apart, so d_ddot = -.7.
    assert d_ddot([0, 1.0, 0], [0, 1.0, 0]) == pytest.approx(-0.7, abs=1e-14)


def test_refusals():
    motion = Motion(edges, 1)
    bodies, touch = motion.bodies(motion.start), motion.touch(motion.start)
    touch.data["edge_b"] = touch.data["edge_a"]
    with pytest.raises(ValueError, match="edge_a.*parallel"):
        normal_rate(bodies, touch.contacts())
    touch = motion.touch(motion.start)
    touch.data["edge_b"] = touch.data["edge_b"] + 0.1 * touch.normal
    with pytest.raises(ValueError, match="contacts.normal.*perpendicular"):
        normal_rate(bodies, touch.contacts())
    contacts = motion.touch(motion.start).contacts()
    with pytest.raises(ValueError, match="force"):
        separation_acceleration(bodies, contacts, np.zeros(3), np.zeros((2, 3)))
    with pytest.raises(ValueError, match="contacts.body_b"):
        separation_rate(Bodies.balls(1.0, 1.0, np.zeros((1, 3))), contacts)
    with pytest.raises(ValueError, match="rate_tolerance"):
        resting(bodies, contacts, rate_tolerance=-1.0)
    bowl = Motion(ball_in_bowl, 1)
    touch = bowl.touch(bowl.start)
    touch.data["curvature_a"] = EYE / 5
    with pytest.raises(ValueError, match="one point"):
        normal_rate(bowl.bodies(bowl.start), touch.contacts())
    deep = Motion(sphere_sphere, 1, gap=-0.8)
    with pytest.raises(ValueError, match="radius of curvature"):
        deep.acceleration()


def test_separation_signs_and_batches():
    n = np.array([0, 0, 1.0])
    assert separation([0, 0, 3.0], [0, 5, 1.0], n) == 2
    assert separation([0, 0, 1.0], [0, 5, 3.0], n) == -2
    assert separation(np.zeros((4, 1, 3)), np.ones((5, 3)), n).shape == (4, 5)
    with pytest.raises(ValueError, match="normal"):
        separation(np.zeros(3), np.zeros(3), 2 * n)


def test_resting_is_a_mask_of_the_rate():
    bodies = Bodies.balls([1.0, 1, 1, 1], 0.5, [[0, 0, 0.5], [2, 0, 0.5], [4, 0, 0.5], [0, 0, -9]],
                          [[1, 0, 0], [0, 0, 1e-5], [0, 0, -1e-5], [0, 0, 0]])  # fmt: skip
    below, up = bodies.position[:3] * [1, 1, 0], np.tile([0, 0, 1.0], (3, 1))
    contacts = Contacts(np.arange(3), np.full(3, 3), below, up, np.zeros(3))
    assert resting(bodies, contacts).tolist() == [True, False, False]
    assert resting(bodies, contacts, rate_tolerance=1e-4).all()
