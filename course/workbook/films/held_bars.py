"""A bar's corner on a turning plank: held by the b of one's own, does the gap open or close?"""

from __future__ import annotations

from typing import Any

import numpy as np

from course import rotations
from course.study.held_bars import (
    BAR,
    HALF,
    PLANK,
    HeldBar,
    held_bar,
    terms_changed,
)
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.stage import (
    Arrows,
    Curves,
    Exhibit,
    Film,
    Flat,
    Knob,
    Number,
    Pane,
    Preset,
    box,
    labelled,
)

SECONDS, STEPS = 0.4, 41
#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-1.75, -1.2, 2.3, 1.4)
FORCE = 0.06  # metres for 1 N
KNOBS = (
    Knob("rate_a", "bar (A) turns", 0.5, -1.5, 1.5, 0.1, "rad/s"),
    Knob("rate_b", "plank (B) turns", 1.2, -1.5, 1.5, 0.1, "rad/s"),
    Knob("place", "corner at y", 0.6, -1.0, 1.0, 0.1, "m"),
)
PRESETS = (
    Preset("both turn", {"rate_a": 0.5, "rate_b": 1.2, "place": 0.6}),
    Preset("at rest", {"rate_a": 0.0, "rate_b": 0.0, "place": 0.6}),
    Preset("only the plank", {"rate_a": 0.0, "rate_b": 1.5, "place": 0.6}),
    Preset("against each other", {"rate_a": -1.0, "rate_b": 1.5, "place": 0.6}),
)


def held_bar_film(against: Any = None) -> Exhibit:
    """A falling bar whose corner lies on a plank that turns on its axle; f = -b/a holds it.

    Args:
        against: plays a second one beside it: "printed", the d_ddot in which the terms
            have changed places, or a function of your own with the arguments of
            ``contact_bias``.
    """
    answer, attempt = asked_of(against, terms_changed, "as the slide repeats it")
    times = np.linspace(0.0, SECONDS, STEPS)

    def film(rate_a: float, rate_b: float, place: float) -> Film:
        given = rate_a, rate_b, place, times
        right = held_bar(*given)
        if against is None:
            return _film(right, right, None)
        other = attempt.motion(lambda: held_bar(*given, function=answer))
        return _film(right, other, attempt)

    return Exhibit(film, KNOBS, presets=PRESETS)


def _film(right: HeldBar, other: Any, attempt: Attempt | None) -> Film:
    motions = moved(right, other) if attempt else [right]
    names = attempt.names if attempt else ("corner",)
    title = "b = (p̈_A − p̈_B)·N + 2 (ṗ_A − ṗ_B)·Ṅ"
    gap = {name: m.gap for name, m in zip(names, motions, strict=False)}
    force = {name: m.force for name, m in zip(names, motions, strict=False)}
    colors = ["blue", "vermillion"][: len(motions)]
    return Film(
        attempt.panes(title, _pane, right, other) if attempt else [_pane("", right)],
        right.times,
        Flat("yz", WINDOW),
        title="A corner on a turning plank",
        caption="The contact force is the one that makes d̈ = 0, if b is right. Does the corner stay on the plank?",
        ending=_ending(motions, attempt, other),
        charts=[
            Curves("gap", "m", gap, limits=(-0.15, 0.15), colors=colors),
            Curves("force f", "N", force, limits=(0.0, 20.0), colors=colors),
        ],
        numbers=[
            Number("gap at the end", tuple(round(float(m.gap[-1]), 4) for m in motions), "m", 2),
            Number("force at the start", tuple(float(m.force[0]) for m in motions), "N"),
        ],
        speed=0.2,
    )  # fmt: skip


def _pane(title: str, motion: HeldBar) -> Pane:
    count = len(motion.times)
    place = np.zeros((count, 2, 3))
    place[:, 0] = motion.position
    turn = rotations.from_rotation_vector(motion.angle[..., None] * [1.0, 0.0, 0.0])
    at = motion.corner[:, None]
    push = (motion.force[:, None] * motion.normal)[:, None]
    return Pane(
        [
            labelled(box((0.1, BAR, HALF), color="orange"), "A"),
            labelled(box((0.1, PLANK, HALF), color="sky"), "B"),
        ],
        place,
        turn,
        title=title,
        arrows=[
            Arrows("force f", push, "N", at=at, scale=FORCE, color="green"),
            Arrows("normal N", motion.normal[:, None], at=at, scale=0.5, color="black", shown=False),
        ],
    )  # fmt: skip


def _ending(motions: list[HeldBar], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    last = motions[-1]
    whose = attempt.whose if attempt else "the right b"
    off = float(last.gap[-1] - motions[0].gap[-1])
    if attempt and abs(off) < 1e-4:
        return "Here both hold the corner alike"
    if last.gap[-1] < -5e-3:
        return f"With {whose} the corner is {-100 * last.gap[-1]:.1f} cm in the plank in the end"
    if last.gap[-1] > 5e-3:
        return f"With {whose} the corner is {100 * last.gap[-1]:.1f} cm above the plank in the end"
    return f"With {whose} the corner stays on the plank"
