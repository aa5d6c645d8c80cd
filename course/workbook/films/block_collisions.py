"""Two blocks and a wall: why do their collisions count the digits of pi?"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array
from course.dynamics import TwoBlocks
from course.dynamics import two_blocks as collided_blocks
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
    Path,
    Preset,
    box,
    labelled,
    standing,
)
from course.workbook.stage.words import shown_number

LEAST, MOST = 5.0, 10.0  # of the film [s]; a last graze may come later than that
START = (0.4, 2.0)  # distances from the wall [m]
#: What is seen, whatever the masses: left, bottom, right, top [m].
WINDOW = (-0.3, -0.12, 4.6, 0.95)
SMALL, LARGE = 0.15, 0.4  # half edges of the blocks [m]
COLORS = ("blue", "vermillion")
KNOBS = (Knob("mass_ratio", "mass 2 / mass 1", 100.0, 1.0, 10_000.0, logarithmic=True),)
PRESETS = (
    Preset("1 : 1", {"mass_ratio": 1}),
    Preset("100 : 1", {"mass_ratio": 100}),
    Preset("10,000 : 1", {"mass_ratio": 10_000}),
)


def two_blocks() -> Exhibit:
    """Block 2 comes in from the right, block 1 stands between it and a wall; nothing is lost."""
    return Exhibit(
        lambda mass_ratio: _film(collided_blocks(mass_ratio, start=START)),
        KNOBS,
        (),
        PRESETS,
        question="Equal blocks collide 3 times, wall included. How often do they if block 2 weighs 100 times "
        "block 1? And 10,000 times?",
        answer="31 and 314 times (keys 2 and 3). Every collision is a mirror image in the circle of equal "
        "energy, so the point walks round it in equal arcs, 2 arctan √(m₁/m₂) long, for half a turn.",
    )


def _film(motion: TwoBlocks) -> Film:
    last = float(np.clip(motion.time[-1] + 0.5, LEAST, MOST))
    times, after = moments(last, list(motion.time), frames=41)
    done = _done(motion, times, after)
    place = _places(motion, times, done)
    velocity = motion.velocity[done]
    return Film(
        [_pane(place, velocity)],
        times,
        Flat("xz", WINDOW),
        title="Two blocks and a wall",
        caption="Nothing is lost. Look at the point on the circle: where does it stop, and why there?",
        ending=_ending(motion, last),
        charts=_charts(motion, times, place, done),
        counters={"collisions": done.astype(float)},
        numbers=_numbers(motion),
    )


def _done(motion: TwoBlocks, times: Array, after: Any) -> Any:
    """How many collisions there have been at each moment, (t,)."""
    over = np.searchsorted(motion.time, times, side="right")
    before = np.searchsorted(motion.time, times, side="left")
    return np.where(after, over, before)


def _places(motion: TwoBlocks, times: Array, done: Any) -> Array:
    """Of the faces that meet, (t, 2) [m]: straight on from the last collision."""
    since = np.concatenate([[0.0], motion.time])[done]
    start = np.array([START])
    from_here = np.concatenate([start, motion.position])[done]
    return np.asarray(from_here + (times - since)[:, None] * motion.velocity[done])


def _pane(place: Array, velocity: Array) -> Pane:
    where = np.zeros((len(place), 4, 3))
    where[:, 0, 0], where[:, 0, 2] = place[:, 0] + SMALL, SMALL
    where[:, 1, 0], where[:, 1, 2] = place[:, 1] + 2 * SMALL + LARGE, LARGE
    where[:, 2] = -5.0, 0.0, 0.0
    where[:, 3] = 0.0, 0.0, -5.0
    blocks = [
        labelled(box((half, 0.2, half), color=color), str(k + 1))
        for k, (half, color) in enumerate(zip((SMALL, LARGE), COLORS, strict=True))
    ]
    wall = standing(box((5.0, 1.0, 20.0)), endless=True)
    floor = standing(box((20.0, 1.0, 5.0)), endless=True)
    arrows = np.zeros((len(place), 2, 3))
    arrows[..., 0] = velocity
    fastest = float(np.abs(velocity).max())
    return Pane(
        [*blocks, wall, floor],
        where,
        arrows=[
            Arrows("velocity", arrows, "m/s", at=where[:, :2], scale=_scale(fastest),
                   color=COLORS, lift=(SMALL + 0.08, LARGE + 0.08)),
        ],
    )  # fmt: skip


def _scale(fastest: float) -> float:
    """Metres for 1 m/s: 1, 2 or 5 times a power of ten, the fastest at most 1 m."""
    power = 10.0 ** np.floor(np.log10(1.0 / fastest))
    return float(power * max(s for s in (1, 2, 5) if s * power * fastest <= 1.0 + 1e-9))


def _charts(motion: TwoBlocks, times: Array, place: Array, done: Any) -> list[Any]:
    # Over sqrt(2 T) the circle has the radius 1, whatever the masses.
    scaled = motion.scaled_velocity / np.linalg.norm(motion.scaled_velocity[0])
    turn = np.linspace(0.0, 2 * np.pi, 181)
    circle = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    ratio = motion.mass[1] / motion.mass[0]
    theta = np.arctan(np.sqrt(1 / ratio))
    equal = 1.1 * np.array([[0.0, 0.0], [np.sin(theta), np.cos(theta)]])
    return [
        Path(
            "velocities on the circle of equal energy",
            "√m₁ v₁ / √2T",
            "√m₂ v₂ / √2T",
            scaled[done, 0],
            scaled[done, 1],
            guides={"equal energy": circle, "v₁ = v₂": equal},
        ),
        Curves(
            "distance from the wall",
            "m",
            {"block 1": place[:, 0], "block 2": place[:, 1]},
            limits=(0.0, 4.0),
        ),
    ]


def _numbers(motion: TwoBlocks) -> list[Number]:
    ratio = float(motion.mass[1] / motion.mass[0])
    theta = float(np.arctan(np.sqrt(1 / ratio)))
    return [
        Number("collisions", (float(motion.count),), digits=6),
        Number("θ = arctan √(m₁/m₂)", (np.degrees(theta),), "°", 4),
        Number("π / θ", (np.pi / theta,), digits=6),
        Number("v₂ at the end", (float(motion.velocity[-1, 1]),), "m/s", 4),
    ]


def _ending(motion: TwoBlocks, last: float) -> str:
    v_1, v_2 = motion.velocity[-1]
    later = motion.time[-1]
    late = (
        f", the last of them, a graze, {shown_number(later, 3)} s from the start,"
        if later > last
        else ""
    )
    return (
        f"After {motion.count} collisions{late} block 2 leaves with {shown_number(v_2, 3)} m/s, "
        f"and block 1, with {shown_number(v_1, 3)} m/s, does not catch up with it"
    )
