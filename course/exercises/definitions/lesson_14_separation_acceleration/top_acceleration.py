"""The exercise ``top_acceleration``: its inputs, its comparison, and the slips it knows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.exercises.definition import Case, Exercise, Mistake, Value

# top_acceleration, the student's step of the derivation: the ladder's top against the wall.


def _top(
    *,
    sign_y: float = -1.0,
    turning: float = 1.0,
    inward: float = 1.0,
    power: int = 2,
    arm: float = 0.5,
    sine: bool = False,
    crossed: float = 0.0,
    swap: bool = False,
) -> Any:
    """The second rate of the gap at the ladder's top with one of its parts changed."""

    def function(a_y: Any, alpha: Any, omega: Any, theta: Any, ell: Any) -> Any:
        if isinstance(theta, (float, np.ndarray)):
            sin, cos = np.sin(theta), np.cos(theta)
        else:
            import sympy

            sin, cos = sympy.sin(theta), sympy.cos(theta)
            return -a_y + ell / 2 * (alpha * sin + omega**2 * cos)
        if swap:
            sin, cos = cos, sin
        bracket = turning * alpha * sin + inward * omega**power * (sin if sine else cos)
        return sign_y * a_y + arm * ell * (bracket + crossed * alpha * omega * cos)

    return function


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
            "m/s^2",
            "rate of v_y, the centre's acceleration toward the wall",
        ),
        Value("alpha", "scalar", "rad/s^2", "rate of omega"),
        Value("omega", "scalar", "rad/s", "rate of theta"),
        Value("theta", "scalar", "rad", "angle between ladder and floor"),
        Value("ell", "scalar", "m", "length of the ladder"),
    ),
    results=(
        Value(
            "top_acceleration",
            "(...)",
            "m/s^2",
            "second rate of the gap between top and wall",
        ),
    ),
    reference=_top(),
    cases=_ladders,
    mistakes=(
        Mistake(
            "sine held still",
            _top(inward=0.0),
            "One term is missing: omega sin(theta) is a product, and theta changes too. The rate of sin(theta) is "
            "cos(theta) times omega.",
        ),
        Mistake(
            "omega held still",
            _top(turning=0.0),
            "One term is missing: omega changes as well, at the rate alpha.",
        ),
        Mistake(
            "omega once",
            _top(power=1),
            "In the last term omega stands only once. One omega is the factor in d_2_dot, the second comes from the "
            "chain rule.",
        ),
        Mistake(
            "sign of the last term",
            _top(inward=-1.0),
            "The last term has the wrong sign: the derivative of sin(theta) is +cos(theta).",
        ),
        Mistake(
            "twice",
            _top(inward=2.0),
            "The last term is taken twice. By the product rule, each factor is differentiated once.",
        ),
        Mistake(
            "sine kept",
            _top(sine=True),
            "In the last term you left the sine standing. Its derivative is the cosine.",
        ),
        Mistake(
            "whole length",
            _top(arm=1.0),
            "Your arm is the whole ladder. From the centre to the top it is half the length.",
        ),
        Mistake(
            "sign of a_y",
            _top(sign_y=1.0),
            "The sign of a_y: d_2_dot holds -v_y, and the sign stays with it.",
        ),
        Mistake(
            "centre held still",
            _top(sign_y=0.0),
            "a_y is missing: the centre's velocity changes too.",
        ),
        Mistake(
            "pattern of the foot",
            _top(swap=True, inward=-1.0),
            "In the bracket stands what belongs to the foot, where the gap has a cosine. Here it has a sine: "
            "differentiate omega sin(theta).",
        ),
        Mistake(
            "pattern of the foot with its minus",
            _top(swap=True, turning=-1.0),
            "From -(ell/2) on this is the formula of the foot. The gap at the top has + (ell/2) omega sin(theta): "
            "differentiate that.",
        ),
        Mistake(
            "minus before the bracket",
            _top(turning=-1.0, inward=-1.0),
            "There is a minus before the bracket, as at the foot. At the top d_2_dot has + (ell/2) omega sin(theta), "
            "and the plus stays.",
        ),
        Mistake(
            "product of the rates",
            _top(turning=0.0, inward=0.0, crossed=1.0),
            "You multiply the rates of both factors. The product rule keeps one factor and takes the rate of the "
            "other, then the other way about, and adds.",
        ),
        Mistake(
            "bracket once more by omega",
            _top(power=3),
            "In the last term omega stands three times. One omega is the factor in d_2_dot, the chain rule brings one "
            "more.",
        ),
        Mistake(
            "turned round",
            lambda *given: -_top()(*given),
            "All signs are turned round: this is the acceleration of the top toward the wall.",
        ),
    ),
    hints=(
        "Three things in d_2_dot depend on time: v_y, omega and theta. The second term is a product of two of them.",
        "The rate of v_y is a_y. The rate of omega sin(theta) is alpha sin(theta) plus omega times the rate of "
        "sin(theta), which is omega cos(theta).",
        "top_acceleration = -____ + ell / 2 * (alpha * sp.sin(theta) + ____ * sp.cos(theta))",
    ),
)
