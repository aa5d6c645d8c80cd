"""A rod that turns toward a ball: stopped at the time of impact, with the places from which it was asked."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course import formulas, rotations
from course.arrays import Array
from course.study.turning_rods import Rod, ball_ahead, stopped_rod
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
)

#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-1.9, -1.4, 1.9, 1.4)
HALF, TOLERANCE = (
    0.012,
    1e-4,
)  # half the thickness that is drawn [m]; of the question [m]
KNOBS = (
    Knob("degrees", "ball ahead by", 90.0, 20.0, 340.0, 5.0, "°"),
    Knob("distance", "ball from the pivot", 0.8, 0.3, 1.3, 0.01, "m"),
    Knob("omega", "spin", 1.5, -3.0, 3.0, 0.1, "rad/s"),
)
PRESETS = (
    Preset("a quarter turn ahead", {"degrees": 90, "distance": 0.8, "omega": 1.5}),
    Preset("the tip grazes", {"degrees": 90, "distance": 1.09, "omega": 1.5}),
    Preset("out of reach", {"degrees": 90, "distance": 1.2, "omega": 1.5}),
    Preset("the other way round", {"degrees": 90, "distance": 0.8, "omega": -1.5}),
)


@dataclass(frozen=True, eq=False)
class Turn:
    """Angles of the rod (t,) [rad], the gap (t,) [m], and when it stopped [s]."""

    angle: Array
    gap: Array
    stop: float


def rod_to_ball(against: Any = None) -> Exhibit:
    """A rod of 1 m turns about its end until it meets the ball.

    Args:
        against: plays a second one beside it: a ``conservative_advancement`` of your own.
    """
    answer, attempt = asked_of(against)

    def film(degrees: float, distance: float, omega: float) -> Film:
        rod = ball_ahead(omega, degrees, distance)
        times = np.linspace(0.0, rod.horizon, 121)
        right = _turn(rod, times, formulas.conservative_advancement)

        def pane(title: str, turn: Turn) -> Pane:
            return _pane(title, rod, turn)

        if against is None:
            return _film([pane("", right)], times, [right], _ending(right))
        other = attempt.motion(lambda: _turn(rod, times, answer))
        panes = attempt.panes("the right time of impact", pane, right, other)
        ending = _compared(right, other, attempt)
        return _film(panes, times, moved(right, other), ending)

    return Exhibit(film, KNOBS, presets=PRESETS)


def _turn(rod: Rod, times: Array, function: Any) -> Turn:
    stop = stopped_rod(rod, function, TOLERANCE)
    turned = np.minimum(times, stop)
    return Turn(rod.omega * turned, rod.gap(turned), stop)


def _pane(title: str, rod: Rod, turn: Turn) -> Pane:
    place = np.zeros((len(turn.angle), 2, 3))
    place[:, 1] = rod.center
    about_z = np.zeros((len(turn.angle), 2, 3))
    about_z[:, 0, 2] = turn.angle
    stick = box((0.5, HALF, HALF), center=(0.5, 0.0, 0.0), color="blue")
    return Pane(
        [replace(stick, what="rod"), ball(rod.radius, color="orange")],
        place,
        rotations.from_rotation_vector(about_z),
        title=title,
    )


def _film(panes: list[Pane], times: Array, turns: list[Turn], ending: str) -> Film:
    last = float(times[-1])
    flown = tuple(round(min(turn.stop, last), 3) + 0.0 for turn in turns)
    one = len(panes) == 1
    charts = [Curves("gap to the ball", "m", {"gap": turns[0].gap}, limits=(-0.2, 2.4))]
    return Film(
        panes,
        times,
        Flat("xy", WINDOW),
        title="A rod turns toward a ball",
        caption="The rod turns about its end and stops where its function says that it meets the ball.",
        ending=ending,
        charts=charts if one else [],
        numbers=[
            Number("it turns for", flown if len(flown) == len(panes) else flown[:1], "s")
        ],
    )  # fmt: skip


def _ending(turn: Turn) -> str:
    if np.isinf(turn.stop):
        return "The rod does not meet the ball"
    return f"The rod meets the ball after {turn.stop:.3f} s"


def _compared(right: Turn, other: Any, attempt: Attempt) -> str:
    if isinstance(other, Stopped):
        return attempt.sentence(other)
    if other.stop == right.stop or abs(other.stop - right.stop) < 1e-3:
        return f"Both say the same. {_ending(right)}"
    said = "never" if np.isinf(other.stop) else f"after {other.stop:.3f} s"
    true = "never" if np.isinf(right.stop) else f"after {right.stop:.3f} s"
    return f"By your function they meet {said}, and right is {true}"
