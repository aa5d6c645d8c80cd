"""Boxes of one size on one another, against all pairs and by hand."""

import numpy as np
import pytest

from course.overlap import stacked_box_contacts
from course.overlap.box_faces import supports


@pytest.mark.parametrize("size", [(2.0, 1.0, 1.0), (0.3, 0.7, 0.1), (40.0, 0.2, 3.0)])
def test_supports_are_those_of_all_pairs(size):
    """Layers of boxes at random places of a grid of fifths, which share edges, faces, or only touch."""
    rng = np.random.default_rng(4)
    places = rng.integers(0, 16, (120, 2)) / 5
    low = np.column_stack([places, rng.integers(0, 4, 120)]) * size
    upper, lower = supports(low, size)
    expected = [
        (i, j)
        for i in range(120)
        for j in range(120)
        if abs(low[i, 2] - low[j, 2] - size[2]) < 1e-6 * size[2]
        and all(abs(low[i, k] - low[j, k]) < (1 - 1e-6) * size[k] for k in (0, 1))
    ]
    assert list(zip(upper.tolist(), lower.tolist(), strict=True)) == expected
    assert len(expected) > 50


def test_contacts_are_the_corners_of_what_two_faces_share():
    """A box half off another in x and a quarter in y, and the lower one on the ground."""
    found = stacked_box_contacts([[0, 0, 0], [1.0, 0.25, 0.1]], (2.0, 1.0, 0.1))
    assert found.body_a.tolist() == [0] * 4 + [1] * 4
    assert found.body_b.tolist() == [2] * 4 + [0] * 4
    shared = [[2, 1, 0.1], [1, 1, 0.1], [1, 0.25, 0.1], [2, 0.25, 0.1]]
    np.testing.assert_allclose(found.point[4:], shared)
    ground = [[2, 1, 0], [0, 1, 0], [0, 0, 0], [2, 0, 0]]
    np.testing.assert_allclose(found.point[:4], ground)
    np.testing.assert_array_equal(found.normal, np.tile([0, 0, 1.0], (8, 1)))
    assert not found.separation.any()


def test_boxes_beside_each_other_and_over_a_gap_do_not_touch():
    beside = [[0, 0, 0], [1.0, 0, 0], [0, 0, 1.5]]
    assert stacked_box_contacts(beside, (1.0, 1.0, 1.0)).body_b.tolist() == [3] * 8
    assert len(supports([[0, 0, 0], [1.0, 0, 1.0]], (1.0, 1.0, 1.0))[0]) == 0


def test_sizes_that_are_none_are_refused():
    with pytest.raises(ValueError, match="size: expected positive"):
        supports([[0.0, 0, 0]], (1.0, 0.0, 1.0))
