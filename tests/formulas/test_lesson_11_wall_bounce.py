"""Lesson 11 against reflections, flights added up one by one, and the limit of small
steps."""

import numpy as np
import pytest

from course import formulas


def flights(height, e, gravity, count):
    """Times of the impacts from v = sqrt(2 g h) and flights of 2 v/g."""
    speed = np.sqrt(2 * gravity * height)
    times = [speed / gravity]
    while len(times) < count:
        speed *= e
        times.append(times[-1] + 2 * speed / gravity)
    return times


def test_nothing_lost_is_a_mirror():
    """Householder's matrix 1 - 2 n n' for balls that come in, and the speed is kept."""
    rng = np.random.default_rng(2)
    normal = rng.normal(size=(8, 3))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    velocity = rng.normal(size=(8, 3))
    found = formulas.wall_bounce(velocity, normal, 1.0)
    mirrored = [
        (np.eye(3) - 2 * np.outer(n, n)) @ v
        for v, n in zip(velocity, normal, strict=True)
    ]
    comes = np.einsum("ki,ki->k", velocity, normal) < 0
    assert 0 < comes.sum() < 8
    np.testing.assert_allclose(
        found, np.where(comes[:, None], mirrored, velocity), atol=1e-14
    )


@pytest.mark.parametrize("e", [0.0, 0.35, 1.0])
def test_a_bounce_is_the_impulse_of_a_wall(e):
    velocity, n = np.array([1.0, -2.0, -3.0]), np.array([0.0, 0.6, 0.8])
    p_hat = formulas.impulse_central(2.0, np.inf, velocity, np.zeros(3), n, e)
    found = formulas.wall_bounce(velocity, n, e)
    np.testing.assert_allclose(found, velocity + p_hat / 2.0 * n, atol=1e-14)


@pytest.mark.parametrize("e", [0.0, 0.5, 0.9, 1.0])
def test_bounce_times_are_the_flights_added_up(e):
    found = formulas.bounce_times(np.array([1.0, 2.5]), e, 12, np.array([9.81, 1.6]))
    expected = [flights(1.0, e, 9.81, 12), flights(2.5, e, 1.6, 12)]
    np.testing.assert_allclose(found, expected, rtol=1e-14)


def test_rest_time_is_where_the_flights_end():
    late = flights(1.5, 0.6, 9.81, 80)[-1]
    assert float(formulas.rest_time(1.5, 0.6, 9.81)) == pytest.approx(late, rel=1e-14)


def test_small_steps_hit_when_the_ball_does():
    h, height, velocity, hits = 1e-4, 1.0, 0.0, []
    for k in range(14_000):
        before = velocity
        height, velocity = formulas.bouncing_ball_step(height, velocity, h, 0.5, 9.81)
        if before < 0 < velocity:
            hits.append(k * h)
    expected = flights(1.0, 0.5, 9.81, len(hits))
    assert len(hits) >= 5
    np.testing.assert_allclose(hits[:5], expected[:5], atol=10 * h)


def test_in_the_air_a_step_is_the_parabola_s_sum():
    height, velocity, h, n = 3.0, 4.0, 0.01, 30
    for _ in range(n):
        height, velocity = formulas.bouncing_ball_step(height, velocity, h, 0.5, 9.81)
    assert velocity == pytest.approx(4.0 - 9.81 * n * h, rel=1e-13)
    fallen = 9.81 * h**2 * n * (n + 1) / 2
    assert height == pytest.approx(3.0 + 4.0 * n * h - fallen, rel=1e-13)
