"""The break on the stage: balances, balls that do not overlap, and which laws keep the symmetry."""

from __future__ import annotations

import numpy as np
import pytest

from course.scenes import POOL_RADIUS
from course.workbook.films.break_laws import (
    MEETING,
    SPEED,
    _from_mirror,
    billiard_break,
)


@pytest.fixture(scope="module")
def film():
    return billiard_break().made()


def test_no_ball_overlaps_another_in_any_pane(film):
    i, j = np.triu_indices(16, 1)
    for pane in film.panes:
        place = pane.position[:, :16]
        apart = np.linalg.norm(place[:, i] - place[:, j], axis=-1)
        assert apart.min() > 2 * POOL_RADIUS * (1 - 1e-6)


def test_places_are_those_that_velocities_add_up_to(film):
    for pane in film.panes:
        moved = np.diff(pane.position[:, :16], axis=0)
        velocity = pane.arrows[0].vector[:-1]
        assert moved == pytest.approx(
            np.diff(film.times)[:, None, None] * velocity, abs=1e-8
        )


def test_momentum_is_kept_by_the_break_and_energy_throughout(film):
    k = int(np.argmax(film.times > MEETING))
    for pane in film.panes:
        total = pane.arrows[0].vector[k].sum(axis=0)
        assert total == pytest.approx([SPEED, 0.0, 0.0], abs=1e-9)
    for energy in film.charts[0].curves.values():
        assert energy == pytest.approx(0.5 * 0.17 * SPEED**2)


def test_which_laws_break_symmetrically_is_what_the_answer_says(film):
    values = {n.name: n.values for n in film.numbers}
    odd = values["velocities off mirror image"]
    assert odd[0] == odd[2] == 0.0 and odd[1] > 1.0
    assert (
        film.ending == "Symmetric: simultaneous, reflection; not symmetric: sequential"
    )
    assert np.all(film.charts[1].curves["simultaneous"] < 1e-3)


def test_the_mirror_image_of_a_triangle_of_three():
    symmetric = np.array([[-1, 0, 0], [0, 0, 0], [1, -0.5, 0], [1, 0.5, 0.0]])
    assert _from_mirror(symmetric) == 0.0
    symmetric[3, 1] += 0.1
    assert _from_mirror(symmetric) == pytest.approx(0.1)
