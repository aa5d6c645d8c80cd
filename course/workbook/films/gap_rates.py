"""A bar over a plank: what makes the gap close, and how fast?"""

from __future__ import annotations

from typing import Any

import numpy as np

from course import rotations
from course.arrays import Array
from course.scenes.moving_pairs import BAR, HALF_THICKNESS, PLANK
from course.study.gap_motions import GapMotion, first_touch, gap_motion
from course.workbook.films.timing import moments
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
    Segments,
    box,
)

REACH, CLEAR, LAST = 1.8, 0.7, 0.5  # [m], [m], [s]
#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-1.55, -1.2, 2.85, 2.0)
SCALE = 0.25  # metres drawn for 1 m/s
KNOBS = (
    Knob("rate_a", "A turns", 1.0, -1.5, 1.5, 0.1, "rad/s"),
    Knob("velocity_a", "A rises", 0.0, -1.5, 1.5, 0.1, "m/s"),
    Knob("rate_b", "B turns", 0.5, -1.5, 1.5, 0.1, "rad/s"),
    Knob("velocity_b", "B rises", 0.0, -1.5, 1.5, 0.1, "m/s"),
)
PRESETS = (
    Preset("only A turns", {"rate_a": 1, "velocity_a": 0, "rate_b": 0, "velocity_b": 0}),
    Preset("only B turns", {"rate_a": 0, "velocity_a": 0, "rate_b": 1, "velocity_b": 0}),
    Preset("both rise alike", {"rate_a": 0, "velocity_a": 1, "rate_b": 0, "velocity_b": 1}),
    Preset("A rises, and closes", {"rate_a": 1.5, "velocity_a": 0.5, "rate_b": 0.5, "velocity_b": 0}),
)  # fmt: skip


def gap_rate() -> Exhibit:
    """A bar over a plank; each rises and turns, and the velocities can be taken by their tips."""

    def film(
        rate_a: float, velocity_a: float, rate_b: float, velocity_b: float
    ) -> Film:
        rates, lifts = np.array([rate_a, rate_b]), np.array([velocity_a, velocity_b])
        start: dict[str, Any] = {"reach": REACH, "clear": CLEAR}
        touching, corner = first_touch(rates, lifts, LAST, **start)
        times, _ = moments(LAST, [touching], frames=51)
        met: dict[str, Any] = {"touching": touching, "corner": corner}
        return _film(times, gap_motion(rates, lifts, times, **start, **met))

    arms = (-BAR, REACH - BAR)
    held = [
        Hand({f"velocity_{body}": (0.0, 0.0, 1.0)}, arrows="velocity of the centres", index=k, until=1e-9)
        for k, body in enumerate("ab")
    ] + [
        Hand({f"rate_{body}": (0.0, 0.0, 1 / arm)}, arrows="velocity of the contact points", index=k, until=1e-9)
        for k, (body, arm) in enumerate(zip("ab", arms, strict=True))
    ]  # fmt: skip
    return Exhibit(
        film,
        KNOBS,
        held,
        PRESETS,
        question="Neither centre moves, but both bodies turn. Does the gap stay as wide as it is?",
        answer="No: d is measured at the contact. A's corner sinks where the bar turns against the clock, "
        "and B's point rises: ḋ is the difference of the two points' velocities along N. It closes even where A's "
        "centre rises (key 4).",
    )


def _film(times: Array, motion: GapMotion) -> Film:
    rate = np.sum(list(motion.parts.values()), axis=0)
    seen = times <= motion.touching
    shown = {n: np.where(seen, v, np.nan) for n, v in motion.parts.items()}
    return Film(
        [_pane(motion)],
        times,
        Flat("yz", WINDOW),
        title="A bar over a plank",
        caption="A is the bar, blue, B the plank. The gap d is that of A's corner over B. "
        "Take a velocity by its tip at 0 s.",
        ending=_ending(motion, rate),
        charts=[
            Curves("gap d", "m", {"gap d": motion.gap}, limits=(-0.1, 2.6), colors=("purple",)),
            Curves("rate of the gap, and what adds to it", "m/s", {"ḋ": np.where(seen, rate, np.nan)} | shown,
                   limits=(-5.0, 5.0), colors=("purple", "blue", "sky", "vermillion", "orange")),
        ],
        numbers=[Number(f"{n}, at 0 s", (float(v[0]),), "m/s") for n, v in motion.parts.items()]
        + [Number("ḋ at 0 s", (float(rate[0]),), "m/s")],
        speed=0.2,
    )  # fmt: skip


def _pane(motion: GapMotion) -> Pane:
    turn = np.zeros((*motion.turn.shape, 3))
    turn[..., 0] = motion.turn
    bodies = [
        box((0.2, half, HALF_THICKNESS), color=color)
        for half, color in ((BAR, "blue"), (PLANK, "vermillion"))
    ]
    centre = motion.centre
    return Pane(
        bodies,
        centre,
        rotations.from_rotation_vector(turn),
        arrows=[
            Arrows("velocity of the contact points", motion.velocity, "m/s",
                   at=motion.point, scale=SCALE, color="green"),
            Arrows("velocity of the centres", motion.lift, "m/s", at=centre, scale=SCALE, color="black"),
        ],
        segments=[Segments("d", motion.point[:, 1:], motion.point[:, :1], np.round(motion.gap, 9)[:, None] + 0.0)],
    )  # fmt: skip


def _ending(motion: GapMotion, rate: Array) -> str:
    way = "shrinks" if rate[0] < 0 else "grows"
    start = f"At 0 s the gap {way} with {abs(rate[0]):.2f} m/s"
    if not np.isfinite(motion.touching):
        return f"{start}; after {LAST} s it is {motion.gap[-1]:.2f} m"
    if motion.corner:
        return f"{start}; after {motion.touching:.2f} s A's corner is on B"
    return f"{start}; after {motion.touching:.2f} s B's end is on A, and this corner's gap is no longer the least"
