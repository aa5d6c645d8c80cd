"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course.dynamics import impulse_central
from course.exercises.definition import Prediction


def _blocks() -> int:
    from course.dynamics import count_collisions

    return count_collisions(100**2)


def _cradle_choice() -> str:
    from course.study import cradle

    first = float(cradle([1.0, 0.0, 0.0], law="simultaneous")[0])
    return "stands" if abs(first) < 1e-9 else "back" if first < 0 else "on"


PREDICTIONS = (
    Prediction(
        "blocks",
        "A block of 10,000 kg slides toward one of 1 kg that stands before a wall. Nothing is lost. How many "
        "collisions are there in all, block against block and block against wall?",
        _blocks,
        "These are the first three digits of pi.",
        tolerance=0.0,
        later="See",
        wrong={
            2: "One block against block, one against the wall: but the small block comes back, again and again.",
            100: "100 is the root of the mass ratio. The count grows with it, but it is larger, by a factor of pi.",
            10000: "The count grows with the square root of the mass ratio, not with the ratio.",
        },
    ),
    Prediction(
        "equal_balls",
        "Two balls of 1 kg, e = 1, v_1 = -2 m/s, v_2 = 0. What is p_hat?",
        lambda: float(
            impulse_central(
                1.0,
                1.0,
                np.array([-2.0, 0.0, 0.0]),
                np.zeros(3),
                np.array([1.0, 0.0, 0.0]),
                1.0,
            )
        ),
        "The bracket is 1/m_1 + 1/m_2 = 2, so -2 + 2 p_hat = 2 and p_hat = 2 N s: body 1 stops, body 2 leaves with "
        "the speed body 1 had.",
        unit="N s",
        tolerance=1e-9,
        wrong={
            4: "Here the bracket is 1: only one of the two bodies took part.",
            1: "This only stops the approach: e = 0.",
        },
    ),
    Prediction(
        "cradle",
        "Three equal balls hang in a row and touch; the first comes in at 1 m/s, nothing is lost. You solve for both "
        "impulses at once. What does the *first* ball do afterwards?",
        _cradle_choice,
        "Momentum and energy leave room for many outcomes. All at once and one pair after the other are two laws, "
        "and they choose differently; real balls, with springs in between, do a third thing.",
        choices={
            "stands": "it stands still",
            "back": "it goes back",
            "on": "it goes on slowly",
        },
        wrong={
            "stands": "This is what the toy shows, nearly: it is the answer of one pair after the other."
        },
    ),
    Prediction(
        "parting",
        "Two bodies already part at 2 m/s, e = 1/2, and a program calls the slide's formula all the same. At what "
        "separation speed do they leave? (Positive: they part, negative: they approach.)",
        lambda: -0.5 * 2.0,
        "The formula sets the speed along n to -e times what it was, whatever its sign: parting bodies are turned "
        "round into each other. It must ask first whether they approach.",
        unit="m/s",
        wrong={
            2: "So it should be. The formula does not know it.",
            1: "Half the speed, but also the other way round.",
        },
    ),
)
