"""The dome on the stage: what is said of each angle is true of the flight itself."""

from __future__ import annotations

import numpy as np
import pytest

from course.workbook.films.dome_gaps import LAST, NAMES, dome


def flight(angle, times):
    """A parabola from the dome of 1 m at the speed sqrt(2 g (1 - cos)), written out here."""
    phi, g = np.radians(angle), 9.81
    v = np.sqrt(2 * g * (1 - np.cos(phi)))
    y = np.sin(phi) + v * np.cos(phi) * times
    z = np.cos(phi) - v * np.sin(phi) * times - 0.5 * g * times**2
    return y, z


@pytest.mark.parametrize("angle", range(5, 71))
@pytest.mark.slow
def test_the_words_are_true_at_every_angle(angle):
    said = dome().made(angle=float(angle)).ending
    times = np.geomspace(1e-6, LAST, 20_000)
    y, z = flight(angle, times)
    gap = np.hypot(y, z) - 1
    out = np.flatnonzero(gap[np.argmin(gap) :] >= 0)
    if gap.min() > -1e-12:
        assert "parts from the dome" in said and angle > 48.19
    else:
        assert "sinks into the dome" in said and angle < 48.19
        size = said.split("sinks into the dome, ")[1].split(" mm")[0]
        if size == "less than 0.001":
            assert -1000 * gap.min() < 0.001
        else:
            assert float(size) == pytest.approx(-1000 * gap.min(), rel=0.06)
        assert ("still in it" in said) == (out.size == 0)
    if "out of it" in said:
        late = float(said.split("again after ")[1].split(" ms")[0])
        assert late == pytest.approx(1000 * times[np.argmin(gap) + out[0]], rel=0.06)
    old = y - np.sin(np.radians(angle)), z - np.cos(np.radians(angle))
    from_old = (old[0] * y + old[1] * z) / np.hypot(y, z)
    # The first moment at which rounding cannot decide.
    assert (from_old[np.searchsorted(times, 1e-4)] > 0) == ("grows at once" in said)


@pytest.mark.parametrize("angle", [5.0, 42.0, 60.0])
def test_segments_are_as_long_as_the_gaps_and_lie_where_they_are_measured(angle):
    film = dome().made(angle=angle)
    lines = {s.name: s for s in film.panes[0].segments}
    for name in NAMES:
        measured = np.linalg.norm(lines[name].end - lines[name].start, axis=-1)[:, 0]
        assert 1000 * measured == pytest.approx(
            np.abs(film.charts[0].curves[name]), abs=1e-9
        )
    foot = np.linalg.norm(lines[NAMES[0]].start, axis=-1)
    assert foot == pytest.approx(1.0)
    y, z = flight(angle, film.times)
    assert film.panes[0].position[:, 2, 1] == pytest.approx(y)
    assert film.panes[0].position[:, 2, 2] == pytest.approx(z)


def test_key_numbers_are_the_second_rates_of_the_gaps():
    film = dome().made(angle=42.0)
    t = film.times[:9]
    for name, number in zip(NAMES, film.numbers[1:], strict=True):
        fitted = np.polyfit(t, 1e-3 * film.charts[0].curves[name][:9], 5)
        assert 2 * fitted[-3] == pytest.approx(number.values[0], rel=1e-3)
