"""A shape goes on until a verdict says that it meets another: the film of an answer."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.study.meeting_shapes import (
    ENCOUNTERS,
    Encounter,
    Meeting,
    Simple,
    at,
    meeting,
)
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.films.shapes_as_solids import solid_of
from course.workbook.stage import (
    Curves,
    Exhibit,
    Film,
    Flat,
    Hand,
    Knob,
    Number,
    Pane,
    Preset,
)

START, LAST, SPEED = -2.6, 5.0, 1.1  # [m], [s], [m/s]
TIMES = np.linspace(0.0, LAST, 151)
#: What is seen, whatever the knob says: left, bottom, right, top [m].
WINDOW = (-3.6, -2.6, 3.6, 2.6)
KNOBS = (Knob("lane", "A at y", 1.2, -2.0, 2.0, 0.05, "m"),)
PRESETS = (
    Preset("in the middle", {"lane": 0.2}),
    Preset("beyond the end", {"lane": 1.2}),
    Preset("past it", {"lane": -2.0}),
)


def meeting_film(against: Any = None, exercise: str = "spheres_overlap") -> Exhibit:
    """A goes to the right until the verdict says that it overlaps B.

    Args:
        against: plays a second one beside it: a function of your own.
        exercise: whose arguments that function has.
    """
    encounter = ENCOUNTERS[exercise]
    answer, attempt = asked_of(against)
    way = START + SPEED * TIMES

    def film(lane: float) -> Film:
        right = meeting(encounter, encounter.reference, lane, way)
        if against is None:
            return _film("", encounter, right, None, None, lane)
        other = attempt.motion(lambda: meeting(encounter, answer, lane, way))
        return _film(encounter.title, encounter, right, other, attempt, lane)

    return Exhibit(film, KNOBS, [Hand({"lane": (0.0, 1.0, 0.0)}, body=0)], PRESETS)


def _film(
    title: str, encounter: Encounter, right: Meeting, other: Any, attempt: Attempt | None, lane: float
) -> Film:  # fmt: skip
    motions = moved(right, other) if attempt else [right]
    middle = _middle(encounter.still)

    def pane(title: str, m: Meeting) -> Pane:
        place = np.zeros((len(TIMES), 2, 3))
        place[:, 0, 0], place[:, 0, 1], place[:, 1] = m.x, lane, middle
        bodies = [
            solid_of(encounter.moving, "blue", "A"),
            solid_of(at(encounter.still, -middle), "orange", "B"),
        ]
        return Pane(bodies, place, title=title)

    names = attempt.names if attempt else ("right",)
    gaps = {name: m.gap for name, m in zip(names, motions, strict=False)}
    places = {name: m.x for name, m in zip(names, motions, strict=False)}
    colors = ["blue", "vermillion"][: len(gaps)]
    return Film(
        attempt.panes(title, pane, right, other) if attempt else [pane(title, right)],
        TIMES,
        Flat("xy", WINDOW),
        title="A goes on until the verdict is: they overlap",
        caption="A stops at the first moment at which it is said to overlap B. Drag it up or down.",
        ending=_ending(right, motions, attempt, other),
        charts=[
            Curves("true gap", "m", gaps, limits=(-1.8, 4.0), colors=colors),
            Curves("x of A", "m", places, limits=(-2.8, 3.0), colors=colors),
        ],
        numbers=[Number("A ends at x", tuple(round(float(m.x[-1]), 3) + 0.0 for m in motions), "m")],
    )  # fmt: skip


def _middle(shape: Simple) -> np.ndarray:
    bounds = shape.bounds()
    return np.asarray(0.5 * (bounds.lower + bounds.upper))


def _ending(
    right: Meeting, motions: list[Meeting], attempt: Attempt | None, other: Any
) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    last = motions[-1]
    if len(motions) == 2 and right.x[-1] != last.x[-1]:
        if last.x[-1] < right.x[-1]:
            return f"Your verdict stops A while the gap is {last.gap[-1]:.2f} m: they do not overlap there"
        return f"Your verdict lets A go {last.x[-1] - right.x[-1]:.2f} m too far"
    if not last.stopped:
        return "A passes by: there is a gap at every moment"
    return f"A stops where it touches B, at x = {last.x[-1]:.2f} m"
