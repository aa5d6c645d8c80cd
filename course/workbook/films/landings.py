"""Boxes that fall on each other: what must a program ask, so that they land?"""

from __future__ import annotations

import numpy as np

from course.arrays import Array
from course.dynamics import FallingBoxes, falling_boxes
from course.workbook.films.timing import moments
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
    Segments,
    box,
    labelled,
    standing,
)

COUNT, SIDE, LAST, FLASH = 3, 0.5, 0.8, 0.12  # boxes, [m], [s], [s]
#: What is seen, whatever the knob says: left, bottom, right, top [m].
WINDOW = (-1.5, -1.0, 1.5, 3.2)
SCALE, PUSH_SCALE = 0.1, 0.12  # metres drawn for 1 m/s and for 1 N s
COLORS = ("blue", "vermillion", "green")
KNOBS = (Knob("gap", "gaps at the start", 0.4, 0.1, 0.5, 0.05, "m"),)
PRESETS = (Preset("0.4 m", {"gap": 0.4}), Preset("0.1 m", {"gap": 0.1}))


def landing_boxes() -> Exhibit:
    """Three boxes of 1 kg over a floor: with a program that asks for gaps, and with one that does not."""
    return Exhibit(
        _film,
        KNOBS,
        (),
        PRESETS,
        question="Both programs know gravity. What else does the one on the left ask, and what does it answer with?",
        answer="How far apart two bodies are, d. Where d is 0 and falls, it answers with an impulse; "
        "where d stays 0, with a force. The other one never asks.",
    )


def _film(gap: float) -> Film:
    landing = falling_boxes([0.0], count=COUNT, side=SIDE, gap=gap).landing
    times, after = moments(LAST, list(landing), frames=81)
    motion = falling_boxes(times, count=COUNT, side=SIDE, gap=gap)
    landed = (times[:, None] > landing) | ((times[:, None] == landing) & after[:, None])
    falling = -9.81 * times[:, None] * np.ones(COUNT)
    asked = _gaps(motion.stacked)
    unasked = _gaps(motion.unasked)
    since = times[:, None] - landing
    push = np.where(landed & (since < FLASH), 9.81 * landing, 0.0)
    return Film(
        [
            _pane("gaps are asked for", motion.stacked, np.where(landed, 0.0, falling), asked, push),
            _pane("nobody asks", motion.unasked, falling, unasked, 0 * push),
        ],
        times,
        Flat("xz", WINDOW),
        title="Three boxes fall",
        caption="Nothing bounces. Look at the gaps, and at what happens when one of them is 0.",
        ending=_ending(motion, unasked),
        charts=[
            Curves("gaps, asked for", "m", _named(asked), limits=(-0.3, 1.6), colors=COLORS),
            Curves("gaps, nobody asks", "m", _named(unasked), limits=(-3.2, 0.7), colors=COLORS),
        ],
        counters={"impulses": landed.sum(axis=1).astype(float)},
        numbers=_numbers(motion),
        speed=0.3,
    )  # fmt: skip


def _gaps(bottom: Array) -> Array:
    """Of each box to what is below it: the floor, or the box before, (t, n) [m]."""
    below = np.concatenate([np.zeros((len(bottom), 1)), bottom[:, :-1] + SIDE], axis=1)
    return np.asarray(bottom - below)


def _named(gaps: Array) -> dict[str, Array]:
    names = ("box 1 and the floor", "2 and 1", "3 and 2")
    return dict(zip(names, gaps.T, strict=True))


def _pane(title: str, bottom: Array, speed: Array, gaps: Array, push: Array) -> Pane:
    place = np.zeros((len(bottom), COUNT + 1, 3))
    place[:, :COUNT, 2] = bottom + 0.5 * SIDE
    place[:, COUNT, 2] = -3.0
    velocity, impulse, feet = np.zeros((3, len(bottom), COUNT, 3))
    velocity[..., 2], impulse[..., 2], feet[..., 2] = speed, push, bottom
    aside = np.array([0.5 * SIDE + 0.15, 0.0, 0.0])
    boxes = [
        labelled(box((0.5 * SIDE, 0.2, 0.5 * SIDE), color=color), str(k + 1))
        for k, color in enumerate(COLORS)
    ]
    lower = feet - gaps[..., None] * np.array([0.0, 0.0, 1.0])
    return Pane(
        [*boxes, standing(box((20.0, 1.0, 3.0)), endless=True)],
        place,
        title=title,
        arrows=[
            Arrows("velocity", velocity, "m/s", at=place[:, :COUNT] - aside, scale=SCALE, color=COLORS),
            Arrows("impulse", impulse, "N s", at=feet - aside - [0.2, 0, 0], scale=PUSH_SCALE, color="black"),
        ],
        segments=[Segments("d", lower + aside, feet + aside, gaps)],
    )  # fmt: skip


def _numbers(motion: FallingBoxes) -> list[Number]:
    each = [
        Number(f"box {k + 1} lands after", (float(t),), "s")
        for k, t in enumerate(motion.landing)
    ]
    total = 9.81 * float(motion.landing.sum())
    return [*each, Number("impulses of 1 kg boxes, all", (total, 0.0), "N s")]


def _ending(motion: FallingBoxes, unasked: Array) -> str:
    first, last = motion.landing[0], motion.landing[-1]
    return (
        f"Where gaps are asked for, box 1 lands after {first:.2f} s, box 3 after {last:.2f} s, and the stack stands; "
        f"where nobody asks, box 1 is {-unasked[-1, 0]:.2f} m deep in the floor at the end"
    )
