"""The films of lesson 06: what they show is what the formulas say, at the ends of every knob."""

import json

import numpy as np
import pytest

from course import formulas
from course.workbook.films.ball_throws import throws
from course.workbook.films.bullet_and_wall import MOST, bullet, swept_bullet
from course.workbook.films.rods_and_balls import rod_to_ball
from course.workbook.stage.encoding import encoded


def ends(exhibit):
    return [{k.name: end} for k in exhibit.knobs for end in (k.low, k.high)]


@pytest.mark.parametrize(
    "exhibit", [bullet(), bullet(opening=True), swept_bullet(), throws(), rod_to_ball()]
)
def test_it_is_made_at_both_ends_of_every_knob(exhibit):
    for values in ({}, *ends(exhibit), *(p.values for p in exhibit.presets)):
        film = exhibit.made(**values)
        json.dumps(encoded(film), allow_nan=False)
        assert film.title and film.caption and film.ending and film.moves


def test_presets_of_the_bullet_are_what_their_buttons_say():
    said = {p.label: bullet().made(**p.values).ending for p in bullet().presets}
    assert said["the bullet"].startswith("No look sees")
    assert said["600 looks a second"].startswith("No look sees")
    assert said["a lucky look"].startswith("A look sees it")
    assert said["9,000 looks a second"].startswith("A look sees it")


def test_looks_are_left_behind_where_they_were_made():
    film = bullet().made(rate=600.0)
    place = np.asarray(film.panes[1].position)[:, :, 0]
    looks, shot = place[-1, 1:-1], place[:, -1]
    assert np.diff(looks) == pytest.approx(1.5) and len(looks) <= MOST
    for k, look in enumerate(looks):
        assert place[:, k + 1] == pytest.approx(np.minimum(shot, look))


def test_the_film_that_opens_the_lesson_tells_no_more_than_it_asks():
    exhibit = bullet(opening=True)
    film = exhibit.made()
    assert not exhibit.question and not film.numbers and not film.charts
    assert [k.name for k in exhibit.knobs] == ["before"]
    assert bullet().question and bullet().made().numbers


def test_presets_of_the_throws_are_what_their_buttons_say():
    made = {p.label: throws().made(**p.values) for p in throws().presets}
    flown = {label: film.numbers[0].values[0] for label, film in made.items()}
    least = {label: film.numbers[1].values[0] for label, film in made.items()}
    assert flown["they meet"] < 2 and least["they meet"] == 0
    assert flown["they graze"] == pytest.approx(1.75), "3.5 m at 2 m/s, side by side"
    assert flown["their ways cross"] == 2 and least["their ways cross"] > 0.5
    for label in ("touching and parting", "touching and sliding"):
        assert flown[label] == 2 and least[label] == 0


def test_what_is_to_be_found_is_found_by_hand():
    """Where an answer plays, no button gives the throw; B moves from the start, so that one exists."""
    exhibit = throws(formulas.swept_spheres_time)
    assert len(exhibit.presets) == len(throws().presets) - 2
    assert throws().made().numbers[0].values[0] < 2, "the first throw meets"
    steeper = throws().made(velocity_y=0.6)
    assert steeper.numbers[1].values[0] > 0.2, "a flatter one does not"


def test_the_swept_volume_is_all_places_of_the_ball():
    """Its ends are where the ball is at 0 and, had nothing stopped it, after two seconds."""
    film = throws().made(x=-3.0, y=1.0, velocity_x=1.5, velocity_y=-0.5)
    core = np.concatenate([p.core for p in film.panes[0].solids[1].parts])
    assert core.min(axis=0)[:2] == pytest.approx([-3.0, 0.0])
    assert core.max(axis=0)[:2] == pytest.approx([0.0, 1.0])


def test_an_answer_that_flies_through_is_seen():
    def never(*given):
        return np.full(np.shape(given[0])[:-1], np.inf)

    film = swept_bullet(never).made()
    right, other = (np.asarray(p.position)[-1, -1, 0] for p in film.panes)
    assert right == pytest.approx(0, abs=1e-9) and other > 12
    assert "too far" in film.ending
    film = throws(never).made()
    assert "lets them meet never" in film.ending
    film = rod_to_ball(lambda *given: np.inf).made()
    assert "they meet never" in film.ending


def test_right_answers_end_as_the_right_one():
    assert swept_bullet(formulas.swept_boxes_time).made().ending.startswith("Both stop")
    for film in (
        throws(formulas.swept_spheres_time).made(),
        rod_to_ball(formulas.conservative_advancement).made(),
    ):
        assert film.ending.startswith("Both say the same")
