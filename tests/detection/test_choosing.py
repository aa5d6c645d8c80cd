"""Which broad phase "auto" takes, and that every name is served."""

import numpy as np
import pytest
from detection.drawn_boxes import clustered, endless, identical, mixed, uniform

from course.detection import all_pairs, broad_phase, method_for
from course.detection.choosing import METHODS


@pytest.mark.parametrize("method", ["auto", *METHODS])
def test_every_name_gives_the_same_pairs(method):
    boxes = mixed(300, np.random.default_rng(1))
    expected = all_pairs(boxes)
    assert len(expected) > 50
    np.testing.assert_array_equal(broad_phase(boxes, method=method), expected)


@pytest.mark.parametrize(
    "scene, n, chosen",
    [
        (uniform, 50, "sweep_and_prune"),
        (uniform, 1000, "uniform_grid"),
        (clustered, 1000, "uniform_grid"),
        (identical, 1000, "uniform_grid"),
        (mixed, 1000, "bvh"),
        (endless, 1000, "bvh"),
    ],
)
def test_sizes_choose_the_method(scene, n, chosen):
    assert method_for(scene(n, np.random.default_rng(0))) == chosen


def test_another_method_is_refused():
    with pytest.raises(ValueError, match="method: expected one of 'auto', 'all_pairs'"):
        broad_phase(uniform(3, np.random.default_rng(0)), method="octree")
