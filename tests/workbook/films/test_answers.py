"""What holds of every film in which an answer plays: at the ends of its knobs, right or wrong."""

from __future__ import annotations

import json

import pytest

from course.exercises.definition import find_exercise
from course.workbook.stage import Flat
from course.workbook.stage.encoding import encoded
from course.workbook.stage.words import shown_number
from course.workbook.watching import WATCHED

#: One exercise of each film is enough where they share it, and all that have their own motion.
EACH = (
    "contact_state", "place",
    "symplectic_euler_step", "rk4_step", "rotate", "momentum_after", "wall_bounce", "bounce_times",
    "bouncing_ball_step", "apply_impulse", "simultaneous_impulses", "contact_bias", "pivot",
)  # fmt: skip


def ends(exhibit):
    single = [{k.name: end} for k in exhibit.knobs for end in (k.low, k.high)]
    corners = [
        {k.name: getattr(k, end) for k in exhibit.knobs} for end in ("low", "high")
    ]
    return [*single, *corners]


@pytest.mark.slow
@pytest.mark.parametrize("mistaken", [False, True])
@pytest.mark.parametrize("name", EACH)
@pytest.mark.long
def test_it_stands_still_where_it_should_and_says_something(name, mistaken):
    exercise = find_exercise(name)[1]
    answer = exercise.mistakes[0].function if mistaken else exercise.reference
    exhibit = WATCHED[name].exhibit(name, answer)
    first = exhibit.made()
    for values in ends(exhibit):
        film = exhibit.made(**values)
        json.dumps(encoded(film), allow_nan=False)
        assert film.title and film.caption and film.ending and film.moves
        assert [c.title for c in film.charts] == [c.title for c in first.charts]
        if isinstance(film.view, Flat):
            assert film.view.window == first.view.window is not None
        else:
            assert film.view.window is not None
        if not mistaken:
            said = [shown_number(v, n.digits) for n in film.numbers for v in n.values]
            assert not [v for v in said if "e−" in v]
    # A pane that stands still has none; the others have the same.
    for kind in ("arrows", "segments"):
        named = [{item.name for item in getattr(p, kind)} for p in first.panes]
        assert named[1] == named[0] or not named[1]


@pytest.mark.parametrize("name", sorted({w.name for w in WATCHED.values()}))
@pytest.mark.slow
def test_it_plays_without_an_answer_too(name):
    exercise = next(e for e, w in WATCHED.items() if w.name == name)
    film = WATCHED[exercise].exhibit(exercise, None).made()
    assert len(film.panes) == 1 and film.ending
    assert all(len(n.values) == 1 for n in film.numbers)
