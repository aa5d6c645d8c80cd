"""A box on its corners: balances, and what wrong impulses do."""

from __future__ import annotations

import numpy as np
import pytest

from course import formulas
from course.study.landed_boxes import landed_box
from course.workbook.films.timing import moments

TIMES, AFTER = moments(0.8, [0.3], frames=41)
LATE = (TIMES > 0.3) | AFTER


def land(spin, e, function=formulas.simultaneous_impulses):
    return landed_box(spin, e, TIMES, LATE, meeting=0.3, function=function)


@pytest.mark.parametrize("spin", [(0.0, 0.0), (1.0, 0.0), (1.2, 0.8), (-2.0, 2.0)])
@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_right_impulses_part_fast_enough_and_lose_what_they_should(spin, e):
    box = land(spin, e)
    assert np.all(box.after >= -e * box.before - 1e-9)
    pressed = box.impulse > 1e-9
    np.testing.assert_allclose(box.after[pressed], -e * box.before[pressed], atol=1e-6)
    # The work of the impulses: p.(u + u')/2, of 1 kg that came with 1 m/s.
    assert box.impulse @ (box.before + box.after) <= 1e-9
    assert box.kept <= 1 + 1e-9
    # A plane's corner: a turn lowers it by the square of a small angle only.
    if spin == (0.0, 0.0):
        assert box.corners[..., 2].min() > -1e-12


def test_the_corners_are_where_the_box_is():
    box = land((1.0, 0.5), 0.5)
    at = np.flatnonzero(LATE)[0]
    np.testing.assert_allclose(box.corners[at, :, 2], 0.0, atol=1e-12)
    step = TIMES[at + 1] - TIMES[at]
    np.testing.assert_allclose(box.corners[at + 1, :, 2] / step, box.after, atol=0.05)


def test_half_of_the_impulse_goes_on_into_the_floor():
    def only_e(matrix, u, e):
        return 0.5 * formulas.simultaneous_impulses(matrix, u, e)

    box = land((1.0, 0.0), 0.5, only_e)
    assert box.after.min() < -0.1 and box.corners[-1, :, 2].min() < -0.05
