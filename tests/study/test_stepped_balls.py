"""A ball by steps and by times, against the closed forms of its flights."""

from __future__ import annotations

import numpy as np
import pytest

from course.scenes import GRAVITY
from course.study.asking import RUN_AWAY, UnusableResult
from course.study.stepped_balls import exact_ball, flown_ball, stepped_ball

pytestmark = pytest.mark.slow  # with its like, left out of --quick


@pytest.mark.parametrize("restitution", [0.5, 0.8, 1.0])
def test_steps_come_to_the_exact_ball_at_first_order(restitution):
    """A step late or early at the first impact: at most a step times the speeds before and after."""
    errors = []
    for step in (8e-3, 1e-3, 1.25e-4):
        ball = stepped_ball(1.0, restitution, step, 0.8)
        exact = exact_ball(1.0, restitution, ball.times)
        errors.append(np.abs(ball.height - exact.height).max())
    speed = np.sqrt(2 * GRAVITY)
    assert np.all(np.array(errors) < 2.5 * speed * np.array([8e-3, 1e-3, 1.25e-4]))


@pytest.mark.parametrize("restitution", [0.0, 0.5, 0.8, 1.0])
def test_flights_are_those_of_the_exact_ball(restitution):
    times = np.linspace(0.0, 1.0, 200)
    ball, hits = flown_ball(1.0, restitution, 12, times)
    assert hits[0] == pytest.approx(np.sqrt(2 / GRAVITY))
    exact = exact_ball(1.0, restitution, times)
    np.testing.assert_allclose(ball.height, exact.height, atol=1e-6)


def test_a_first_time_that_is_too_long_is_seen_in_the_floor():
    times = np.linspace(0.0, 1.0, 200)
    late, _ = flown_ball(
        1.0, 0.8, 3, times, function=lambda h, e, n, g: 0.6 + np.arange(n)
    )
    assert late.height.min() < -0.5


def test_a_ball_that_is_not_turned_round_falls_on_and_one_that_runs_away_is_left():
    def falls(x, v, h, e, g):
        return x + h * (v - g * h), v - g * h

    assert stepped_ball(1.0, 0.8, 0.01, 2.0, function=falls).height[-1] < -15
    wild = stepped_ball(
        1.0, 0.8, 0.01, 4.0, function=lambda x, v, h, e, g: (3 * x, 5 * v)
    )
    assert np.all(np.isfinite(wild.height)) and wild.height[-1] < 3.1 * RUN_AWAY


def test_what_is_no_height_and_velocity_is_said():
    with pytest.raises(UnusableResult, match="it returned one in place of 2 results"):
        stepped_ball(1.0, 0.8, 0.01, 1.0, function=lambda *given: 1.0)
