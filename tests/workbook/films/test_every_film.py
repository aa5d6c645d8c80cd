"""What holds of every exhibit: it can be made at the ends of its knobs, and its window stands still."""

from __future__ import annotations

import json

import numpy as np
import pytest

from course.workbook.films.listing import LISTED
from course.workbook.films.wall_bounces import wall
from course.workbook.stage import Exhibit, Flat
from course.workbook.stage.encoding import encoded
from course.workbook.stage.words import shown_number

EXHIBITS = {film.name: film.exhibit() for film in LISTED} | {
    "wall, printed": wall("printed")
}


def at_the_ends(exhibit: Exhibit) -> list[dict[str, float]]:
    ends = [{k.name: end} for k in exhibit.knobs for end in (k.low, k.high)]
    corners = [
        {k.name: getattr(k, end) for k in exhibit.knobs} for end in ("low", "high")
    ]
    return [{}, *ends, *corners, *(dict(p.values) for p in exhibit.presets)]


@pytest.mark.slow
@pytest.mark.parametrize("name", EXHIBITS)
@pytest.mark.long
def test_it_can_be_made_at_both_ends_of_every_knob_and_for_every_preset(name):
    exhibit = EXHIBITS[name]
    first = exhibit.made()
    for values in at_the_ends(exhibit):
        film = exhibit.made(**values)
        json.dumps(encoded(film), allow_nan=False)
        assert film.title and film.caption and film.ending and film.moves
        assert len(film.panes) == len(first.panes)
        assert [c.title for c in film.charts] == [c.title for c in first.charts]
        # What is rounding only is written as 0; the step of stored numbers is no rounding.
        said = [
            shown_number(v, n.digits)
            for n in film.numbers
            if n.name != "step of the numbers"
            for v in n.values
        ]
        assert not [v for v in said if "e−" in v]
        if isinstance(film.view, Flat):
            assert film.view.window is not None
            # The picture stands still while a knob moves; other bodies are another picture.
            if len(film.panes[0].solids) == len(first.panes[0].solids):
                assert film.view.window == first.view.window
    assert exhibit.question and exhibit.answer


@pytest.mark.parametrize("name", EXHIBITS)
@pytest.mark.slow
def test_arrows_and_segments_have_the_same_names_in_all_panes(name):
    film = EXHIBITS[name].made()
    for kind in ("arrows", "segments"):
        named = [{item.name for item in getattr(p, kind)} for p in film.panes]
        assert all(names == named[0] for names in named)


@pytest.mark.parametrize("name", EXHIBITS)
@pytest.mark.slow
def test_hands_hold_something_that_is_there(name):
    exhibit = EXHIBITS[name]
    pane = exhibit.made().panes[0]
    for hand in exhibit.hands:
        if hand.body is not None:
            assert 0 <= hand.body < len(pane.solids)
        else:
            arrows = next(a for a in pane.arrows if a.name == hand.arrows)
            assert hand.index < len(arrows.color)


def held(film, hand):
    """Where what a hand holds is at the start, and how many metres one unit of it is."""
    pane = film.panes[0]
    if hand.body is not None:
        return pane.position[0, hand.body], 1.0
    arrows = next(a for a in pane.arrows if a.name == hand.arrows)
    return (
        arrows.at[0, hand.index] + arrows.scale * arrows.vector[0, hand.index],
        arrows.scale,
    )


@pytest.mark.parametrize("name", EXHIBITS)
@pytest.mark.slow
def test_what_a_hand_holds_goes_with_it(name):
    """Knobs move by what the hand does along their directions, and the held thing follows."""
    exhibit = EXHIBITS[name]
    first = exhibit.made()
    for hand in exhibit.hands:
        before, scale = held(first, hand)
        for knob, direction in hand.knobs.items():
            way = np.asarray(direction) / np.linalg.norm(direction)
            # Inside the knob's range, whichever way that is.
            limits = next((k.low, k.high) for k in exhibit.knobs if k.name == knob)
            value = exhibit.values[knob]
            sign = 1.0 if limits[1] - value > value - limits[0] else -1.0
            moved = sign * 0.02 * way
            film = exhibit.made(**{knob: value + moved @ direction / scale})
            after, _ = held(film, hand)
            along = (after - before) @ way
            # It goes the same way; an arrow whose start moves against it goes less far, and
            # the stage learns by how much.
            least = 0.65 if hand.body is not None else 0.5
            assert least <= along / (sign * 0.02) <= 1.35
