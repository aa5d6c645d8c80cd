"""A ball meets a wall: what changes along the normal, and what does not."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import rotations
from course.study.wall_meetings import WallMeeting, mirrored, wall_meeting
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
    ball,
    box,
    standing,
)

RADIUS, MEETING = 0.2, 1.0
#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-3.4, -1.6, 3.4, 2.6)
SCALE = 0.5  # metres drawn for 1 m/s
THICK = 0.15
KNOBS = (
    Knob("wall_angle", "wall turned by", 15.0, -60.0, 60.0, 1.0, "°"),
    Knob("velocity_x", "velocity x", 1.5, -2.0, 2.0, 0.1, "m/s"),
    Knob("velocity_y", "velocity y", -1.6, -2.0, 2.0, 0.1, "m/s"),
    Knob("restitution", "restitution e", 0.6, 0.0, 1.0, 0.05),
)
PRESETS = (
    Preset("a mirror", {"wall_angle": 0, "velocity_x": 1.5, "velocity_y": -1.5, "restitution": 1}),
    Preset("half comes back", {"wall_angle": 0, "velocity_x": 1.5, "velocity_y": -1.5, "restitution": 0.5}),
    Preset("head on", {"wall_angle": 0, "velocity_x": 0, "velocity_y": -2, "restitution": 0.5}),
    Preset("nothing bounces", {"wall_angle": 30, "velocity_x": 1.5, "velocity_y": -1.5, "restitution": 0}),
    Preset("it leaves", {"wall_angle": 30, "velocity_x": -1, "velocity_y": 0.5, "restitution": 1}),
)  # fmt: skip


def wall(against: Any = None) -> Exhibit:
    """A ball and a wall; the ball can be taken and thrown from elsewhere.

    Args:
        against: plays a second bounce beside the right one: "printed", v - 2 (v.n) n of
            the slide, which has no e, or a function of your own with the arguments of
            ``wall_bounce``.
    """

    law, attempt = asked_of(against, mirrored, "v − 2 (v·n) n, as the slide has it")

    def film(**values: float) -> Film:
        velocity = [values["velocity_x"], values["velocity_y"], 0.0]
        given = values["wall_angle"], velocity, values["restitution"]
        right = wall_meeting(*given, radius=RADIUS, meeting=MEETING)
        if against is None:
            return _film([("", right)], values["wall_angle"])
        other = attempt.motion(
            lambda: wall_meeting(*given, law=law, radius=RADIUS, meeting=MEETING)
        )
        shown = [("v − (1 + e) (v·n) n", right), (attempt.title, other)]
        return _film(shown, values["wall_angle"], attempt)

    # It is to arrive at the same place and time: from farther away it has to be faster.
    away = {"velocity_x": (-1.0, 0.0, 0.0), "velocity_y": (0.0, -1.0, 0.0)}
    return Exhibit(
        film,
        KNOBS,
        [Hand(away, body=0, until=0.6 * MEETING)],
        PRESETS,
        question="The wall is tilted, and e = 0.6 of the speed into it comes back. "
        "Seen from the wall, does the ball leave flatter or steeper than it came?",
        answer="Flatter: only the part along n shrinks, the part along the wall stays. "
        "From 45° onto a level wall it leaves at 27° where e = 0.5 (key 2).",
    )  # fmt: skip


def _film(
    shown: list[tuple[str, Any]], wall_angle: float, attempt: Attempt | None = None
) -> Film:
    title, right = shown[0]
    other = shown[-1][1]
    motions = moved(*(motion for _, motion in shown))

    def pane(title: str, motion: WallMeeting) -> Pane:
        return _pane(title, motion, wall_angle)

    return Film(
        attempt.panes(title, pane, right, other) if attempt else [pane(title, right)],
        right.times,
        Flat("xy", WINDOW),
        title="A ball and a wall",
        caption="The velocity is the sum of a part along n and a part along the wall. "
        "Drag the ball before they meet: from farther away it comes faster.",
        ending=attempt.sentence(other)
        if attempt and isinstance(other, Stopped)
        else _ending(right),
        charts=_charts(motions),
        numbers=_numbers(motions),
        events=(MEETING,),
    )


def _pane(title: str, motion: WallMeeting, wall_angle: float) -> Pane:
    across = (motion.velocity @ motion.normal)[:, None] * motion.normal
    beside = (motion.velocity @ motion.along)[:, None] * motion.along
    place = np.zeros((4, 2, 3))
    place[:, 0] = motion.position
    place[:, 1] = -THICK * motion.normal
    turn = rotations.from_rotation_vector([[0, 0, 0], [0, 0, np.radians(wall_angle)]])
    at = motion.position[:, None]
    return Pane(
        [ball(RADIUS), standing(box((20.0, THICK, 1.0)), endless=True)],
        place,
        turn,
        title=title,
        arrows=[
            Arrows("along n", across[:, None], "m/s", at=at, scale=SCALE, color="vermillion"),
            Arrows("along the wall", beside[:, None], "m/s", at=at, scale=SCALE, color="green"),
            Arrows("velocity", motion.velocity[:, None], "m/s", at=at, scale=SCALE, color="black"),
            Arrows("normal n", motion.normal[None], at=[[0.0, 0.0, 0.0]], scale=0.7, color="purple", shown=False),
        ],
        trails=[0],
    )  # fmt: skip


def _charts(motions: list[WallMeeting]) -> list[Any]:
    right = motions[0]
    curves = {"along n": right.velocity @ right.normal}
    colors = ["vermillion", "green"]
    curves["along the wall"] = right.velocity @ right.along
    for other in motions[1:]:
        curves["along n, right pane"] = other.velocity @ other.normal
        colors.append("orange")
    across, beside = (
        0.5 * (right.velocity @ n) ** 2 for n in (right.normal, right.along)
    )
    whole = across[0] + beside[0]
    parts = {
        "along the wall": beside,
        "along n": across,
        "lost": whole - across - beside,
    }
    return [
        Curves("parts of the velocity", "m/s", curves, limits=(-3.0, 3.0), colors=colors),
        Curves("kinetic energy of 1 kg", "J", parts, stacked=True, limits=(0.0, 4.2),
               colors=["green", "vermillion", "grey"]),
    ]  # fmt: skip


def _numbers(motions: list[WallMeeting]) -> list[Number]:
    def of(get: Any) -> tuple[float, ...]:
        return tuple(float(get(m)) for m in motions)

    return [
        Number("along n before", of(lambda m: m.before @ m.normal)[:1], "m/s"),
        Number("along n after", of(lambda m: m.after @ m.normal), "m/s"),
        Number("along the wall", of(lambda m: m.after @ m.along), "m/s"),
        Number("energy kept", of(_kept), "%"),
    ]


def _kept(motion: WallMeeting) -> float:
    """Kinetic energy after over before [%]."""
    whole = float(motion.before @ motion.before)
    return 100.0 * float(motion.after @ motion.after) / whole if whole else 100.0


def _ending(motion: WallMeeting) -> str:
    come, leave = (abs(float(v @ motion.normal)) for v in (motion.before, motion.after))
    if not np.isfinite(motion.meeting):
        return (
            f"It does not approach the wall: its speed along n, {come:.2f} m/s, stays"
        )
    return (
        f"Along n its speed is {come:.2f} m/s before and {leave:.2f} m/s after; "
        f"along the wall it keeps {abs(float(motion.after @ motion.along)):.2f} m/s"
    )
