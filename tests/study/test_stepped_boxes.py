"""A box in steps: against closed forms of the fall, the edge g h, and the fall without steps."""

import numpy as np
import pytest

from course import formulas
from course.study import (  # fmt: skip
    highest_hidden_drop,
    share_without_rest,
    step_tolerance,
    stepped_box,
)
from course.study.asking import UnusableResult
from course.study.stepped_boxes import GRAVITY, STATES, asked_word, rule_of_the_sign


def box(speed, rate=60.0, **options):
    tolerance = step_tolerance(speed, rate)
    return stepped_box(
        formulas.contact_state, tolerance=tolerance, steps_per_second=rate, **options
    )


def test_it_falls_by_the_sum_of_its_steps_until_it_touches():
    """After k steps the way is g h^2 (1 + 2 + ... + k)."""
    fall = box(0.33, drop=0.15)
    first = next(k for k, word in enumerate(fall.said) if word != "apart")
    k = np.arange(first + 1)
    assert fall.gap[: first + 1] == pytest.approx(0.15 - 9.81 / 3600 * k * (k + 1) / 2)
    assert fall.rate[:first] == pytest.approx(-9.81 / 60 * (k[:-1] + 1))
    assert fall.said[first] == "colliding" and set(fall.said) <= set(STATES)


@pytest.mark.parametrize("rate", [30.0, 60.0, 144.0])
@pytest.mark.parametrize("restitution", [0.0, 0.5, 0.9])
def test_a_box_that_was_put_down_rests_exactly_from_g_h_on(rate, restitution):
    edge = GRAVITY / rate
    speeds = edge * np.array([0.2, 0.6, 0.999, 1.0, 1.001, 3.0])
    shares = share_without_rest(speeds, steps_per_second=rate, restitution=restitution)
    assert np.all(shares[:3] > 0) and np.all(shares[3:] == 0)


def test_many_boxes_at_once_move_as_one_does():
    alone = [
        1.0 - box(s, drop=0.15, duration=4.0).share("resting", 1.0)
        for s in (0.05, 0.33, 1.0)
    ]
    together = share_without_rest(
        [0.05, 0.33, 1.0], steps_per_second=60, drops=[0.15], duration=4.0
    )
    assert together == pytest.approx(alone)
    own = share_without_rest(
        [0.05, 0.33], steps_per_second=60, drops=[0.15], function=formulas.contact_state
    )
    assert own == pytest.approx(
        share_without_rest([0.05, 0.33], steps_per_second=60, drops=[0.15])
    )


@pytest.mark.parametrize("speed", [0.3, 1.0, 2.0])
@pytest.mark.slow
def test_what_a_tolerance_hides_comes_to_the_fall_without_steps(speed):
    """v^2 = 2 g y; the distance of the tolerance and the step vanish with the step."""
    errors = []
    for rate in (100, 1000, 10_000):
        hidden = highest_hidden_drop(speed, steps_per_second=rate)
        errors.append(abs(hidden / (speed**2 / 19.62) - 1))
    # The drops that are tried are 2.3 percent apart.
    assert errors[-1] < 0.03 and errors[0] < 0.15


def test_a_box_that_slides_is_said_to_slide_and_stays():
    slides = box(0.33, slip_speed=0.4)
    assert slides.said[-1] == "sliding" and slides.gap[-1] == slides.gap[-5]
    assert box(0.33, slip_speed=0.3).said[-1] == "resting"


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        (lambda *given: None, "return"),
        (lambda *given: "falling", "none of the six"),
        (lambda *given: np.array(["apart", "apart"]), "in place of one word"),
        (lambda *given: 3, "none of the six"),
    ],
)
def test_what_is_no_word_is_refused(answer, said):
    with pytest.raises(UnusableResult, match=said):
        asked_word(answer, 0.0, 0.0, 0.0, (0.1, 0.1))


def test_a_slide_reads_the_sign():
    assert rule_of_the_sign([1.0, 0.0, -1.0]).tolist() == ["moving", "stay", "no"]
