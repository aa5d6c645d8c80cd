"""Trees of boxes: against brute force, the library's tree, and counts by hand."""

import numpy as np
import pytest

from course.detection import BVH
from course.formulas.lesson_03_bounding_volume_hierarchies import (
    break_even,
    enclose,
    median_split,
    query_tree,
    refit,
    surface_area_cost,
)
from course.shapes import AABB


def drawn(rng, n, size=1.0):
    lower = rng.uniform(0, 10, (n, 3))
    return lower, lower + rng.uniform(0, size, (n, 3))


def tree_of(lower, upper, method="median"):
    """The library's tree with one box a leaf, as the formulas take it."""
    tree = BVH.build(AABB(lower, upper), method=method, leaf_size=1)
    children = tree.children.copy()
    leaves = np.flatnonzero(tree.is_leaf)
    children[leaves, 1] = tree.order[tree.ranges[leaves, 0]]
    return children, tree.reach[:, :3].copy(), tree.reach[:, 3:].copy()


def test_a_tree_finds_what_brute_force_finds():
    rng = np.random.default_rng(3)
    for n in (1, 2, 3, 50):
        lower, upper = drawn(rng, n)
        tree = tree_of(lower, upper)
        for _ in range(40):
            a, b = (x[0] for x in drawn(rng, 1, size=6.0))
            found, tests = query_tree(*tree, a, b)
            meets = np.all((lower <= b) & (a <= upper), axis=-1)
            assert found.tolist() == np.flatnonzero(meets).tolist()
            assert 1 <= tests <= 2 * n - 1 and tests % 2 == 1


def test_what_meets_everything_costs_every_node():
    lower, upper = drawn(np.random.default_rng(4), 33)
    found, tests = query_tree(*tree_of(lower, upper), np.zeros(3), np.full(3, 20.0))
    assert found.tolist() == list(range(33)) and tests == 2 * 33 - 1


def test_touching_is_met():
    lower, upper = (
        np.array([[0.0, 0, 0], [2, 0, 0]]),
        np.array([[1.0, 1, 1], [3, 1, 1]]),
    )
    found, _ = query_tree(*tree_of(lower, upper), np.array([1.0, 1, 1]), np.array([1.5, 2, 2]))  # fmt: skip
    assert found.tolist() == [0]


def test_a_box_around_boxes_holds_all_corners_and_no_more():
    lower, upper = drawn(np.random.default_rng(5), 20)
    a, b = enclose(lower, upper)
    corners = np.concatenate([lower, upper])
    assert np.all(corners >= a) and np.all(corners <= b)
    assert np.array_equal(a, lower.min(axis=0)) and np.array_equal(b, upper.max(axis=0))
    many = enclose(lower.reshape(4, 5, 3), upper.reshape(4, 5, 3))
    assert many[0].shape == many[1].shape == (4, 3)


@pytest.mark.parametrize("n", [2, 3, 10, 11])
def test_no_other_halves_are_farther_along_the_axis(n):
    lower, upper = drawn(np.random.default_rng(n), n)
    lower[:, 1] *= 7
    upper[:, 1] *= 7
    first, second = median_split(lower, upper)
    center = (lower + upper)[:, 1]
    assert len(first) == n // 2 and len(second) == n - n // 2
    assert sorted([*first, *second]) == list(range(n))
    assert center[first].max() <= center[second].min()


def test_boxes_with_one_centre_are_halved_too():
    lower, upper = np.full((6, 3), -1.0), np.full((6, 3), 1.0)
    first, second = median_split(lower, upper)
    assert first.tolist() == [0, 1, 2] and second.tolist() == [3, 4, 5]


def test_boxes_with_the_same_place_on_the_axis_keep_their_order():
    lower = np.zeros((300, 3))
    lower[:, 2] = np.random.default_rng(1).integers(0, 4, 300)
    halves = np.concatenate(median_split(lower, lower + 1))
    assert halves.tolist() == sorted(range(300), key=lambda k: lower[k, 2])


def test_costs_of_cuts_by_hand_and_by_dice():
    """Cubes of 1 m at x = 0, 1 and 5: areas 6, 10 and 26; and 22 of the last two."""
    lower = np.array([[0.0, 0, 0], [1, 0, 0], [5, 0, 0]])
    cost = surface_area_cost(lower, lower + 1)
    assert cost == pytest.approx([(6 * 1 + 22 * 2) / 26, (10 * 2 + 6 * 1) / 26])
    rng = np.random.default_rng(8)
    lower, upper = drawn(rng, 9)
    order = np.argsort(lower[:, 0] + upper[:, 0])
    lower, upper = lower[order], upper[order]
    whole = enclose(lower, upper)
    # Lines that meet the whole, each equally likely, meet a part by the ratio of areas.
    point = rng.normal(size=(60_000, 3))
    point /= np.linalg.norm(point, axis=-1, keepdims=True)
    other = rng.normal(size=(60_000, 3))
    other /= np.linalg.norm(other, axis=-1, keepdims=True)
    middle, radius = np.add(*whole) / 2, np.linalg.norm(np.subtract(*whole)) / 2
    start, way = middle + radius * point, radius * (other - point)

    def met(a, b):
        one, two = (a - start) / way, (b - start) / way
        enter = np.minimum(one, two).max(axis=-1)
        return enter <= np.maximum(one, two).min(axis=-1)

    meets = met(*whole)
    k = 4
    parts = [met(*enclose(lower[s], upper[s])) for s in (slice(k), slice(k, None))]
    share = [np.mean(part[meets]) for part in parts]
    dice = share[0] * k + share[1] * (9 - k)
    assert dice == pytest.approx(surface_area_cost(lower, upper)[k - 1], rel=0.03)


def test_a_refitted_tree_is_the_one_of_the_new_places():
    rng = np.random.default_rng(9)
    lower, upper = drawn(rng, 21)
    children, low, high = tree_of(lower, upper)
    shift = rng.normal(size=lower.shape)
    leaves = children[:, 0] < 0
    low[leaves] += shift[children[leaves, 1]]
    high[leaves] += shift[children[leaves, 1]]
    before = low.copy()
    new_low, new_high = refit(children, low, high)
    assert np.array_equal(low, before), "the given arrays are not written in"
    tree = BVH.build(AABB(lower, upper), method="median", leaf_size=1)
    right = tree.refit(AABB(lower + shift, upper + shift)).reach
    assert new_low == pytest.approx(right[:, :3]) and new_high == pytest.approx(right[:, 3:])  # fmt: skip


def test_one_cut_breaks_even_where_its_cost_is_the_number_of_boxes():
    import sympy as sp

    n = sp.Symbol("n", positive=True)
    p = break_even(n)
    assert sp.simplify(2 + p * n - n) == 0
    assert p.subs(n, 2) == 0
