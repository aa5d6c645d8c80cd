"""Impulses between two bodies: formulas of syllabus rows 15-17, and what they must keep."""

import warnings
from fractions import Fraction

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from course.dynamics import (
    Bodies,
    apply_impulse,
    effective_mass,
    impulse_at_point,
    impulse_central,
    kinetic_energy_lost,
    momentum_after,
    normal_velocity,
    point_velocity,
    separation_speed,
    velocity_after,
)
from course.overlap import Contacts

X = [1.0, 0.0, 0.0]


def pairs(seed, count=500):
    """Random pairs, a fifth of them with one fixed body."""
    rng = np.random.default_rng(seed)
    mass = 10 ** rng.uniform(-3, 3, (2, count))
    velocity = rng.normal(size=(2, count, 3))
    fixed = rng.random(count) < 0.2
    mass[1, fixed], velocity[1, fixed] = np.inf, 0
    normal = rng.normal(size=(count, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return mass[0], mass[1], velocity[0], velocity[1], normal, rng.random(count)


def test_worked_pair():
    # By hand: m = 2 and 3, v = -4 and 1 along n = x (body 1 right of body 2), e = 1/2:
    # u = -5, 1/m1 + 1/m2 = 5/6, p_hat = 1.5 * 5 * 6/5 = 9, v' = -4 + 9/2, 1 - 9/3.
    v_1, v_2 = [-4.0, 0, 0], [1.0, 0, 0]
    p_hat = impulse_central(2.0, 3.0, v_1, v_2, X, 0.5)
    assert p_hat == pytest.approx(9, rel=1e-15)
    after = velocity_after(2.0, 3.0, v_1, v_2, p_hat, X)
    assert np.allclose(after[0], [0.5, 0, 0]) and np.allclose(after[1], [-2, 0, 0])
    assert separation_speed(v_1, v_2, X, 0.5) == 2.5 == after[0][0] - after[1][0]
    assert kinetic_energy_lost(2.0, 3.0, v_1, v_2, X, 0.5) == pytest.approx(
        0.5 * (6 / 5) * 0.75 * 25
    )
    assert np.allclose(
        momentum_after([-8.0, 0, 0], [3.0, 0, 0], p_hat, X), [[1, 0, 0], [-6, 0, 0]]
    )


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_laws_hold_on_random_pairs(seed):
    m_1, m_2, v_1, v_2, n, e = pairs(seed)
    p_hat = impulse_central(m_1, m_2, v_1, v_2, n, e)
    w_1, w_2 = velocity_after(m_1, m_2, v_1, v_2, p_hat, n)
    u, w = np.sum((v_1 - v_2) * n, axis=1), np.sum((w_1 - w_2) * n, axis=1)
    assert np.all(p_hat >= 0) and np.all(
        p_hat[u >= 0] == 0
    )  # never pulls; nothing to bodies that part
    assert np.allclose(w, np.where(u < 0, -e * u, u), rtol=0, atol=1e-13)
    assert np.allclose(w, separation_speed(v_1, v_2, n, e), rtol=0, atol=1e-13)
    fixed = np.isinf(m_2)
    assert np.array_equal(w_2[fixed], v_2[fixed])
    free = ~fixed
    energy = [
        0.5 * m_1 * np.sum(a**2, axis=1)
        + 0.5 * np.where(free, m_2, 0) * np.sum(b**2, axis=1)
        for a, b in ((v_1, v_2), (w_1, w_2))
    ]
    lost = kinetic_energy_lost(m_1, m_2, v_1, v_2, n, e)
    assert np.all(lost >= 0)
    assert np.allclose(
        energy[0] - energy[1], lost, rtol=0, atol=1e-12 * energy[0].max()
    )  # row 15 defines T_lost
    p_1, p_2 = m_1[free, None] * v_1[free], m_2[free, None] * v_2[free]
    q_1, q_2 = momentum_after(p_1, p_2, p_hat[free], n[free])
    assert np.allclose(
        q_1 + q_2, p_1 + p_2, rtol=0, atol=1e-15 * np.abs([p_1, p_2]).max()
    )
    assert np.allclose(q_1, m_1[free, None] * w_1[free]) and np.allclose(
        q_2, m_2[free, None] * w_2[free]
    )


def test_energy_kept_at_one_and_relative_motion_gone_at_zero():
    m_1, m_2, v_1, v_2, n, _ = pairs(4)
    assert not kinetic_energy_lost(m_1, m_2, v_1, v_2, n, 1.0).any()
    hit = np.sum((v_1 - v_2) * n, axis=1) < 0
    w_1, w_2 = velocity_after(
        m_1, m_2, v_1, v_2, impulse_central(m_1, m_2, v_1, v_2, n, 0.0), n
    )
    assert np.abs(np.sum((w_1 - w_2) * n, axis=1))[hit].max() < 1e-14


@pytest.mark.parametrize("e", [0.25, 0.5, 1.0])
def test_restitution_as_printed_leaves_the_bodies_approaching(e):
    # Misprint 3: u' = +e u along n means p_hat = -(1 - e) u mu; at e = 1 that is no impulse at all.
    v_1, v_2 = np.array([-4.0, 0, 0]), np.array([1.0, 0, 0])
    mended = impulse_central(2.0, 3.0, v_1, v_2, X, e)
    printed = mended * (1 - e) / (1 + e)
    for p_hat, speed in ((printed, -5 * e), (mended, 5 * e)):
        w_1, w_2 = velocity_after(2.0, 3.0, v_1, v_2, p_hat, X)
        assert w_1[0] - w_2[0] == pytest.approx(speed, rel=1e-14)


def test_walls():
    # Misprint 4: a wall needs 1/m2 = 0 and v2 = 0; p_hat = -(1 + e) m1 v1.n.
    assert (
        impulse_central(3.0, np.inf, [-2.0, 1, 0], [0, 0, 0], X, 0.25) == 1.25 * 3 * 2
    )
    assert impulse_central(np.inf, 3.0, [0, 0, 0], [2.0, 1, 0], X, 0.25) == 1.25 * 3 * 2
    assert impulse_central(np.inf, np.inf, [-2.0, 0, 0], [0, 0, 0], X, 0.25) == 0
    assert kinetic_energy_lost(np.inf, np.inf, [-2.0, 0, 0], [0, 0, 0], X, 0.25) == 0


def test_broadcasting_equals_a_loop():
    m_1, m_2, v_1, v_2, n, e = pairs(5, 6)
    batch = impulse_central(m_1[:, None], m_2, v_1[:, None], v_2, n, e)
    lost = kinetic_energy_lost(m_1[:, None], m_2, v_1[:, None], v_2, n, e)
    for i in range(6):
        for j in range(6):
            one = (m_1[i], m_2[j], v_1[i], v_2[j], n[j], e[j])
            assert batch[i, j] == impulse_central(*one) and lost[
                i, j
            ] == kinetic_energy_lost(*one)
    assert impulse_central(1.0, 1.0, np.zeros((0, 3)), [0, 0, 0], X, 1).shape == (0,)


def test_inputs_are_not_written():
    arguments = pairs(6, 10)
    before = [a.copy() for a in arguments]
    p_hat = impulse_central(*arguments)
    kinetic_energy_lost(*arguments)
    velocity_after(*arguments[:4], p_hat, arguments[4])
    separation_speed(*arguments[2:])
    momentum_after(arguments[2], arguments[3], p_hat, arguments[4])
    assert all(np.array_equal(a, b) for a, b in zip(arguments, before, strict=True))


@pytest.mark.parametrize(
    "change, message",
    [
        (dict(mass_1=0.0), "mass_1: expected positive numbers; got 0.0"),
        (dict(mass_2=-1.0), "mass_2: expected positive numbers"),
        (dict(velocity_1=[1.0, 2.0]), r"velocity_1: expected vectors of shape \(\.\.\., 3\); got shape \(2,\)"),
        (dict(velocity_2=[np.nan, 0, 0]), "velocity_2: expected finite"),
        (dict(normal=[0.0, 0, 0]), "normal: expected unit vectors .* got length 0.0"),
        (dict(restitution=1.1), "restitution: expected numbers from 0 to 1; got 1.1"),
        (dict(restitution=-0.1), "restitution: expected numbers from 0 to 1"),
        (dict(mass_1=np.ones(2), velocity_1=np.zeros((3, 3))), r"velocity_1: .* mass_1 of batch shape \(2,\)"),
    ],
)  # fmt: skip
def test_refuses(change, message):
    good = dict(
        mass_1=1.0,
        mass_2=2.0,
        velocity_1=[-1.0, 0, 0],
        velocity_2=[0.0, 0, 0],
        normal=X,
        restitution=0.5,
    )
    for function in (impulse_central, kinetic_energy_lost):
        with pytest.raises(ValueError, match=message):
            function(**{**good, **change})


def test_impulse_may_not_be_nan():
    with pytest.raises(ValueError, match="impulse: expected finite real numbers"):
        momentum_after(X, X, np.nan, X)
    with pytest.raises(ValueError, match="impulse: expected finite real numbers"):
        velocity_after(1.0, 1.0, X, X, np.inf, X)


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


@pytest.mark.parametrize(
    "m_1,m_2",
    [(1e308, 1e308), (1.7e308, 1e300), (1e-308, 1e-308), (1e308, 1e-300), (1e-320, 1.0), (3.0, 1e308)],
)  # fmt: skip
@pytest.mark.parametrize("closing", [1.0, 1e-3])
def test_masses_at_the_ends_of_float64(m_1, m_2, closing):
    """mu = m1 m2/(m1 + m2) in rational numbers: neither the product nor the sum is held by float64."""
    mu = Fraction(m_1) * Fraction(m_2) / (Fraction(m_1) + Fraction(m_2))
    motion = [-closing, 0, 0], [0.0, 0, 0]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        p_hat = impulse_central(m_1, m_2, *motion, X, 0.5)
        lost = kinetic_energy_lost(m_1, m_2, *motion, X, 0.5)
    speed = Fraction(closing)
    assert p_hat == pytest.approx(float(Fraction(3, 2) * mu * speed), rel=1e-14, abs=1e-322)
    right = float(Fraction(3, 8) * mu * speed**2)
    assert lost == pytest.approx(right, rel=1e-14, abs=1e-322)


def test_the_square_of_a_minute_speed_is_not_formed():
    """By hand: mu = 5e299, T_lost = 3/8 5e299 (1e-170)^2."""
    lost = kinetic_energy_lost(1e300, 1e300, [-1e-170, 0, 0], [0, 0, 0], X, 0.5)
    assert lost == pytest.approx(1.875e-41, rel=1e-13)
