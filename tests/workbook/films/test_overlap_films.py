"""The films of lesson 04: what they say is what the places say, and the opening says no more than it asks."""

import json

import numpy as np
import pytest

from course.study.meeting_shapes import ENCOUNTERS
from course.workbook.films.dragged_shapes import WINDOW, touching
from course.workbook.films.meeting_shapes import meeting_film
from course.workbook.films.spheres_far_out import far_spheres
from course.workbook.stage.encoding import encoded


@pytest.mark.parametrize("exercise", ENCOUNTERS)
def test_the_film_of_an_answer_is_made_at_both_ends_of_its_knob(exercise):
    exhibit = meeting_film(ENCOUNTERS[exercise].reference, exercise)
    for lane in (-2.0, 2.0):
        film = exhibit.made(lane=lane)
        json.dumps(encoded(film), allow_nan=False)
        assert film.ending.startswith(("A stops where it touches", "A passes by"))


def test_far_out_the_ending_says_how_far_too_early():
    film = far_spheres().made()
    assert film.ending == "In 4 bytes B stops 3.00 m too early"
    assert film.numbers[0].values == (0.0, 3.0)
    assert film.numbers[1].values == (2.0**-26, 8.0), "[m]: 10^8 is above 2^26"
    aside = far_spheres().made(lane=5.0)
    assert aside.ending == "In 4 bytes B stops 2.60 m too late, inside A"
    near = far_spheres().made(far=1e4)
    assert near.ending == "In 4 bytes B stops where it touches A, to within 5 mm"


def test_places_in_4_bytes_jump_and_those_in_8_do_not():
    wide, few = (np.asarray(p.position)[:, 2, 0] for p in far_spheres().made().panes)
    jumps = np.abs(np.diff(few))
    assert set(jumps[jumps > 0]) == {8.0} and np.abs(np.diff(wide)).max() < 0.2
    assert few[-1] == 8.0 and wide[-1] == pytest.approx(9.0, abs=1e-6)


def test_the_film_that_opens_the_lesson_tells_no_more_than_it_asks():
    exhibit = far_spheres(opening=True)
    assert not exhibit.question and not exhibit.made().charts
    assert not exhibit.made().numbers, "a table is read before the film is played"
    assert far_spheres().question and far_spheres().made().charts


def test_a_function_of_ones_own_decides_on_both_sides_and_a_wrong_one_is_seen():
    def later(x_a, r_a, x_b, r_b):
        return np.sum((x_a - x_b) ** 2, axis=-1) <= r_a**2 + r_b**2

    film = far_spheres(later).made(far=1e4)
    assert film.numbers[0].values[0] == pytest.approx(np.sqrt(41) - 9, abs=0.01)

    def broken(*given):
        raise TypeError("nothing of the kind")

    assert "raised TypeError" in far_spheres(broken).made().ending


def test_dragged_into_another_shape_it_meets_it_and_the_gap_is_below_0():
    film = touching().made(x=2.2, y=1.2)
    assert "box" in film.ending
    box = next(s for s in film.panes[0].segments if s.name == "box")
    assert np.asarray(box.value).max() < 0
    assert film.numbers[0].values[0] < 0


def test_all_bodies_are_seen_wherever_a_is_dragged():
    left, bottom, right, top = WINDOW
    for x in (-3.2, 3.2):
        for y in (-2.0, 2.0):
            for pane in touching().made(x=x, y=y, shape=3).panes:
                place = np.asarray(pane.position)
                assert place[..., 0].min() > left and place[..., 0].max() < right
                assert place[..., 1].min() > bottom and place[..., 1].max() < top
