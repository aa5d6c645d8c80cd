"""The rod on the stage: closed forms, balances, and a peg that is never inside the rod."""

from __future__ import annotations

import numpy as np
import pytest

from course.workbook.films.rod_impacts import HALF, MEETING, SPEED, rod


def values(film):
    return {n.name: n.values[0] for n in film.numbers}


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("angle", [0.0, 25.0, 60.0])
@pytest.mark.parametrize("place", [-1.0, -0.3, 0.0, 0.5, 1.0])
def test_impulse_and_energy_are_those_of_the_closed_form(place, angle, restitution):
    film = rod().made(place=place, angle=angle, restitution=restitution)
    felt = 1 / (1 + 3 * (place * np.cos(np.radians(angle))) ** 2)
    said = values(film)
    assert said["mass felt there"] == pytest.approx(felt)
    assert said["impulse p̂"] == pytest.approx((1 + restitution) * felt * SPEED)
    lost = 0.5 * felt * SPEED**2 * (1 - restitution**2)
    assert 100 - said["energy kept"] == pytest.approx(100 * lost / 0.5)
    energy = film.charts[1].curves
    assert energy["lost"][-1] == pytest.approx(lost, abs=1e-12)
    assert sum(energy.values()) == pytest.approx(0.5)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("angle", [0.0, 30.0, 60.0])
@pytest.mark.parametrize("place", np.linspace(-1, 1, 9))
@pytest.mark.slow
def test_the_rod_touches_the_peg_at_the_meeting_and_is_over_it_at_all_other_times(
    place, angle, restitution
):
    film = rod().made(place=place, angle=angle, restitution=restitution)
    pane = film.panes[0]
    ends = pane.arrows[0].at
    peg = pane.position[:, 1] + [0, 0, 0.018]
    along = (ends[:, 2] - ends[:, 0]) / (2 * HALF)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = (peg[:, 0] - ends[:, 1, 0]) / along[:, 0]
    height = ends[:, 1, 2] + at * along[:, 2] - peg[:, 2]
    over = np.abs(at) <= HALF
    assert np.all(height[over] > -1e-9)
    meeting = film.times == MEETING
    assert meeting.sum() == 2
    touching = ends[meeting, 1] + HALF * place * along[meeting]
    assert touching == pytest.approx(peg[meeting])


@pytest.mark.parametrize("place", [-0.7, 1.0])
def test_velocities_are_the_rates_of_the_places(place):
    film = rod().made(place=place, angle=20.0)
    at, velocity, times = (
        film.panes[0].arrows[0].at,
        film.panes[0].arrows[0].vector,
        film.times,
    )
    even = np.diff(times) > 1e-9
    rate = np.diff(at, axis=0)[even] / np.diff(times)[even][:, None, None]
    middle = 0.5 * (velocity[1:] + velocity[:-1])[even]
    assert rate == pytest.approx(middle, abs=5e-3)


def test_the_answer_and_the_words():
    film = rod().made()
    assert values(film)["impulse p̂"] == pytest.approx(0.5)
    assert film.ending == (
        "After 0.5 N s the middle goes on down with 0.50 m/s and the rod turns with 3.00 rad/s, against the clock"
    )
    ends = film.panes[0].arrows[0].at[-1]
    # Hit under its right end: that end is up, the other one down.
    assert ends[2, 2] > ends[0, 2]
    level = rod().made(place=0.0, restitution=0.0)
    assert (
        level.ending == "After 1 N s the middle stands still and the rod does not turn"
    )
