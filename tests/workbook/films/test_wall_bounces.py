"""The bounce on the stage: the two parts of the velocity, and the slide's formula."""

from __future__ import annotations

import numpy as np
import pytest

from course.study.wall_meetings import mirrored, wall_meeting
from course.workbook.films.wall_bounces import PRESETS, wall


@pytest.mark.parametrize("seed", range(30))
def test_the_part_along_n_is_turned_by_e_and_the_other_stays(seed):
    rng = np.random.default_rng(seed)
    angle, e = rng.uniform(-60, 60), rng.uniform(0, 1)
    motion = wall_meeting(angle, [*rng.uniform(-2, 2, 2), 0.0], e)
    come, leave = motion.before @ motion.normal, motion.after @ motion.normal
    assert leave == pytest.approx(-e * come if come < 0 else come)
    assert motion.after @ motion.along == pytest.approx(motion.before @ motion.along)
    # It touches the wall at the origin and is never inside.
    height = motion.position @ motion.normal
    assert np.all(height >= 0.2 - 1e-12)
    assert height[1 if come < 0 else 0] == pytest.approx(0.2)


def test_the_slide_is_right_at_e_1_only():
    for e, same in ((1.0, True), (0.5, False)):
        ours, slide = (
            wall_meeting(20, [1.0, -2.0, 0.0], e, **law)
            for law in ({}, {"law": mirrored})
        )
        assert np.allclose(ours.after, slide.after) == same


def test_the_answer_to_the_question():
    film = wall().made(**PRESETS[1].values)
    values = {n.name: n.values[0] for n in film.numbers}
    leaves = np.degrees(np.arctan2(values["along n after"], values["along the wall"]))
    assert leaves == pytest.approx(26.565, abs=1e-3)
    assert values["energy kept"] == pytest.approx(62.5)
    film = wall().made()
    values = {n.name: n.values[0] for n in film.numbers}
    assert abs(values["along n after"]) < abs(values["along n before"])


def test_what_is_said_of_a_ball_that_leaves():
    film = wall().made(**PRESETS[4].values)
    assert film.ending.startswith("It does not approach")


def test_a_law_that_gives_no_velocity_is_named():
    with pytest.raises(ValueError, match=r"in place of shape \(3,\)"):
        wall_meeting(0, [0, -1.0, 0], 1.0, law=lambda *given: 1.0)
