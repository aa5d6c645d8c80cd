"""The ladder on the stage: where it lets go, energy, and gaps that never close."""

from __future__ import annotations

import numpy as np
import pytest

from course.study.ladder_slides import ladder_slide
from course.workbook.films.sliding_ladders import ladder


@pytest.mark.parametrize("start", [40.0, 65.0, 85.0])
@pytest.mark.parametrize("held", [False, True])
def test_energy_is_kept_until_it_lies(start, held):
    slide = ladder_slide(np.radians(start), held=held, frames=2001)
    up = slide.time <= slide.lying
    dy, dz = np.gradient(slide.centre, slide.time, axis=0).T
    # Finite differences are good inside each of the two ways of moving.
    inside = up & (np.abs(slide.time - slide.leaving) > 0.01)
    inside &= (slide.time > 0.01) & (slide.time < slide.lying - 0.01)
    moving = 0.5 * (dy**2 + dz**2) + 0.5 * 16 / 12 * slide.rate**2
    total = (moving + 9.81 * slide.centre[:, 1])[inside]
    assert total == pytest.approx(9.81 * 2 * np.sin(np.radians(start)), rel=2e-4)


@pytest.mark.parametrize("start", [40.0, 65.0, 85.0])
def test_it_lets_go_where_the_force_is_0_and_keeps_its_speed_away_from_the_wall(start):
    slide = ladder_slide(np.radians(start), duration=2.1)
    at = slide.time.tolist().index(slide.leaving)
    assert np.sin(slide.angle[at]) == pytest.approx(2 / 3 * np.sin(np.radians(start)))
    assert slide.force[at, 1] == pytest.approx(0.0, abs=1e-6)
    assert np.all(slide.force[: at - 1, 1] > 0)
    assert np.nanmin(slide.force[:, 0]) > 0
    assert slide.gap.min() > -1e-9 and slide.gap[-1, 1] > 0.05
    flying = (slide.time >= slide.leaving) & (slide.time <= slide.lying)
    rate = np.diff(slide.centre[flying, 0]) / np.diff(slide.time[flying])
    assert rate == pytest.approx(rate[0], rel=1e-6)


@pytest.mark.parametrize("start", [40.0, 65.0, 85.0])
def test_forces_are_those_that_move_the_centre(start):
    slide = ladder_slide(np.radians(start), frames=4001)
    time, h = slide.time, 0.02
    for t in (0.5 * slide.leaving, 0.5 * (slide.leaving + slide.lying)):
        near = np.abs(time - t) < h
        y, z = (np.polyfit(time[near] - t, c, 4)[2] * 2 for c in slide.centre[near].T)
        floor, wall = (np.interp(t, time, f) for f in slide.force.T)
        assert 10 * y == pytest.approx(-wall, abs=1e-3)
        assert 10 * (z + 9.81) == pytest.approx(floor, abs=1e-3)


def test_what_is_said():
    film = ladder().made(start=65.0)
    assert film.ending.startswith(
        "Let go at 65° the ladder leaves the wall at 37.2° after 0.74 s;"
    )
    values = {n.name: n.values for n in film.numbers}
    assert values["sin θ there / at the start"][0] == pytest.approx(2 / 3)
    free, held = values["least force of the wall"]
    assert free == 0.0 and held < -100
    # The arrow of a wall that pulls points into the wall.
    pull = film.panes[1].arrows[1].vector[..., 1].max()
    assert pull == pytest.approx(-held, rel=0.02)
