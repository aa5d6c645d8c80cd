"""Bar and plank on the stage: the rate is that of the gap, and bodies never overlap."""

from __future__ import annotations

import numpy as np
import pytest

from course.scenes.moving_pairs import BAR, HALF_THICKNESS, PLANK
from course.study import gap_rate as rates_now
from course.study.gap_motions import first_touch, gap_motion
from course.workbook.films.gap_rates import LAST, PRESETS, gap_rate


def drawn(seed):
    rng = np.random.default_rng(seed)
    return rng.uniform(-1.5, 1.5, 2), rng.uniform(-1.5, 1.5, 2)


@pytest.mark.parametrize("seed", range(20))
def test_the_parts_add_up_to_the_rate_of_the_gap(seed):
    rates, lifts = drawn(seed)
    times = np.linspace(0, 0.4, 9)
    h = 1e-5
    later, before = (gap_motion(rates, lifts, times + s).gap for s in (h, -h))
    total = sum(gap_motion(rates, lifts, times).parts.values())
    assert total == pytest.approx((later - before) / (2 * h), abs=1e-8)
    here = gap_motion(rates, lifts, [0.0])
    now = rates_now(*rates, *lifts)
    assert {n: p[0] for n, p in here.parts.items()} == pytest.approx(now.parts)
    assert here.velocity[0] == pytest.approx(now.velocity)


def corners(half, centre, turn):
    y, z = np.meshgrid(np.linspace(-half, half, 81), [-HALF_THICKNESS, HALF_THICKNESS])
    c, s = np.cos(turn), np.sin(turn)
    return np.stack([c * y - s * z + centre[1], s * y + c * z + centre[2]], axis=-1)


@pytest.mark.parametrize("seed", range(20))
def test_neither_body_is_in_the_other_before_or_at_the_touch(seed):
    rates, lifts = drawn(seed)
    touching, corner = first_touch(rates, lifts, LAST)
    times = np.linspace(0, LAST, 26)
    m = gap_motion(rates, lifts, times, touching=touching, corner=corner)
    halves = (BAR, PLANK)
    for k in range(len(times)):
        for one, other in ((0, 1), (1, 0)):
            away = corners(halves[one], m.centre[k, one], m.turn[k, one])
            away = away - m.centre[k, other, 1:]
            c, s = np.cos(m.turn[k, other]), np.sin(m.turn[k, other])
            y, z = (
                c * away[..., 0] + s * away[..., 1],
                c * away[..., 1] - s * away[..., 0],
            )
            deep = np.minimum(halves[other] - np.abs(y), HALF_THICKNESS - np.abs(z))
            assert deep.max() < 1e-5


def test_the_end_is_told_as_it_is():
    closes = gap_rate().made(rate_a=1.5, velocity_a=-1.5, rate_b=0.0)
    assert "A's corner is on B" in closes.ending
    assert closes.charts[0].curves["gap d"][-1] == pytest.approx(0.0, abs=1e-6)
    other = gap_rate().made(rate_a=-1.0, velocity_a=-1.5, rate_b=1.5, velocity_b=1.0)
    assert "B's end is on A" in other.ending and other.charts[0].curves["gap d"][-1] > 0
    film = gap_rate().made(**PRESETS[3].values)
    rises, *_, rate = (n.values[0] for n in film.numbers)
    assert rises == 0.5 and rate < 0


def test_a_hand_moves_the_tip_that_it_holds():
    """A knob grows by so much that the arrow's tip follows the hand."""
    exhibit = gap_rate()
    first = exhibit.made()
    for hand in exhibit.hands:
        ((name, direction),) = hand.knobs.items()
        change = 0.1 * np.array([0.0, 0.0, 1.0]) @ np.asarray(direction)
        film = exhibit.made(**{name: exhibit.values[name] + change})
        tips = [
            next(a for a in f.panes[0].arrows if a.name == hand.arrows).vector[
                0, hand.index
            ]
            for f in (first, film)
        ]
        assert tips[1][2] - tips[0][2] == pytest.approx(0.1)


def test_the_answer_to_the_question():
    """At first neither centre moves and the gap closes; by key 4 it does so while A's centre rises."""
    values = dict(gap_rate().values)
    assert values["velocity_a"] == values["velocity_b"] == 0
    closes = [values, PRESETS[3].values]
    for v in closes:
        now = rates_now(v["rate_a"], v["rate_b"], v["velocity_a"], v["velocity_b"])
        assert sum(now.parts.values()) < 0
    assert PRESETS[3].values["velocity_a"] > 0
