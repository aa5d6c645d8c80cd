"""Lesson 12 against clouds of point masses, what is conserved, and nonnegative least
squares."""

import numpy as np
import pytest
from formulas.clouds import drawn_cloud, rate, turn
from scipy.optimize import nnls

from course import formulas

SEEDS = pytest.mark.parametrize("seed", [1, 2, 3, 4])


def impact(seed):
    """Two clouds, their velocities and spins, arms to one contact, and a normal along
    which they approach."""
    rng = np.random.default_rng(seed)
    clouds = drawn_cloud(rng), drawn_cloud(rng)
    v, omega, arm = rng.normal(size=(3, 2, 3))
    n = rng.normal(size=3)
    n /= np.linalg.norm(n)
    points = [
        formulas.point_velocity(*given) for given in zip(v, omega, arm, strict=True)
    ]
    if (points[0] - points[1]) @ n > 0:
        n = -n
    return clouds, v, omega, arm, n, points


def mu_of(clouds, arm, n):
    inverse = [np.linalg.inv(c.inertia) for c in clouds]
    return formulas.effective_mass(
        1 / clouds[0].mass, 1 / clouds[1].mass, *inverse, *arm, n
    )


@SEEDS
def test_point_velocity_is_the_rate_of_the_point(seed):
    x, v, omega, r = np.random.default_rng(seed).normal(size=(4, 3))
    found = formulas.point_velocity(v, omega, r)
    moved = rate(lambda t: x + t * v + turn(t * omega) @ r)
    np.testing.assert_allclose(found, moved, atol=1e-9)


@SEEDS
def test_effective_mass_is_one_over_j_m_inverse_j(seed):
    """Row of the Jacobian (n, r x n, -n, -r x n) with the mass matrix, solved."""
    clouds, _, _, arm, n, _ = impact(seed)
    row = np.concatenate([n, np.cross(arm[0], n), -n, -np.cross(arm[1], n)])
    mass = np.zeros((12, 12))
    for k, c in enumerate(clouds):
        mass[6 * k : 6 * k + 3, 6 * k : 6 * k + 3] = c.mass * np.eye(3)
        mass[6 * k + 3 : 6 * k + 6, 6 * k + 3 : 6 * k + 6] = c.inertia
    expected = 1 / (row @ np.linalg.solve(mass, row))
    assert mu_of(clouds, arm, n) == pytest.approx(expected, rel=1e-12)


@SEEDS
@pytest.mark.parametrize("e", [0.0, 0.6, 1.0])
def test_an_impact_of_turning_bodies(seed, e):
    """Momentum and angular momentum kept, the points part at e u, and at e = 1 the
    energy of all points is kept."""
    clouds, v, omega, arm, n, points = impact(seed)
    p_hat = formulas.impulse_at_point(*points, n, mu_of(clouds, arm, n), e)
    after = [
        formulas.apply_impulse(
            v[k],
            omega[k],
            1 / c.mass,
            np.linalg.inv(c.inertia),
            arm[k],
            n,
            sign * p_hat,
        )
        for k, (c, sign) in enumerate(zip(clouds, (1, -1), strict=True))
    ]
    before = list(zip(v, omega, strict=True))

    def sums(motion):
        """Energy, momentum, angular momentum about the contact of all points."""
        total = np.zeros(7)
        for c, r, (moving, turning) in zip(clouds, arm, motion, strict=True):
            velocity = c.velocities(moving, turning)
            total[0] += 0.5 * c.m @ np.sum(velocity**2, axis=-1)
            total[1:4] += c.m @ velocity
            total[4:] += c.m @ np.cross(c.r - r, velocity)
        return total

    np.testing.assert_allclose(sums(after)[1:], sums(before)[1:], atol=1e-12)
    assert sums(after)[0] <= sums(before)[0] + 1e-12
    if e == 1:
        assert sums(after)[0] == pytest.approx(sums(before)[0], rel=1e-12)
    later = [formulas.point_velocity(*a, r) for a, r in zip(after, arm, strict=True)]
    speed = (later[0] - later[1]) @ n
    assert speed == pytest.approx(-e * (points[0] - points[1]) @ n, abs=1e-12)
    assert formulas.impulse_at_point(*points, -n, 1.0, e) == 0


@pytest.mark.parametrize("theta", [0.0, 0.7, np.pi / 2])
def test_rod_impulse_solves_its_three_equations(theta):
    """Unknowns v', omega', p, with the inertia of the rod integrated along it."""
    m, v, e, ell = 1.7, 2.0, 0.4, 3.0
    nodes, weights = np.polynomial.legendre.leggauss(3)
    inertia = m * np.sum(weights / 2 * (ell / 2 * nodes) ** 2)
    lever = ell / 2 * np.cos(theta)
    equations = np.array([[m, 0, -1], [0, inertia, -lever], [1, lever, 0]])
    _, _, p = np.linalg.solve(equations, [-m * v, 0.0, e * v])
    assert float(formulas.rod_impulse(m, v, theta, e, ell)) == pytest.approx(
        p, rel=1e-13
    )


def test_a_ball_onto_two_that_touch():
    """By hand: 2 p_1 - p_2 = 2, 2 p_2 = p_1."""
    found = formulas.simultaneous_impulses(
        np.array([[2.0, -1.0], [-1.0, 2.0]]), np.array([-1.0, 0.0]), 1.0
    )
    np.testing.assert_allclose(found, [4 / 3, 2 / 3], rtol=1e-14)


@SEEDS
def test_simultaneous_impulses_are_those_of_nonnegative_least_squares(seed):
    """min |J'p + J'^+ c|: with A = J J' its conditions are p >= 0, A p + c >= 0, p (A p
    + c) = 0."""
    rng = np.random.default_rng(seed)
    jacobian, u, e = rng.normal(size=(4, 7)), rng.normal(size=4), 0.3
    matrix, c = jacobian @ jacobian.T, (1 + e) * u
    target = np.linalg.lstsq(jacobian, -c, rcond=None)[0]
    expected, _ = nnls(jacobian.T, target)
    found = formulas.simultaneous_impulses(matrix, u, e)
    np.testing.assert_allclose(found, expected, atol=1e-9)


def test_a_slip_in_simultaneous_impulses_is_seen():
    """A slip of 1e-4 in an impulse that pushes is seen by the properties that judge."""
    from course.exercises.definition import find_exercise

    exercise = find_exercise("simultaneous_impulses")[1]
    for case in exercise.draw(3):
        answer = formulas.simultaneous_impulses(*case.arguments.values())
        pushed = np.flatnonzero(answer > 1e-3)
        if not pushed.size:  # all part: no impulse to be wrong in
            continue
        for sign in (1e-4, -1e-4):
            slipped = answer.copy()
            slipped[pushed[0]] += sign
            worst = max(
                np.max(np.abs(rule.residual(case.arguments, slipped)))
                for rule in exercise.properties
            )
            assert worst > 1e-6
