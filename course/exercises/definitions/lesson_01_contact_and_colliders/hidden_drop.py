"""The exercise ``hidden_drop``, the last step of the derivation: inputs and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

_FORMULA = "s**2 / (2 * g)"


def _points(rng: np.random.Generator) -> Sequence[Case]:
    return [
        Case("a fall of a second", {"s": 10.0, "g": 10.0}),
        Case(
            "six drawn points",
            {"s": rng.uniform(0.05, 3.0, 6), "g": rng.uniform(1.5, 25.0, 6)},
            "batch",
        ),
    ]


def _slip(name: str, new: str, message: str) -> Mistake:
    return Mistake(name, slip(formulas.hidden_drop, _FORMULA, new), message)


HIDDEN_DROP = Exercise(
    name="hidden_drop",
    kind="expression",
    rows=(1,),
    points=1,
    minutes=5,
    task="Give the height from which a body at rest falls until its speed is s, in s and g.",
    arguments=(
        Value("s", "scalar", "m/s", "tolerance of speed"),
        Value("g", "scalar", "m/s²", "gravity"),
    ),
    results=(Value("hidden_drop", "(...)", "m", "the drop whose landing is hidden"),),
    reference=formulas.hidden_drop,
    cases=_points,
    mistakes=(
        _slip(
            "factor 2",
            "s**2 / g",
            "Twice too high. While it falls its speed grows from 0 to s: the way is g t^2/2, not g t times t.",
        ),
        _slip(
            "not squared",
            "s / (2 * g)",
            "This is half the time of the fall, in seconds: a height is asked for. Put t = s/g into g t^2/2.",
        ),
        _slip(
            "the time",
            "s / g",
            "This is the time of the fall. Put it into the way, g t^2/2.",
        ),
        _slip(
            "g above",
            "g * s**2 / 2",
            "The time is s/g, so g stands below in the end. If it does in yours, brackets are missing: a / 2 * b "
            "is a/2 times b.",
        ),
        _slip(
            "the other way round",
            "(2 * g * s) ** 0.5",
            "This is the speed after a fall from a height s. Asked is the height for a given speed.",
        ),
        _slip(
            "sign",
            "-(s**2) / (2 * g)",
            "The drop is a height, above 0. Count both the speed and the way downward.",
        ),
    ),  # fmt: skip
    hints=(
        "A fall from rest: after the time t the speed is g t and the way g t^2/2. You have s and look for the way.",
        "Solve s = g t for t, and put that t into the way.",
        "hidden_drop = s**____ / (____ * g)",
    ),
)
