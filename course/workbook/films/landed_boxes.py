"""A box lands on its four corners: the impulses of one's own beside the right ones."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.scenes.impacts import BOX
from course.study.landed_boxes import LandedBox, landed_box
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.films.timing import moments
from course.workbook.stage import (
    Arrows,
    Curves,
    Exhibit,
    Film,
    Knob,
    Number,
    Pane,
    Preset,
    Space,
    box,
)
from course.workbook.stage.words import shown_number

MEETING, LAST = 0.3, 0.9  # [s]
#: What is seen, whatever the knobs say [m].
WINDOW = ((-0.8, -0.8, -0.35), (0.8, 0.8, 1.1))
PUSH = 0.4  # metres for 1 N s
KNOBS = (
    Knob("spin_x", "spin about x", 1.0, -2.0, 2.0, 0.1, "rad/s"),
    Knob("spin_y", "spin about y", 0.0, -2.0, 2.0, 0.1, "rad/s"),
    Knob("restitution", "restitution e", 0.5, 0.0, 1.0, 0.05),
)
PRESETS = (
    Preset("rocking about x", {"spin_x": 1.0, "spin_y": 0.0, "restitution": 0.5}),
    Preset("flat", {"spin_x": 0.0, "spin_y": 0.0, "restitution": 0.5}),
    Preset("about both", {"spin_x": 1.2, "spin_y": 0.8, "restitution": 0.75}),
    Preset("nothing bounces", {"spin_x": 1.0, "spin_y": 0.5, "restitution": 0.0}),
)


def landed_box_film(against: Any = None) -> Exhibit:
    """A box of 1 kg whose four corners touch the floor at the same moment.

    Args:
        against: plays a second one beside it: a function of your own with the arguments
            of ``simultaneous_impulses``.
    """
    answer, attempt = asked_of(against)
    times, after = moments(LAST, [MEETING], frames=46)
    late = (times > MEETING) | after

    def film(spin_x: float, spin_y: float, restitution: float) -> Film:
        given = (spin_x, spin_y), restitution, times, late
        right = landed_box(*given, meeting=MEETING)
        if against is None:
            return _film(right, right, None, late)
        other = attempt.motion(
            lambda: landed_box(*given, meeting=MEETING, function=answer)
        )
        return _film(right, other, attempt, late)

    return Exhibit(film, KNOBS, presets=PRESETS)


def _film(right: LandedBox, other: Any, attempt: Attempt | None, late: Any) -> Film:
    motions = moved(right, other) if attempt else [right]
    names = attempt.names if attempt else ("lowest",)

    def pane(title: str, motion: LandedBox) -> Pane:
        return _pane(title, motion, late)

    def of(get: Any) -> tuple[float, ...]:
        return tuple(float(get(m)) for m in motions)

    low = {
        name: m.corners[..., 2].min(axis=1)
        for name, m in zip(names, motions, strict=False)
    }
    title = "p ≥ 0, w = A p + (1 + e) u ≥ 0, p w = 0"
    colors = ["blue", "vermillion"][: len(motions)]
    return Film(
        attempt.panes(title, pane, right, other) if attempt else [pane("", right)],
        right.times,
        Space(camera="low", ground=0.0, window=WINDOW),
        title="A box on its four corners",
        caption="All four touch the floor at 0.3 s; there is no gravity. Does a corner go on into the floor?",
        ending=_ending(motions, attempt, other),
        charts=[Curves("height of the lowest corner", "m", low, limits=(-0.4, 0.6), colors=colors)],
        numbers=[
            *(Number(f"p{'₁₂₃₄'[k]}", of(lambda m, k=k: m.impulse[k]), "N s") for k in range(4)),
            Number("slowest corner after", of(lambda m: m.after.min()), "m/s"),
            Number("energy kept", of(lambda m: 100 * m.kept), "%"),
        ],
        events=(MEETING,),
        speed=0.3,
    )  # fmt: skip


def _pane(title: str, motion: LandedBox, late: Any) -> Pane:
    count = len(motion.times)
    push = np.zeros((count, 4, 3))
    shown = late & (motion.times < MEETING + 0.2)
    push[shown, :, 2] = motion.impulse
    return Pane(
        [box(BOX, color="orange")],
        motion.position[:, None],
        motion.orientation[:, None],
        title=title,
        arrows=[Arrows("impulse p̂", push, "N s", at=motion.corners, scale=PUSH, color="green")],
    )  # fmt: skip


def _ending(motions: list[LandedBox], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    last = motions[-1]
    slowest = float(last.after.min())
    if len(motions) == 2 and np.allclose(motions[0].after, last.after, atol=1e-6):
        return "Here both boxes leave the floor alike"
    whose = f"With {attempt.whose} a" if attempt else "A"
    if slowest < -1e-6:
        return f"{whose} corner goes on into the floor, with {shown_number(-slowest, 2)} m/s"
    whose = f"With {attempt.whose} the" if attempt else "The"
    return (
        f"{whose} slowest corner leaves the floor with {shown_number(slowest, 2)} m/s"
    )
