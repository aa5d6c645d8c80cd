"""Demos: every listed film can be played by its name, and answers when a knob is moved."""

import re

import pytest

from course.workbook import demos, stage
from course.workbook.demos.full_screen import notebook_of
from course.workbook.films.listing import LISTED, find_film
from course.workbook.stage import Exhibit, Film, Flat, Knob, Pane, ball


@pytest.mark.parametrize("film", LISTED, ids=lambda film: film.name)
def test_a_demo_plays_its_film_and_answers(film):
    widget = getattr(demos, film.name)(large=True)
    assert widget.exhibit["large"] and widget.exhibit["film"]["title"]
    if not widget.shown.knobs:
        assert not widget.answers
        return
    sent = []
    widget.send = lambda message, buffers=None: sent.append(message)
    knob = widget.shown.knobs[0]
    moved = knob.high if knob.value != knob.high else knob.low
    question = {"kind": "ask", "id": 3, "values": {knob.name: moved}}
    widget._asked(widget, question, [])
    assert sent[0]["kind"] == "film" and sent[0]["id"] == 3
    assert sent[0]["film"]["description"] != widget.exhibit["film"]["description"]


def test_a_question_that_is_asked_again_is_answered_again_and_nothing_is_computed():
    made, sent = [], []

    def film(k):
        made.append(k)
        if k > 2:
            raise ZeroDivisionError("too large")
        return Film([Pane([ball(0.1)], [[k, 0.0, 0.0]])], [0.0], Flat("xz"))

    widget = stage.show(Exhibit(film, [Knob("k", "k", 1.0, 0.0, 9.0)]))
    widget.send = lambda message, buffers=None: sent.append(message)
    made.clear()
    for number, k in ((1, 2.0), (1, 2.0), (2, 2.0), (3, 5.0), (3, 5.0), (3, None)):
        widget._asked(widget, {"kind": "ask", "id": number, "values": {"k": k}}, [])
    assert made == [2.0, 2.0, 5.0]
    assert [m["kind"] for m in sent] == ["film"] * 3 + ["failed"] * 3
    assert sent[0] == sent[1] and sent[3] == sent[4]
    assert [m["id"] for m in sent] == [1, 1, 2, 3, 3, 3]
    assert sent[3]["words"] == "ZeroDivisionError: too large"


def test_a_demo_has_every_listed_film_and_no_other():
    names = set(demos.__all__) - {"player", "table"}
    assert names == {film.name for film in LISTED}


@pytest.mark.parametrize("film", LISTED, ids=lambda film: film.name)
def test_who_shows_it_is_told_where_to_look(film):
    """One line of a terminal, and keys that there are."""
    assert 20 < len(film.look) <= 110 and film.minutes >= 2
    presets = len(film.exhibit().presets)
    keys = [int(k) for k in re.findall(r"(?<![\d.,:])([1-9])(?=[:,.])", film.look)]
    assert all(k <= presets for k in keys)


def test_the_page_shows_the_film_large_and_nothing_else():
    cells = notebook_of(find_film("impulse")).cells
    assert len(cells) == 1 and "demos.impulse(large=True)" in cells[0].source
