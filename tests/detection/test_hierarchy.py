"""Trees of boxes: what a tree must be whatever built it, and what it is asked."""

import numpy as np
import pytest
from detection.drawn_boxes import SCENES, boxes_about, clustered, endless, huge, uniform

from course.detection import BVH, SphereTree, all_pairs
from course.detection.hierarchy import METHODS
from course.shapes import AABB

FINITE = [scene for scene in SCENES if scene is not endless]
each_method = pytest.mark.parametrize("method", METHODS)


def boxes_below(tree, node):
    begin, end = tree.ranges[node]
    return tree.order[begin:end]


@each_method
@pytest.mark.parametrize("scene", FINITE, ids=lambda s: s.__name__)
@pytest.mark.parametrize("leaf_size", [1, 4])
@pytest.mark.slow
def test_a_tree_holds_each_box_once_and_bounds_it(method, scene, leaf_size):
    boxes = scene(130, np.random.default_rng(7))
    tree = BVH.build(boxes, method=method, leaf_size=leaf_size)
    assert sorted(tree.order.tolist()) == list(range(130))
    bounds, depth = tree.bounds, tree.depth
    for node, (left, right) in enumerate(tree.children):
        below = boxes_below(tree, node)
        assert np.array_equal(bounds.lower[node], boxes.lower[below].min(axis=0))
        assert np.array_equal(bounds.upper[node], boxes.upper[below].max(axis=0))
        if tree.is_leaf[node]:
            assert left == right == -1 and 1 <= below.size <= leaf_size
            continue
        parts = [boxes_below(tree, child) for child in (left, right)]
        assert np.array_equal(np.concatenate(parts), below)
        assert depth[left] == depth[right] == depth[node] + 1


@each_method
@pytest.mark.parametrize("scene", FINITE, ids=lambda s: s.__name__)
def test_pairs_and_queries_are_those_of_brute_force(method, scene):
    boxes = scene(200, np.random.default_rng(9))
    tree = BVH.build(boxes, method=method)
    np.testing.assert_array_equal(tree.pairs(), all_pairs(boxes))
    first, rest = boxes[:50], boxes[50:]
    both = all_pairs(AABB.concatenate([first, rest]))
    across = both[(both[:, 0] < 50) & (both[:, 1] >= 50)] - [0, 50]
    asked = BVH.build(rest, method=method).query(first)
    np.testing.assert_array_equal(asked, across)


@each_method
def test_refitted_it_has_the_pairs_of_the_new_places(method):
    rng = np.random.default_rng(3)
    center = rng.uniform(0, 1, (300, 3))
    tree = BVH.build(boxes_about(center, 0.05), method=method)
    moved = boxes_about(center + rng.normal(scale=0.1, size=center.shape), 0.05)
    before = tree.reach.copy()
    refitted = tree.refit(moved)
    np.testing.assert_array_equal(refitted.pairs(), all_pairs(moved))
    assert refitted.children.tolist() == tree.children.tolist()
    assert np.array_equal(tree.reach, before)
    assert refitted.cost() > BVH.build(moved, method=method).cost()


def test_the_cost_of_a_tree_by_hand():
    """Two unit cubes of area 6 and the box (3, 1, 1) around both, of area 14: one test of the
    children at the root, 6/14 tests of a box at either leaf. In a single leaf: 2.
    """
    boxes = AABB([[0.0, 0, 0], [2, 0, 0]], [[1.0, 1, 1], [3, 1, 1]])
    assert BVH.build(boxes, leaf_size=1).cost() == pytest.approx(1 + 12 / 14)
    assert BVH.build(boxes, leaf_size=1).cost(node_cost=3) == pytest.approx(3 + 12 / 14)
    assert BVH.build(boxes, leaf_size=2).cost() == 2.0


def test_surface_area_builds_the_best_tree_of_clusters():
    """What the heuristic is for: in 20 scenes never dearer than the median, and fewer tests in all."""
    tests = np.zeros(2)
    for seed in range(20):
        boxes = clustered(1000, np.random.default_rng(seed))
        best, median = (BVH.build(boxes, method=m) for m in ("surface_area", "median"))
        assert best.cost() < median.cost()
        tests += best.tests(), median.tests()
    assert tests[0] < tests[1]


def test_a_median_is_balanced():
    tree = BVH.build(uniform(1024, np.random.default_rng(0)), method="median", leaf_size=1)  # fmt: skip
    assert tree.right.size == 2047 and tree.depth.max() == 10


def test_morton_codes_interleave_the_bits():
    from course.detection.hierarchy_builds import morton_codes, spread_bits

    rng = np.random.default_rng(5)
    for x in rng.integers(0, 1 << 21, 50).tolist():
        assert int(spread_bits(x)) == sum(((x >> k) & 1) << 3 * k for k in range(21))
    corners = np.array(
        [[x, y, z] for z in (0.0, 1) for y in (0.0, 1) for x in (0.0, 1)]
    )
    low = (1 << 63) // 7  # 2^0 + 2^3 + ...: all bits of x
    expected = [k & 1 | k & 2 | k & 4 for k in range(8)]
    assert morton_codes(corners).tolist() == [low * k for k in expected]


def test_a_tree_of_none_and_of_one():
    none = BVH.build(AABB(np.zeros((0, 3)), np.ones((0, 3))))
    one = BVH.build(AABB(np.zeros((1, 3)), np.ones((1, 3))))
    assert none.pairs().shape == one.pairs().shape == (0, 2)
    assert one.query(one.boxes).tolist() == [[0, 0]]
    assert none.query(one.boxes).shape == one.query(none.boxes).shape == (0, 2)
    assert none.cost() == 0.0 and one.cost() == 1.0
    assert none.children.shape == (0, 2) and none.depth.shape == (0,)


def test_costs_of_huge_boxes_do_not_overflow():
    tree = BVH.build(huge(100, np.random.default_rng(0)))
    assert np.isfinite(tree.cost())


def test_a_query_may_reach_to_infinity():
    tree = BVH.build(uniform(50, np.random.default_rng(0)))
    everything = AABB([[-np.inf] * 3], [[np.inf] * 3])
    assert tree.query(everything).tolist() == [[0, k] for k in range(50)]


def test_wrong_arguments_are_refused_by_name():
    boxes = uniform(5, np.random.default_rng(0))
    tree = BVH.build(boxes)
    endless_box = AABB(np.zeros((2, 3)), [[1.0, 1, 1], [1, np.inf, 1]])
    for said, wrong in (
        ("method: expected one of 'median'", lambda: BVH.build(boxes, method="best")),
        ("leaf_size: expected a whole number", lambda: BVH.build(boxes, leaf_size=0)),
        ("boxes: expected finite boxes.*entry 1", lambda: BVH.build(endless_box)),
        (r"boxes: expected shape \(5, 3\)", lambda: tree.refit(boxes[:4])),
        ("boxes: expected AABB", lambda: tree.query(np.zeros((2, 6)))),
        ("node_cost: expected numbers at or above 0", lambda: tree.cost(node_cost=-1)),
        (
            "boxes: expected coordinates below 1e",
            lambda: SphereTree.build(huge(5, np.random.default_rng(0))),
        ),
    ):
        with pytest.raises(ValueError, match=said):
            wrong()


def test_nobody_writes_to_a_tree():
    tree = BVH.build(uniform(20, np.random.default_rng(0)))
    for array in (tree.order, tree.right, tree.ranges, tree.reach):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


@each_method
def test_spheres_hold_the_boxes_below_them(method):
    for scene in (uniform, clustered):
        boxes = scene(300, np.random.default_rng(2))
        found = SphereTree.build(boxes, method=method)
        for node, (center, radius) in enumerate(
            zip(found.volumes.center, found.volumes.radius, strict=True)
        ):
            below = boxes_below(found.tree, node)
            far = np.maximum(center - boxes.lower[below], boxes.upper[below] - center)
            assert np.linalg.norm(far, axis=1).max() <= radius
        assert np.array_equal(found.pairs(), all_pairs(boxes))
        assert found.tests() > found.tree.tests()
