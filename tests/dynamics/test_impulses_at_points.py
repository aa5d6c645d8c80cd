"""Impulses at the contacts of bodies that turn: the closed form of a rod, and what must be kept."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from course.dynamics import (
    Bodies,
    apply_impulse,
    effective_mass,
    impulse_at_point,
    normal_velocity,
    point_velocity,
)
from course.overlap import Contacts

X = [1.0, 0.0, 0.0]


def rod(angle, mass=1.5, length=2.0, speed=3.0):
    """A rod falling on the end that points down, at an angle from the horizontal, and that contact."""
    axis = np.array([np.cos(angle), 0.0, -np.sin(angle)])
    inertia = mass * length**2 / 12 * (np.eye(3) - 0.999999 * np.outer(axis, axis))
    end = 0.5 * length * axis
    bodies = Bodies(
        [mass, np.inf],
        [inertia, np.eye(3)],
        np.zeros((2, 3)),
        [[0, 0, 0, 1]] * 2,
        [[0, 0, -mass * speed], [0, 0, 0]],
        np.zeros((2, 3)),
    )
    return bodies, Contacts([0], [1], [end], [[0, 0, 1.0]], [0.0])


@pytest.mark.parametrize("angle", [0.0, 0.4, 1.0, np.pi / 2])
@pytest.mark.parametrize("e", [0.0, 0.7, 1.0])
def test_rod_hit_at_its_end(angle, e):
    bodies, contacts = rod(angle)
    # j = (1 + e) m v / (1 + 3 cos^2 theta): the rod about its centre has I = m L^2/12.
    expected = (1 + e) * 1.5 * 3.0 / (1 + 3 * np.cos(angle) ** 2)
    assert impulse_at_point(bodies, contacts, e)[0] == pytest.approx(expected, rel=1e-5)
    after = apply_impulse(bodies, contacts, impulse_at_point(bodies, contacts, e))
    assert normal_velocity(after, contacts)[0] == pytest.approx(3 * e, abs=1e-14)
    assert not after.momentum[1].any() and not after.angular_momentum[1].any()


def spinning(seed, n=40, fixed=0.2):
    rng = np.random.default_rng(seed)
    mass = 10 ** rng.uniform(-1, 1, 2 * n)
    mass[n:][rng.random(n) < fixed] = np.inf
    moving = np.isfinite(mass)[:, None]
    inertia = np.array([np.diag(rng.uniform(1, 1.9, 3)) for _ in mass])
    q = Rotation.random(2 * n, random_state=rng).as_quat()
    p, angular = rng.normal(size=(2, 2 * n, 3)) * moving
    bodies = Bodies(mass, inertia, rng.normal(size=(2 * n, 3)), q, p, angular)
    normal = rng.normal(size=(n, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return bodies, Contacts(
        np.arange(n), np.arange(n) + n, rng.normal(size=(n, 3)), normal, np.zeros(n)
    )


@pytest.mark.parametrize("seed", [7, 8])
def test_impulse_at_point_keeps_what_it_must(seed):
    bodies, contacts = spinning(seed)
    e = np.random.default_rng(seed).random(len(contacts))
    u = normal_velocity(bodies, contacts)
    p_hat = impulse_at_point(bodies, contacts, e)
    after = apply_impulse(bodies, contacts, p_hat)
    assert np.all(p_hat[u >= 0] == 0) and np.all(p_hat[u < 0] > 0)
    assert np.allclose(
        normal_velocity(after, contacts), np.where(u < 0, -e * u, u), atol=1e-13
    )

    def energy(b):
        return 0.5 * np.sum(b.momentum * b.velocity, axis=1) + 0.5 * np.sum(
            b.angular_momentum * b.angular_velocity, axis=1
        )

    n = len(contacts)
    change = (energy(after) - energy(bodies)).reshape(2, n).sum(axis=0)
    closing = np.minimum(u, 0)
    expected = 0.5 * effective_mass(bodies, contacts) * (1 - e**2) * closing**2
    assert np.allclose(change, -expected, atol=1e-13)
    free = np.isfinite(bodies.mass[n:])
    for total in (
        lambda b: b.momentum,
        lambda b: np.cross(b.position, b.momentum) + b.angular_momentum,
    ):
        before_sum, after_sum = (
            total(b).reshape(2, n, 3).sum(axis=0)[free] for b in (bodies, after)
        )
        assert np.allclose(before_sum, after_sum, atol=1e-14)


def test_without_spin_it_is_the_central_formula():
    bodies = Bodies.balls(
        [2.0, 3.0], 0.5, [[0.5, 0, 0], [-0.5, 0, 0]], [[-4.0, 1, 0], [1.0, 0, 2]]
    )
    contacts = Contacts([0], [1], [[0.0, 0, 0]], [X], [0.0])
    assert impulse_at_point(bodies, contacts, 0.5)[0] == pytest.approx(9, rel=1e-15)
    assert effective_mass(bodies, contacts)[0] == pytest.approx(6 / 5, rel=1e-15)


def test_two_fixed_bodies_feel_nothing():
    bodies = Bodies.balls(np.inf, 0.5, [[0.5, 0, 0], [-0.5, 0, 0]])
    contacts = Contacts([0], [1], [[0.0, 0, 0]], [X], [0.0])
    assert (
        effective_mass(bodies, contacts)[0] == np.inf
        and impulse_at_point(bodies, contacts, 1.0)[0] == 0
    )


def test_point_velocity_of_a_wheel():
    # Rolling: the lowest point stands still, the highest moves at twice the speed.
    arms = [[0, 0, -1.0], [0, 0, 1.0]]
    assert np.allclose(
        point_velocity([2.0, 0, 0], [0, 2.0, 0], arms), [[0, 0, 0], [4, 0, 0]]
    )


def test_refuses_contacts_with_bodies_that_are_not_there_and_wrong_lengths():
    bodies, contacts = spinning(9, 3)
    few = Bodies.balls(1.0, 0.5, np.zeros((2, 3)))
    with pytest.raises(
        ValueError,
        match=r"contacts.body_a: expected whole numbers from 0 to 1; got 2 in entry 2",
    ):
        impulse_at_point(few, contacts, 1.0)
    with pytest.raises(
        ValueError, match="restitution: expected a batch that broadcasts with contacts"
    ):
        impulse_at_point(bodies, contacts, [1.0, 1.0])
    with pytest.raises(
        ValueError, match="impulse: expected a batch that broadcasts with contacts"
    ):
        apply_impulse(bodies, contacts, [1.0, 1.0])
