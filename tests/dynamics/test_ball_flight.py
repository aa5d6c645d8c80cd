"""The dropped ball: closed form and events."""

import numpy as np
import pytest

from course.dynamics import (
    ball_events,
    ball_motion,
    bounce_path_length,
    bounce_rest_time,
    bounce_times,
)


@pytest.mark.parametrize("e", [0.0, 0.1, 0.5, 0.9, 1.0])
def test_events_follow_the_closed_form(e):
    events = ball_events(1.0, e, 3.0, rest_speed=1e-10)
    assert np.allclose(events.time, bounce_times(1.0, e, events.time.size), rtol=1e-14)
    t = np.linspace(0, 3, 2001)
    by_events, closed = events.motion(t), ball_motion(t, 1.0, e)
    assert np.allclose(by_events.height, closed.height, atol=1e-12)
    assert (
        closed.height.min() >= 0 and closed.height[0] == 1 and closed.velocity[0] == 0
    )
    resting = t > bounce_rest_time(1.0, e) + 1e-9
    assert not closed.height[resting].any() and not closed.velocity[resting].any()
    assert not by_events.height[resting].any() and not by_events.velocity[resting].any()


def test_closed_form_obeys_the_laws_of_motion():
    e = np.array([0.3, 0.8, 1.0])
    t = np.linspace(0, 1.2, 4001)[:, None]
    motion = ball_motion(t, 1.0, e)
    assert motion.height.shape == (4001, 3)
    rises = ball_motion(np.sqrt(2 / 9.81) * (1 + e), 1.0, e)  # top of the first rise
    assert np.allclose(rises.height, e**2, atol=1e-14) and np.allclose(
        rises.velocity, 0, atol=1e-14
    )
    energy = 9.81 * motion.height + 0.5 * motion.velocity**2
    assert np.all(np.diff(energy, axis=0) < 1e-12)  # never gained
    assert np.allclose(energy[:, 2], 9.81)  # kept at e = 1
    levels = np.unique(np.round(energy[t[:, 0] < 0.7, 0] / 9.81, 9))
    assert np.allclose(levels, 0.09 ** np.arange(levels.size)[::-1], atol=1e-9)


def test_path_travelled_is_that_of_the_closed_form():
    t = np.linspace(0, bounce_rest_time(1.0, 0.5), 200_001)
    travelled = np.abs(np.diff(ball_motion(t, 1.0, 0.5).height)).sum()
    assert travelled == pytest.approx(bounce_path_length(1.0, 0.5), rel=1e-4)  # 5/3


def test_infinitely_many_bounces_are_never_got_past_without_a_rest_speed():
    events = ball_events(1.0, 0.5, 3.0, max_events=40)
    assert not events.finished and events.time.size == 40
    assert (
        events.time[-1]
        < bounce_rest_time(1.0, 0.5)
        == pytest.approx(1.354571, abs=5e-7)
    )
    assert np.isnan(events.motion(2.0).height)
    cured = ball_events(
        1.0, 0.5, 3.0, rest_speed=9.81e-3
    )  # above g h for a step of 1 ms
    assert cured.finished and cured.time.size < 12
    # What is cut off is 2 s/(g (1 - e)) at most, s the rest speed.
    assert 0 < 1.354571 - cured.rest <= 2 * 9.81e-3 / (9.81 * 0.5)
    assert cured.motion(2.0).height == 0
