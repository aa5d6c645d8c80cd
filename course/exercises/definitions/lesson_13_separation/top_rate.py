"""The exercise ``top_rate``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

# top_rate, the student's step of the derivation: the rate of the gap between a ladder's
# top and the wall.


def _ladders(rng: np.random.Generator) -> Sequence[Case]:
    draws = {
        "v_y": np.round(rng.uniform(-2.0, -0.5, 8), 2),
        "omega": np.round(rng.uniform(-2.0, -0.5, 8), 2),
        "theta": np.round(rng.uniform(0.3, 1.3, 8), 2),
        "ell": np.round(rng.uniform(1.5, 5.0, 8), 2),
    }
    by_hand = {"v_y": -1.0, "omega": -0.5, "theta": 0.5, "ell": 4.0}
    return [Case("one ladder", by_hand), Case("eight ladders", draws, "batch")]


TOP_RATE = Exercise(
    name="top_rate",
    kind="expression",
    rows=(19, 20),
    points=2,
    minutes=8,
    task="Give the rate of d_2 = -y - (ell/2) cos(theta) in the symbols v_y, omega, theta and ell.",
    arguments=(
        Value("v_y", "scalar", "m/s", "rate of y, the centre's speed toward the wall"),
        Value("omega", "scalar", "rad/s", "rate of theta"),
        Value("theta", "scalar", "rad", "angle between ladder and floor"),
        Value("ell", "scalar", "m", "length of the ladder"),
    ),
    results=(
        Value("top_rate", "(...)", "m/s", "rate of the gap between top and wall"),
    ),
    reference=formulas.top_rate,
    cases=_ladders,
    mistakes=(
        Mistake(
            "turned round",
            slip(formulas.top_rate, "-v_y + ell", "v_y - ell"),
            "Both signs are reversed: you give the rate of +y + (ell/2) cos(theta), which is the speed of the top "
            "toward the wall. The gap shrinks when the top comes nearer.",
        ),
        Mistake(
            "chain rule",
            slip(formulas.top_rate, " * omega", ""),
            "omega is missing: theta depends on time, so the derivative of cos(theta) is -sin(theta) times the rate of "
            "theta. (Look at the unit: metres and metres per second do not add.)",
        ),
        Mistake(
            "sign of the cosine",
            slip(formulas.top_rate, "+ ell", "- ell"),
            "The second sign: the derivative of cos(theta) is -sin(theta), and a minus stands before it already.",
        ),
        Mistake(
            "cosine kept",
            slip(
                formulas.top_rate,
                "+ ell / 2 * omega * sp.sin",
                "- ell / 2 * omega * sp.cos",
            ),
            "You multiplied by omega but left the cosine standing. Its derivative is -sin(theta).",
        ),
        Mistake(
            "only y differentiated",
            slip(formulas.top_rate, "+ ell / 2 * omega * sp.sin", "- ell / 2 * sp.cos"),
            "You differentiated y and left the second term as it stood. theta changes too: differentiate cos(theta) by "
            "the chain rule. (Look at the unit: metres and metres per second do not add.)",
        ),
        Mistake(
            "that of the foot",
            slip(formulas.top_rate, "sin", "cos"),
            "cos(theta) belongs to the rate of the foot's gap. d_2 holds the cosine, whose derivative is a sine.",
        ),
        Mistake(
            "whole length",
            slip(formulas.top_rate, "ell / 2", "ell"),
            "Your arm is the whole ladder. y is where the *centre* is: from there to the top it is half the length.",
        ),
        Mistake(
            "centre alone",
            slip(formulas.top_rate, " + ell / 2 * omega * sp.sin(theta)", ""),
            "This is the rate for a ladder that does not turn. theta changes too.",
        ),
        Mistake(
            "turning alone",
            slip(formulas.top_rate, "-v_y + ", ""),
            "This is the rate for a ladder that turns about a fixed centre. y changes too, at the rate v_y.",
        ),
        Mistake(
            "first sign",
            slip(formulas.top_rate, "-v_y", "v_y"),
            "The sign of v_y: d_2 holds -y. When the centre moves toward the wall, to the right, the gap shrinks.",
        ),
    ),
    hints=(
        "Go through d_2 term by term as the text does with d_1. What depends on time? y and theta.",
        "The rate of y is v_y. The rate of cos(theta) is -sin(theta) times the rate of theta, which is omega.",
        "top_rate = -____ + ell / 2 * ____ * sp.sin(theta)",
    ),
)
