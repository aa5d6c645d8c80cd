"""The impact on the stage: its numbers against closed forms, and what the printed line does."""

from __future__ import annotations

import numpy as np
import pytest

from course.study.meeting_on_a_line import central_motion, printed_law
from course.workbook.films.central_impacts import KNOBS, WINDOW, impulse

RIGHT = {"mass_1": 1.0, "mass_2": 2.0, "velocity_1": -2.0, "velocity_2": 2.0}


def gap(motion):
    """Between the surfaces, at each moment [m]."""
    return motion.position[:, 0] - motion.position[:, 1] - motion.radius.sum()


def draw(rng):
    mass_1, mass_2 = 10.0 ** rng.uniform(-2, 2, 2)
    v1, v2 = rng.uniform(-4, 4, 2)
    return mass_1, mass_2, v1, v2, rng.uniform(0, 1)


@pytest.mark.parametrize("seed", range(40))
def test_balls_meet_keep_momentum_and_part_by_e(seed):
    m1, m2, v1, v2, e = draw(np.random.default_rng(seed))
    motion = central_motion(m1, m2, v1, v2, e)
    assert motion.velocity[-1] @ motion.mass == pytest.approx(m1 * v1 + m2 * v2)
    assert np.all(gap(motion) >= -1e-12)
    u, parted = v1 - v2, motion.velocity[-1, 0] - motion.velocity[-1, 1]
    assert parted == pytest.approx(-e * u if u < 0 else u)
    mu = m1 * m2 / (m1 + m2)
    lost = 0.5 * mu * (1 - e**2) * u**2 if u < 0 else 0.0
    assert motion.lost == pytest.approx(lost, abs=1e-12 * mu * u**2)
    if u < 0:
        assert gap(motion)[1] == pytest.approx(0.0, abs=1e-12)


def test_as_printed_they_pass_through_each_other_and_lose_the_same_energy():
    """The sign of e does not show in the energy, (1 - e^2) mu u^2 / 2."""
    right = central_motion(**RIGHT, restitution=0.8)
    wrong = central_motion(**RIGHT, restitution=0.8, law=printed_law)
    assert gap(wrong)[-1] < -0.5
    assert wrong.lost == pytest.approx(right.lost)
    nothing = central_motion(**RIGHT, restitution=1.0, law=printed_law)
    assert nothing.velocity[-1].tolist() == [-2.0, 2.0]


def test_a_law_is_not_asked_of_balls_that_part():
    def never(*given):
        raise AssertionError("asked")

    motion = central_motion(1, 1, 1.0, -1.0, 0.5, law=never)
    assert motion.impulse == 0.0 and motion.meeting == np.inf


def test_a_law_that_gives_no_single_number_is_named():
    with pytest.raises(ValueError, match=r"shape \(3,\) in place of one number"):
        central_motion(**RIGHT, restitution=1.0, law=lambda *given: np.ones(3))


@pytest.mark.parametrize("end", ["low", "high"])
@pytest.mark.parametrize("knob", [k.name for k in KNOBS])
def test_the_film_can_be_made_at_both_ends_of_every_knob(knob, end):
    exhibit = impulse("printed")
    value = next(getattr(k, end) for k in KNOBS if k.name == knob)
    film = exhibit.made(**{knob: value})
    assert len(film.panes) == 2 and film.view.window == WINDOW


def test_a_function_of_ones_own_plays_beside_the_right_one():
    film = impulse(lambda m1, m2, v1, v2, n, e: 2.0).made()
    assert [p.title for p in film.panes][1] == "your function"
    assert film.numbers[0].values == pytest.approx((4.8, 2.0))


def test_momenta_and_the_speed_of_parting_are_the_same_impact():
    from course import formulas
    from course.study.meeting_on_a_line import (
        by_momenta,
        by_separation_speed,
        printed_speed,
    )

    right = central_motion(**RIGHT, restitution=0.8)
    for outcome in (
        by_momenta(formulas.momentum_after),
        by_separation_speed(formulas.separation_speed),
    ):
        same = central_motion(**RIGHT, restitution=0.8, outcome=outcome)
        np.testing.assert_allclose(same.velocity, right.velocity, atol=1e-14)
        assert same.lost == pytest.approx(right.lost)
    wrong = central_motion(
        **RIGHT, restitution=0.8, outcome=by_separation_speed(printed_speed)
    )
    assert gap(wrong)[-1] < -0.5


def test_momenta_off_the_line_are_seen_off_it():
    from course.study.meeting_on_a_line import by_momenta

    def all_alike(p1, p2, impulse, normal):
        return p1 + impulse, p2 - impulse

    motion = central_motion(**RIGHT, restitution=0.8, outcome=by_momenta(all_alike))
    assert motion.aside == pytest.approx([4.8, -2.4])


def test_the_answer_to_the_question():
    """Of the film that stands there at first, and with e = 0.5."""
    shown = {knob.name: knob.value for knob in KNOBS}
    after = central_motion(**shown).velocity[-1]
    assert after == pytest.approx([2.8, -0.4])
    stopped = central_motion(**{**shown, "restitution": 0.5}).velocity[-1]
    assert stopped[1] == pytest.approx(0.0, abs=1e-12)
    assert shown["mass_2"] == 2 * shown["mass_1"]
    assert shown["velocity_2"] == -shown["velocity_1"] == 2
