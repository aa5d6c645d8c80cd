"""A bullet and a wall: looks that see it and looks that do not, and where the sweep stops it."""

import numpy as np
import pytest

from course import formulas
from course.study import (
    by_looking,
    by_sweeping,
    enough_looks,
    look_places,
    passing_share,
    thrown,
)
from course.study.wall_shots import END, RADIUS, START, THICKNESS

TIMES = np.linspace(0, (END - START) / 900, 61)


@pytest.mark.parametrize("before", [0.0, 0.3, 0.8])
@pytest.mark.parametrize("rate", [60.0, 700.0])
def test_looks_are_evenly_spaced_and_one_is_where_it_was_asked_for(before, rate):
    places, way = look_places(900.0, rate, before), 900.0 / rate
    assert np.diff(places) == pytest.approx(way)
    assert np.abs(places + RADIUS + before * way).min() < 1e-9
    assert START - 1e-9 <= places[0] and places[-1] < END


@pytest.mark.parametrize(
    "before, seen", [(0.5, False), (0.999, True), (0.994, True), (0.98, False)]
)
def test_it_is_seen_where_a_look_falls_on_the_wall(before, seen):
    shot = by_looking(900.0, 60.0, before, TIMES)
    assert np.isfinite(shot.stop) == seen
    assert shot.x[-1] == (shot.place if seen else END)
    if seen:
        assert -RADIUS <= shot.place <= THICKNESS + RADIUS


@pytest.mark.parametrize("speed, rate", [(900.0, 60.0), (30.0, 30.0), (1200.0, 1e4)])
def test_the_sweep_stops_it_at_the_wall(speed, rate):
    times = np.linspace(0, (END - START) / speed, 61)
    for before in np.linspace(0, 1, 7):
        shot = by_sweeping(speed, rate, before, times)
        assert shot.place == pytest.approx(-RADIUS, abs=1e-9)
        assert shot.stop == pytest.approx((-RADIUS - START) / speed)


def test_the_share_that_passes_is_the_formula_s():
    """Of 2,000: within four standard errors."""
    rates = np.array([60.0, 600.0, 3000.0, 8000.0, 9000.0])
    said = formulas.miss_probability(THICKNESS, RADIUS, 900.0, 1 / rates)
    found = passing_share(900.0, rates)
    assert np.all(np.abs(found - said) <= 4 * np.sqrt(said * (1 - said) / 2000) + 1e-12)


def test_thrown_balls_stop_where_they_touch():
    times = np.linspace(0, 2, 41)
    start, v, w = (
        np.array([-2.5, -0.4, 0]),
        np.array([2.0, 0.1, 0]),
        np.array([0, 0.2, 0]),
    )
    throw = thrown(start, v, w, times)
    assert 0 < throw.stop < 2 and throw.gap[-1] == pytest.approx(0, abs=1e-12)
    assert np.all(throw.gap[times < throw.stop] > 0)
    past = thrown(start, v, 5 * w, times)
    assert np.isinf(past.stop) and past.gap.min() > 0


@pytest.mark.parametrize("speed", [30.0, 900.0])
def test_enough_looks_are_just_enough(speed):
    rate = enough_looks(speed)
    some, none = passing_share(speed, np.array([0.95, 1.001]) * rate)
    assert some > 0 == none
