"""Lesson 09 against clouds of point masses, differences in time, SciPy and what is
conserved."""

import numpy as np
import pytest
from formulas.clouds import drawn_cloud, rate, turn
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from course import formulas

SEEDS = pytest.mark.parametrize("seed", [1, 2, 3])


@SEEDS
def test_both_energies_add_up_to_that_of_the_points(seed):
    """Koenig: the sum of m v^2/2 over the points; each energy alone where the other is
    0."""
    rng = np.random.default_rng(seed)
    cloud, (v, omega) = drawn_cloud(rng), rng.normal(size=(2, 3))
    for moving, turning in ((v, omega), (v, 0 * omega), (0 * v, omega)):
        velocity = cloud.velocities(moving, turning)
        momentum = cloud.m @ velocity
        angular = cloud.m @ np.cross(cloud.r, velocity)
        found = formulas.linear_kinetic_energy(momentum, moving)
        found = found + formulas.angular_kinetic_energy(angular, turning)
        expected = 0.5 * cloud.m @ np.sum(velocity**2, axis=-1)
        assert found == pytest.approx(expected, rel=1e-13)


@SEEDS
def test_world_inertia_is_that_of_the_turned_points(seed):
    rng = np.random.default_rng(seed)
    clouds, rotations = (
        [drawn_cloud(rng) for _ in range(4)],
        turn(rng.normal(size=(4, 3))),
    )
    found = formulas.world_inertia(rotations, np.array([c.inertia for c in clouds]))
    expected = [c.turned(r).inertia for c, r in zip(clouds, rotations, strict=True)]
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)


@SEEDS
def test_angular_acceleration_is_the_rate_of_omega(seed):
    """omega(t) = I(t)^-1 L(t) with the body turned on by omega, L by the torque."""
    rng = np.random.default_rng(seed)
    cloud, (L, torque) = drawn_cloud(rng), rng.normal(size=(2, 3))
    omega = np.linalg.solve(cloud.inertia, L)

    def omega_at(t):
        return np.linalg.solve(cloud.turned(turn(t * omega)).inertia, L + t * torque)

    found = formulas.angular_acceleration(cloud.inertia, L, torque)
    np.testing.assert_allclose(found, rate(omega_at), rtol=1e-7, atol=1e-8)


def test_sigma_is_the_growth_of_euler_s_equations():
    """The largest eigenvalue of the equations about the middle axis, differentiated by
    differences."""
    moments, spin = np.array([1.0, 1.7, 2.2]), np.array([0.0, 3.0, 0.0])

    def rates(omega):
        return np.cross(moments * omega, omega) / moments

    jacobian = [rate(lambda t, axis=axis: rates(spin + t * axis)) for axis in np.eye(3)]
    growth = np.linalg.eigvals(np.array(jacobian).T).real.max()
    assert float(formulas.sigma(*moments, 3.0)) == pytest.approx(growth, rel=1e-8)


def test_steps_of_a_thrown_spinning_body_in_closed_form():
    """x_n = x + n h v + n (n + 1)/2 h^2 g; about a principal axis the turns add up
    exactly."""
    g, h, steps = np.array([0.0, 0.0, -9.81]), 0.02, 25
    mass, moments, spin = 2.0, np.diag([1.0, 2.0, 3.0]), np.array([0.0, 4.0, 0.0])
    x, R, p, L = np.zeros(3), np.eye(3), np.array([2.0, 1.0, 6.0]), moments @ spin
    p_start = p
    for _ in range(steps):
        x, R, p, L = formulas.symplectic_euler_step(
            x, R, p, L, mass, moments, mass * g, np.zeros(3), h
        )
    fallen = steps * (steps + 1) / 2 * h**2 * g
    np.testing.assert_allclose(x, steps * h * p_start / mass + fallen, rtol=1e-13)
    np.testing.assert_allclose(R, turn(steps * h * spin), atol=1e-13)


def test_steps_on_a_spring_keep_areas():
    """The map of (x, p) has determinant 1; that of explicit Euler 1 + h^2 k/m."""
    h, k, mass = 0.3, 5.0, 2.0

    def stepped(x, p):
        start = np.array([x, 0.0, 0.0]), np.eye(3), np.array([p, 0.0, 0.0]), np.zeros(3)
        force = -k * start[0]
        after = formulas.symplectic_euler_step(
            *start, mass, np.eye(3), force, np.zeros(3), h
        )
        return after[0][0], after[2][0]

    square = np.array([stepped(1.0, 0.0), stepped(0.0, 1.0)])
    assert np.linalg.det(square) == pytest.approx(1.0, abs=1e-14)


@SEEDS
def test_rotate_is_the_exponential_of_the_cross_product(seed):
    rng = np.random.default_rng(seed)
    v, theta = rng.normal(size=(2, 6, 3)) * np.array([1.0, 3.0])[:, None, None]
    theta[0] = 0.0
    expected = [
        expm(np.cross(t, np.eye(3)).T) @ w for w, t in zip(v, theta, strict=True)
    ]
    found = formulas.rotate(v, theta)
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(
        np.einsum("kij,kj->ki", turn(theta), v), expected, atol=1e-12
    )


def test_rk4_step_is_of_order_four():
    """Half the step, a 32nd of the error of one step: it is h^5."""
    rng = np.random.default_rng(5)
    cloud, l_start = drawn_cloud(rng), rng.normal(size=3)

    def exact(h):
        def rates(t, momentum):
            return np.cross(momentum, np.linalg.solve(cloud.inertia, momentum))

        return solve_ivp(
            rates, (0, h), l_start, method="DOP853", rtol=1e-13, atol=1e-14
        ).y[:, -1]

    errors = [
        np.linalg.norm(formulas.rk4_step(l_start, cloud.inertia, h) - exact(h))
        for h in (1.6, 0.8, 0.4)
    ]
    assert errors[0] > 1e-9
    assert np.log2(errors[1] / errors[2]) == pytest.approx(5, abs=0.3)
