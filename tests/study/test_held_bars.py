"""A corner on a turning plank: the right b keeps it there, wrong ones let it sink or throw it off."""

from __future__ import annotations

import numpy as np
import pytest

from course import formulas
from course.exercises.definition import find_exercise
from course.scenes import GRAVITY
from course.study.held_bars import BAR, HALF, INERTIA, held_bar, terms_changed

pytestmark = pytest.mark.slow  # with its like, left out of --quick


@pytest.mark.parametrize(
    ("rate_a", "rate_b"), [(0, 0), (0.5, 1.2), (-1.0, 1.5), (1.5, -1.0)]
)
def test_the_right_b_keeps_the_gap_at_second_order(rate_a, rate_b):
    gaps = []
    for count in (21, 41, 81):
        bar = held_bar(rate_a, rate_b, 0.6, np.linspace(0, 0.3, count))
        assert bar.force.min() > 0
        gaps.append(np.abs(bar.gap).max())
    assert gaps[1] < 2e-3 and gaps[2] < 0.3 * gaps[1] < 0.09 * gaps[0] * 1.1


def test_from_rest_the_force_is_that_of_a_bar_let_go_at_one_end():
    """f = g / (1/m + l^2/I) with the corner l = BAR aside of the centre."""
    bar = held_bar(0.0, 0.0, 0.5, np.linspace(0, 0.1, 11))
    assert bar.force[0] == pytest.approx(GRAVITY / (1 + BAR**2 / INERTIA))


def test_in_free_fall_the_gap_is_what_gravity_makes_of_it():
    times = np.linspace(0, 0.3, 31)
    bar = held_bar(0.0, 0.0, 0.5, times, function=lambda *given: 1.0)
    np.testing.assert_allclose(bar.gap, -0.5 * GRAVITY * times**2, atol=1e-12)
    np.testing.assert_allclose(bar.corner[0], [0, 0.5, HALF], atol=1e-12)


def test_without_n_dot_it_sinks_in_and_as_printed_it_is_thrown_off():
    times = np.linspace(0, 0.4, 41)
    mistakes = find_exercise("contact_bias")[1].mistakes
    lost = next(m.function for m in mistakes if m.name == "N_dot lost")
    assert held_bar(0.5, 1.2, 0.6, times, function=lost).gap[-1] < -0.03
    assert held_bar(0.5, 1.2, 0.6, times, function=terms_changed).gap[-1] > 0.5


def test_b_is_asked_as_its_exercise_has_it():
    kept = []

    def seen(*given):
        kept.append(given)
        return formulas.contact_bias(*given)

    held_bar(0.5, 1.2, 0.6, np.linspace(0, 0.1, 3), function=seen)
    p, n, face, body_a, body_b = kept[0]
    assert p.shape == n.shape == (3,) and face == "face_b"
    assert (
        [part.shape for part in body_a] == [part.shape for part in body_b] == [(3,)] * 5
    )
