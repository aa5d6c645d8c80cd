"""A body turns in the box that an answer draws around it."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import rotations
from course.study.boxed_bodies import (
    ASKED,
    BAR,
    HAMMER,
    HEAD_TURN,
    PLACES,
    BoxedBody,
    boxed_body,
)
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.stage import (
    Curves,
    Exhibit,
    Film,
    Knob,
    Number,
    Pane,
    Preset,
    Segments,
    Solid,
    Space,
    ball,
    box,
    joined,
)

LAST = 6.0  # [s]
WINDOW = ((-1.2, -1.2, -1.2), (1.2, 1.2, 1.2))
#: Pairs of corners of a box that an edge joins: they differ in one place.
EDGES = np.array([(i, j) for i in range(8) for j in range(i) if i ^ j in (1, 2, 4)])
KNOBS = (Knob("start", "turned at the start by", 0.0, -180.0, 180.0, 5.0, "°"),)
PRESETS = (
    Preset("from rest along the axes", {"start": 0}),
    Preset("a quarter on", {"start": 90}),
    Preset("the other way round", {"start": -120}),
)
#: What the box is made of, by the exercise.
TITLES = {
    "rotated_box_extents": "by the right half extents",
    "k_dop": "by the right intervals",
    "support": "by the farthest points along ±x, ±y, ±z",
    "compound_support": "by the farthest points along ±x, ±y, ±z",
}


#: What is said of a box whose ends change places.
CROSSED = "no box, a lower end lies above its upper one"


def boxed(against: Any = None, exercise: str = "rotated_box_extents") -> Exhibit:
    """A bar, or for a compound a hammer, turns in space in the box along the axes.

    Args:
        against: plays a second one beside it: a function of your own.
        exercise: whose arguments that function has, one of ``TITLES``.
    """
    answer, attempt = asked_of(against)
    times = np.linspace(0.0, LAST, 61)
    right_one = ASKED[exercise][1]

    def film(start: float) -> Film:
        right = boxed_body(exercise, right_one, times, start)
        if against is None:
            return _film("", right, None, None, exercise)
        other = attempt.motion(lambda: boxed_body(exercise, answer, times, start))
        return _film(TITLES[exercise], right, other, attempt, exercise)

    return Exhibit(film, KNOBS, (), PRESETS)


def _film(
    title: str, right: BoxedBody, other: Any, attempt: Attempt | None, exercise: str
) -> Film:
    motions = moved(right, other) if attempt else [right]
    solid = _hammer() if exercise == "compound_support" else box(BAR, color="blue")
    names = (attempt.names if attempt else ("right",))[: len(motions)]
    colors = ["blue", "vermillion"][: len(motions)]
    outside = {n: m.outside for n, m in zip(names, motions, strict=True)}
    volume = {n: m.volume for n, m in zip(names, motions, strict=True)}

    def pane(title: str, motion: BoxedBody) -> Pane:
        return _pane(f"{title}: {CROSSED}" if motion.crossed.any() else title, motion, solid)  # fmt: skip

    return Film(
        attempt.panes(title, pane, right, other) if attempt else [pane(title, right)],
        right.times,
        Space("corner", window=WINDOW),
        title="A body that turns, and the box along the axes around it",
        caption="The box is drawn anew at every moment, along the axes of the world. It should hold the body and touch "
        "it on every side. Where a lower end lies above its upper one there is no box.",
        ending=_ending(motions, attempt, other),
        charts=[
            Curves("sticks out by", "m", outside, colors=colors),
            Curves("volume of the box", "m³", volume, colors=colors),
        ],
        numbers=[
            Number("sticks out by at most", tuple(round(float(m.outside.max()), 3) for m in motions), "m"),
            Number("a side is away by at most", tuple(round(float(m.loose.max()), 3) for m in motions), "m"),
        ],
        speed=1.0,
    )  # fmt: skip


def _hammer() -> Solid:
    handle = box(HAMMER[0], center=PLACES[0], color="orange")
    head = box(HAMMER[1], center=PLACES[1], rotation=HEAD_TURN, color="blue")
    return joined(handle, head, what="hammer")


def _pane(title: str, motion: BoxedBody, solid: Solid) -> Pane:
    corners = motion.corners
    place = np.concatenate([np.zeros((len(corners), 1, 3)), corners], axis=1)
    turn = np.broadcast_to(rotations.identity(9), (len(corners), 9, 4)).copy()
    turn[:, 0] = rotations.from_matrix(motion.turns)
    marks = [ball(0.035, color="vermillion") for _ in range(8)]
    edges = Segments("box", corners[:, EDGES[:, 0]], corners[:, EDGES[:, 1]], color="vermillion")  # fmt: skip
    return Pane([solid, *marks], place, turn, title=title, segments=[edges])


def _ending(motions: list[BoxedBody], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    last = motions[-1]
    whose = "Your box" if len(motions) == 2 else "The box"
    if last.crossed.any():
        return f"{whose} has no inside: a lower end lies above its upper one"
    if (out := float(last.outside.max())) > 1e-6:
        return f"{whose} lets the body stick out by {out:.2f} m"
    if (away := float(last.loose.max())) > 1e-6:
        return f"{whose} holds the body, but a side of it is up to {away:.2f} m away"
    return f"{whose} holds the body at every moment, and touches it on every side"
