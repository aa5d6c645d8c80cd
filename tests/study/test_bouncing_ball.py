"""The bouncing ball: closed form, events, fixed-step loops, and the published figures of SimBenchmark."""

import numpy as np
import pytest

from course.dynamics import (
    ball_events,
    ball_motion,
)
from course.study import (
    PUBLISHED_BOUNCING,
    bouncing_errors,
    bouncing_loop,
    energy_error,
    engine_ball_step,
    event_driven_error,
)

pytestmark = pytest.mark.slow  # with its like, left out of --quick


def digits(value):
    """As the published table prints it: six figures."""
    return f"{value:.6g}"


def test_both_orders_reproduce_the_published_columns_to_every_digit():
    ours = bouncing_errors()
    assert [digits(x) for x in ours.ode] == [
        digits(x) for x in PUBLISHED_BOUNCING.ode_error
    ]
    assert [digits(x) for x in ours.bullet] == [
        digits(x) for x in PUBLISHED_BOUNCING.bullet_error
    ]
    assert ours.steps.tolist() == [
        1999999,
        499999,
        200000,
        50000,
        20000,
        5000,
        2000,
        500,
        200,
    ]
    ratio = ours.bullet / ours.ode  # one line moved
    assert np.all(ratio > 370) and np.all(ratio < 420)
    # Exact between impacts: ten events against two million steps.
    assert ours.events == 10 and np.all(ours.event_driven < 1e-20)


@pytest.mark.parametrize("order", ["ode", "bullet"])
@pytest.mark.parametrize("step", [1e-3, 4e-3, 0.03, 0.1])
def test_fast_error_is_that_of_the_readable_loop(order, step):
    motion = bouncing_loop(order, step)
    each = 10 * (9.81 * motion.height + 0.5 * motion.velocity**2)
    error = np.mean((49 * each - 49 * 10 * 9.81 * 5) ** 2)
    assert energy_error(order, step) == pytest.approx(error, rel=1e-10)


def test_small_steps_follow_the_estimate():
    # (49 m g dt/2)^2 V^2/3 with V^2 = 2 g (H - R): the energy of z and v taken at times half a step apart.
    for step in (1e-4, 1e-3):
        estimate = (49 * 10 * 9.81 * step / 2) ** 2 * 2 * 9.81 * 4.9 / 3
        assert energy_error("ode", step) == pytest.approx(estimate, rel=2e-3)


@pytest.mark.parametrize("order", ["ode", "bullet"])
def test_one_step_at_a_time_is_the_loop(order):
    motion = bouncing_loop(order, 0.01, duration=3.0)
    z, v = 5.0, 0.0
    for k in range(motion.time.size):
        assert (z, v) == (motion.height[k], motion.velocity[k])
        z, v = engine_ball_step(z, v, 0.01, order=order)


def test_step_by_hand_and_batched():
    # z = .05 < r and v = -2: reflect first, and gravity waits a step; or pull first, and reflect the pull too.
    assert engine_ball_step(0.05, -2.0, 0.1) == pytest.approx((0.25, 2.0))
    assert engine_ball_step(0.05, -2.0, 0.1, order="bullet") == pytest.approx(
        (0.05 + 0.2981, 2.981)
    )
    assert engine_ball_step(0.05, -2.0, 0.1, restitution=0.5) == pytest.approx(
        (0.15, 1.0)
    )
    z, v = engine_ball_step([1.0, 0.05, 0.05], [-2.0, -2.0, 2.0], 0.1)
    assert np.allclose(v, [-2.981, 2.0, 1.019]) and np.allclose(
        z, [1 - 0.2981, 0.25, 0.1519]
    )


def test_event_driven_error_counts_events():
    error, events = event_driven_error(0.01)
    # 20 s of flights of 2 sqrt(2 * 4.9/g) s, the first half as long.
    assert events == int((20 / np.sqrt(2 * 4.9 / 9.81) - 1) / 2) + 1 == 10
    assert error < 1e-20


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: energy_error("havok", 0.1), "order: expected one of 'ode', 'bullet'; got 'havok'"),
        (lambda: energy_error("ode", 0.0), "step: expected positive numbers; got 0.0"),
        (lambda: energy_error("ode", 30.0), "step: expected at most the duration, 20; got 30"),
        (lambda: ball_motion(-1.0, 1.0, 0.5), "time: expected numbers at or above 0"),
        (lambda: ball_motion(1.0, 0.0, 0.5), "height: expected positive numbers"),
        (lambda: ball_events(1.0, 1.2, 1.0), "restitution: expected numbers from 0 to 1"),
        (lambda: ball_events([1.0], 1.0, 1.0), r"height: expected one real number; got shape \(1,\)"),
        (lambda: ball_events(1.0, 1.0, 1.0, max_events=0), "max_events: expected a whole number of at least 1"),
        (lambda: engine_ball_step(1.0, np.nan, 0.1), "velocity: expected finite real numbers"),
    ],
)  # fmt: skip
def test_refuses(call, message):
    with pytest.raises(ValueError, match=message):
        call()
