"""Lesson 10 against three equations, the textbook's velocities, energy, and a spring
between the bodies."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from course import formulas

M_1, M_2, V_1, V_2 = 1.3, 4.0, -2.5, 1.1
X = np.array([1.0, 0.0, 0.0])


def after(e):
    """Both speeds after an impact on a line: the common velocity, and what e adds to
    it."""
    common = (M_1 * V_1 + M_2 * V_2) / (M_1 + M_2)
    part = e * (V_2 - V_1) / (M_1 + M_2)
    return common + M_2 * part, common - M_1 * part


def drawn_pairs(seed, count=12):
    rng = np.random.default_rng(seed)
    normal = rng.normal(size=(count, 3))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    masses, velocities = rng.uniform(0.5, 3, (2, count)), rng.normal(size=(2, count, 3))
    return *masses, *velocities, normal, rng.uniform(0, 1, count)


@pytest.mark.parametrize("e", [0.0, 0.4, 1.0])
def test_p_hat_solves_its_three_equations(e):
    """Unknowns v_1', v_2', p: two changes of momentum and the law of restitution."""
    equations = np.array([[M_1, 0, -1], [0, M_2, 1], [1, -1, 0]])
    right = np.array([M_1 * V_1, M_2 * V_2, -e * (V_1 - V_2)])
    v_1, v_2, p = np.linalg.solve(equations, right)
    assert formulas.p_hat(M_1, M_2, V_1, V_2, e) == pytest.approx(p, rel=1e-14)
    assert (v_1, v_2) == pytest.approx(after(e), rel=1e-14)


@pytest.mark.parametrize("e", [0.0, 0.4, 1.0])
def test_on_a_line_the_bodies_leave_as_the_textbook_says(e):
    given = M_1, M_2, V_1 * X, V_2 * X, X, e
    p_hat = formulas.impulse_central(*given)
    p_1, p_2 = formulas.momentum_after(M_1 * V_1 * X, M_2 * V_2 * X, p_hat, X)
    assert (p_1[0] / M_1, p_2[0] / M_2) == pytest.approx(after(e), rel=1e-14)
    speed = formulas.separation_speed(V_1 * X, V_2 * X, X, e)
    assert speed == pytest.approx(after(e)[0] - after(e)[1], rel=1e-13)
    before = M_1 * V_1**2 / 2 + M_2 * V_2**2 / 2
    kept = M_1 * after(e)[0] ** 2 / 2 + M_2 * after(e)[1] ** 2 / 2
    assert formulas.kinetic_energy_lost(*given) == pytest.approx(
        before - kept, abs=1e-13
    )


def test_in_space_momentum_is_kept_and_energy_balances():
    m_1, m_2, v_1, v_2, n, e = drawn_pairs(3)
    p_hat = formulas.impulse_central(m_1, m_2, v_1, v_2, n, e)
    before = m_1[:, None] * v_1, m_2[:, None] * v_2
    later = formulas.momentum_after(*before, p_hat, n)
    np.testing.assert_allclose(later[0] + later[1], before[0] + before[1], atol=1e-14)

    def energy(p, q):
        return np.sum(p**2, axis=-1) / (2 * m_1) + np.sum(q**2, axis=-1) / (2 * m_2)

    lost = formulas.kinetic_energy_lost(m_1, m_2, v_1, v_2, n, e)
    np.testing.assert_allclose(energy(*before) - energy(*later), lost, atol=1e-13)
    approaching = np.sum((v_1 - v_2) * n, axis=-1) < 0
    assert 0 < approaching.sum() < len(approaching)
    assert (p_hat[~approaching] == 0).all() and (p_hat[approaching] > 0).all()


def test_nothing_lost_is_what_a_stiff_spring_does():
    """Two blocks with a spring between them, from touching to parting; the impulse is
    the force's integral."""
    k = 1e4

    def rates(t, state):
        x_1, x_2, v_1, v_2, p = state
        force = k * max(0.0, x_2 - x_1)  # body 1 is pressed in while x_1 < x_2
        return [v_1, v_2, force / M_1, -force / M_2, force]

    parted = lambda t, s: (s[0] - s[1]) if t > 1e-6 else -1.0  # noqa: E731
    parted.terminal = True
    run = solve_ivp(
        rates, (0, 1), [0, 0, V_1, V_2, 0], events=parted, rtol=1e-10, atol=1e-12
    )
    expected = formulas.impulse_central(M_1, M_2, V_1 * X, V_2 * X, X, 1.0)
    assert run.y[4, -1] == pytest.approx(expected, rel=1e-8)


def test_a_wall_is_a_body_without_end():
    velocity, n = np.array([1.0, -2.0, -3.0]), np.array([0.0, 0.6, 0.8])
    wall = formulas.impulse_central(2.0, np.inf, velocity, np.zeros(3), n, 0.5)
    heavy = formulas.impulse_central(2.0, 1e12, velocity, np.zeros(3), n, 0.5)
    assert wall == pytest.approx(heavy, rel=1e-11) and wall > 0
