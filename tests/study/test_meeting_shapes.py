"""Shapes that come nearer until a verdict stops them: where they stop, and where they should."""

import numpy as np
import pytest

from course import formulas, overlap
from course.study import LOST_BELOW, far_meeting, feet_apart, rods_side_by_side
from course.study.dragged_shapes import AMONG, DRAGGED, STAND, dragged_shape
from course.study.meeting_shapes import ENCOUNTERS, FAR_RADII, at, meeting

TIMES = np.linspace(0.0, 6.0, 61)


def test_far_out_eight_bytes_stop_where_they_touch_and_four_where_steps_say():
    right, fewer = (
        far_meeting(1e8, 0.0, TIMES, size, formulas.spheres_overlap) for size in (8, 4)
    )
    assert right.stopped and right.gap[-1] == pytest.approx(0.0, abs=1e-6)
    # 16 m are stored down to 12 m, from there on 8 m: less than the 9 m of both radii.
    assert fewer.gap[-1] == pytest.approx(12 - sum(FAR_RADII), abs=1e-6)
    assert fewer.drawn[-1, 0] == 8.0 and fewer.stored_gap[-1] == -1.0
    assert set(np.unique(fewer.drawn[:, 0] % 8)) == {0.0}


@pytest.mark.parametrize("exercise", ENCOUNTERS)
@pytest.mark.parametrize("lane", [-2.0, 0.2, 1.2])
def test_the_right_function_stops_a_shape_where_it_touches(exercise, lane):
    encounter, way = ENCOUNTERS[exercise], np.linspace(-2.6, 3.0, 57)
    found = meeting(encounter, encounter.reference, lane, way)
    assert found.gap.min() > -1e-6
    if found.stopped:
        assert found.gap[-1] == pytest.approx(0.0, abs=1e-6)
    else:
        whole = np.stack([way, np.full_like(way, lane), 0 * way], axis=-1)
        assert overlap.gap(at(encounter.moving, whole), encounter.still).min() > 0


@pytest.mark.parametrize("which", range(3))
def test_gaps_of_a_dragged_shape_are_those_of_the_shapes(which):
    found = dragged_shape(which, -0.6, -1.4, 1.0, TIMES, 8)
    assert found.gap.shape == (61, 3)
    first = at(DRAGGED[which], np.array([-0.6, -1.4, 0.0]))
    for k, shape in enumerate(AMONG):
        gap = overlap.gap(first, at(shape, STAND[k]))
        assert found.gap[0, k] == pytest.approx(gap, abs=1e-9)
    assert np.ptp(found.gap[:, 1]) > 0.1 and np.ptp(found.gap[:, 0]) < 1e-9


def test_far_out_four_bytes_put_a_dragged_shape_at_whole_steps():
    found = dragged_shape(0, -0.6, -1.4, 1e7, TIMES, 4)
    assert np.array_equal(found.place[:, :2], np.rint(found.place[:, :2]))


def test_feet_lose_their_digits_at_the_root_of_a_rounding():
    worst = [
        np.abs(feet_apart(*rods_side_by_side(angle)) - 0.5).max()
        for angle in (10 * LOST_BELOW, 0.1 * LOST_BELOW)
    ]
    assert worst[0] < 1e-3 < 0.1 < worst[1]
    a, b, c, d = rods_side_by_side(0.1 * LOST_BELOW)
    gap = formulas.capsule_gap(a, b, 0.0, c, d, 0.0)
    assert gap == pytest.approx(0.5, abs=1e-8)
