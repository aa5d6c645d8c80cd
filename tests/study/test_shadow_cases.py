"""Pairs of shapes for pictures: shadows against sampled points, places where they stop against closed forms."""

import numpy as np
import pytest

from course import formulas
from course.study import (
    PENTAGON,
    TRIANGLE,
    crossed_gaps,
    difference_body,
    polygon_shadows,
    sinking_boxes,
    turned,
)
from course.study.shadow_cases import common, stopped_at, turning_axis


def test_shadows_hold_every_point_of_their_polygons():
    found = polygon_shadows(turned(TRIANGLE, 33.0, (-1.0, 0.4)), PENTAGON)
    rng = np.random.default_rng(0)
    for polygon, shadow in ((found.a, found.shadow_a), (found.b, found.shadow_b)):
        inside = rng.dirichlet(np.ones(len(polygon)), 300) @ polygon @ found.axes.T
        assert np.all(inside >= shadow[:, 0] - 1e-12)
        assert np.all(inside <= shadow[:, 1] + 1e-12)
    assert found.best == np.argmax(found.gap) and found.overlap == (
        found.gap.max() <= 0
    )


def test_an_axis_that_turns_begins_at_the_greatest_gap_and_never_shows_more_where_they_overlap():
    found = polygon_shadows(turned(TRIANGLE, 20.0, (-0.6, 0.4)), PENTAGON)
    turning = turning_axis(found, np.linspace(0.0, 180.0, 721))
    assert turning.gap[0] == pytest.approx(found.gap.max()) == turning.gap[-1]
    assert turning.gap.max() <= found.gap.max() + 1e-12
    ends = common(turning.shadow_a, turning.shadow_b)
    assert np.all(ends[:, 0] <= ends[:, 1])
    for (polygon, corner), shadow in zip(
        turning.bounding, (turning.shadow_a[:, 0], turning.shadow_a[:, 1]), strict=False
    ):
        assert np.sum(polygon[corner] * turning.axis, axis=-1) == pytest.approx(shadow)


@pytest.mark.parametrize("height", [2.9, 3.0, 3.5, 3.8])
def test_the_crossed_cubes_of_the_question(height):
    """Edges: h - 2 sqrt 2. Faces: h/sqrt 2 - (1 + 1/2 + 1/2 + 1/sqrt 2)."""
    faces, edges = crossed_gaps(height)
    assert edges == pytest.approx(height - 2 * np.sqrt(2))
    assert faces == pytest.approx(height / np.sqrt(2) - 2 - 1 / np.sqrt(2))
    assert faces < 0 < edges


@pytest.mark.parametrize("turn", [-60.0, 0.0, 30.0, 90.0])
def test_level_edges_stop_at_2_sqrt_2_however_they_cross(turn):
    times = np.linspace(0.0, 3.0, 31)
    sunk = sinking_boxes(turn, 0.0, times, formulas.oriented_boxes_overlap)
    assert sunk.stopped and sunk.height[-1] == pytest.approx(2 * np.sqrt(2), abs=1e-6)
    assert np.all(np.diff(sunk.height) <= 0) and sunk.height[0] == 4.4


def test_a_way_ends_where_the_verdict_changes_or_at_its_end():
    way = np.linspace(0.0, 3.0, 10)
    place, met = stopped_at(lambda x: x >= np.sqrt(2), way)
    assert met and place == pytest.approx(np.sqrt(2), abs=1e-6)
    assert stopped_at(lambda x: False, way) == (3.0, False)
    assert stopped_at(lambda x: True, way) == (0.0, True)


def test_the_differences_have_the_edges_of_both():
    a = turned(TRIANGLE, -78.0, (-1.5, 1.3))
    found = difference_body(a, PENTAGON)
    assert sorted(found.owner) == ["A"] * 3 + ["B"] * 5
    lengths = np.linalg.norm(
        np.roll(found.corners, -1, axis=0) - found.corners, axis=-1
    )
    own = [np.linalg.norm(np.roll(p, -1, axis=0) - p, axis=-1) for p in (a, PENTAGON)]
    assert np.sort(lengths) == pytest.approx(np.sort(np.concatenate(own)))
    assert found.distance == pytest.approx(polygon_shadows(a, PENTAGON).gap.max())


def test_a_square_in_a_notch_needs_a_compound():
    """By the outline of the L up to x = 3, by its two parts up to x = 1, where they part."""
    outline = np.array([[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3.0]])
    parts = np.array(
        [[[0, 0], [3, 0], [3, 1], [0, 1]], [[0, 0], [1, 0], [1, 3], [0, 3.0]]]
    )
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    for x in (0.5, 1.0, 1.25, 2.0, 3.0, 3.5):
        moved = square + x
        assert formulas.polygons_overlap(outline, moved) == (x <= 3)
        by_parts = [bool(formulas.polygons_overlap(part, moved)) for part in parts]
        assert any(by_parts) == (x <= 1)
