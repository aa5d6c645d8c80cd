"""The cradle on the stage: balls that never overlap, balances, and who goes out."""

from __future__ import annotations

import numpy as np
import pytest

from course import formulas
from course.contact.collisions import LAWS
from course.study.cradle_swings import by_impulses, swinging_cradle
from course.workbook.films.cradle_laws import cradle


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("restitution", [0.0, 0.6, 1.0])
@pytest.mark.parametrize("coming", [1, 2, 3])
@pytest.mark.slow
def test_balls_keep_their_order_and_momentum(coming, restitution, law):
    motion = swinging_cradle(5, coming, restitution, law=law)
    rows = motion.velocity
    for k in range(1, len(rows)):
        arriving = rows[0] if k == 1 else -rows[k - 1]
        assert rows[k].sum() == pytest.approx(arriving.sum())
        lost = np.sum(arriving**2) - np.sum(rows[k] ** 2)
        assert lost > -1e-12
        assert restitution < 1 or lost == pytest.approx(0.0, abs=1e-12)
        half = motion.half_period
        time = np.linspace(half * (k - 0.5), half * (k + 0.5), 50)
        shift, _ = motion.at(time, np.full(50, k))
        assert np.all(np.diff(shift, axis=1) >= -1e-9)


def test_a_swing_is_that_of_a_small_pendulum():
    """x'' = -(g/l) x between two collisions, and the velocity is the rate of x."""
    motion = swinging_cradle(5, 1, 1.0, law="sequential", length=0.7)
    time, h = np.linspace(0.8, 1.1, 7) * motion.half_period, 1e-4
    one = np.full(7, 1)
    (before, _), (here, speed), (later, _) = (
        motion.at(time + s, one) for s in (-h, 0.0, h)
    )
    assert (later - before) / (2 * h) == pytest.approx(speed, abs=1e-6)
    pull = (later - 2 * here + before) / h**2
    assert pull == pytest.approx(-9.81 / 0.7 * here, abs=1e-4)
    assert motion.at(np.zeros(1), np.zeros(1, dtype=int))[1] == pytest.approx(0.0)


def test_who_goes_out_is_what_the_answer_says():
    film = cradle().made()
    after = np.array([n.values for n in film.numbers[:5]]).T / 0.8
    assert after[0] == pytest.approx([-0.6, 0.4, 0.4, 0.4, 0.4])
    for row in after[1:]:
        assert row == pytest.approx([0, 0, 0, 0, 1.0], abs=1e-9)
    assert "simultaneous, 4 forward and 1 back" in film.ending
    assert "sequential, 1 forward;" in film.ending
    assert film.counters["collisions"][-1] == 4
    assert film.charts[1].curves["reflection"] == pytest.approx(100.0)


def test_all_stay_together_where_nothing_bounces():
    film = cradle().made(restitution=0.0)
    for number in film.numbers[:5]:
        assert number.values == pytest.approx((0.16,) * 3)


@pytest.mark.parametrize("restitution", [0.0, 0.6, 1.0])
@pytest.mark.parametrize("coming", [1, 2, 3])
@pytest.mark.slow
def test_impulses_of_the_formula_swing_as_the_simultaneous_law_does(
    coming, restitution
):
    law = by_impulses(formulas.simultaneous_impulses, restitution)
    found = swinging_cradle(5, coming, restitution, law=law)
    right = swinging_cradle(5, coming, restitution, law="simultaneous")
    assert found.velocity == pytest.approx(right.velocity, abs=1e-12)
