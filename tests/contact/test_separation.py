"""d, d_dot, N_dot and d_ddot against motion that is integrated to 1e-13, its geometry in closed form at each moment."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.integrate import solve_ivp

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

EYE = np.eye(3)


def unit(x):
    return x / np.linalg.norm(x)


@dataclass
class Touch:
    """One contact as closed-form geometry finds it: where each surface is nearest, N, d, and the feature's data."""

    point_a: np.ndarray
    point_b: np.ndarray
    normal: np.ndarray
    feature: str
    data: dict

    @property
    def gap(self):
        return float((self.point_a - self.point_b) @ self.normal)

    def contacts(self):
        data = {name: value[None] for name, value in self.data.items()}
        return Contacts(np.array([0]), np.array([1]), 0.5 * (self.point_a + self.point_b)[None], self.normal[None],
                        np.array([self.gap]), np.array([self.feature]), **data)  # fmt: skip


def nearest_on_lines(p, d, q, e):
    """The points nearest to each other of the lines p + s d and q + t e."""
    s, t = np.linalg.lstsq(np.stack([d, -e], axis=1), q - p, rcond=None)[0]
    return p + s * d, q + t * e


def curved(centre_a, centre_b, r_a, r_b, k_a, k_b):
    """Round surfaces about two centres (of a ball, or nearest on a capsule's axis)."""
    n = unit(centre_a - centre_b)
    return Touch(
        centre_a - r_a * n, centre_b + r_b * n, n, "curved", {"curvature_a": k_a, "curvature_b": k_b}
    )


def ball(r):
    return EYE / r


def rod(r, axis):
    axis = unit(axis)
    return (EYE - np.outer(axis, axis)) / r


# Each takes the poses (x_A, R_A, x_B, R_B) and numbers drawn once; the body's own geometry turns with R.
def face_b(x_a, r_a, x_b, r_b, g):
    p, n = x_a + r_a @ g["corner"], r_b @ g["normal"]
    d = (p - x_b - r_b @ g["on_face"]) @ n
    return Touch(p, p - d * n, n, "face_b", {})


def face_a(x_a, r_a, x_b, r_b, g):
    p, n = x_b + r_b @ g["corner"], -r_a @ g["normal"]
    d = (x_a + r_a @ g["on_face"] - p) @ n
    return Touch(p + d * n, p, n, "face_a", {})


def edges(x_a, r_a, x_b, r_b, g):
    e_a, e_b = r_a @ g["edge_a"], r_b @ g["edge_b"]
    n = unit(np.cross(e_a, e_b)) * np.sign(g["normal"][0])
    p, q = nearest_on_lines(x_a + r_a @ g["corner"], e_a, x_b + r_b @ g["on_face"], e_b)
    return Touch(p, q, n, "edges", {"edge_a": e_a, "edge_b": e_b})


def sphere_plane(x_a, r_a, x_b, r_b, g):
    centre, n = x_a + r_a @ g["corner"], r_b @ g["normal"]
    foot = centre - ((centre - x_b - r_b @ g["on_face"]) @ n) * n
    zero = np.zeros((3, 3))
    return Touch(centre - 0.7 * n, foot, n, "curved", {"curvature_a": ball(0.7), "curvature_b": zero})


def plane_sphere(x_a, r_a, x_b, r_b, g):
    centre, n = x_b + r_b @ g["corner"], -r_a @ g["normal"]
    foot = centre - ((centre - x_a - r_a @ g["on_face"]) @ n) * n
    zero = np.zeros((3, 3))
    return Touch(foot, centre + 0.7 * n, n, "curved", {"curvature_a": zero, "curvature_b": ball(0.7)})


def sphere_sphere(x_a, r_a, x_b, r_b, g):
    return curved(x_a + r_a @ g["corner"], x_b + r_b @ g["on_face"], 0.7, 0.6, ball(0.7), ball(0.6))


def sphere_capsule(x_a, r_a, x_b, r_b, g):
    axis, start = r_b @ unit(g["edge_b"]), x_b + r_b @ g["on_face"]
    centre = x_a + r_a @ g["corner"]
    return curved(centre, start + ((centre - start) @ axis) * axis, 0.7, 0.6, ball(0.7), rod(0.6, axis))


def capsules(x_a, r_a, x_b, r_b, g):
    e_a, e_b = r_a @ g["edge_a"], r_b @ g["edge_b"]
    p, q = nearest_on_lines(x_a + r_a @ g["corner"], e_a, x_b + r_b @ g["on_face"], e_b)
    return curved(p, q, 0.7, 0.6, rod(0.7, e_a), rod(0.6, e_b))


def vertex_sphere(x_a, r_a, x_b, r_b, g):
    """A corner as the limit of a ball of radius 0."""
    return curved(x_a + r_a @ g["corner"], x_b + r_b @ g["on_face"], 0.0, 0.9, 1e12 * EYE, ball(0.9))


def vertex_capsule(x_a, r_a, x_b, r_b, g):
    touch = sphere_capsule(x_a, r_a, x_b, r_b, g)
    data = {"curvature_a": 1e12 * EYE, "curvature_b": touch.data["curvature_b"]}
    return Touch(touch.point_a + 0.7 * touch.normal, touch.point_b, touch.normal, "curved", data)


def ball_in_bowl(x_a, r_a, x_b, r_b, g):
    """A hollow of radius 2.5 has the curvature -1/2.5."""
    centre, bowl = x_a + r_a @ g["corner"], x_b + r_b @ g["on_face"]
    n = unit(bowl - centre)
    return Touch(
        centre - 0.3 * n, bowl - 2.5 * n, n, "curved", {"curvature_a": ball(0.3), "curvature_b": -EYE / 2.5}
    )


KINDS = [face_b, face_a, edges, sphere_plane, plane_sphere, sphere_sphere, sphere_capsule, capsules,
         vertex_sphere, vertex_capsule, ball_in_bowl]  # fmt: skip
SEEDS = (1, 2)


class Motion:
    """Two bodies that fly, turn and are pushed by changing forces; the contact's gap at t = 0 is chosen."""

    def __init__(self, kind, seed, gap=0.0):
        rng = np.random.default_rng([seed, KINDS.index(kind)])
        self.kind = kind
        self.numbers = {name: rng.normal(size=3) for name in ("corner", "on_face", "edge_a", "edge_b")}
        self.numbers["normal"] = unit(rng.normal(size=3))
        self.mass = rng.uniform(0.5, 3, 2)
        root = rng.normal(size=(2, 3, 3))
        self.inertia = root @ np.swapaxes(root, 1, 2) + np.eye(3)
        position = rng.normal(size=(2, 3))
        quaternion = np.array([unit(q) for q in rng.normal(size=(2, 4))])
        self.push = rng.normal(size=(2, 4, 3))  # force and torque, constant and rate
        momenta = 0.3 * rng.normal(size=(4, 3))  # slow enough that differences over 5e-6 s are good to 1e-9
        self.start = np.concatenate([x.ravel() for x in (position, quaternion, momenta)])
        touch = self.touch(self.start)
        position[0] += (gap - touch.gap) * touch.normal
        self.start[:6] = position.ravel()

    def wrench(self, t):
        return self.push[:, 0] + t * self.push[:, 1], self.push[:, 2] + t * self.push[:, 3]

    def bodies(self, state):
        x, q, p, spin = np.split(state, [6, 14, 20])
        q = q.reshape(2, 4)
        q = q / np.linalg.norm(q, axis=1, keepdims=True)
        shaped = (x.reshape(2, 3), q, p.reshape(2, 3), spin.reshape(2, 3))
        return Bodies(self.mass, self.inertia, *shaped)

    def touch(self, state):
        bodies = self.bodies(state)
        r = rotations.to_matrix(bodies.orientation)
        return self.kind(bodies.position[0], r[0], bodies.position[1], r[1], self.numbers)

    def rate(self, t, state):
        bodies = self.bodies(state)
        force, torque = self.wrench(t)
        w, q = bodies.angular_velocity, state[6:14].reshape(2, 4)
        q_dot = 0.5 * np.concatenate(
            [w * q[:, 3:] + np.cross(w, q[:, :3]), -np.sum(w * q[:, :3], axis=1, keepdims=True)], axis=1
        )
        return np.concatenate([x.ravel() for x in (bodies.velocity, q_dot, force, torque)])

    def at(self, t):
        if t == 0:
            return self.start
        run = solve_ivp(self.rate, (0, t), self.start, method="DOP853", rtol=1e-13, atol=1e-15)
        assert run.success
        return run.y[:, -1]

    def acceleration(self):
        return separation_acceleration(
            self.bodies(self.start), self.touch(self.start).contacts(), *self.wrench(0)
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
    h = 5e-6
    central = (motion.rate_at(h) - motion.rate_at(-h)) / (2 * h)
    assert abs(central - motion.acceleration()) < 1e-9


@by_kind_seed_gap
def test_acceleration_is_the_second_difference_of_the_gap(kind, seed, gap):
    motion = Motion(kind, seed, gap)
    h = 1e-3
    d = [motion.touch(motion.at(k * h)).gap for k in (-2, -1, 0, 1, 2)]
    five = (-d[0] + 16 * d[1] - 30 * d[2] + 16 * d[3] - d[4]) / (12 * h * h)
    assert abs(five - motion.acceleration()) < 1e-8


@by_kind_seed_gap
def test_rates_of_gap_and_normal(kind, seed, gap):
    motion, h = Motion(kind, seed, gap), 1e-5
    before, after = (motion.touch(motion.at(t)) for t in (-h, h))
    contacts = motion.touch(motion.start).contacts()
    bodies = motion.bodies(motion.start)
    assert abs(separation_rate(bodies, contacts)[0] - (after.gap - before.gap) / (2 * h)) < 1e-8
    turning = normal_rate(bodies, contacts)[0]
    np.testing.assert_allclose(turning, (after.normal - before.normal) / (2 * h), rtol=0, atol=1e-8)
    assert abs(turning @ contacts.normal[0]) < 1e-13


def test_error_of_differences_is_a_v_over_the_step():
    """Truncation falls as h^2 (central) and h^4 (five points); rounding rises as 1/h and 1/h^2 below that."""
    motion = Motion(sphere_sphere, 1)
    exact = motion.acceleration()
    steps = 10.0 ** np.arange(-6.5, -0.9, 0.5)
    central = np.array([abs((motion.rate_at(h) - motion.rate_at(-h)) / (2 * h) - exact) for h in steps])
    least = int(np.argmin(central))
    assert 0 < least < len(steps) - 1
    assert central[least] < 1e-9
    assert central[0] > 3 * central[least] and central[-1] > 1e4 * central[least]
    slope = np.polyfit(np.log(steps[-3:]), np.log(central[-3:]), 1)[0]
    assert slope == pytest.approx(2, abs=0.3)


def test_printed_formula_fails_on_a_dome():
    """Particle on a fixed sphere, N turning with the radius: misprint 8 counts 2 v^2/R, the truth is v^2/R."""
    radius, theta, speed = 2.0, 0.4, 1.3
    out = np.array([np.sin(theta), 0, np.cos(theta)])
    along = np.array([np.cos(theta), 0, -np.sin(theta)])
    centres, velocities = [(radius + 1e-3) * out, np.zeros(3)], [speed * along, np.zeros(3)]
    bodies = Bodies.balls([1.0, np.inf], [1e-3, radius], centres, velocities)
    k = np.stack([EYE / 1e-3, EYE / radius])[:, None]
    contacts = Contacts(np.array([0]), np.array([1]), (radius * out)[None], out[None], np.zeros(1),
                        np.array(["curved"]), curvature_a=k[0], curvature_b=k[1])  # fmt: skip
    gravity = np.array([[0, 0, -9.81], [0, 0, 0]])
    d_ddot = separation_acceleration(bodies, contacts, gravity, np.zeros((2, 3)))[0]
    assert d_ddot == pytest.approx(speed**2 / (radius + 1e-3) - 9.81 * np.cos(theta), abs=1e-12)


def test_leaves_the_sphere_at_two_thirds():
    """A particle from rest at theta_0 leaves where d_ddot without a force turns positive: cos = 2/3 cos theta_0."""
    theta_0, r, radius = 0.3, 1e-9, 1.0

    def free(theta):
        speed = np.sqrt(2 * 9.81 * (radius + r) * (np.cos(theta_0) - np.cos(theta)))
        out, along = np.array([np.sin(theta), 0, np.cos(theta)]), np.array([np.cos(theta), 0, -np.sin(theta)])
        centres, velocities = [(radius + r) * out, np.zeros(3)], [speed * along, np.zeros(3)]
        bodies = Bodies.balls([1.0, np.inf], [r, radius], centres, velocities)
        contacts = Contacts(np.array([0]), np.array([1]), (radius * out)[None], out[None], np.zeros(1),
                            np.array(["curved"]), None, None, EYE[None] / r, EYE[None] / radius)  # fmt: skip
        return separation_acceleration(bodies, contacts, [[0, 0, -9.81], [0, 0, 0]], np.zeros((2, 3)))[0]

    lower, upper = theta_0, np.pi / 2
    for _ in range(60):
        middle = 0.5 * (lower + upper)
        lower, upper = (middle, upper) if free(middle) < 0 else (lower, middle)
    assert np.cos(lower) == pytest.approx(2 / 3 * np.cos(theta_0), abs=1e-9)


def test_terms_add_up_and_only_two_depend_on_the_wrench():
    motion = Motion(capsules, 2, 0.05)
    bodies, contacts = motion.bodies(motion.start), motion.touch(motion.start).contacts()
    loaded = separation_acceleration_terms(bodies, contacts, *motion.wrench(0))
    free = separation_acceleration_terms(bodies, contacts, np.zeros((2, 3)), np.zeros((2, 3)))
    assert [name for name in loaded if loaded[name] != free[name]] == ["force", "torque"]
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
    for spin in ([0, 0, 0], [2.0, 0, 0], [0, 0, 3.0]):  # still, rolling, turning about the vertical
        assert separation_acceleration(bodies(spin), contacts, zero, zero)[0] == pytest.approx(0, abs=1e-14)
    with pytest.raises(ValueError, match="two ends"):
        separation_acceleration(bodies([0, 1.0, 0]), contacts, zero, zero)


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
