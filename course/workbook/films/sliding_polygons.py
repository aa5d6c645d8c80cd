"""A triangle slides along until a verdict says that it overlaps a pentagon."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import formulas, rotations
from course.arrays import Array
from course.study.shadow_cases import (
    PENTAGON,
    TRIANGLE,
    Verdict,
    by_gap,
    by_verdict,
    polygon_shadows,
    stopped_at,
    turned,
)
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.films.polygon_shadows import flat
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

START, LAST, SPEED = -2.4, 4.0, 1.2  # [m], [s], [m/s]
#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-3.6, -2.4, 3.6, 2.4)
KNOBS = (
    Knob("lane", "A at y", 0.9, -1.6, 1.6, 0.05, "m"),
    Knob("turn", "A turned by", 20.0, -180.0, 180.0, 2.0, "°"),
)
PRESETS = (
    Preset("against an edge", {"lane": 0.9, "turn": 20}),
    Preset("against a corner", {"lane": -0.6, "turn": 60}),
    Preset("close by", {"lane": 1.5, "turn": 150}),
)
#: What is asked, by the exercise: a verdict made of a function, the right one, in words.
ASKED: dict[str, tuple[Callable[[Any], Verdict], Any, str]] = {
    "polygons_overlap": (by_verdict, formulas.polygons_overlap, "no axis has a gap"),
    "shadow_gap": (by_gap, formulas.shadow_gap, "gaps of intervals"),
}


@dataclass(frozen=True, eq=False)
class Slide:
    """Where A is, x (t,) [m], whether a verdict stopped it, and the greatest gap (t,) [m]."""

    x: Array
    stopped: bool
    gap: Array


def sliding(against: Any = None, exercise: str = "polygons_overlap") -> Exhibit:
    """A slides to the right until the verdict says that it overlaps B.

    Args:
        against: plays a second one beside it: a function of your own.
        exercise: whose arguments that function has, one of ``ASKED``.
    """
    says, reference, title = ASKED[exercise]
    answer, attempt = asked_of(against)
    times = np.linspace(0.0, LAST, 121)

    def film(lane: float, turn: float) -> Film:
        right = _slide(says(reference), lane, turn, times)
        if against is None:
            return _film("", right, None, None, lane, turn, times)
        other = attempt.motion(lambda: _slide(says(answer), lane, turn, times))
        return _film(title, right, other, attempt, lane, turn, times)

    return Exhibit(film, KNOBS, [Hand({"lane": (0.0, 1.0, 0.0)}, body=0)], PRESETS)


def _slide(verdict: Verdict, lane: float, turn: float, times: Array) -> Slide:
    way = START + SPEED * times

    def shape(x: float) -> Array:
        return turned(TRIANGLE, turn, (x, lane))

    stop, met = stopped_at(lambda x: verdict(shape(x), PENTAGON), way)
    x = np.minimum(way, stop)
    gap = [polygon_shadows(shape(place), PENTAGON).gap.max() for place in x]
    return Slide(x, met, np.array(gap))


def _film(
    title: str, right: Slide, other: Any, attempt: Attempt | None, lane: float, turn: float, times: Array
) -> Film:  # fmt: skip
    motions = moved(right, other) if attempt else [right]

    def pane(title: str, slide: Slide) -> Pane:
        place = np.zeros((len(times), 2, 3))
        place[:, 0, 0], place[:, 0, 1] = slide.x, lane
        quarter = rotations.from_rotation_vector(
            np.array([[0.0, 0.0, np.radians(turn)], [0.0, 0.0, 0.0]])
        )
        bodies = [
            flat(TRIANGLE, "blue", "A", (0.0, 0.0)),
            flat(PENTAGON, "orange", "B", (0.0, 0.0)),
        ]
        return Pane(bodies, place, quarter, title=title)

    names = attempt.names if attempt else ("right",)
    curves = {name: m.gap for name, m in zip(names, motions, strict=False)}
    places = {name: m.x for name, m in zip(names, motions, strict=False)}
    colors = ["blue", "vermillion"][: len(curves)]
    return Film(
        attempt.panes(title, pane, right, other) if attempt else [pane(title, right)],
        times,
        Flat("xy", WINDOW),
        title="A slides until the verdict is: they overlap",
        caption="A stops at the first moment at which it is said to overlap B. Drag it up or down, or turn it.",
        ending=_ending(right, motions, attempt, other),
        charts=[
            Curves("true greatest gap", "m", curves, limits=(-1.2, 3.0), colors=colors),
            Curves("x of A", "m", places, limits=(-2.6, 2.6), colors=colors),
        ],
        numbers=[Number("A ends at x", tuple(round(float(m.x[-1]), 3) + 0.0 for m in motions), "m")],
    )  # fmt: skip


def _ending(
    right: Slide, motions: list[Slide], attempt: Attempt | None, other: Any
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
