"""Impulses between two bodies that do not turn: formulas of syllabus rows 15-17, and what they must keep."""

import warnings
from fractions import Fraction

import numpy as np
import pytest

from course.dynamics import (
    impulse_central,
    kinetic_energy_lost,
    momentum_after,
    separation_speed,
    velocity_after,
)

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
    assert p_hat == pytest.approx(
        float(Fraction(3, 2) * mu * speed), rel=1e-14, abs=1e-322
    )
    right = float(Fraction(3, 8) * mu * speed**2)
    assert lost == pytest.approx(right, rel=1e-14, abs=1e-322)


def test_the_square_of_a_minute_speed_is_not_formed():
    """By hand: mu = 5e299, T_lost = 3/8 5e299 (1e-170)^2."""
    lost = kinetic_energy_lost(1e300, 1e300, [-1e-170, 0, 0], [0, 0, 0], X, 0.5)
    assert lost == pytest.approx(1.875e-41, rel=1e-13)
