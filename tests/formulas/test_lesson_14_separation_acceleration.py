"""Lesson 14 against second differences in time of what is carried along."""

import numpy as np
import pytest
from formulas.clouds import carried, drawn_cloud, rate, second_rate, turn

from course import formulas

SEEDS = pytest.mark.parametrize("seed", [1, 2, 3])


@SEEDS
def test_free_point_acceleration_is_the_second_rate_of_the_point(seed):
    *motion, r = np.random.default_rng(seed).normal(size=(6, 3))

    def point(t):
        place, rotation = carried(motion, t)
        return place + rotation @ r

    _, _, omega, v_dot, omega_dot = motion
    found = formulas.free_point_acceleration(v_dot, omega_dot, omega, r)
    np.testing.assert_allclose(found, second_rate(point), atol=1e-7)


@SEEDS
@pytest.mark.parametrize("face", ["face_a", "face_b"])
def test_contact_bias_is_the_second_rate_of_the_gap(seed, face):
    """Both points are the same at t = 0 and go their own ways; the normal goes with its
    face."""
    rng = np.random.default_rng(seed)
    p, n, *motions = rng.normal(size=(12, 3))
    n /= np.linalg.norm(n)
    a, b = tuple(motions[:5]), tuple(motions[5:])

    def gap(t):
        (x_a, R_a), (x_b, R_b) = carried(a, t), carried(b, t)
        p_a, p_b = x_a + R_a @ (p - a[0]), x_b + R_b @ (p - b[0])
        return (p_a - p_b) @ (R_b if face == "face_b" else R_a) @ n

    found = formulas.contact_bias(p, n, face, a, b)
    assert found == pytest.approx(second_rate(gap), abs=1e-7)


@SEEDS
def test_separation_acceleration_is_the_second_rate_of_the_gap(seed):
    """Of two points apart, each carried by its body, along a normal that turns as it
    likes."""
    rng = np.random.default_rng(seed)
    n, n_dot, n_ddot, p_a, p_b, *motions = rng.normal(size=(15, 3))
    a, b = tuple(motions[:5]), tuple(motions[5:])

    def gap(t):
        (x_a, R_a), (x_b, R_b) = carried(a, t), carried(b, t)
        apart = x_a + R_a @ (p_a - a[0]) - x_b - R_b @ (p_b - b[0])
        return apart @ (n + t * n_dot + t**2 / 2 * n_ddot)

    given = p_a, p_b, a, b, n, n_dot, n_ddot
    found = formulas.separation_acceleration(*given)
    assert found == pytest.approx(second_rate(gap), rel=1e-7, abs=1e-7)
    printed = [  # misprint 7: terms that change places are seen
        formulas.separation_acceleration(*given[:5], n_ddot, n_dot),
        formulas.separation_acceleration(p_b, p_a, *given[2:]),
    ]
    assert min(np.abs(found - printed)) > 1e-3


@SEEDS
@pytest.mark.parametrize("face", ["face_a", "face_b"])
def test_where_points_coincide_it_is_the_bias(seed, face):
    p, n, *motions = np.random.default_rng(seed).normal(size=(12, 4, 3))
    a, b = tuple(motions[:5]), tuple(motions[5:])
    n_dot = formulas.normal_rate(n, a[2], b[2], face)
    n_ddot = np.full_like(n, 1e3)  # not read
    found = formulas.separation_acceleration(p, p, a, b, n, n_dot, n_ddot)
    bias = formulas.contact_bias(p, n, face, a, b)
    np.testing.assert_allclose(found, bias, rtol=1e-12, atol=1e-12)


@SEEDS
def test_free_angular_acceleration_is_the_rate_of_omega(seed):
    rng = np.random.default_rng(seed)
    cloud, (L, torque) = drawn_cloud(rng), rng.normal(size=(2, 3))
    inverse = np.linalg.inv(cloud.inertia)
    omega = inverse @ L

    def omega_at(t):
        return np.linalg.solve(cloud.turned(turn(t * omega)).inertia, L + t * torque)

    found = formulas.angular_acceleration_free(inverse, L, omega, torque)
    np.testing.assert_allclose(found, rate(omega_at), rtol=1e-7, atol=1e-8)


def test_without_torque_the_energy_of_turning_stays():
    """d/dt (L.omega/2) = L.omega_dot/2 + L_dot.omega/2, and L_dot = 0."""
    rng = np.random.default_rng(4)
    inverse, L = np.linalg.inv(drawn_cloud(rng).inertia), 5 * rng.normal(size=3)
    omega_dot = formulas.angular_acceleration_free(inverse, L, inverse @ L, np.zeros(3))
    assert np.linalg.norm(omega_dot) > 0.01
    assert L @ omega_dot == pytest.approx(0.0, abs=1e-14)


def test_top_acceleration_is_the_second_rate_of_the_gap():
    y, v_y, a_y, theta, omega, alpha, ell = -2.0, -0.8, -1.5, 0.6, -0.5, -2.0, 3.0

    def gap(t):
        angle = theta + t * omega + t**2 / 2 * alpha
        return -(y + t * v_y + t**2 / 2 * a_y) - ell / 2 * np.cos(angle)

    found = float(formulas.top_acceleration(a_y, alpha, omega, theta, ell))
    assert found == pytest.approx(second_rate(gap), abs=1e-7)
