"""The handle by steps and by accelerations, against its exact motion and a spring's."""

from __future__ import annotations

import numpy as np
import pytest

from course.dynamics import free_tumble
from course.scenes import handle_mass_properties, spinning_handle
from course.study.stepped_handles import (
    STRETCH,
    by_acceleration,
    by_body_momentum,
    by_free_acceleration,
    by_inertia,
    by_steps,
    without_cross,
    without_gyration,
)

pytestmark = pytest.mark.slow  # with its like, left out of --quick

TILT = np.radians(20)
START = {"tilt": TILT}


def error(motion):
    """Of omega over the whole motion [rad/s]."""
    truth = free_tumble(spinning_handle(tilt=TILT).bodies, motion.times)
    return np.abs(motion.angular_velocity - truth.angular_velocity).max()


@pytest.mark.parametrize(
    ("make", "order", "most"),
    [
        (lambda h: by_steps(h, 0.5, 0.0, **START), 1, 0.6),
        (lambda h: by_body_momentum(h, 0.5, **START), 2, 1e-3),
        (lambda h: by_acceleration(h, 0.5, **START), 2, 2e-2),
    ],
)
def test_the_free_handle_comes_to_its_exact_motion(make, order, most):
    coarse, fine = error(make(0.01)), error(make(0.005))
    assert fine < most
    assert np.log2(coarse / fine) == pytest.approx(order, abs=0.25)


def test_held_at_its_centre_it_swings_as_a_spring_does():
    """x = s (1 - cos w t) for a spring that is stretched by s at the start, w^2 = k/m."""
    stiffness, mass = 20.0, float(handle_mass_properties().mass)
    motion = by_steps(0.001, 2.0, stiffness, tilt=TILT, arm=np.zeros(3))
    swing = 1 - np.cos(np.sqrt(stiffness / mass) * motion.times)
    np.testing.assert_allclose(motion.position, swing[:, None] * STRETCH, atol=2e-4)


def test_on_the_spring_the_right_step_keeps_its_energy_and_explicit_euler_gains():
    from course.exercises.definition import find_exercise

    right = by_steps(0.01, 4.0, 20.0, **START)
    assert np.abs(right.energy / right.energy[0] - 1).max() < 0.05
    mistakes = find_exercise("symplectic_euler_step")[1].mistakes
    explicit = next(m.function for m in mistakes if m.name == "explicit Euler")
    wrong = by_steps(0.01, 4.0, 20.0, function=explicit, **START)
    assert wrong.energy[-1] > 2 * wrong.energy[0]


def stem_up(motion):
    """Cosine between the stem and where L was at the start."""
    return motion.rotation[:, 2, 1]


def test_as_printed_it_does_not_turn_over_or_spins_ever_faster():
    right = by_acceleration(0.01, 4.0, tilt=np.radians(1))
    assert stem_up(right).min() < -0.9
    calm = by_acceleration(0.01, 4.0, tilt=np.radians(1), function=without_gyration)
    assert stem_up(calm).min() > 0.99
    free = by_free_acceleration(without_cross)
    wild = by_acceleration(0.01, 2.0, tilt=np.radians(1), function=free)
    # omega_dot = omega: exp(2) after 2 s, in midpoint steps.
    speed = np.linalg.norm(wild.angular_velocity, axis=1)
    assert speed[-1] / speed[0] == pytest.approx(np.exp(2), rel=1e-3)


def test_what_runs_away_or_is_no_rotation_is_left_where_it_is():
    def grows(x, r, p, momentum, *rest):
        return 10 * x + 1, 1.2 * r, p, momentum

    motion = by_steps(0.01, 1.0, 0.0, function=grows, **START)
    assert np.all(np.isfinite(motion.position))
    assert np.array_equal(motion.position[20], motion.position[-1])


def test_with_l_as_it_is_the_inertia_turns_the_handle_as_it_turns():
    right = by_inertia(0.005, 0.5, **START)
    assert error(right) < 0.01
    long = {"tilt": np.radians(1)}
    assert stem_up(by_inertia(0.01, 4.0, **long)).min() < -0.9
    calm = by_inertia(0.01, 4.0, function=lambda r, body: body, **long)
    assert stem_up(calm).min() > 0.99
