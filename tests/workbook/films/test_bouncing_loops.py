"""The 49 balls on the stage: published errors, and energies that are those of the pictures."""

from __future__ import annotations

import numpy as np
import pytest

from course.study import PUBLISHED_BOUNCING
from course.workbook.films.bouncing_loops import many_balls


@pytest.mark.parametrize("step", [0.001, 0.004, 0.01])
def test_the_errors_are_the_published_ones(step):
    film = many_balls().made(step=step)
    at = PUBLISHED_BOUNCING.step.tolist().index(step)
    exact, ode, bullet = film.numbers[1].values
    assert exact == 0.0
    assert ode == pytest.approx(PUBLISHED_BOUNCING.ode_error[at], rel=1e-3)
    assert bullet == pytest.approx(PUBLISHED_BOUNCING.bullet_error[at], rel=1e-3)


def test_one_loop_gains_with_every_bounce_and_the_other_wavers():
    film = many_balls().made()
    exact, ode, bullet = (
        film.charts[0].curves[name] for name in ("exact", "ODE", "Bullet")
    )
    assert exact == pytest.approx(100.0)
    assert np.abs(ode - 100).max() < 2.0
    # k m V g h too much after k bounces, over m g H, to the leading order in h.
    speed = np.sqrt(2 * 9.81 * 4.9)
    assert bullet[-1] - 100 == pytest.approx(100 * 10 * speed * 0.01 / 5, rel=0.15)
    assert film.counters["bounces"][-1] == 10


def test_the_balls_are_where_their_heights_say():
    film = many_balls().made()
    for pane, height in zip(film.panes, film.charts[1].curves.values(), strict=True):
        assert np.array_equal(pane.position[:, 0, 2], height)
    assert film.panes[0].position[:, 0, 2].min() == pytest.approx(0.1)
