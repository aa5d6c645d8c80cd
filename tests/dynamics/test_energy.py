"""Energies and totals: by hand, by particles, and with fixed bodies among them."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from course.dynamics import (
    Bodies,
    angular_kinetic_energy,
    kinetic_energy,
    linear_kinetic_energy,
    potential_energy,
    splitting,
    total_angular_momentum,
    total_energy,
    total_momentum,
    uniform_gravity,
)

SEEDS = [0, 1, 2]
GRAVITY = np.array([0.0, 0.0, -9.81])


def with_a_fixed_one(n=4, seed=0):
    rng = np.random.default_rng(seed)
    inertia = np.array([np.diag(rng.uniform(1, 2, 3)) for _ in range(n)])
    mass, momenta = rng.uniform(1, 3, n), rng.normal(size=(2, n, 3))
    mass[1], momenta[:, 1], inertia[1] = np.inf, 0, np.nan
    q = Rotation.random(n, random_state=rng).as_quat()
    return Bodies(mass, inertia, rng.normal(size=(n, 3)), q, *momenta)


def test_by_hand():
    # 2 kg at (3, 4, 0) m/s: 25 J. L = (1, 2, 3), omega = (3, 0, 1): 3 J. 2 kg at 5 m: 98.1 J.
    assert linear_kinetic_energy([6, 8, 0], [3, 4, 0]) == pytest.approx(25)
    assert angular_kinetic_energy([1, 2, 3], [3, 0, 1]) == pytest.approx(3)
    assert potential_energy(2.0, [7, 7, 5], GRAVITY) == pytest.approx(98.1)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_rigid_set_of_particles(seed):
    """T, p and L of the body are the sums over its particles (Goldstein, sections 1.2 and 5.1)."""
    rng = np.random.default_rng(seed)
    m, r = rng.uniform(0.5, 2, 9), rng.normal(size=(9, 3))
    r -= m @ r / m.sum()
    inertia = sum(
        mi * (x @ x * np.eye(3) - np.outer(x, x)) for mi, x in zip(m, r, strict=True)
    )
    turn, x, v, omega = Rotation.random(random_state=rng), *rng.normal(size=(3, 3))
    arms = turn.apply(r)
    angular = turn.as_matrix() @ inertia @ turn.as_matrix().T @ omega
    bodies = Bodies(
        [m.sum()], [inertia], [x], [turn.as_quat()], [m.sum() * v], [angular]
    )
    speeds = v + np.cross(omega, arms)
    c = rng.normal(size=3)
    assert kinetic_energy(bodies)[0] == pytest.approx(
        0.5 * np.sum(m * np.sum(speeds**2, axis=1)), rel=1e-12
    )
    assert np.allclose(total_momentum(bodies), m @ speeds, rtol=1e-12)
    expected = np.sum(m[:, None] * np.cross(x + arms - c, speeds), axis=0)
    assert np.allclose(
        total_angular_momentum(bodies, c), expected, rtol=1e-12, atol=1e-12
    )
    energy = kinetic_energy(bodies)[0] - np.sum(m * ((x + arms) @ GRAVITY))
    assert total_energy(bodies, GRAVITY) == pytest.approx(energy, rel=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_fixed_bodies_add_nothing_and_make_no_nan(seed):
    bodies = with_a_fixed_one(seed=seed)
    keep = np.array([0, 2, 3])
    free = bodies[keep]
    with np.errstate(all="raise"):
        assert total_energy(bodies, GRAVITY) == pytest.approx(
            total_energy(free, GRAVITY)
        )
        assert kinetic_energy(bodies)[1] == 0
        assert potential_energy(np.inf, [0, 0, 0], GRAVITY) == 0
        assert potential_energy([1.0, np.inf], [0, 0, 2], GRAVITY)[1] == 0
    assert np.array_equal(total_momentum(bodies), total_momentum(free))
    assert np.allclose(
        total_angular_momentum(bodies, [1, 2, 3]),
        total_angular_momentum(free, [1, 2, 3]),
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_what_free_fall_keeps(seed):
    bodies = with_a_fixed_one(seed=seed)
    before = total_energy(bodies, GRAVITY)
    after = splitting(bodies, uniform_gravity(GRAVITY), 1e-3)
    # A parabola is exact for this step; turning keeps T to order h^2 and better for a torque-free body.
    assert total_energy(after, GRAVITY) == pytest.approx(before, abs=1e-6)
    pulled = total_momentum(after) - total_momentum(bodies)
    assert np.allclose(pulled, 1e-3 * GRAVITY * bodies.mass[~bodies.fixed].sum())


def test_energies_broadcast():
    rng = np.random.default_rng(0)
    p, v = rng.normal(size=(4, 1, 3)), rng.normal(size=(5, 3))
    table = linear_kinetic_energy(p, v)
    assert table.shape == (4, 5) and table[2, 3] == pytest.approx(0.5 * p[2, 0] @ v[3])
    assert np.array_equal(angular_kinetic_energy(p, v), table)
    assert potential_energy(np.ones((4, 1)), v, GRAVITY).shape == (4, 5)


def test_bad_input_is_refused_by_name():
    with pytest.raises(
        ValueError,
        match=r"momentum: expected vectors of shape \(\.\.\., 3\); got shape \(2,\)",
    ):
        linear_kinetic_energy([1, 2], [1, 2, 3])
    with pytest.raises(ValueError, match="angular_velocity: expected finite"):
        angular_kinetic_energy([1, 2, 3], [1, 2, np.inf])
    with pytest.raises(
        ValueError, match="velocity: expected a batch that broadcasts with momentum"
    ):
        linear_kinetic_energy(np.ones((2, 3)), np.ones((4, 3)))
    with pytest.raises(ValueError, match=r"mass: expected positive numbers; got -1.0"):
        potential_energy(-1, [0, 0, 0], GRAVITY)
    with pytest.raises(
        ValueError, match=r"gravity: expected shape \(3,\); got shape \(1, 3\)"
    ):
        total_energy(with_a_fixed_one(), [GRAVITY])
    with pytest.raises(ValueError, match=r"point: expected vectors"):
        total_angular_momentum(with_a_fixed_one(), 1.0)


def test_inputs_are_not_written():
    bodies = with_a_fixed_one()
    copy = replace(bodies)
    total_energy(bodies, GRAVITY)
    total_angular_momentum(bodies)
    assert np.array_equal(bodies.momentum, copy.momentum) and np.array_equal(
        bodies.position, copy.position
    )
