"""A rod that turns toward a ball: its gap, the library's time, steps, and straight sweeps that miss."""

import numpy as np
import pytest

from course import formulas
from course.study import advancement_steps, ball_ahead, rod_time, tip_swept_straight


@pytest.mark.parametrize("degrees, distance", [(90, 0.6), (140, 1.05), (40, 0.95)])
def test_the_library_and_the_formula_meet_when_the_gap_is_0(degrees, distance):
    rod = ball_ahead(1.7, degrees, distance)
    time = rod_time(rod)
    assert rod.gap(np.array([time]))[0] == pytest.approx(0, abs=1e-6)
    assert rod.gap(np.linspace(0, time - 1e-4, 5000)).min() > 0
    found = formulas.conservative_advancement(*rod.arguments, 1e-8)
    assert found == pytest.approx(time, abs=1e-6)


def test_the_gap_is_that_to_all_points_of_the_rod():
    rod = ball_ahead(2.0, 70.0, 0.8)
    times = np.linspace(0, 1.5, 7)
    share = np.linspace(0, 1, 20_001)[:, None]
    for t, gap in zip(times, rod.gap(times), strict=True):
        points = share * rod.tip(np.array([t]))
        least = np.linalg.norm(rod.center - points, axis=-1).min() - rod.radius
        assert gap == pytest.approx(least, abs=1e-7)


def test_steps_are_those_of_the_formula_and_grow_by_a_fixed_number_for_each_digit():
    rod = ball_ahead(2.0, 90.0, 0.6)
    steps = []
    for k in (2, 4, 6, 8):
        time, count = advancement_steps(rod, 10.0**-k)
        assert time == formulas.conservative_advancement(*rod.arguments, 10.0**-k)
        steps.append(count)
    assert np.ptp(np.diff(steps)) <= 1
    out = ball_ahead(2.0, 90.0, 1.2)
    assert np.isinf(advancement_steps(out, 1e-6)[0])
    assert advancement_steps(ball_ahead(2.0, 90.0, 1.0999), 1e-8, most=20)[1] == 20


def test_a_tip_swept_straight_is_right_for_small_steps_and_misses_large_ones():
    rod = ball_ahead(2.0, 90.0, 1.05)
    time = rod_time(rod)
    assert tip_swept_straight(rod, np.radians(1) / 2) == pytest.approx(time, abs=1e-3)
    assert np.isinf(tip_swept_straight(rod, np.pi / 2)), "through the pivot"
    # Past 2 acos(0.95) the middle of a chord passes 0.1 m away from the ball.
    at = np.degrees(2 * np.arccos(0.95))
    for turn, misses in ((at - 1, False), (at + 1, True)):
        middle = ball_ahead(2.0, 2.5 * turn, 1.05)
        assert np.isinf(tip_swept_straight(middle, np.radians(turn) / 2)) == misses
