"""Sweeps through a stack: each step by hand, the factor measured, the endings true."""

from __future__ import annotations

import numpy as np
import pytest

from course.study.swept_stacks import swept_stack
from course.workbook.films.sweeping import KNOBS, PRESETS, SWEEPS, longest, sweeps

START = {k.name: k.value for k in KNOBS}
CASES = [START | {k.name: end} for k in KNOBS for end in (k.low, k.high)]
CASES += [p.values for p in PRESETS]


def test_the_right_forces_carry_what_stands_above():
    found = swept_stack(4, 7.0, 1.0, 1)
    assert found.truth == pytest.approx(9.81 * np.array([10.0, 9.0, 8.0, 7.0]))


def found_for(values):
    return swept_stack(
        int(values["count"]), values["top"], values["relaxation"], SWEEPS
    )


@pytest.mark.parametrize("values", CASES)
def test_each_step_sets_one_contact_from_its_neighbours(values):
    """d_ddot_k = f_k (1/m_k + 1/m_k-1) - f_k-1/m_k-1 - f_k+1/m_k + b_k, with b only at the ground."""
    found = found_for(values)
    n, r = int(values["count"]), values["relaxation"]
    inverse = np.r_[
        0.0, 1 / np.r_[np.ones(n - 1), values["top"]]
    ]  # below, then each box
    for step in (1, 2, n, n + 1, 7 * n + 2, SWEEPS * n):
        k, f = (step - 1) % n, found.path[step - 1]
        w = f[k] * (inverse[k] + inverse[k + 1]) - (9.81 if k == 0 else 0.0)
        w -= (f[k - 1] * inverse[k] if k else 0.0) + (
            f[k + 1] * inverse[k + 1] if k + 1 < n else 0.0
        )
        expected = f.copy()
        expected[k] = max(0.0, f[k] - r * w / (inverse[k] + inverse[k + 1]))
        assert found.path[step] == pytest.approx(expected, rel=1e-9, abs=1e-9)


def test_the_factor_is_the_one_that_is_seen():
    found = swept_stack(6, 1.0, 1.0, SWEEPS)
    off = np.linalg.norm(found.path[::6] - found.truth, axis=1)
    assert off[-1] / off[-2] == pytest.approx(found.factor, rel=1e-3)
    # D^-1/2 A D^-1/2 has the off-diagonals 1/sqrt(2), 1/2, 1/2, ...: Chebyshev's.
    assert found.factor == pytest.approx(np.cos(np.pi / 12) ** 2, rel=1e-9)


@pytest.mark.parametrize("values", CASES)
def test_the_film_shows_the_path_and_its_ending_is_true(values):
    film, found = sweeps().made(**values), found_for(values)
    n = int(values["count"])
    force, right = film.panes[0].arrows
    assert np.asarray(force.vector)[:, :, 2] == pytest.approx(found.path)
    assert np.asarray(right.vector)[0, :, 2] == pytest.approx(found.truth)
    assert force.scale == right.scale
    assert 0.2 < right.scale * found.truth.max() / longest(n) <= 1
    tips = np.asarray(right.at)[0] + right.scale * np.asarray(right.vector)[0]
    _, _, far, top = film.view.window
    assert tips[:, 0].max() < far and tips[:, 2].max() <= top
    off = np.abs(found.path[::n] / found.truth - 1).max(axis=1)
    if "still" in film.ending:
        assert off[-1] > 0.01
    else:
        done = int(film.ending.split("r = ")[1].split(", ")[1].split()[0])
        assert np.all(off[done:] <= 0.01) and off[done - 1] > 0.01
    assert film.times[-1] == SWEEPS


def test_twelve_are_not_done_unless_they_look_ahead():
    labels = {p.label: sweeps().made(**p.values).ending for p in PRESETS}
    assert (
        "still" in labels["twelve"] and "still" not in labels["twelve, looking ahead"]
    )
    assert (
        "still" in labels["a heavy one on top"]
        and "still" not in labels["a light one on top"]
    )
