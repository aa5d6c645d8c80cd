"""The films of lesson 05: what they show is what the formulas say, at the ends of every knob."""

import json

import numpy as np
import pytest

from course import formulas
from course.study import PENTAGON, TRIANGLE, turned
from course.workbook.films.polygon_shadows import EDGE, SMALL, WINDOW, shadows
from course.workbook.films.sinking_boxes import sinking, six_faces
from course.workbook.films.sliding_polygons import sliding
from course.workbook.stage.encoding import encoded


def ends(exhibit):
    return [{k.name: end} for k in exhibit.knobs for end in (k.low, k.high)]


def segments(pane, name):
    return [s for s in pane.segments if s.name == name]


@pytest.mark.parametrize("exhibit", [shadows(), sliding(), sinking(), sinking("faces")])
@pytest.mark.slow
def test_it_is_made_at_both_ends_of_every_knob(exhibit):
    for values in ({}, *ends(exhibit), *(p.values for p in exhibit.presets)):
        film = exhibit.made(**values)
        json.dumps(encoded(film), allow_nan=False)
        assert film.title and film.caption and film.ending and film.moves


def test_presets_are_what_their_buttons_say():
    said = {
        preset.label: shadows().made(**preset.values).ending
        for preset in shadows().presets
    }
    assert "only A shows it" in said["only an edge of A shows it"]
    assert "only B shows it" in said["only an edge of B shows it"]
    assert said["apart"].startswith("They are apart")
    assert said["overlapping"].startswith("No axis has a gap")


@pytest.mark.parametrize("seed", range(12))
def test_the_verdict_shown_is_that_of_the_formula_and_the_rows_are_its_gaps(seed):
    rng = np.random.default_rng(seed)
    x, y, turn = rng.uniform(-1.7, 1.7), rng.uniform(-1.4, 1.4), rng.uniform(-180, 180)
    film = shadows().made(x=x, y=y, turn=turn)
    a = turned(TRIANGLE, turn, (x, y))
    assert film.ending.startswith("No axis") == bool(
        formulas.polygons_overlap(a, PENTAGON)
    )
    labels = [solid.label for solid in film.panes[1].solids[1:]]
    rows = [float(label.replace("−", "-")) for label in labels[len(labels) // 2 :]]
    axes = np.concatenate([formulas.edge_normals(p) for p in (a, PENTAGON)])
    gap = formulas.shadow_gap(
        *formulas.project(a, axes), *formulas.project(PENTAGON, axes)
    )
    assert rows == pytest.approx(gap, abs=0.0051)
    parting, meeting = segments(film.panes[1], "gap")
    assert (parting.color, meeting.color) == ("green", "vermillion")
    ends = np.array([parting.start[0], parting.end[0]])[..., 0]
    whole = np.all((ends > EDGE[0]) & (ends < EDGE[1]), axis=0)
    length = np.abs(ends[1] - ends[0])
    assert length[whole] == pytest.approx(SMALL * gap[gap > 0][whole])
    assert np.shape(meeting.start)[-2] == np.sum(gap <= 0)
    assert film.numbers[0].values == (np.sum(gap > 0),)


@pytest.mark.parametrize(
    "values", [{}, *({"x": x, "y": y} for x in (-1.7, 1.7) for y in (-1.4, 1.4))]
)
def test_all_of_it_is_seen(values):
    """The axis with its shadows, however it turns, and the rows."""
    left, bottom, right, top = WINDOW
    for s in [
        s
        for pane in shadows().made(**values).panes
        for s in pane.segments
        if np.size(s.start)
    ]:
        for points in (np.asarray(s.start), np.asarray(s.end)):
            assert points[..., 0].min() >= left and points[..., 0].max() <= right
            assert points[..., 1].min() >= bottom and points[..., 1].max() <= top


def test_six_faces_stop_a_metre_too_high_and_fifteen_axes_do_not():
    film = sinking(six_faces).made()
    right, six = film.numbers[0].values
    assert right == pytest.approx(2 * np.sqrt(2), abs=1e-3)
    assert six == pytest.approx(1 + 2 * np.sqrt(2), abs=1e-3)
    assert film.ending.startswith("By this verdict B stops 1.00 m too high")


def test_the_film_that_opens_the_lesson_tells_no_more_than_it_asks():
    exhibit = sinking("faces")
    film = exhibit.made()
    assert not exhibit.question and not film.charts and not film.numbers
    assert not exhibit.presets and [knob.name for knob in exhibit.knobs] == ["aside"]
    assert [pane.title for pane in film.panes] == [
        "in truth",
        "by the six face normals alone",
    ]
    assert sinking().question and sinking().made().charts


def test_a_slide_ends_where_the_polygons_touch():
    for preset in sliding().presets:
        film = sliding().made(**preset.values)
        assert film.charts[0].curves["right"][-1] == pytest.approx(0.0, abs=1e-5)
