"""The handle in space: what is shown is the exact motion, and what it says is true of it."""

from __future__ import annotations

import numpy as np
import pytest

from course import rotations
from course.dynamics import free_tumble
from course.scenes import handle_mass_properties, spinning_handle
from course.workbook.films.tumbling import (
    KNOBS,
    LONGEST,
    PRESETS,
    WINDOW,
    handle,
    handle_film,
)

ENDS = [
    {"axis": axis, "tilt": tilt, "spin": spin}
    for axis in (1, 2, 3)
    for tilt in (0.01, 50.0)
    for spin in (1.0, 12.0)
]  # fmt: skip


@pytest.fixture(scope="module")
def films():
    return [(values, handle().made(**values)) for values in ENDS]


def lines(film, name):
    return next(a for a in film.panes[0].arrows if a.name == name)


def test_the_knobs_end_where_the_films_were_made():
    assert {k.name: (k.low, k.high) for k in KNOBS} == {
        "axis": (1, 3), "tilt": (0.01, 50.0), "spin": (1.0, 12.0)
    }  # fmt: skip


@pytest.mark.slow
def test_L_stands_still_and_energy_is_kept_at_every_knobs_ends(films):
    moments = np.diag(handle_mass_properties().inertia)
    for values, film in films:
        momentum = np.asarray(lines(film, "L").vector)
        size = moments[values["axis"] - 1] * values["spin"]
        expected = np.broadcast_to([0.0, 0.0, size], momentum.shape)
        assert momentum == pytest.approx(expected, abs=1e-12)
        energy = np.sum(list(film.charts[0].curves.values()), axis=0)
        assert energy == pytest.approx(energy[0], rel=1e-9)
        assert (
            0.5 * film.charts[0].limits[1] < 1.02 * energy[0] < film.charts[0].limits[1]
        )
        omega = np.asarray(lines(film, "ω").vector)[:, 0]
        assert 500 * omega @ [0, 0, size] == pytest.approx(
            energy
        )  # T = L.omega/2, in mJ


def test_omega_turns_the_handle_that_is_shown(films):
    """The turn from moment to moment is omega times the time between, to second order."""
    for values, film in films:
        if values["spin"] > 1.0:
            continue
        q = np.asarray(film.panes[0].orientation)[:, 0]
        omega = np.asarray(lines(film, "ω").vector)[:, 0]
        step = np.diff(film.times)[:, None]
        later = rotations.turned(q[:-1], step * 0.5 * (omega[:-1] + omega[1:]))
        off = rotations.angle_between(
            rotations.to_matrix(later), rotations.to_matrix(q[1:])
        )
        assert off.max() < 2e-4


def test_everything_stays_in_the_window(films):
    low, high = np.array(WINDOW)
    for _, film in films:
        for name in ("L", "ω"):
            a = lines(film, name)
            drawn = a.scale * np.linalg.norm(a.vector, axis=-1)
            assert 0.3 * LONGEST < drawn.max() <= LONGEST * (1 + 1e-12)
        tip = np.asarray(film.panes[0].position)[:, 1]
        assert (
            np.abs(tip[:, :2]).max() < np.hypot(high[0], high[1])
            and tip[:, 2].min() > low[2]
        )


def test_what_the_ending_says_is_what_happens(films):
    for values, film in films:
        q = np.asarray(film.panes[0].orientation)[:, 0]
        axis = rotations.to_matrix(q)[:, :, values["axis"] - 1]
        turned_over = int(np.sum(np.diff(np.sign(axis[:, 2])) != 0))
        assert ("turns over" in film.ending) == (turned_over > 0)
        assert len(film.events) == turned_over
        if not turned_over:
            lean = np.degrees(np.arccos(axis[:, 2].min()))
            assert f"leans at most {lean:.3g}°" in film.ending


def test_only_the_middle_axis_turns_over_from_a_small_tilt():
    exhibit = handle()
    endings = [exhibit.made(**preset.values).ending for preset in PRESETS]
    assert ["turns over" in e for e in endings] == [False, True, False]
    assert "1.56, 4.68, 7.80 s" in endings[1]


def test_without_arrows_there_is_only_the_handle():
    motion = free_tumble(spinning_handle().bodies, np.linspace(0.0, 2.0, 21))
    film = handle_film(motion, arrows=False, about=None, caption="It turns.")
    assert (
        film.panes[0].arrows == () and film.charts == () and film.caption == "It turns."
    )
