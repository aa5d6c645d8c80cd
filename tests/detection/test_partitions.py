"""Cells of space: each point in one, each box in all it reaches into."""

import numpy as np
import pytest
from detection.drawn_boxes import boxes_about, clustered, huge, mixed, uniform

from course.detection import Partition, all_pairs, uniform_grid
from course.detection.grid import median_cell_size

each_kind = pytest.mark.parametrize("oblique", [False, True])


@each_kind
@pytest.mark.parametrize("scene", [uniform, clustered, mixed], ids=lambda s: s.__name__)
def test_a_cell_holds_the_boxes_that_reach_into_it(oblique, scene):
    rng = np.random.default_rng(3)
    boxes = scene(400, rng)
    found = Partition.build(boxes, oblique=oblique)
    assert found.right.size > 20
    where = rng.integers(400, size=2000)
    lower, upper = boxes.lower[where], boxes.upper[where]
    points = lower + rng.uniform(0, 1, lower.shape) * (upper - lower)
    for leaf, box in zip(found.cell_of(points), where, strict=True):
        begin, end = found.ranges[leaf]
        assert box in found.held[begin:end]


@each_kind
def test_cells_hold_fewer_pairs_than_all(oblique):
    n = 1000
    found = Partition.build(uniform(n, np.random.default_rng(0)), oblique=oblique)
    assert len(found.pairs()) < found.tests < 0.05 * n * (n - 1) / 2


def test_oblique_planes_are_taken_where_the_scene_is_oblique():
    """A cloud along the space diagonal: the planes across it cut the fewest boxes."""
    rng = np.random.default_rng(2)
    center = rng.uniform(0, 100, (500, 1)) + rng.normal(size=(500, 3))
    boxes = boxes_about(center, 0.5)
    oblique = Partition.build(boxes, oblique=True)
    upright = Partition.build(boxes, oblique=False)
    root = oblique.planes[0, :3]
    assert np.linalg.norm(root - 1 / np.sqrt(3)) < 0.01
    assert set(map(tuple, upright.planes[upright.right >= 0, :3].tolist())) == {
        (1.0, 0, 0), (0, 1.0, 0), (0, 0, 1.0),
    }  # fmt: skip
    assert oblique.pairs().tolist() == upright.pairs().tolist()


def test_huge_coordinates_are_refused_by_name():
    with pytest.raises(ValueError, match="boxes: expected coordinates below 1e"):
        Partition.build(huge(3, np.random.default_rng(0)), oblique=False)


@pytest.mark.parametrize("cell_size", [1e-9, 0.01, 0.1, 1.0, 50.0])
@pytest.mark.parametrize("scene", [uniform, mixed], ids=lambda s: s.__name__)
def test_any_cell_size_gives_the_same_pairs(cell_size, scene):
    boxes = scene(500, np.random.default_rng(4))
    found = uniform_grid(boxes, cell_size=cell_size)
    np.testing.assert_array_equal(found, all_pairs(boxes))


def test_the_cell_size_leaves_the_wide_out():
    assert median_cell_size(np.array([1.0, 1.5, 2.0, 3.0, 3.5, 90.0])) == 3.5
    assert median_cell_size(np.zeros(4)) == 0.0


@pytest.mark.parametrize("cell_size", [0.0, -1.0, np.nan, np.inf])
def test_a_cell_size_that_is_none_is_refused(cell_size):
    with pytest.raises(ValueError, match="cell_size: expected"):
        uniform_grid(uniform(3, np.random.default_rng(0)), cell_size=cell_size)
