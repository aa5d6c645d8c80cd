"""What a sweep remembers from frame to frame, and what that saves."""

import numpy as np
import pytest
from detection.drawn_boxes import boxes_about, column_swept, uniform

from course.detection import CoherentSweep, all_pairs, sweep_and_prune
from course.shapes import AABB


def inversions(order, keys):
    """Pairs that stand the wrong way round."""
    k = keys[order]
    return int(np.sum(np.triu(k[:, None] > k[None, :])))


def test_frames_in_a_row_have_the_pairs_of_each():
    rng = np.random.default_rng(4)
    center, sweep = rng.uniform(0, 1, (200, 3)), CoherentSweep()
    for _ in range(20):
        center = center + rng.normal(scale=0.01, size=center.shape)
        boxes = boxes_about(center, 0.06)
        np.testing.assert_array_equal(sweep.pairs(boxes), all_pairs(boxes))


def test_swaps_are_the_pairs_that_changed_places():
    rng = np.random.default_rng(6)
    before = rng.uniform(0, 1, (150, 3))
    after = before + rng.normal(scale=0.02, size=before.shape)
    sweep = CoherentSweep(axis=1)
    sweep.pairs(boxes_about(before, 0.05))
    assert sweep.swaps == 0
    order = sweep.order.copy()
    sweep.pairs(boxes_about(after, 0.05))
    assert sweep.swaps == inversions(order, after[:, 1] - 0.05) > 0


def test_a_still_frame_takes_no_swap_and_a_reversed_one_all():
    n = 50
    x = np.column_stack([np.arange(n), np.zeros((n, 2))])
    sweep = CoherentSweep()
    for center, swaps in ((x, 0), (x, 0), (-x, n * (n - 1) // 2)):
        sweep.pairs(boxes_about(center, 0.3))
        assert sweep.swaps == swaps


def test_another_number_of_boxes_starts_anew():
    rng, sweep = np.random.default_rng(1), CoherentSweep()
    for n in (40, 60, 0, 1, 40):
        boxes = uniform(n or 1, rng)[:n]
        assert sweep.pairs(boxes).tolist() == sweep_and_prune(boxes).tolist()
        assert sweep.swaps == 0


def test_tests_along_the_wrong_axis_are_all():
    """A column of n cubes swept across it tests all n(n - 1)/2, along it only neighbours:
    those that touch, n - 1.
    """
    boxes = column_swept(30, None)
    along, across = CoherentSweep(axis=2), CoherentSweep(axis=1)
    assert along.pairs(boxes).tolist() == across.pairs(boxes).tolist()
    assert (along.tests, across.tests) == (29, 30 * 29 // 2)
    chosen = CoherentSweep()
    chosen.pairs(boxes)
    assert chosen.axis == 2


def test_endless_boxes_are_swept_too():
    lower = np.array([[-np.inf, -np.inf, -np.inf], [0, 0, 0], [5, 5, 5]])
    upper = np.array([[np.inf, np.inf, 1], [1, 1, 1], [6, 6, 6]])
    assert CoherentSweep().pairs(AABB(lower, upper)).tolist() == [[0, 1]]


@pytest.mark.parametrize("axis", [3, -1, "x"])
def test_an_axis_that_is_none_is_refused(axis):
    with pytest.raises(ValueError, match="axis: expected 0, 1, 2 or None"):
        CoherentSweep(axis=axis)
