"""Walls and the bouncing ball in closed form (syllabus row 18)."""

import numpy as np
import pytest

from course.dynamics import (
    bounce_path_length,
    bounce_rest_time,
    bounce_times,
    impulse_central,
    wall_bounce,
)


def test_wall_at_one_is_the_mirror_of_the_slide():
    rng = np.random.default_rng(21)
    v, n = rng.normal(size=(2, 200, 3))
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    mirrored = v - 2 * np.sum(v * n, axis=1, keepdims=True) * n  # row 18
    approaching = np.sum(v * n, axis=1) < 0
    after = wall_bounce(v, n, 1.0)
    assert np.allclose(after[approaching], mirrored[approaching])
    assert np.array_equal(
        after[~approaching], v[~approaching]
    )  # parting: nothing happens
    assert 40 < approaching.sum() < 160


def test_wall_is_the_limit_of_a_fixed_second_body():
    rng = np.random.default_rng(22)
    v, n = rng.normal(size=(2, 50, 3))
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    e, m = rng.random(50), rng.uniform(1, 5, 50)
    p_hat = impulse_central(m, np.inf, v, np.zeros(3), n, e)
    assert np.allclose(wall_bounce(v, n, e), v + (p_hat / m)[:, None] * n, atol=1e-15)


def test_wall_keeps_the_tangential_part_and_broadcasts():
    assert np.allclose(wall_bounce([1.0, 2.0, -4.0], [0, 0, 1.0], 0.5), [1, 2, 2])
    assert wall_bounce(
        np.zeros((4, 1, 3)), np.tile([0, 0, 1.0], (5, 1)), [0.1] * 5
    ).shape == (4, 5, 3)


def test_figures_of_a_ball_dropped_from_one_metre():
    # h = 1, e = 1/2, g = 9.81: at rest at sqrt(2 h/g) * 3 = 1.354571 s, path 5/3.
    assert bounce_rest_time(1.0, 0.5) == pytest.approx(1.354571, abs=5e-7)
    assert bounce_path_length(1.0, 0.5) == pytest.approx(5 / 3, rel=1e-15)
    first = np.sqrt(2 / 9.81)
    assert np.allclose(
        bounce_times(1.0, 0.5, 4), first * np.array([1, 2, 2.5, 2.75]), rtol=1e-15
    )


def test_times_run_to_the_rest_time():
    e = np.array([0.0, 0.2, 0.9])
    times = bounce_times(2.0, e, 2000, gravity=1.6)
    assert times.shape == (3, 2000)
    assert np.allclose(times[:, -1], bounce_rest_time(2.0, e, gravity=1.6), rtol=1e-12)
    assert np.all(np.diff(times[1:, :20]) > 0)
    assert np.allclose(
        np.diff(bounce_times(2.0, 1.0, 5)), 2 * np.sqrt(4 / 9.81)
    )  # at e = 1 for ever


def test_path_is_the_sum_of_the_rises():
    e = 0.8
    rises = 3.0 * e ** (2 * np.arange(1, 400))
    assert bounce_path_length(3.0, e) == pytest.approx(3.0 + 2 * rises.sum(), rel=1e-13)


def test_limits():
    assert (
        bounce_rest_time(1.0, 1.0) == np.inf and bounce_path_length(1.0, 1.0) == np.inf
    )
    assert bounce_rest_time(0.0, 1.0) == 0 and bounce_path_length(0.0, 1.0) == 0
    assert np.array_equal(bounce_times(1.0, 0.0, 3), np.full(3, np.sqrt(2 / 9.81)))


@pytest.mark.parametrize(
    "function, arguments, message",
    [
        (bounce_times, (-1.0, 0.5, 3), "height: expected numbers at or above 0; got -1.0"),
        (bounce_times, (1.0, 1.5, 3), "restitution: expected numbers from 0 to 1"),
        (bounce_times, (1.0, 0.5, 0), "count: expected a whole number of at least 1; got 0"),
        (bounce_times, (1.0, 0.5, 2.0), "count: expected a whole number"),
        (bounce_times, (1.0, 0.5, 3, 0.0), "gravity: expected positive numbers"),
        (bounce_times, ([1.0, 2.0], [0.5] * 3, 3), "restitution: expected a batch that broadcasts with height"),
        (wall_bounce, ([1.0, 0, 0], [0, 0, 1.01], 1.0), "normal: expected unit vectors .* got length 1.01"),
        (wall_bounce, ([1.0, 0, 0], [0, 0, 1.0], 2.0), "restitution: expected numbers from 0 to 1"),
        (wall_bounce, ([1.0, 0], [0, 0, 1.0], 1.0), "velocity: expected vectors"),
    ],
)  # fmt: skip
def test_refuses(function, arguments, message):
    with pytest.raises(ValueError, match=message):
        function(*arguments)
