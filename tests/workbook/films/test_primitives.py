"""The films of lesson 02: what they show is what the shapes and formulas say, at the ends of every knob."""

import json

import numpy as np
import pytest

from course import formulas
from course.exercises.definition import find_exercise
from course.shapes.mesh_makers import dumbbell_mesh
from course.study.boxed_bodies import ASKED
from course.workbook.films.boxed_bodies import boxed
from course.workbook.films.growing_dops import SIDES, WINDOW, fitted, growing_dop
from course.workbook.films.turning_rods import WINDOW as SEEN
from course.workbook.films.turning_rods import turning_rod
from course.workbook.stage.encoding import encoded


def ends(exhibit):
    return [{k.name: end} for k in exhibit.knobs for end in (k.low, k.high)]


@pytest.mark.parametrize(
    "exhibit", [turning_rod(), turning_rod(opening=True), growing_dop(), boxed()]
)
@pytest.mark.slow
def test_it_is_made_at_both_ends_of_every_knob(exhibit):
    for values in ({}, *ends(exhibit), *(p.values for p in exhibit.presets)):
        film = exhibit.made(**values)
        json.dumps(encoded(film), allow_nan=False)
        assert film.title and film.caption and film.ending and film.moves


def test_the_film_that_opens_the_lesson_tells_no_more_than_it_asks():
    exhibit = turning_rod(opening=True)
    assert not exhibit.question and not exhibit.made().charts
    assert not exhibit.made().numbers
    assert turning_rod().question and turning_rod().made().charts


@pytest.mark.parametrize("values", [{}, {"angle": 45, "thickness": 1.0}, {"angle": 70, "thickness": 0.1}])  # fmt: skip
def test_the_box_around_the_rod_is_that_of_its_corners_and_is_seen(values):
    film = turning_rod().made(**values)
    pane, thick = film.panes[0], values.get("thickness", 0.01)
    start = np.asarray(pane.segments[0].start)
    degrees = values.get("angle", 0) + 15.0 * np.asarray(film.times)
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    ways = [(i, j) for i in (-1, 1) for j in (-1, 1)]
    x = np.array([i * 0.5 * c - j * 0.5 * thick * s for i, j in ways]).max(axis=0)
    y = np.array([i * 0.5 * s + j * 0.5 * thick * c for i, j in ways]).max(axis=0)
    assert np.allclose(np.abs(start[:, 0, 0]), x) and np.allclose(start[:, 2, 1], y)
    value = np.asarray(pane.segments[1].value)[:, 0]
    assert np.allclose(value, 4 * x * y / thick, atol=0.051)
    left, bottom, right, top = SEEN
    for line in pane.segments:
        at = np.concatenate([np.asarray(line.start), np.asarray(line.end)])
        assert at[..., 0].min() > left and at[..., 0].max() < right
        assert at[..., 1].min() > bottom and at[..., 1].max() < top - 0.03


def test_the_question_of_the_rod_is_answered_by_its_film():
    for thickness, most in ((0.01, 51.005), (0.1, 6.05)):
        film = turning_rod().made(thickness=thickness)
        assert film.numbers[1].values[0] == pytest.approx(most)
        at = turning_rod().made(angle=45.0, thickness=thickness).numbers[0].values[0]
        assert at == pytest.approx(most)
        curve = film.charts[0].guides["at every angle"]
        assert curve[np.argmax(curve[:, 1]), 0] in (45.0, 135.0)


@pytest.mark.slow
def test_more_sides_are_never_looser_and_the_question_has_its_numbers():
    """14 and 18 sides hold those of the box, and 26 those of both."""
    told = {}
    for preset in growing_dop().presets:
        film = growing_dop().made(**preset.values)
        box, some, others, all_of_them = (n.values[0] for n in film.numbers)
        assert all_of_them <= min(some, others) + 1e-9 and max(some, others) <= box
        told[preset.label] = box, some, others
    box, fourteen, eighteen = told["along a diagonal of the cube"]
    assert round(box) == 9
    assert fourteen == pytest.approx(4.5, abs=0.05)
    assert eighteen == pytest.approx(2.2, abs=0.05)


@pytest.mark.slow
def test_all_edges_of_the_k_dops_are_seen_and_belong_to_sides_that_touch():
    mesh = dumbbell_mesh()
    assert [len(shape.directions) for shape in fitted(mesh)[1:]] == [7, 9, 13]
    for values in (*ends(growing_dop()), *(p.values for p in growing_dop().presets)):
        lines = growing_dop().made(**values).panes[0].segments[0]
        at = np.concatenate([np.asarray(lines.start), np.asarray(lines.end)])
        assert np.abs(at).max() < max(WINDOW[1])
    assert SIDES == (6, 14, 18, 26)


@pytest.mark.parametrize("exercise", ASKED)
def test_a_right_box_holds_the_body_and_touches_it(exercise):
    film = boxed(find_exercise(exercise)[1].reference, exercise).made()
    assert film.ending.startswith("Your box holds the body at every moment, and")
    for number in film.numbers:
        assert max(number.values) < 1e-6


def test_a_wrong_box_lets_the_bar_stick_out_or_is_too_large():
    film = boxed(lambda e, rotation: np.abs(rotation @ e)).made()
    assert film.ending.startswith("Your box lets the body stick out by")
    assert film.numbers[0].values[1] > 0.5
    film = boxed(lambda e, rotation: np.full(3, np.linalg.norm(e))).made()
    assert film.ending.startswith("Your box holds the body, but a side of it is up to")
    at = np.asarray(boxed().made().panes[0].position)
    assert at.shape[1:] == (9, 3), "the body and the corners of its box"
    assert formulas.rotated_box_extents(np.ones(3), np.eye(3)) == pytest.approx(1.0)
