"""A box that falls onto a floor in steps, and the word that a program says of it in each."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.study.stepped_boxes import STATES, BoxSteps, step_tolerance, stepped_box
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.stage import (
    Curves,
    Exhibit,
    Film,
    Flat,
    Knob,
    Number,
    Pane,
    Preset,
    ball,
    box,
    labelled,
    standing,
)
from course.workbook.stage.words import shown_number

LAST, DROP, HALF = 1.2, 0.15, 0.04  # [s], [m], half a side [m]
#: Left, bottom, right, top of what is seen [m]: with room to slide, and without.
WIDE, NARROW = (-0.34, -0.03, 0.54, 0.26), (-0.34, -0.03, 0.1, 0.26)
#: Where the words stand, from the highest down, and the mark beside the one that is said [m].
WORDS_AT, MARK_AT = -0.2, -0.31
ROWS = dict(zip(STATES, np.linspace(0.24, 0.03, 6), strict=True))
#: The tolerances of speed of the three programs that open the lesson [m/s].
OPENING = (0.05, 0.33, 4.0)
KNOBS = (
    Knob("speed", "tolerance of speed", 0.33, 0.02, 8.0, unit="m/s", logarithmic=True),
    Knob("rate", "steps a second", 60.0, 30.0, 240.0, 10.0, "1/s"),
    Knob("slip", "slips at", 0.0, 0.0, 0.4, 0.05, "m/s"),
)
PRESETS = (
    Preset("too small", {"speed": 0.05, "rate": 60, "slip": 0}),
    Preset("twice g h", {"speed": 0.33, "rate": 60, "slip": 0}),
    Preset("too large", {"speed": 4.0, "rate": 60, "slip": 0}),
    Preset("it slides", {"speed": 0.33, "rate": 60, "slip": 0.4}),
)
QUESTION = (
    "A box falls onto a floor, at 60 steps a second. With a tolerance of speed of 0.05 m/s, does it come to rest? And "
    "with 4 m/s, where?"
)
ANSWER = (
    "With 0.05 m/s it never rests: gravity alone makes 0.16 m/s in a step. With 4 m/s it is called resting as soon as "
    "it is near, and stays in the air."
)


def resting(against: Any = None, *, slip: float = 0.0) -> Exhibit:
    """A box of 8 cm is let go 15 cm above a floor, restitution 1/2.

    Args:
        against: plays a second one beside it: a ``contact_state`` of your own; "three"
            plays three programs that differ in one number, and tells nothing else: it
            opens the lesson.
        slip: how fast it moves along the floor, where the knob stands at first [m/s].
    """
    if isinstance(against, str) and against == "three":
        return Exhibit(lambda: _opening())
    answer, attempt = asked_of(against)

    knobs = (*KNOBS[:2], replace(KNOBS[2], value=slip))

    def film(speed: float, rate: float, slip: float) -> Film:
        right = _steps(formulas.contact_state, speed, rate, slip)
        if against is None:
            return _film(right, None, None, speed, slip)
        other = attempt.motion(lambda: _steps(answer, speed, rate, slip))
        return _film(right, other, attempt, speed, slip)

    return Exhibit(film, knobs, (), PRESETS, question=QUESTION, answer=ANSWER)


def drifting(against: Any = None) -> Exhibit:
    """The same box with a slip: all six words have to be asked for in the right order."""
    return resting(against, slip=0.4)


def _steps(function: Any, speed: float, rate: float, slip: float) -> BoxSteps:
    return stepped_box(
        function,
        tolerance=step_tolerance(speed, rate),
        steps_per_second=rate,
        drop=DROP,
        slip_speed=slip,
        duration=LAST,
    )


def _moments(steps: BoxSteps) -> tuple[Array, Array]:
    """Times at which the film stands, and the number of the step that holds from there on.

    The word changes at once: each time but the ends stands twice.
    """
    count = len(steps.said)
    times = np.repeat(steps.times, 2)[1:-1]
    return times, np.repeat(np.arange(count), 2)


def _opening() -> Film:
    programs = [_steps(formulas.contact_state, s, 60.0, 0.0) for s in OPENING]
    times, _ = _moments(programs[0])
    names = ("first program", "second program", "third program")
    return Film(
        [_pane(n, p, 0.0) for n, p in zip(names, programs, strict=True)],
        times,
        Flat("xz", NARROW),
        title="A box falls onto a floor",
        caption="Three programs move the same box in the same steps, 60 a second. Each says a word in each step, and "
        "does what the word asks for. They differ in one number.",
        ending=f"In the first program the box never rests, in the second it rests "
        f"{_mm(programs[1].gap[-1])} above the floor, in the third {_mm(programs[2].gap[-1])} above it",
        speed=0.3,
    )  # fmt: skip


def _film(
    right: BoxSteps, other: Any, attempt: Attempt | None, speed: float, slip: float
) -> Film:
    motions = moved(right, other) if attempt else [right]
    times, step = _moments(right)

    def pane(title: str, steps: BoxSteps) -> Pane:
        return _pane(title, steps, slip)

    names = attempt.names if attempt else ("gap",)
    gaps = {n: 1e3 * _gap(m) for n, m in zip(names, motions, strict=False)}
    last = motions[-1]
    rates = {
        "rate": last.rate[step],
        "minus the tolerance": np.full(len(step), -speed),
    }
    colors = ["blue", "vermillion"]
    return Film(
        attempt.panes("the six words", pane, right, other) if attempt else [pane("", right)],
        times,
        Flat("xz", WIDE),
        title="A box falls onto a floor, step by step",
        caption="In each step gravity changes the rate of the gap first; then a word is said, and the box does what "
        "the word asks for.",
        ending=_ending(motions, attempt, other),
        charts=[
            Curves("gap to the floor", "mm", gaps, limits=(-12.0, 60.0), colors=colors[: len(gaps)]),
            Curves("rate when the word is said", "m/s", rates, limits=(-2.2, 1.2), colors=["green", "grey"]),
        ],
        numbers=[
            Number("gap at the end", tuple(round(1e3 * float(m.gap[-1]), 2) + 0.0 for m in motions), "mm"),
            Number("steps with the word colliding", tuple(float(m.said.count("colliding")) for m in motions)),
            Number("steps with the word resting", tuple(float(m.said.count("resting")) for m in motions)),
        ],
        speed=0.3,
    )  # fmt: skip


def _gap(steps: BoxSteps) -> Array:
    """At the film's moments."""
    return np.repeat(steps.gap, 2)[1:-1]


def _pane(title: str, steps: BoxSteps, slip: float) -> Pane:
    times, step = _moments(steps)
    place = np.zeros((len(times), 9, 3))
    place[:, 0, 0], place[:, 0, 2] = slip * times, _gap(steps) + HALF
    place[:, 1, 2] = -0.5
    place[:, 2:8, 0], place[:, 2:8, 2] = WORDS_AT, list(ROWS.values())
    place[:, 8, 0] = MARK_AT
    place[:, 8, 2] = [ROWS[steps.said[k]] for k in step]
    dot = replace(standing(ball(0.001)), what="word")
    words = [labelled(dot, word) for word in STATES]
    mark = replace(ball(0.009, color="vermillion"), what="mark")
    return Pane(
        [
            box((HALF, HALF, HALF)),
            standing(box((4.0, 1.0, 0.5)), endless=True),
            *words,
            mark,
        ],
        place,
        title=title,
    )


def _mm(gap: float) -> str:
    return f"{shown_number(1e3 * float(gap) + 0.0, 2)} mm"


def _ending(motions: list[BoxSteps], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    last = motions[-1]
    whose = f"With {attempt.whose} the box" if attempt else "The box"
    if last.said[-1] in ("resting", "sliding"):
        doing = "rests" if last.said[-1] == "resting" else "slides along"
        gap = float(last.gap[-1])
        where = "above" if gap >= 0 else "below"
        return (
            f"{whose} {doing} in the end, {_mm(abs(gap))} {where} the top of the floor"
        )
    if last.gap[-1] < -HALF:
        return f"{whose} falls through the floor"
    count = last.said.count("colliding")
    return f"{whose} has not come to rest: {count} steps have called it colliding"
