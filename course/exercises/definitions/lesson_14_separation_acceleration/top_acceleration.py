"""The exercise ``top_acceleration``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

# top_acceleration, the student's step of the derivation: the ladder's top against the
# wall.


def _ladders(rng: np.random.Generator) -> Sequence[Case]:
    draws = {
        "a_y": np.round(rng.uniform(-3.0, -0.5, 8), 2),
        "alpha": np.round(rng.uniform(-4.0, -0.5, 8), 2),
        "omega": np.round(rng.uniform(-2.0, -0.5, 8), 2),
        "theta": np.round(rng.uniform(0.3, 0.7, 8), 2),
        "ell": np.round(rng.uniform(1.5, 5.0, 8), 2),
    }
    one = {"a_y": -1.0, "alpha": -2.0, "omega": -0.5, "theta": 0.5, "ell": 4.0}
    return [Case("one ladder", one), Case("eight ladders", draws, "batch")]


TOP_ACCELERATION = Exercise(
    name="top_acceleration",
    kind="expression",
    rows=(20, 23),
    points=2,
    minutes=8,
    task="Give the rate of d_2_dot = -v_y + (ell/2) omega sin(theta) in the symbols a_y, alpha, omega, theta and ell.",
    arguments=(
        Value(
            "a_y",
            "scalar",
            "m/s²",
            "rate of v_y, the centre's acceleration toward the wall",
        ),
        Value("alpha", "scalar", "rad/s²", "rate of omega"),
        Value("omega", "scalar", "rad/s", "rate of theta"),
        Value("theta", "scalar", "rad", "angle between ladder and floor"),
        Value("ell", "scalar", "m", "length of the ladder"),
    ),
    results=(
        Value(
            "top_acceleration",
            "(...)",
            "m/s²",
            "second rate of the gap between top and wall",
        ),
    ),
    reference=formulas.top_acceleration,
    cases=_ladders,
    mistakes=(
        Mistake(
            "sine held still",
            slip(formulas.top_acceleration, " + omega**2 * sp.cos(theta)", ""),
            "One term is missing: omega sin(theta) is a product, and theta changes too. The rate of sin(theta) is "
            "cos(theta) times omega.",
        ),
        Mistake(
            "omega held still",
            slip(formulas.top_acceleration, "alpha * sp.sin(theta) + ", ""),
            "One term is missing: omega changes as well, at the rate alpha.",
        ),
        Mistake(
            "omega once",
            slip(formulas.top_acceleration, "omega**2", "omega"),
            "In the last term omega stands only once. One omega is the factor in d_2_dot, the second comes from the "
            "chain rule.",
        ),
        Mistake(
            "sign of the last term",
            slip(formulas.top_acceleration, "+ omega", "- omega"),
            "The last term has the wrong sign: the derivative of sin(theta) is +cos(theta).",
        ),
        Mistake(
            "twice",
            slip(formulas.top_acceleration, "omega**2", "2 * omega**2"),
            "The last term is taken twice. By the product rule, each factor is differentiated once.",
        ),
        Mistake(
            "sine kept",
            slip(formulas.top_acceleration, "sp.cos", "sp.sin"),
            "The term with omega^2 has a sine. It comes from the rate of sin(theta), which has the cosine.",
        ),
        Mistake(
            "whole length",
            slip(formulas.top_acceleration, "ell / 2", "ell"),
            "Your arm is the whole ladder. From the centre to the top it is half the length.",
        ),
        Mistake(
            "sign of a_y",
            slip(formulas.top_acceleration, "-a_y", "a_y"),
            "The sign of a_y: d_2_dot holds -v_y, and the sign stays with it.",
        ),
        Mistake(
            "centre held still",
            slip(formulas.top_acceleration, "-a_y + ", ""),
            "a_y is missing: the centre's velocity changes too.",
        ),
        Mistake(
            "pattern of the foot",
            slip(
                formulas.top_acceleration,
                "alpha * sp.sin(theta) + omega**2 * sp.cos(theta)",
                "alpha * sp.cos(theta) - omega**2 * sp.sin(theta)",
            ),
            "What you add to -a_y is (ell/2) times the rate of omega cos(theta), which belongs to the foot. At the top "
            "d_2_dot has omega sin(theta): differentiate that.",
        ),
        Mistake(
            "pattern of the foot with its minus",
            slip(
                formulas.top_acceleration,
                "alpha * sp.sin(theta) + omega**2 * sp.cos(theta)",
                "omega**2 * sp.sin(theta) - alpha * sp.cos(theta)",
            ),
            "What you add to -a_y is -(ell/2) times the rate of omega cos(theta), which belongs to the foot. At the "
            "top d_2_dot has + (ell/2) omega sin(theta): differentiate that.",
        ),
        Mistake(
            "minus before the bracket",
            slip(formulas.top_acceleration, "+ ell", "- ell"),
            "All that stands with ell has the wrong sign. At the top d_2_dot has + (ell/2) omega sin(theta), and the "
            "plus stays.",
        ),
        Mistake(
            "product of the rates",
            slip(
                formulas.top_acceleration,
                "alpha * sp.sin(theta) + omega**2 * sp.cos(theta)",
                "alpha * omega * sp.cos(theta)",
            ),
            "You multiply the rates of both factors. The product rule keeps one factor and takes the rate of the "
            "other, then the other way about, and adds.",
        ),
        Mistake(
            "bracket once more by omega",
            slip(formulas.top_acceleration, "omega**2", "omega**3"),
            "In the last term omega stands three times. One omega is the factor in d_2_dot, the chain rule brings one "
            "more.",
        ),
        Mistake(
            "turned round",
            slip(formulas.top_acceleration, "-a_y + ell", "a_y - ell"),
            "All signs are reversed: this is the acceleration of the top toward the wall.",
        ),
    ),
    hints=(
        "Three things in d_2_dot depend on time: v_y, omega and theta. The second term is a product of two of them.",
        "The rate of v_y is a_y. The rate of omega sin(theta) is alpha sin(theta) plus omega times the rate of "
        "sin(theta), which is omega cos(theta).",
        "top_acceleration = -____ + ell / 2 * (alpha * sp.sin(theta) + ____ * sp.cos(theta))",
    ),
)
