"""The boxes on the stage: gaps, impulses and what nobody asks for."""

from __future__ import annotations

import numpy as np
import pytest

from course.workbook.films.landings import COUNT, SIDE, landing_boxes


@pytest.mark.parametrize("gap", [0.1, 0.4, 0.5])
def test_no_gap_is_below_0_where_it_is_asked_for(gap):
    film = landing_boxes().made(gap=gap)
    asked, unasked = (np.array(list(c.curves.values())) for c in film.charts)
    assert asked.min() >= 0 and asked[:, -1] == pytest.approx(0.0)
    assert unasked[0] == pytest.approx(gap - 0.5 * 9.81 * film.times**2)
    assert unasked[1:] == pytest.approx(gap)
    for pane, gaps in zip(film.panes, (asked, unasked), strict=True):
        drawn = pane.segments[0]
        assert (drawn.end - drawn.start)[..., 2] == pytest.approx(gaps.T)
        bottom = pane.position[:, :COUNT, 2] - 0.5 * SIDE
        assert bottom[:, 0] == pytest.approx(gaps[0])


def test_each_impulse_is_what_stops_its_box():
    film = landing_boxes().made()
    speeds = np.sqrt(2 * 9.81 * 0.4 * np.arange(1, COUNT + 1))
    push = film.panes[0].arrows[1].vector[..., 2]
    assert push.max(axis=0) == pytest.approx(speeds)
    velocity = film.panes[0].arrows[0].vector[..., 2]
    for k in range(COUNT):
        at = int(np.argmax(push[:, k] > 0))
        assert film.times[at] == film.times[at - 1]
        assert velocity[at - 1, k] == pytest.approx(-speeds[k]) and velocity[at, k] == 0
    assert film.numbers[-1].values[0] == pytest.approx(speeds.sum())
    assert film.counters["impulses"][-1] == COUNT
