"""Words for contacts, placed points and tightness, against falls that are stepped,
libraries that turn, and points that are counted."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from course import formulas

WORDS = {"apart", "penetrating", "colliding", "separating", "sliding", "resting"}


@pytest.mark.parametrize(
    ("speed", "gravity"), [(0.1635, 9.81), (1.0, 9.81), (2.0, 1.62)]
)
def test_a_fall_from_the_hidden_drop_ends_at_the_speed(speed, gravity):
    """Stepped, in a hundred thousand steps: no square and no half in it."""
    height, v, step = formulas.hidden_drop(speed, gravity), 0.0, speed / gravity * 1e-5
    while height > 0:
        v += gravity * step
        height -= v * step
    assert v == pytest.approx(speed, rel=1e-4)


def drawn(count, seed=0):
    rng = np.random.default_rng(seed)
    tolerance = (0.004, 0.3)
    gap, rate = rng.uniform(-0.012, 0.012, count), rng.uniform(-0.9, 0.9, count)
    return gap, rate, rng.uniform(0.0, 0.6, count), tolerance


def test_the_six_words_hold_all_there_is_and_each_occurs():
    said = formulas.contact_state(*drawn(4000))
    assert set(said) == WORDS


def test_words_by_what_happens_next():
    """Moved on for a moment without any answer: what comes nearer is colliding, ..."""
    gap, rate, slip, (distance, speed) = drawn(4000)
    said = formulas.contact_state(gap, rate, slip, (distance, speed))
    later = gap + 1e-3 * rate
    way = 1e-3 * speed
    touches = np.abs(gap) <= distance
    nearer, farther = gap - later > way, later - gap > way
    assert np.array_equal(said == "colliding", touches & nearer)
    assert np.array_equal(said == "separating", touches & farther)
    along = touches & ~nearer & ~farther
    assert np.array_equal(along, np.isin(said, ["sliding", "resting"]))
    assert np.all(slip[said == "sliding"] > speed) and np.all(slip[said == "resting"] <= speed)  # fmt: skip
    assert np.all(gap[said == "apart"] > 0) and np.all(gap[said == "penetrating"] < 0)


def test_the_tolerances_are_that_of_the_length_and_that_of_the_speed():
    """In other units of length and time the words are the same."""
    gap, rate, slip, (distance, speed) = drawn(500)
    said = formulas.contact_state(gap, rate, slip, (distance, speed))
    mm, minutes = 1000.0, 1 / 60.0
    v = mm / minutes
    other = formulas.contact_state(mm * gap, v * rate, v * slip, (mm * distance, v * speed))  # fmt: skip
    assert np.array_equal(said, other)


def test_one_pair_gives_one_word_and_a_batch_one_for_each():
    assert formulas.contact_state(0.0, -0.1635, 0.0, (0.003, 0.05)) == "colliding"
    assert formulas.contact_state(0.0, -0.1635, 0.0, (0.003, 0.33)) == "resting"
    gap, rate, slip, tolerance = drawn(12)
    grid = formulas.contact_state(gap.reshape(3, 4), rate.reshape(3, 4), slip.reshape(3, 4), tolerance)  # fmt: skip
    one_by_one = [formulas.contact_state(*each, tolerance) for each in zip(gap, rate, slip, strict=True)]  # fmt: skip
    assert grid.ravel().tolist() == [str(word) for word in one_by_one]


def test_what_lies_on_a_tolerance_is_within_it():
    on = (0.25, 0.5)
    for given in ((0.25, 0, 0), (-0.25, 0, 0), (0, -0.5, 0), (0, 0.5, 0), (0, 0, 0.5)):
        assert formulas.contact_state(*map(float, given), on) == "resting"


def test_points_are_placed_as_scipy_turns_them():
    rng = np.random.default_rng(2)
    turns, shift = Rotation.random(5, random_state=3), rng.normal(size=(5, 3))
    points = rng.normal(size=(5, 7, 3))
    placed = formulas.place(points, turns.as_matrix(), shift)
    for k in range(5):
        assert np.allclose(placed[k], turns[k].apply(points[k]) + shift[k], atol=1e-14)


def test_a_placed_body_keeps_its_distances_and_its_volume():
    rng = np.random.default_rng(4)
    points, turn = rng.normal(size=(20, 3)), Rotation.random(random_state=5).as_matrix()
    placed = formulas.place(points, turn, np.array([3.0, -1.0, 2.0]))
    before, after = ConvexHull(points).volume, ConvexHull(placed).volume
    assert after == pytest.approx(before, rel=1e-12)
    i, j = np.triu_indices(20, 1)
    lengths = [np.linalg.norm(p[i] - p[j], axis=-1) for p in (points, placed)]
    assert np.allclose(*lengths, atol=1e-13)


def test_tightness_is_the_share_of_the_collider_s_points_that_are_filled():
    """A ball in its cube: of points drawn in the cube, pi/6 are in the ball."""
    points = np.random.default_rng(6).uniform(-1, 1, (400_000, 3))
    share = np.mean(np.sum(points**2, axis=-1) <= 1)
    assert formulas.tightness(8.0, 4 * np.pi / 3) == pytest.approx(share, abs=4e-3)
    assert np.allclose(formulas.tightness(np.array([2.0, 4.0]), 1.0), [0.5, 0.25])
