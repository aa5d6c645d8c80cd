"""Where sweeps of balls break: the shares that rounding says, and the cures."""

import numpy as np
import pytest

from course import formulas
from course.overlap import time_of_impact
from course.shapes import Sphere
from course.study import (
    depth_says,
    held_share,
    impact_by_nearest,
    rounding_of_the_root_says,
    stopped_shots,
    wrong_in_single,
)
from course.study.grazing_shots import far_shots

FAR = [1.0, 5.0, 20.0, 200.0]


def test_far_shots_are_of_32_bits_and_half_of_them_hit():
    shots = far_shots(10.0, 2000, seed=1)
    assert all(np.asarray(x).dtype == np.float32 for x in shots)
    assert formulas.swept_spheres_time(*shots).dtype == np.float32
    x, r, v, y, s, w, horizon = (np.asarray(value, dtype=float) for value in shots)
    time = time_of_impact(Sphere(x, r), Sphere(y, s), v, w, horizon=horizon)
    assert np.isfinite(time).mean() == pytest.approx(0.5, abs=0.04)


def test_wrong_verdicts_are_those_that_rounding_says():
    """Of 4,000: within a quarter of what is said, or half a percent."""
    found = wrong_in_single(formulas.swept_spheres_time, FAR)
    said = rounding_of_the_root_says(FAR)
    assert found == pytest.approx(said, rel=0.25, abs=0.005)
    assert found[0] < 0.01 and found[-1] > 0.4


def test_the_nearest_approach_cures_it():
    assert wrong_in_single(impact_by_nearest, FAR).max() < 0.005


def test_by_the_nearest_approach_it_is_the_same_time():
    rng = np.random.default_rng(4)
    x, y = rng.normal(0, 2, (2, 300, 3))
    v = rng.normal(0, 1, (300, 3)) - (x - y)
    given = x, 0.4, v, y, 0.5, np.zeros((300, 3)), 3.0
    expected = formulas.swept_spheres_time(*given)
    assert np.isfinite(expected).sum() > 50
    np.testing.assert_allclose(impact_by_nearest(*given), expected, rtol=1e-9)


def test_stopped_balls_touch_and_part():
    x, r, v, y, s, w, _ = stopped_shots(formulas.swept_spheres_time, 0.0, count=500)
    gap = np.linalg.norm(x - y, axis=-1) - r - s
    assert np.abs(gap).max() < 1e-13 and np.all(np.sum((x - y) * (v - w), axis=-1) > 0)
    short = stopped_shots(formulas.swept_spheres_time, 0.01, count=500)
    gap = np.linalg.norm(short[0] - short[3], axis=-1) - short[1] - short[4]
    assert gap == pytest.approx(0.01, abs=1e-12)


def test_half_of_them_are_held_as_rounding_says_and_none_if_asked_only_when_they_approach():
    shorts = [0.0, 1e-15, 3e-15, 1e-14, 1e-13]
    found = held_share(formulas.swept_spheres_time, shorts)
    assert found == pytest.approx(depth_says(shorts), abs=0.03)
    assert found[0] > 0.4 and found[-1] == 0
    cured = held_share(formulas.swept_spheres_time, shorts, only_approaching=True)
    assert cured.max() == 0
