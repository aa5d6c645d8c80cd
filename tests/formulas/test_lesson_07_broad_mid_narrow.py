"""Pairs of boxes: against two loops, the library and counts that are known."""

import numpy as np
import pytest

from course import detection
from course.formulas.lesson_07_broad_mid_narrow import (
    all_pairs,
    axis_share,
    resort_swaps,
    sweep_and_prune,
)
from course.shapes import AABB


def drawn(seed, n, size=3.0):
    rng = np.random.default_rng(seed)
    lower = rng.uniform(0, 10, (n, 3)).round(1)  # some touch
    return lower, lower + rng.uniform(0, size, (n, 3)).round(1)


def by_loops(lower, upper):
    n = len(lower)
    return [
        [i, j]
        for i in range(n)
        for j in range(i + 1, n)
        if all(lower[i, k] <= upper[j, k] and lower[j, k] <= upper[i, k] for k in range(3))
    ]  # fmt: skip


@pytest.mark.parametrize("n", [0, 1, 2, 30, 60])
def test_pairs_are_those_of_two_loops_and_of_the_library(n):
    lower, upper = drawn(n, n)
    expected = by_loops(lower, upper)
    assert all_pairs(lower, upper).tolist() == expected
    order = np.argsort(lower[:, 0], kind="stable")
    pairs, tests = sweep_and_prune(order, lower, upper)
    assert pairs.tolist() == expected and pairs.shape == (len(expected), 2)
    assert detection.sweep_and_prune(AABB(lower, upper)).tolist() == expected
    shadows = (lower[:, None, 0] <= upper[:, 0]) & (lower[:, 0] <= upper[:, None, 0])
    on_x = np.sum(np.triu(shadows, 1))
    assert tests == on_x, "one test for each pair whose shadows on x overlap"


def test_all_on_one_axis_or_side_by_side():
    """A row along x: n - 1 neighbours touch. A pile along y: all pairs are tested."""
    x = np.arange(6.0)
    row = np.stack([x, 0 * x, 0 * x], axis=-1)
    order = np.arange(6)
    pairs, tests = sweep_and_prune(order, row, row + 1)
    assert len(pairs) == tests == 5
    pile = row[:, [1, 0, 2]]
    pairs, tests = sweep_and_prune(order, pile, pile + 1)
    assert len(pairs) == 5 and tests == 15


def test_swaps_are_the_pairs_in_the_wrong_order():
    rng = np.random.default_rng(2)
    for n in (0, 1, 2, 20):
        order, keys = rng.permutation(n), rng.uniform(size=n)
        found, swaps = resort_swaps(order, keys)
        assert np.all(np.diff(keys[found]) > 0) and sorted(found) == list(range(n))
        wrong = sum(
            keys[order[i]] > keys[order[j]] for i in range(n) for j in range(i + 1, n)
        )
        assert swaps == wrong
    kept, none = resort_swaps(np.array([2, 0, 1]), np.array([1.0, 1.0, 1.0]))
    assert kept.tolist() == [2, 0, 1] and none == 0


def test_the_share_on_one_axis_gives_the_known_number_of_pairs():
    """N = 400, s/L = 0.1: 547.35 pairs are expected."""
    import sympy as sp

    s, L = sp.symbols("s L", positive=True)
    share = sp.lambdify((s, L), axis_share(s, L))
    assert 400 * 399 / 2 * share(0.1, 1.0) ** 3 == pytest.approx(547.35, abs=0.005)
    x, y = np.random.default_rng(3).uniform(0, 2.0, (2, 400_000))
    assert np.mean(np.abs(x - y) <= 0.3) == pytest.approx(share(0.3, 2.0), abs=0.003)
