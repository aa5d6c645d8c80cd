"""The two blocks on the stage: counts that are digits of pi, places that never overlap."""

from __future__ import annotations

import numpy as np
import pytest

from course.dynamics import pi_count
from course.workbook.films.block_collisions import SMALL, two_blocks


@pytest.mark.parametrize("exponent", [0, 1, 2])
def test_the_counter_ends_at_the_digits_of_pi(exponent):
    film = two_blocks().made(mass_ratio=100**exponent)
    counted = film.counters["collisions"]
    assert counted[0] == 0 and counted[-1] == pi_count(exponent)
    assert set(np.diff(counted)) == {0, 1}
    assert film.ending.startswith(f"After {pi_count(exponent)} collisions")


@pytest.mark.parametrize("mass_ratio", [1.0, 1.7, 20.0, 100.0, 10_000.0])
def test_blocks_and_wall_never_overlap_and_the_point_stays_on_its_circle(mass_ratio):
    film = two_blocks().made(mass_ratio=mass_ratio)
    places = film.charts[1].curves
    one, two = places["block 1"], places["block 2"]
    assert np.all(one >= -1e-12) and np.all(two >= one - 1e-12)
    drawn = film.panes[0].position[:, 0, 0]
    assert drawn == pytest.approx(one + SMALL)
    path = film.charts[0]
    assert np.hypot(path.x, path.y) == pytest.approx(1.0)
    # At rest from each other: right of v1 = 0 and left of v1 = v2.
    theta = np.arctan(1 / np.sqrt(mass_ratio))
    assert -1e-9 <= path.x[-1] <= np.tan(theta) * path.y[-1] + 1e-9


def test_places_are_those_that_velocities_add_up_to():
    film = two_blocks().made(mass_ratio=100)
    velocity = film.panes[0].arrows[0].vector[:-1, :, 0]
    moved = np.diff(film.panes[0].position[:, :2, 0], axis=0)
    assert moved == pytest.approx(np.diff(film.times)[:, None] * velocity)


def test_a_last_graze_after_the_film_is_said():
    """Just above the ratio 3 there is a sixth collision, very late."""
    film = two_blocks().made(mass_ratio=3.0001)
    assert film.times[-1] == 10.0 and film.counters["collisions"][-1] == 5
    assert film.ending.startswith("After 6 collisions, the last of them, a graze,")
