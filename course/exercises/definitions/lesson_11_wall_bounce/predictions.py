"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course.dynamics import bounce_rest_time
from course.exercises.definition import Prediction


def _long_normal() -> float:
    down, twice = np.array([0.0, 0.0, -1.0]), np.array([0.0, 0.0, 2.0])
    return float(np.linalg.norm(down - 2 * np.sum(down * twice) * twice))


def _longer_choice() -> str:
    from course.study import energy_error

    ratios = [
        energy_error("bullet", 1e-3, duration=t) / energy_error("ode", 1e-3, duration=t)
        for t in (20.0, 40.0)
    ]
    return {1: "same", 2: "twice", 4: "four"}[round(ratios[1] / ratios[0])]


PREDICTIONS = (
    Prediction(
        "longer",
        "In 20 s the mean squared energy error of one program is 400 times that of the other. Both run on to 40 s. "
        "What becomes of the 400?",
        _longer_choice,
        "The energy of the one rises with every bounce, that of the other only wavers. Twice the time is twice the "
        "rise, and its mean square is four times as large: 1608 for 407.",
        later="Speed against accuracy",
        choices={"same": "it stays about 400", "twice": "about 800", "four": "about 1600"},
        wrong={
            "same": "That holds if both errors grow alike. One of them does not grow at all.",
            "twice": "The error itself doubles. The measure is its square.",
        },
    ),
    Prediction(
        "rest",
        "A ball dropped from 1 m, e = 1/2, g = 9.81 m/s^2. After how many seconds is it at rest?",
        lambda: float(bounce_rest_time(1.0, 0.5, 9.81)),
        "Infinitely many bounces, and all of them done after three times the first fall. Your step gives the formula.",
        unit="s",
        wrong={
            0.4515: "That is the first impact alone.",
            0.9030: "A rise lasts as long as the fall after it: each later flight counts twice.",
        },
    ),
    Prediction(
        "long_normal",
        "The programmer forgets to divide n by its length, which is 2. A ball comes straight in at 1 m/s, e = 1. How "
        "fast does it leave?",
        _long_normal,
        "v.n is twice too large, and it multiplies an n twice too long: 2 (v.n) n is four times what it should be, "
        "-1 + 8 = 7. The energy grows 49-fold at every bounce.",
        unit="m/s",
        wrong={
            2: "n stands twice in the formula, so its length counts squared.",
            4: "Four times the change, not four times the speed: -1 + 4*2.",
        },
    ),
)  # fmt: skip
