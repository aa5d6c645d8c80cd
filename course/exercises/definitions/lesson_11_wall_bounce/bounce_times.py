"""The exercise ``bounce_times``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_11_wall_bounce.wall_bounce import RESTITUTION
from course.exercises.slips import slip

GRAVITY = Value("gravity", "(...)", "m/s²", "g, positive")


COUNT = Value("count", "scalar", "", "how many impacts, at least 1", dtype="int")


def _drops(rng: np.random.Generator) -> Sequence[Case]:
    def drop(shape: tuple[int, ...], count: int) -> dict[str, Any]:
        height, e, g = (rng.uniform(a, b, shape).round(3) if shape else round(rng.uniform(a, b), 3)
                        for a, b in ((0.5, 3), (0.3, 0.8), (1.6, 12)))  # fmt: skip
        return {"height": height, "restitution": e, "count": count, "gravity": g}

    text = {"height": 1.0, "restitution": 0.5, "count": 5, "gravity": 9.81}
    return [
        Case("the ball of the text", text),
        Case("another ball on another planet", drop((), 4)),
        Case("only the first impact", drop((), 1), "edge"),
        Case("it stays down, e = 0", {**text, "restitution": 0.0}, "edge"),
        Case("it bounces for ever, e = 1", {**text, "restitution": 1.0}, "edge"),
        Case("forty impacts", {**text, "restitution": 0.9, "count": 40}),
        Case("three balls, three impacts", drop((3,), 3), "batch"),
        Case("four balls", drop((4,), 3), "batch"),
        Case("a 2 by 3 batch", drop((2, 3), 6), "batch"),
    ]


BOUNCE_TIMES = Exercise(
    name="bounce_times",
    rows=(17, 18),
    points=2,
    minutes=10,
    task="Return the times of the first `count` impacts of a ball dropped from rest, on a new last axis; e may be 1.",
    arguments=(
        Value("height", "(...)", "m", "height of the drop"),
        RESTITUTION,
        COUNT,
        GRAVITY,
    ),
    results=(Value("times", "(..., count)", "s", "from the drop"),),
    reference=formulas.bounce_times,
    cases=_drops,
    properties=(
        Property(
            "in order",
            lambda given, t: np.minimum(np.diff(t, axis=-1), 0.0),
            "The times are not in order.",
        ),
    ),
    mistakes=(
        Mistake(
            "rises forgotten",
            slip(
                formulas.bounce_times,
                "2 * np.cumsum(powers, axis=-1) - 1",
                "np.cumsum(powers, axis=-1)",
            ),
            "Each later flight counts once in your sum. The ball goes up and comes down: twice.",
        ),
        Mistake(
            "from the first impact",
            slip(formulas.bounce_times, "- 1)", "- 2)"),
            "Your clock starts at the first impact. The first fall, sqrt(2 h/g), comes before it.",
        ),
        Mistake(
            "e squared",
            slip(formulas.bounce_times, "np.arange(count)", "(2 * np.arange(count))"),
            "The flights shrink by e^2 in your answer. That is what the heights do; times go with the speed, by e.",
        ),
        Mistake(
            "first flight not shortened",
            slip(
                formulas.bounce_times,
                "2 * np.cumsum(powers, axis=-1) - 1",
                "1 + 2 * (np.cumsum(powers, axis=-1) - powers)",
            ),
            "Your first rise lasts as long as the first fall. The ball has already lost speed there: the powers begin "
            "with e^1.",
        ),
        Mistake(
            "one flight on",
            slip(
                formulas.bounce_times,
                "2 * np.cumsum(powers, axis=-1) - 1",
                "1 + 2 * np.asarray(restitution)[..., None] * np.cumsum(powers, axis=-1)",
            ),
            "Your times begin with the second impact. The first is the end of the first fall, at t_0.",
        ),
        Mistake(
            "the first fall counted as a flight",
            slip(formulas.bounce_times, " - 1)", ")"),
            "You count 2 t_0 for the first fall. The ball starts at the top: only the way down is there.",
        ),
        Mistake(
            "powers from e^0",
            slip(formulas.bounce_times, " - 1)", " + 1)"),
            "Each of your times is 2 t_0 too late, as if a flight as long as 2 t_0 followed the first fall. The "
            "flights last 2 e t_0, 2 e^2 t_0, ...: their powers begin with e^1.",
        ),
        Mistake(
            "closed sum",
            slip(
                formulas.bounce_times,
                "np.cumsum(powers, axis=-1)",
                "(1 - np.asarray(restitution)[..., None] * powers) / (1 - np.asarray(restitution)[..., None])",
            ),
            "Right for e < 1. At e = 1 your sum divides 0 by 0: add the flights up instead of dividing by 1 - e.",
        ),
        Mistake(
            "on the first axis",
            slip(
                formulas.bounce_times,
                "fall[..., None] * (2 * np.cumsum(powers, axis=-1) - 1)",
                "np.moveaxis(fall[..., None] * (2 * np.cumsum(powers, axis=-1) - 1), -1, 0)",
            ),
            "Right for one ball. For a batch the impacts must stand on a new *last* axis; yours stand on the first.",
        ),
        Mistake(
            "sqrt(h/g)",
            slip(formulas.bounce_times, "2 * np.asarray(height)", "np.asarray(height)"),
            "The first fall lasts sqrt(2 h/g): from h = g t^2/2.",
        ),
        Mistake(
            "how long instead of when",
            slip(
                formulas.bounce_times,
                "fall[..., None] * (2 * np.cumsum(powers, axis=-1) - 1)",
                "np.diff(fall[..., None] * (2 * np.cumsum(powers, axis=-1) - 1), axis=-1, prepend=0.0)",
            ),
            "These are the lengths of the flights. What is asked for are the times of the impacts: add them up "
            "(np.cumsum).",
        ),
    ),
    hints=(
        "The first impact comes after t_0 = sqrt(2 h/g). Each flight after it lasts 2 e t_0, 2 e^2 t_0, and so on.",
        "So the impacts come at t_0, t_0 (1 + 2 e), t_0 (1 + 2 e + 2 e^2), ...: t_0 times twice the sum of the powers "
        "1, e, e^2, ... so far, less 1. Put the powers on a new last axis and add them up with np.cumsum. No division, "
        "so e = 1 is served.",
        "fall = np.sqrt(2 * np.asarray(height) / gravity)\n"
        "powers = np.asarray(restitution)[..., None] ** np.arange(____)\n"
        "return fall[..., None] * (2 * np.cumsum(____, axis=-1) - ____)",
    ),
)
