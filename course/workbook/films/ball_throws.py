"""Two balls, to be thrown: what each sweeps, and when they meet."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from course.arrays import Array
from course.study.thrown_balls import HORIZON, PLACE_B, RADII, Throw, thrown
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.stage import (
    Arrows,
    Curves,
    Exhibit,
    Film,
    Flat,
    Hand,
    Knob,
    Number,
    Pane,
    Preset,
    Solid,
    ball,
    capsule,
    labelled,
)

#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-4.0, -3.0, 4.6, 3.0)
SCALE = 0.5  # metres drawn for 1 m/s
KNOBS = (
    Knob("x", "A at x", -2.5, -3.4, 2.0, 0.05, "m"),
    Knob("y", "A at y", -1.2, -2.4, 2.4, 0.05, "m"),
    Knob("velocity_x", "velocity of A, x", 2.0, -2.5, 2.5, 0.05, "m/s"),
    Knob("velocity_y", "velocity of A, y", 1.0, -2.0, 2.0, 0.05, "m/s"),
    Knob("rise", "velocity of B, y", 0.5, -1.2, 1.2, 0.05, "m/s"),
)
PRESETS = (
    Preset("they meet", {"x": -2.5, "y": -1.2, "velocity_x": 2, "velocity_y": 0.6, "rise": 0}),
    Preset("they graze", {"x": -2.5, "y": 0.8, "velocity_x": 2, "velocity_y": 0, "rise": 0}),
    Preset("their ways cross", {"x": -2.5, "y": 0, "velocity_x": 2, "velocity_y": 0, "rise": 1}),
    Preset("touching and parting", {"x": 0.2, "y": 0, "velocity_x": -1, "velocity_y": 0.5, "rise": 0}),
    Preset("touching and sliding", {"x": 0.2, "y": 0, "velocity_x": 0, "velocity_y": 1, "rise": 0}),
)  # fmt: skip
#: What the lesson has found by hand: no buttons where an answer plays.
TO_FIND = ("they graze", "their ways cross")
QUESTION = (
    "What two balls sweep in two seconds has points in common. Do the balls meet?"
)
ANSWER = (
    "Not always: they may pass the same place at different times (key 3). Swept volumes that are apart prove that they "
    "do not meet; when they meet says the root."
)


def throws(against: Any = None) -> Exhibit:
    """Two balls in straight lines; A can be taken by itself and by its velocity.

    Args:
        against: plays a second one beside it: a ``swept_spheres_time`` of your own.
    """
    answer, attempt = asked_of(against)
    times = np.linspace(0.0, HORIZON, 81)

    def film(
        x: float, y: float, velocity_x: float, velocity_y: float, rise: float
    ) -> Film:
        start, v = np.array([x, y, 0.0]), np.array([velocity_x, velocity_y, 0.0])
        given = start, v, np.array([0.0, rise, 0.0]), times
        right = thrown(*given)

        def pane(title: str, motion: Throw) -> Pane:
            return _pane(title, motion, given[1], given[2], start)

        if against is None:
            return _film([pane("", right)], [right], _ending(right))
        other = attempt.motion(lambda: thrown(*given, function=answer))
        panes = attempt.panes("the right time of impact", pane, right, other)
        return _film(panes, moved(right, other), _compared(right, other, attempt))

    hands = [
        Hand({"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0)}, body=2),
        Hand(
            {"velocity_x": (1.0, 0.0, 0.0), "velocity_y": (0.0, 1.0, 0.0)},
            arrows="velocity",
        ),
    ]
    alone = against is None
    presets = tuple(p for p in PRESETS if alone or p.label not in TO_FIND)
    return Exhibit(
        film, KNOBS, hands, presets,
        question=QUESTION if alone else "", answer=ANSWER if alone else "",
    )  # fmt: skip


def _film(panes: list[Pane], throws: list[Throw], ending: str) -> Film:
    flown = tuple(round(float(min(t.stop, HORIZON)), 3) + 0.0 for t in throws)
    least = tuple(round(float(t.gap.min()), 3) + 0.0 for t in throws)
    one = len(panes) == 1
    charts = [Curves("gap between the balls", "m", {"gap": throws[0].gap}, limits=(-0.5, 5.0))]  # fmt: skip
    return Film(
        panes,
        throws[0].times,
        Flat("xy", WINDOW),
        title="Two balls, and what they sweep",
        caption="Drag ball A, or the tip of its velocity. Pale: all that A sweeps in two seconds; grey: what B sweeps. "
        "Both stop at the time of impact.",
        ending=ending,
        charts=charts if one else [],
        numbers=[
            Number("they fly for", flown if len(flown) == len(panes) else flown[:1], "s"),
            Number("least gap", least if len(least) == len(panes) else least[:1], "m"),
        ],
        speed=0.5,
    )  # fmt: skip


def _swept(
    start: Array, velocity: Array, radius: float, color: str, what: str
) -> Solid:
    """All places of a ball in two seconds."""
    end = start + HORIZON * velocity
    if np.linalg.norm(end - start) < 1e-9:
        return replace(ball(radius, center=start, color=color), what=what)
    return replace(capsule(start, end, radius, color=color), what=what)


def _pane(title: str, motion: Throw, v: Array, w: Array, start: Array) -> Pane:
    place = np.zeros((len(motion.times), 4, 3))
    place[:, 2], place[:, 3] = motion.a, motion.b
    solids = [
        _swept(PLACE_B, w, RADII[1], "grey", "what B sweeps"),
        _swept(start, v, RADII[0], "sky", "what A sweeps"),
        labelled(ball(RADII[0], color="blue"), "A"),
        labelled(ball(RADII[1], color="orange"), "B"),
    ]
    velocity = np.array([v, w])
    return Pane(
        solids,
        place,
        title=title,
        arrows=[Arrows("velocity", velocity, "m/s", at=place[:, 2:], scale=SCALE, color="black")],
    )  # fmt: skip


def _ending(throw: Throw) -> str:
    if np.isinf(throw.stop):
        if abs(throw.gap[0]) < 1e-9:
            return "They touch at the start and do not approach: they never meet"
        return f"They do not meet within two seconds; the least gap is {throw.gap.min():.2f} m"
    return f"They meet after {throw.stop:.3f} s"


def _compared(right: Throw, other: Any, attempt: Attempt) -> str:
    if isinstance(other, Stopped):
        return attempt.sentence(other)
    if other.stop == right.stop or abs(other.stop - right.stop) < 1e-6:
        return f"Both say the same. {_ending(right)}"
    said = "never" if np.isinf(other.stop) else f"after {other.stop:.3f} s"
    true = "never" if np.isinf(right.stop) else f"after {right.stop:.3f} s"
    return f"Your function lets them meet {said}, and right is {true}"
