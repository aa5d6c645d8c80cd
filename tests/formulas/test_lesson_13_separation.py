"""Lesson 13 against differences in time of the gap and of the normal."""

import numpy as np
import pytest
from formulas.clouds import rate, turn, unit

from course import formulas

SEEDS = pytest.mark.parametrize("seed", [1, 2, 3])


def test_separation_is_the_way_along_the_normal():
    """p_A is p_B, moved by d along N and anyhow across it."""
    rng = np.random.default_rng(1)
    n, p_b, across = unit(rng.normal(size=(5, 3))), *rng.normal(size=(2, 5, 3))
    d = rng.normal(size=5)
    across -= np.einsum("ki,ki->k", across, n)[:, None] * n
    found = formulas.separation(p_b + d[:, None] * n + across, p_b, n)
    np.testing.assert_allclose(found, d, atol=1e-14)


@SEEDS
@pytest.mark.parametrize("face", ["face_a", "face_b"])
def test_rates_of_a_face_s_normal_and_of_the_gap(seed, face):
    """Each point is fixed to its body and the normal to the one whose face it is."""
    rng = np.random.default_rng(seed)
    (x_a, x_b), v, omega, (p_a, p_b) = rng.normal(size=(4, 2, 3))
    n = unit(rng.normal(size=3))

    def carried(t):
        R_a, R_b = turn(t * omega[0]), turn(t * omega[1])
        normal = (R_b if face == "face_b" else R_a) @ n
        a = x_a + t * v[0] + R_a @ (p_a - x_a)
        b = x_b + t * v[1] + R_b @ (p_b - x_b)
        return normal, (a - b) @ normal

    n_dot = formulas.normal_rate(n, *omega, face)
    np.testing.assert_allclose(n_dot, rate(lambda t: carried(t)[0]), atol=1e-9)
    found = formulas.separation_rate(
        p_a, p_b, (x_a, v[0], omega[0]), (x_b, v[1], omega[1]), n, n_dot
    )
    assert found == pytest.approx(rate(lambda t: carried(t)[1]), abs=1e-8)


@SEEDS
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_rate_of_the_normal_of_two_edges(seed, side):
    rng = np.random.default_rng(seed)
    e_a, e_b = unit(rng.normal(size=(2, 3)))
    omega_a, omega_b = rng.normal(size=(2, 3))

    def normal(t):
        q = np.cross(turn(t * omega_a) @ e_a, turn(t * omega_b) @ e_b)
        return side * unit(q)

    found = formulas.edge_normal_rate(e_a, e_b, omega_a, omega_b, normal(0.0))
    np.testing.assert_allclose(found, rate(normal), rtol=1e-7, atol=1e-7)


def test_top_rate_is_the_rate_of_the_gap():
    y, v_y, theta, omega, ell = -2.0, -0.8, 0.6, -0.5, 3.0
    gap = lambda t: -(y + t * v_y) - ell / 2 * np.cos(theta + t * omega)  # noqa: E731
    found = float(formulas.top_rate(v_y, omega, theta, ell))
    assert found == pytest.approx(rate(gap), abs=1e-9)
