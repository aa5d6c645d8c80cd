"""The exercise ``rest_time``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

# The time to rest, the derivation's last step.


def _rest_points(rng: np.random.Generator) -> Sequence[Case]:
    draws = {
        "h": rng.uniform(0.5, 3, 8),
        "e": rng.uniform(0.2, 0.8, 8),
        "g": rng.uniform(1.5, 20, 8),
    }
    # Flight 10,000 of such a ball still lasts: a sum that is cut off shows.
    lively = {
        "h": rng.uniform(0.5, 3, 6),
        "e": 1 - 10 ** rng.uniform(-3.3, -2.9, 6),
        "g": rng.uniform(1.5, 20, 6),
    }
    return [
        Case("the ball of the text", {"h": 1.0, "e": 0.5, "g": 9.81}),
        Case("eight drawn points", draws, "batch"),
        Case("a ball that hardly loses speed", {"h": 1.0, "e": 0.999, "g": 9.81}),
        Case("six that hardly lose speed", lively, "batch"),
    ]


REST_TIME = Exercise(
    name="rest_time",
    kind="expression",
    rows=(17, 18),
    points=2,
    minutes=8,
    task="Give the time from the drop until the ball rests, in the symbols h, e and g.",
    arguments=(
        Value("h", "scalar", "m", "height of the fall"),
        Value("e", "scalar", "", "restitution"),
        Value("g", "scalar", "m/s²", "gravity"),
    ),
    results=(Value("rest_time", "(...)", "s"),),
    reference=formulas.rest_time,
    cases=_rest_points,
    mistakes=(
        Mistake(
            "first fall twice",
            slip(formulas.rest_time, "(1 + 2", "(2 + 2"),
            "You count 2 t_0 for the first fall. The ball starts at the top: only the half flight t_0 is there; every "
            "later flight counts twice.",
        ),
        Mistake(
            "rises forgotten",
            slip(formulas.rest_time, "2 * e", "e"),
            "You count only the falls. Before each later fall the ball rises as long as it falls.",
        ),
        Mistake(
            "first fall forgotten",
            slip(formulas.rest_time, "1 + 2 * e", "2 * e"),
            "The first fall, t_0 = sqrt(2 h/g), is missing from the sum.",
        ),
        Mistake(
            "rises and first fall forgotten",
            slip(formulas.rest_time, "1 + 2 * e", "e"),
            "Two things are missing: the first fall, t_0, and that each later flight goes up and down, twice e^k t_0.",
        ),
        Mistake(
            "upside down",
            slip(formulas.rest_time, "(1 + 2 * e / (1 - e))", "(1 - e) / (1 + e)"),
            "Your time shrinks as e grows. A ball that loses less bounces longer.",
        ),
        Mistake(
            "e squared",
            slip(formulas.rest_time, "2 * e / (1 - e)", "2 * e**2 / (1 - e**2)"),
            "You sum powers of e^2. The *height* shrinks by e^2 at each bounce; the speed, and so the time of a "
            "flight, by e.",
        ),
        Mistake(
            "sqrt(h/g)",
            slip(formulas.rest_time, "2 * h", "h"),
            "The first fall lasts sqrt(2 h/g): from h = g t^2/2.",
        ),
    ),
    hints=(
        "Add up the flights: the first fall t_0, then each flight up and down lasts e times the one before.",
        "t_0 plus two times t_0 times the sum of e + e^2 + e^3 + ..., and that sum is e/(1 - e).",
        "rest_time = sp.sqrt(2 * h / g) * (1 + 2 * ____ / (1 - ____))",
    ),
)
