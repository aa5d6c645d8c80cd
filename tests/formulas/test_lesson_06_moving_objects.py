"""Lesson 06 against motion stepped finely, published figures, and throws of dice."""

import numpy as np
import pytest
from scipy.optimize import brentq

from course.formulas import lesson_06_moving_objects as formulas

STILL, X = np.zeros(3), np.array([1.0, 0, 0])


#: When pictures are taken [s].
TIMES = np.linspace(0, 2, 4001)


def first_overlap(shown):
    """The first time at which a picture shows an overlap; inf if none does."""
    return TIMES[np.argmax(shown)] if shown.any() else np.inf


def agree(found, stepped, step):
    """A step looks late by less than its length, and may miss what grazes."""
    if np.isinf(stepped):
        return np.isinf(found) or found > 0
    return stepped - step <= found <= stepped


def test_spheres_meet_when_a_film_of_them_shows_it():
    rng = np.random.default_rng(1)
    kinds = set()
    for _ in range(40):
        c, d, v, w = rng.normal(0, 1.5, (4, 3))
        r, s = rng.uniform(0.1, 0.7, 2)
        found = formulas.swept_spheres_time(c, r, v, d, s, w, 2.0)
        apart = np.linalg.norm(c - d + (v - w) * TIMES[:, None], axis=1)
        stepped = first_overlap(apart <= r + s)
        assert agree(found, stepped, 2.0 / 4000)
        kinds.add("never" if np.isinf(found) else "at once" if found == 0 else "later")
    assert len(kinds) == 3


def test_boxes_meet_when_a_film_of_them_shows_it():
    rng = np.random.default_rng(2)
    kinds = set()
    for _ in range(60):
        c, d, v, w = rng.normal(0, 1.5, (4, 3))
        e, f = rng.uniform(0.2, 1.2, (2, 3))
        found = formulas.swept_boxes_time(c - e, c + e, v, d - f, d + f, w, 2.0)
        apart = np.abs(c - d + (v - w) * TIMES[:, None])
        stepped = first_overlap(np.all(apart <= e + f, axis=1))
        assert agree(found, stepped, 2.0 / 4000)
        kinds.add("never" if np.isinf(found) else "at once" if found == 0 else "later")
    assert len(kinds) == 3


def test_published_figures():
    """Half extents 1 and 1, centres 10 apart, speed 2; spheres of radius .35 and .5 at 0.1
    a step from x = -5 (libccd's spheresphere: apart at step 41, overlapping at 42)."""
    one, far = np.ones(3), 10 * X
    assert formulas.swept_boxes_time(-one, one, 2 * X, far - one, far + one, STILL, 9.0) == 4  # fmt: skip
    steps = formulas.swept_spheres_time(-5 * X, 0.35, 0.1 * X, STILL, 0.5, STILL, 99.0)
    assert steps == pytest.approx(41.5, rel=1e-13)
    bullet = formulas.swept_spheres_time(STILL, 0.002, 900 * X, X, 0.002, STILL, 1 / 60)
    assert bullet == pytest.approx(0.996 / 900, rel=1e-13)


@pytest.mark.parametrize(
    "velocity, expected",
    [(2 * X, 0.0), (-X, np.inf), (STILL, np.inf), ((0, 1.0, 0), np.inf)],
)
def test_those_that_touch_meet_only_if_they_approach(velocity, expected):
    one, v = np.ones(3), np.array(velocity)
    assert formulas.swept_boxes_time(-one, one, v, one * (1, -1, -1), 3 * one, STILL, 9.0) == expected  # fmt: skip
    assert formulas.swept_spheres_time(STILL, 1.0, v, 3 * X, 2.0, STILL, 9.0) == expected  # fmt: skip
    # Those that overlap meet at once, whichever way they move.
    assert formulas.swept_boxes_time(-one, one, v, 0 * one, 3 * one, STILL, 9.0) == 0
    assert formulas.swept_spheres_time(STILL, 1.0, v, 2.9 * X, 2.0, STILL, 9.0) == 0


def test_a_batch_is_its_members_and_the_horizon_ends_it():
    speed = np.array([1.0, 2.0, 4.0])[:, None] * X
    found = formulas.swept_spheres_time(STILL, 1.0, speed, 6 * X, 1.0, STILL, 2.0)
    assert found.tolist() == [np.inf, 2.0, 1.0]
    one = np.ones(3)
    found = formulas.swept_boxes_time(-one, one, speed, 5 * X - one, 5 * X + one, STILL, 1.5)  # fmt: skip
    assert found.tolist() == [np.inf, 1.5, 0.75]


def test_the_share_of_misses_is_what_dice_say():
    """A bullet of 4 mm at 900 m/s, a wall of 10 cm, 60 looks a second: 99 in 100 pass."""
    assert formulas.miss_probability(0.1, 0.002, 900.0, 1 / 60) == pytest.approx(1 - 0.104 / 15)  # fmt: skip
    rng = np.random.default_rng(3)
    thickness, radius, way = np.array([0.2, 1.0, 0.5]), 0.1, 0.8
    first = rng.uniform(0, way, 200_000)[:, None]  # the first look in front of the wall
    inside = (first - radius <= thickness) & (first + radius >= 0)
    # Looks follow at every `way`; the wall begins at 0, the ball comes from below.
    behind = first - way
    inside |= (behind - radius <= thickness) & (behind + radius >= 0)
    found = formulas.miss_probability(thickness, radius, 8.0, 0.1)
    np.testing.assert_allclose(found, 1 - inside.mean(axis=0), atol=5e-3)
    assert found[1] == 0
    assert formulas.miss_probability(0.1, 0.1, 0.0, 0.1) == 0


def test_a_rod_comes_to_the_ball_from_below():
    """pi/2 - asin(r/1) for a ball across; by root finding where the spin leans."""
    for tolerance in 1e-3, 1e-9:
        found = formulas.conservative_advancement(
            STILL, 2 * X, np.array([0, 0, 1.0]), np.array([0, 1.0, 0]), 0.1, 9.0, tolerance
        )  # fmt: skip
        exact = np.pi / 2 - np.arcsin(0.1)
        assert exact - 2 * tolerance <= found <= exact
    from scipy.spatial.transform import Rotation

    arm, spin, ball = np.array([1.5, 0.2, 0.5]), np.array([0.1, 0.2, 2.0]), np.array([0.1, 1.0, 0.3])  # fmt: skip

    def gap(t):
        rod = Rotation.from_rotvec(spin * t).apply(arm)
        s = np.linspace(0, 1, 100_001)[:, None]
        return np.min(np.linalg.norm(ball - s * rod, axis=1)) - 0.25

    exact = brentq(gap, 0.0, 0.65, xtol=1e-9)
    found = formulas.conservative_advancement(STILL, arm, spin, ball, 0.25, 9.0, 1e-8)
    assert exact - 1e-6 <= found <= exact + 1e-8


def test_a_rod_that_passes_or_rests_never_meets():
    ball = np.array([0, 1.0, 0.5])
    spin = np.array([0, 0, 1.0])
    meets = formulas.conservative_advancement
    assert meets(STILL, 2 * X, spin, ball, 0.4, 20.0, 1e-6) == np.inf
    assert meets(STILL, 2 * X, STILL, ball, 0.4, 20.0, 1e-6) == np.inf
    assert meets(STILL, 2 * X, STILL, 0.3 * ball, 0.4, 20.0, 1e-6) == 0


def test_the_meeting_time_is_the_lower_root_of_the_quadratic():
    """Roots by companion matrix (np.roots), for those that meet ahead."""
    import sympy as sp

    symbols = sp.symbols("a b c")
    time = sp.lambdify(symbols, formulas.meeting_time(*symbols))
    rng = np.random.default_rng(4)
    for _ in range(30):
        first, second = np.sort(rng.uniform(0.1, 5.0, 2))
        a = rng.uniform(0.2, 9.0)
        b, c = -0.5 * a * (first + second), a * first * second
        assert time(a, b, c) == pytest.approx(np.roots([a, 2 * b, c]).min(), rel=1e-9)


def test_boxes_that_only_graze_meet_and_those_that_slide_along_do_not():
    """The gap in y is 0 all the time: they meet when it is 0 along x as well."""
    one, aside = np.ones(3), np.array([5.0, 2.0, 0.0])
    found = formulas.swept_boxes_time(
        -one, one, X, aside - one, aside + one, STILL, 9.0
    )
    assert found == 3
    aside[0] = 0.0
    found = formulas.swept_boxes_time(
        -one, one, X, aside - one, aside + one, STILL, 9.0
    )
    assert np.isinf(found)


@pytest.mark.parametrize("radius", [0.3, 1.7])
def test_it_is_what_the_library_says(radius):
    """The library is held to its own truths; a drawn batch must not differ from it."""
    from course.overlap import time_of_impact
    from course.shapes import AABB, Sphere

    rng = np.random.default_rng(6)
    c, d, v, w = rng.normal(0, 2, (4, 2000, 3))
    found = formulas.swept_spheres_time(c, radius, v, d, 0.5, w, 4.0)
    truth = time_of_impact(Sphere(c, radius), Sphere(d, 0.5), v, w, horizon=4.0)
    np.testing.assert_allclose(found, truth, rtol=1e-9)
    assert np.isfinite(truth).sum() > 30
    boxes = [(x - radius, x + radius) for x in (c, d)]
    found = formulas.swept_boxes_time(*boxes[0], v, *boxes[1], w, 4.0)
    truth = time_of_impact(AABB(*boxes[0]), AABB(*boxes[1]), v, w, horizon=4.0)
    np.testing.assert_allclose(found, truth, rtol=1e-9)
