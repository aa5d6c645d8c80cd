"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course.dynamics import bounce_rest_time
from course.exercises.definition import Prediction


def _long_normal() -> float:
    down, twice = np.array([0.0, 0.0, -1.0]), np.array([0.0, 0.0, 2.0])
    return float(np.linalg.norm(down - 2 * np.sum(down * twice) * twice))


def _order_choice() -> str:
    from course.study.bouncing_ball import energy_error

    ratio = energy_error("bullet", 1e-4) / energy_error("ode", 1e-4)
    return "alike" if ratio < 2 else "few" if ratio < 50 else "hundreds"


PREDICTIONS = (
    Prediction(
        "order",
        "49 balls bounce for 20 s, nothing lost, a step of 1e-4 s. One program reflects and then lets gravity act, the "
        "other lets gravity act and then reflects. How do their energy errors (mean square) compare?",
        _order_choice,
        "The published figures at this step are 1.85 and 752 J^2.",
        later="Speed against accuracy",
        choices={"alike": "about alike", "few": "a few times", "hundreds": "hundreds of times"},
        wrong={"alike": "The two lines differ by one g dt, once a bounce; but a bounce repeats, and errors add up."},
    ),
    Prediction(
        "rest",
        "A ball dropped from 1 m, e = 1/2, g = 9.81 m/s^2. After how many seconds is it at rest?",
        lambda: float(bounce_rest_time(1.0, 0.5, 9.81)),
        "sqrt(2 h/g) (1 + e)/(1 - e): infinitely many bounces, all done in a finite time.",
        unit="s",
        wrong={0.4515: "That is the first impact alone."},
    ),
    Prediction(
        "long_normal",
        "The programmer forgets to divide n by its length, which is 2. A ball comes straight in at 1 m/s, e = 1. How "
        "fast does it leave?",
        _long_normal,
        "v.n is twice too large, and it multiplies an n twice too long: 2 (v.n) n is four times what it should be, "
        "1 - 8 = -7. The energy grows 49-fold at every bounce.",
        unit="m/s",
        wrong={
            2: "n stands twice in the formula, so its length counts squared.",
            4: "Four times the change, not four times the speed: 1 - 2*4.",
        },
    ),
)  # fmt: skip
