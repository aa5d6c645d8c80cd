"""Demos: every listed film can be played by its name, and answers when a knob is moved."""

import re

import pytest

from course.workbook import demos
from course.workbook.demos.full_screen import notebook_of
from course.workbook.films.listing import LISTED


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
    cells = notebook_of(LISTED[0]).cells
    assert len(cells) == 1 and "demos.impulse(large=True)" in cells[0].source
