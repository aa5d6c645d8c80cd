"""A bullet and a wall: looked at once a step, and swept."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.study.wall_shots import (
    END,
    RADIUS,
    START,
    THICKNESS,
    WallShot,
    by_looking,
    by_sweeping,
)
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.stage import (
    Exhibit,
    Film,
    Flat,
    Knob,
    Number,
    Pane,
    Preset,
    Solid,
    box,
    mesh,
    standing,
)

#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (START - 1.6, -2.4, END + 0.4, 2.4)
MOST = 40  # looks that are drawn, those next to the wall
FRAMES = 81
#: Side view of the bullet behind its tip, much larger than it is [m].
OUTLINE = np.array([[0, 0], [-0.5, 0.35], [-1.3, 0.35], [-1.3, -0.35], [-0.5, -0.35]])
WHERE = Knob(
    "before", "a look falls in front of the wall by", 0.6, 0.0, 1.0, 0.01, "steps"
)
KNOBS = (
    Knob("speed", "speed", 900.0, 30.0, 1200.0, unit="m/s", logarithmic=True),
    Knob("rate", "looks", 60.0, 30.0, 10_000.0, unit="a second", logarithmic=True),
    WHERE,
)
PRESETS = (
    Preset("the bullet", {"speed": 900, "rate": 60, "before": 0.6}),
    Preset("a lucky look", {"speed": 900, "rate": 60, "before": 0.995}),
    Preset("600 looks a second", {"speed": 900, "rate": 600, "before": 0.6}),
    Preset("9,000 looks a second", {"speed": 900, "rate": 9000, "before": 0.6}),
    Preset("a thrown ball", {"speed": 30, "rate": 60, "before": 0.6}),
)  # fmt: skip
QUESTION = (
    "A bullet 4 mm across at 900 m/s, a wall of 10 cm, 60 looks a second. Of 100 bullets, how many are seen to touch "
    "the wall?"
)
ANSWER = (
    "One, rounded up: from look to look the bullet goes 15 m, and it touches the wall on 10.4 cm of them. No look is "
    "needed if one asks when they meet."
)


def bullet(opening: bool = False) -> Exhibit:
    """The bullet in truth and as a program sees it that looks once a step.

    Args:
        opening: asks nothing, and moves only where the looks fall: it opens the lesson.
    """

    def film(speed: float = 900.0, rate: float = 60.0, before: float = 0.6) -> Film:
        times = _times(speed)
        true = by_sweeping(speed, rate, before, times)
        looked = by_looking(speed, rate, before, times)
        panes = [
            _pane("in truth", replace(true, looks=true.looks[:0])),
            _pane(f"by a program that looks {rate:,.0f} times a second", looked),
        ]
        made = _film(panes, [true, looked], speed, rate, _seen(looked))
        return replace(made, numbers=()) if opening else made

    if opening:
        return Exhibit(film, [WHERE])
    return Exhibit(film, KNOBS, presets=PRESETS, question=QUESTION, answer=ANSWER)


def swept_bullet(against: Any = None) -> Exhibit:
    """The bullet stopped at the time of impact, asked step by step.

    Args:
        against: plays a second one beside it: a ``swept_boxes_time`` of your own.
    """
    answer, attempt = asked_of(against)

    def film(speed: float, rate: float, before: float) -> Film:
        times = _times(speed)
        given = speed, rate, before, times
        right = by_sweeping(*given)
        if against is None:
            return _film([_pane("", right)], [right], speed, rate, _met(right))
        other = attempt.motion(lambda: by_sweeping(*given, function=answer))
        panes = attempt.panes("the right time of impact", _pane, right, other)
        ending = _compared(right, other, attempt)
        return _film(panes, moved(right, other), speed, rate, ending)

    return Exhibit(film, KNOBS, presets=PRESETS)


def _times(speed: float) -> Array:
    return np.linspace(0.0, (END - START) / speed, FRAMES)


def _film(
    panes: list[Pane], shots: list[WallShot], speed: float, rate: float, ending: str
) -> Film:
    last = float(shots[0].times[-1])
    missed = formulas.miss_probability(THICKNESS, RADIUS, speed, 1 / rate)
    places = tuple(round(float(shot.x[-1]), 3) + 0.0 for shot in shots)
    return Film(
        panes,
        shots[0].times,
        Flat("xy", WINDOW),
        title="A bullet and a wall",
        caption="The bullet is drawn much larger than its 4 mm; its tip is where its front is. Grey bullets mark where "
        f"it was when it was looked at, at most {MOST} of them.",
        ending=ending,
        numbers=[
            Number("from look to look", (speed / rate,), "m"),
            Number("its centre ends at x", places if len(places) == len(panes) else places[:1], "m"),
            Number("share that no look sees", (float(missed),)),
        ],
        speed=last / 4,
    )  # fmt: skip


def _shape(color: str) -> Solid:
    corners = np.concatenate([OUTLINE, np.zeros((len(OUTLINE), 1))], axis=-1)
    fan = [(0, k, k + 1) for k in range(1, len(OUTLINE) - 1)]
    return replace(mesh(corners, fan, color=color), what="bullet")


def _pane(title: str, shot: WallShot) -> Pane:
    near = np.argsort(np.abs(shot.looks))[:MOST]
    looks = np.sort(shot.looks[near])
    # Each goes along with the bullet until its look, and is left behind there.
    ghosts = np.minimum(shot.x[:, None], looks)
    place = np.zeros((len(shot.times), len(looks) + 2, 3))
    place[:, 0, 0] = THICKNESS / 2
    place[:, 1:-1, 0], place[:, -1, 0] = ghosts + RADIUS, shot.x + RADIUS
    wall = replace(standing(box((THICKNESS / 2, 2.0, 0.5))), what="wall")
    ghost = [replace(_shape("grey"), what="look") for _ in looks]
    return Pane([wall, *ghost, _shape("vermillion")], place, title=title)


def _seen(looked: WallShot) -> str:
    if np.isinf(looked.stop):
        return f"No look sees the bullet touch the wall: {len(looked.looks)} looks, none of them at the right time"
    deep = max(looked.place + RADIUS, 0.0)
    return (
        f"A look sees it, when its front is {100 * deep:.1f} cm behind the wall's front"
    )


def _met(shot: WallShot) -> str:
    if np.isinf(shot.stop):
        return "The bullet flies through: no time of impact was given"
    away = abs(shot.place + RADIUS)
    return f"It is stopped after {1000 * shot.stop:.2f} ms, {away:.2f} m from the wall"


def _compared(right: WallShot, other: Any, attempt: Attempt) -> str:
    if isinstance(other, Stopped):
        return attempt.sentence(other)
    if abs(other.x[-1] - right.x[-1]) < 1e-6:
        return f"Both stop at the wall: {_met(right)}"
    if other.x[-1] > right.x[-1]:
        return f"By your function it gets {other.x[-1] - right.x[-1]:.2f} m too far"
    return f"By your function it stops {right.x[-1] - other.x[-1]:.2f} m in front of the wall"
