"""Two blocks and a wall: the collisions count pi, and where rounding decides instead."""

from fractions import Fraction

import numpy as np
import pytest

from course.dynamics import (
    count_collisions,
    critical_mass_ratio,
    pi_count,
    predicted_count,
    two_blocks,
)

PI = "31415926535897932384626433832795028841971693993751"


@pytest.mark.parametrize("exponent", range(4))
@pytest.mark.parametrize("arithmetic", ["float64", "float32", "exact"])
def test_mass_ratio_100_to_the_k_counts_k_plus_1_digits_of_pi(exponent, arithmetic):
    assert count_collisions(100**exponent, arithmetic=arithmetic) == int(
        PI[: exponent + 1]
    )


def test_more_digits_in_float64():
    assert count_collisions(100**5) == 314159


def test_formula_in_whole_numbers_and_where_its_float64_form_stops():
    for k in (0, 1, 8, 16, 30, 49):
        assert str(pi_count(k)) == PI[: k + 1]
    assert predicted_count(100**8) == 314159265
    assert predicted_count(100**17) != pi_count(17)


@pytest.mark.parametrize(
    "ratio", [Fraction(1, 3), 1, Fraction(22, 7), 3, 50, Fraction(10**7, 3)]
)
def test_any_ratio_three_ways(ratio):
    exact = count_collisions(ratio, arithmetic="exact")
    assert exact == count_collisions(ratio) == predicted_count(ratio)


def test_rounding_decides_grazes():
    # cot^2(pi/n): the n-th collision is a graze; float64 miscounts some of these, each by one.
    wrong = 0
    for n in range(5, 60):
        ratio = critical_mass_ratio(n)
        exact, rounded = (
            count_collisions(ratio, arithmetic="exact"),
            count_collisions(ratio),
        )
        assert exact in (n - 1, n) and abs(exact - rounded) <= 1
        wrong += exact != rounded
    assert wrong > 0
    assert critical_mass_ratio(4) == pytest.approx(1) and critical_mass_ratio(
        6
    ) == pytest.approx(3)
    assert count_collisions(3, arithmetic="exact") == 5


def test_motion_is_a_billiard_on_a_circle():
    motion = two_blocks(100, speed=2.0)
    assert motion.count == 31 and motion.time.shape == (31,)
    radius = np.linalg.norm(motion.scaled_velocity, axis=1)
    assert np.allclose(radius, 20.0, rtol=1e-14)  # sqrt(m2) * speed: energy kept
    assert np.all(np.diff(motion.time) > 0) and motion.time[0] == 0.5  # gap 1 at 2 m/s
    assert np.array_equal(
        motion.at_wall, np.arange(31) % 2 == 1
    )  # by turns, the blocks first
    assert np.all(motion.position[motion.at_wall, 0] == 0)
    meets = motion.position[~motion.at_wall]
    assert np.allclose(meets[:, 0], meets[:, 1]) and np.all(meets[:, 0] > 0)
    v_1, v_2 = motion.velocity[-1]
    assert 0 <= v_1 <= v_2  # nothing will meet again
    momentum = motion.velocity @ motion.mass
    assert np.allclose(np.diff(momentum)[~motion.at_wall], 0, atol=1e-12)


def test_picture_does_not_depend_on_the_units():
    fast, slow = two_blocks(16, speed=3.0, start=(2.0, 4.0)), two_blocks(16)
    assert np.allclose(fast.time, slow.time * 2 / 3) and np.allclose(
        fast.position, 2 * slow.position
    )


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: count_collisions(0), "mass_ratio: expected a positive number; got 0"),
        (lambda: count_collisions(-1.0), "mass_ratio: expected positive numbers; got -1.0"),
        (lambda: count_collisions(np.inf), "mass_ratio: expected finite"),
        (lambda: count_collisions(2, arithmetic="float16"), "arithmetic: expected one of 'float64', 'float32'"),
        (lambda: two_blocks(100, start=(2.0, 1.0)), "start: expected 0 < x1 < x2"),
        (lambda: two_blocks(100**6), "mass_ratio: expected at most 100000 collisions; got 3141592"),
        (lambda: pi_count(-1), "exponent: expected a whole number of at least 0"),
        (lambda: critical_mass_ratio(2), "count: expected a whole number of at least 3"),
    ],
)  # fmt: skip
def test_refuses(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_paths_are_straight_between_collisions():
    motion = two_blocks(3.0, speed=2.0, start=(1.0, 2.5))
    time, place = motion.paths(1.5 * motion.time[-1])
    speed = np.diff(place, axis=0) / np.diff(time)[:, None]
    np.testing.assert_allclose(speed, motion.velocity, atol=1e-12)
    np.testing.assert_allclose(place[0], [1.0, 2.5])
    assert np.all(place[:, 0] >= -1e-12)
    assert np.all(place[:, 1] >= place[:, 0] - 1e-12)
    with pytest.raises(ValueError, match="end: expected at least"):
        motion.paths(0.5 * motion.time[-1])


@pytest.mark.parametrize("ratio", [1.0, 3.7, 100.0])
def test_the_last_state_lies_in_the_wedge_and_no_other_does(ratio):
    motion = two_blocks(ratio)
    angle = np.arctan2(*motion.scaled_velocity.T)  # from the axis of block 2
    within = (angle >= 0) & (angle <= motion.wedge_angle + 1e-12)
    assert within[-1] and not within[:-1].any()
