"""The films of lesson 01: the words that are shown are said, and the collider is where its body is."""

import json

import numpy as np
import pytest

from course import formulas, rotations
from course.study import COLLIDERS, mug, mug_collider, step_tolerance, stepped_box
from course.workbook.films.mug_colliders import PRESETS, colliders
from course.workbook.films.placed_colliders import EDGES, SIGNS, placed
from course.workbook.films.stepped_boxes import ROWS, WIDE, drifting, resting
from course.workbook.stage.encoding import encoded
from course.workbook.stage.views import CAMERAS
from course.workbook.stage.words import description


def ends(exhibit):
    return [{k.name: end} for k in exhibit.knobs for end in (k.low, k.high)]


@pytest.mark.parametrize(
    "exhibit", [resting(), resting("three"), colliders(), placed()]
)
@pytest.mark.slow
def test_it_is_made_at_both_ends_of_every_knob(exhibit):
    for values in ({}, *ends(exhibit), *(p.values for p in exhibit.presets)):
        film = exhibit.made(**values)
        json.dumps(encoded(film), allow_nan=False)
        assert film.title and film.caption and film.ending and film.moves


@pytest.mark.parametrize("preset", resting().presets, ids=lambda p: p.label)
def test_the_mark_stands_at_the_word_that_is_said_and_the_box_at_its_gap(preset):
    film = resting().made(**preset.values)
    v = preset.values
    steps = stepped_box(
        formulas.contact_state, tolerance=step_tolerance(v["speed"], v["rate"]),
        steps_per_second=v["rate"], slip_speed=v["slip"],
    )  # fmt: skip
    place, times = np.asarray(film.panes[0].position), np.asarray(film.times)
    for k, word in enumerate(steps.said):
        middle = 0.5 * (steps.times[k] + steps.times[k + 1])
        at = film.index_at(middle)
        assert times[at] == pytest.approx(steps.times[k])
        assert place[at, 8, 2] == pytest.approx(ROWS[word])
        assert place[at, 0, 2] == pytest.approx(steps.gap[k] + 0.04)
    left, bottom, right, top = WIDE
    assert np.all((place[:, 0, 0] - 0.04 >= left) & (place[:, 0, 0] + 0.04 <= right))
    assert np.all(place[:, 2:, 2] <= top) and np.all(place[:, 2:, 2] >= bottom)


def test_presets_are_what_their_buttons_say():
    said = {p.label: resting().made(**p.values).ending for p in resting().presets}
    assert "has not come to rest" in said["too small"]
    assert said["twice g h"].startswith("The box rests in the end, 2.5 mm above")
    assert said["too large"].startswith("The box rests in the end, 27 mm above")
    assert said["it slides"].startswith("The box slides along")


def test_the_film_that_opens_the_lesson_tells_no_more_than_it_asks():
    exhibit = resting("three")
    film = exhibit.made()
    assert not exhibit.question and not film.charts and not exhibit.knobs
    titles = [pane.title for pane in film.panes]
    assert titles == ["first program", "second program", "third program"]
    assert resting().question and resting().made().charts


def test_words_are_no_bodies_in_the_alternative_text():
    assert "6 words, a mark" in description(resting("three").made())
    assert "ball" not in description(resting("three").made())


def test_the_film_of_an_answer_shows_a_wrong_order_of_the_slip():
    """Asked first, the slip hides the landing: with it there is no bounce."""

    def slip_first(gap, gap_rate, slip_speed, tolerance):
        word = str(formulas.contact_state(gap, gap_rate, slip_speed, tolerance))
        slides = abs(gap) <= tolerance[0] and slip_speed > tolerance[1]
        return "sliding" if slides else word

    film = drifting(slip_first).made()
    right, yours = film.numbers[1].values  # steps with the word colliding
    assert right > 0 and yours == 0
    assert resting().made().numbers[1].values[0] == right


@pytest.mark.parametrize("kind", range(4))
@pytest.mark.slow
def test_the_collider_encloses_the_mug_and_its_numbers_are_those_of_the_shapes(kind):
    film = colliders().made(kind=kind + 1.0, apart=0.0)
    name = COLLIDERS[kind]
    numbers = {n.name: n.values[0] for n in film.numbers}
    volume = float(mug_collider(name).volume())
    assert numbers[f"volume of the {name}"] == pytest.approx(1e6 * volume)
    assert numbers["tightness"] == pytest.approx(mug().volume() / volume)
    body, collider = film.panes[0].solids
    assert np.all(collider.vertices.min(axis=0) <= body.vertices.min(axis=0) + 1e-9)
    assert np.all(collider.vertices.max(axis=0) >= body.vertices.max(axis=0) - 1e-9)
    assert PRESETS[kind].label == name and name in film.title


@pytest.mark.slow
def test_together_they_are_in_one_place_and_turn_alike():
    pane = colliders().made(apart=0.0).panes[0]
    place, turn = np.asarray(pane.position), np.asarray(pane.orientation)
    assert np.array_equal(place[:, 0], place[:, 1])
    assert np.array_equal(turn[:, 0], turn[:, 1])
    apart = np.asarray(colliders().made(apart=0.1).panes[0].position)
    between = apart[0, 1] - apart[0, 0]
    assert np.linalg.norm(between) == pytest.approx(0.1)
    # across the line of sight: neither is nearer, and so drawn larger
    assert between @ np.array(CAMERAS["low"][0]) == pytest.approx(0.0, abs=1e-12)


def test_the_corners_of_the_box_stay_around_the_mug():
    pane = placed().made().panes[0]
    place = np.asarray(pane.position)
    matrix = rotations.to_matrix(np.asarray(pane.orientation)[:, 0])
    own = (place[:, 1:] - place[:, :1]) @ matrix
    assert np.ptp(own, axis=0) == pytest.approx(0.0, abs=1e-12)
    assert np.abs(own[0]) == pytest.approx(np.abs(SIGNS) * [0.04, 0.04, 0.05])
    assert len(EDGES) == 12
