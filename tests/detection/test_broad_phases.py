"""Every broad phase gives the pairs of brute force, whatever the boxes, in one form."""

import numpy as np
import pytest
from detection.drawn_boxes import SCENES, boxes_about, judged, uniform
from hypothesis import given, settings
from hypothesis import strategies as st

from course import detection
from course.shapes import AABB, Sphere

PHASES = {
    "all_pairs": detection.all_pairs,
    "sweep_and_prune": detection.sweep_and_prune,
    "bvh": detection.bvh,
    "uniform_grid": detection.uniform_grid,
    "kd_tree": detection.kd_tree,
    "bsp_tree": detection.bsp_tree,
    "sphere_tree": detection.sphere_tree,
    "broad_phase": detection.broad_phase,
}
each_phase = pytest.mark.parametrize("phase", PHASES.values(), ids=PHASES)


def assert_form(pairs, n):
    """(m, 2) of intp, i < j, sorted, none twice."""
    assert pairs.dtype == np.intp and pairs.ndim == 2 and pairs.shape[1] == 2
    assert np.all(pairs[:, 0] < pairs[:, 1])
    flat = pairs[:, 0] * n + pairs[:, 1]
    assert np.all(np.diff(flat) > 0)


@each_phase
@pytest.mark.parametrize("scene", SCENES, ids=lambda s: s.__name__)
def test_pairs_are_those_of_the_definition(phase, scene):
    for n, seed in ((2, 0), (3, 1), (60, 2), (150, 3)):
        boxes = scene(n, np.random.default_rng(seed))
        pairs = phase(boxes)
        assert_form(pairs, n)
        assert pairs.tolist() == judged(boxes)


@each_phase
@pytest.mark.parametrize("scene", SCENES, ids=lambda s: s.__name__)
@pytest.mark.slow
def test_many_boxes_have_the_pairs_of_brute_force(phase, scene):
    boxes = scene(1500, np.random.default_rng(5))
    np.testing.assert_array_equal(phase(boxes), detection.all_pairs(boxes))


@each_phase
def test_one_box_and_none_have_no_pairs(phase):
    for n in (0, 1):
        pairs = phase(AABB(np.zeros((n, 3)), np.ones((n, 3))))
        assert pairs.shape == (0, 2) and pairs.dtype == np.intp


@each_phase
def test_a_hair_apart_is_no_pair(phase):
    """Closed boxes: what shares a face is a pair, what is one rounding unit off is none."""
    lower = np.array([[0.0, 0, 0], [1, 0, 0], [0, np.nextafter(1, 2), 0]])
    boxes = AABB(lower, lower + 1)
    assert phase(boxes).tolist() == [[0, 1]]


@each_phase
def test_a_column_of_cubes_swept_past_others(phase):
    """Six boxes: a column of five unit cubes apart from each other, and the box of a sixth
    that is swept across all of them: 5 pairs of 15.
    """
    lower = np.array([[0.0, 0, 2 * k] for k in range(5)] + [[0.5, 0, 0]])
    upper = np.array([[1.0, 1, 2 * k + 1] for k in range(5)] + [[1.5, 1, 9]])
    assert phase(AABB(lower, upper)).tolist() == [[k, 5] for k in range(5)]


# Few values, so that bounds coincide; and any finite ones.
NUMBERS = st.one_of(
    st.integers(-3, 3).map(float), st.floats(allow_nan=False, allow_infinity=False)
)


@each_phase
@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(*[NUMBERS] * 6), max_size=25))
@pytest.mark.slow
def test_any_boxes(phase, rows):
    ends = np.array(rows, dtype=float).reshape(-1, 2, 3)
    boxes = AABB(ends.min(axis=1), ends.max(axis=1))
    assert phase(boxes).tolist() == judged(boxes)


@each_phase
def test_the_order_of_the_boxes_renames_the_pairs(phase):
    rng = np.random.default_rng(8)
    boxes, turn = uniform(300, rng), rng.permutation(300)
    renamed = np.sort(turn[phase(boxes[turn])], axis=1)
    expected = phase(boxes).tolist()
    assert sorted(renamed.tolist()) == expected and len(expected) > 100


@each_phase
@pytest.mark.slow
def test_the_expected_number_of_pairs(phase):
    """C(N, 2)(1 - (1 - s/L)^2)^3 = 547.35 for N = 400, s/L = 0.1: of two centres uniform in a
    side L, |x - y| <= s has the probability 1 - (1 - s/L)^2. The mean of 100 scenes within
    five of its own standard errors.
    """
    expected = 400 * 399 / 2 * (1 - 0.9**2) ** 3
    assert abs(expected - 547.35) < 0.01
    rng = np.random.default_rng(13)
    counts = [len(phase(uniform(400, rng, size=0.1))) for _ in range(100)]
    assert abs(np.mean(counts) - expected) < 5 * np.std(counts) / 10


@each_phase
@pytest.mark.parametrize(
    "wrong, said",
    [
        (Sphere(np.zeros((2, 3)), 1.0), "boxes: expected AABB .*; got Sphere"),
        (np.zeros((2, 6)), "boxes: expected AABB .*; got ndarray"),
        (AABB(np.zeros(3), np.ones(3)), r"boxes: expected AABB .*; got batch \(\)"),
        (AABB(np.zeros((2, 2, 3)), 1.0 + np.zeros(3)), r"got batch \(2, 2\)"),
    ],
)
def test_anything_but_a_row_of_boxes_is_refused(phase, wrong, said):
    with pytest.raises(ValueError, match=said):
        phase(wrong)


@each_phase
def test_inputs_are_not_written(phase):
    rng = np.random.default_rng(2)
    lower = rng.uniform(0, 1, (50, 3))
    upper = lower + 0.3
    before = lower.copy(), upper.copy()
    first = phase(AABB(lower, upper))
    assert np.array_equal(lower, before[0]) and np.array_equal(upper, before[1])
    np.testing.assert_array_equal(phase(AABB(lower, upper)), first)


def test_the_judge_knows_what_is_closed():
    assert judged(boxes_about([[0, 0, 0], [2, 2, 2], [5, 0, 0]], 1.0)) == [[0, 1]]
