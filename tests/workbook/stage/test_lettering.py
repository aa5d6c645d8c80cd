"""Words in stills: over no arrow, over no other words, none missing."""

import re

import numpy as np
import pytest

from course.workbook.films.listing import LISTED
from course.workbook.stage import Arrows, Film, Flat, Pane, Space, ball, box, labelled
from course.workbook.stage.lettering import (
    Label,
    Line,
    Shape,
    arrow_label,
    covers,
    crosses,
    lettered,
)
from course.workbook.stage.marks import ink_on
from course.workbook.stage.still import svg

SIZE = np.array([400.0, 300.0])
BOX = np.array([[10.0, 10.0], [30.0, 20.0]])


def place_of(drawn):
    x, y = re.search(r'x="([-\d.]+)" y="([-\d.]+)"', drawn).groups()
    return np.array([float(x), float(y) - 5])


@pytest.mark.parametrize("seed", range(20))
def test_words_keep_off_arrows_and_each_other(seed):
    random = np.random.default_rng(seed)
    ends = random.uniform(0, SIZE, (6, 2, 2))
    lines = [Line(e, 3.0) for e in ends]
    labels = [arrow_label("12.3 N", "#009e73", *e) for e in ends]
    drawn = lettered(labels, lines, [], SIZE)
    assert len(drawn) == 6
    half = np.array([20.0, 8.0])
    boxes = [np.stack([p - half, p + half]) for p in map(place_of, drawn)]
    for k, one in enumerate(boxes):
        for line in lines:
            along = np.linspace(line.ends[0], line.ends[1], 1500)
            assert not np.any(np.all((along > one[0]) & (along < one[1]), axis=1))
        for other in boxes[:k]:
            assert np.any((one[1] <= other[0]) | (other[1] <= one[0]))


def test_what_is_outside_is_not_named():
    outside = Label("far", "#000000", np.array([[390.0, 100.0]]), np.array([420, 100]))
    assert lettered([outside], [], [], SIZE) == []


def test_whether_a_box_lies_on_a_line_or_over_a_body():
    assert crosses(BOX, Line(np.array([[0, 0], [40.0, 30.0]]), 0.0))
    assert not crosses(BOX, Line(np.array([[0, 0], [40.0, 0.0]]), 0.0))
    assert crosses(BOX, Line(np.array([[0, 8], [40.0, 8.0]]), 3.0))
    square = np.array([[40.0, 0], [60, 0], [60, 30], [40, 30]])
    assert not covers(BOX, Shape(square, 0.0)) and covers(BOX, Shape(square, 11.0))
    point = np.array([[34.0, 24.0]])
    assert not covers(BOX, Shape(point, 5.0)) and covers(BOX, Shape(point, 6.0))


def test_a_still_has_the_numbers_of_its_film():
    push = Arrows("push", [[2.5, 0.0, 0.0]], "N", scale=0.2, numbers=True)
    for view in (Flat("xz", (-1, -1, 1, 1)), Space("front")):
        pane = Pane([labelled(ball(0.3), "1")], [[0.0, 0.0, 0.0]], arrows=[push])
        drawn = svg(Film([pane], [0.0], view))
        assert ">2.5 N</text>" in drawn and ">1</text>" in drawn


def test_a_still_has_the_trails_of_its_film():
    place = np.zeros((5, 1, 3))
    place[:, 0, 0] = np.linspace(-0.5, 0.5, 5)
    for view in (Flat("xz", (-1, -1, 1, 1)), Space("front")):
        with_trail, without = (
            svg(
                Film([Pane([ball(0.1)], place, trails=t)], np.arange(5.0), view), time=4
            )
            for t in ([0], [])
        )
        assert with_trail.count("<polyline") > without.count("<polyline")


def test_an_arrow_in_a_body_shines_through_it():
    inner = Arrows("inner", [[0.2, 0.0, 0.0]], "N", scale=1.0)
    pane = Pane([box((0.5, 0.5, 0.5))], [[0.0, 0.0, 0.0]], arrows=[inner])
    drawn = svg(Film([pane], [0.0], Space("front")))
    assert re.search(r'<g opacity="0\.\d+"><\w+', drawn)


def test_ink_on_a_colour_is_what_is_read_better():
    assert ink_on("#0072b2") == "#ffffff" and ink_on("#f0b429") == "#111418"


@pytest.mark.parametrize("listed", LISTED, ids=lambda f: f.name)
@pytest.mark.slow
def test_every_number_of_a_films_arrows_stands_in_its_still(listed):
    film = listed.exhibit().made()
    drawn = svg(film, time=listed.still)
    index = film.index_at(listed.still)
    for pane in film.panes:
        for arrows in pane.arrows:
            if not (arrows.shown and arrows.numbers and arrows.unit):
                continue
            longest = np.linalg.norm(np.asarray(arrows.vector)[index], axis=1).max()
            if longest * arrows.scale > 0.05:
                assert f" {arrows.unit}</text>" in drawn
