"""A table pushed up from below: which of its feet feel it, and which lift."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from course import rotations, study
from course.arrays import Array
from course.study.lifted_tables import LiftedTable, lifted_table
from course.workbook.stage import (
    Arrows,
    Exhibit,
    Film,
    Hand,
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
    labelled,
)

HEIGHT, HALF = 0.7, (0.55, 0.35)  # of the top's underside, and half its sides [m]
WINDOW = ((-0.62, -0.42, 0.0), (0.62, 0.42, 0.85))
FORCE, ACCELERATION, RESPONSE = 0.08, 0.06, 0.12  # metres for 1 N, 1 m/s^2
KNOBS = (
    Knob("x", "push at x", 0.5, -0.55, 0.55, 0.01, "m"),
    Knob("y", "push at y", 0.3, -0.35, 0.35, 0.01, "m"),
    Knob("push", "push", 3.0, 0.0, 12.0, 0.25, "N"),
    Knob("offset_x", "centre of mass, x", 0.1, -0.3, 0.3, 0.05, "m"),
    Knob("offset_y", "centre of mass, y", 0.05, -0.2, 0.2, 0.05, "m"),
)
PRESETS = (
    Preset("at foot 1", {"x": 0.5, "y": 0.3, "push": 3, "offset_x": 0.1, "offset_y": 0.05}),
    Preset("the line meets foot 3", {"x": 0.42, "y": 0.25, "push": 3, "offset_x": 0.1, "offset_y": 0.05}),
    Preset("harder: it lifts", {"x": 0.5, "y": 0.3, "push": 7, "offset_x": 0.1, "offset_y": 0.05}),
    Preset("at the centre of mass", {"x": 0.1, "y": 0.05, "push": 9, "offset_x": 0.1, "offset_y": 0.05}),
)  # fmt: skip


def pushed_table() -> Exhibit:
    """The table in space; the push is dragged under its top."""
    hold = [Hand({"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0)}, body=1)]
    return Exhibit(
        film,
        KNOBS,
        hold,
        PRESETS,
        question="Foot 1 is pushed up with 3 N. Does foot 3, across the table, press the ground less, or more?",
        answer="More: without the ground foot 3 would be driven down, and its entry in A's row of foot 1 is negative. "
        "Where the dashed line meets a foot, that foot does not notice the push.",
    )  # fmt: skip


def film(x: float, y: float, push: float, offset_x: float, offset_y: float) -> Film:
    """The table of these values, and the first moments in which it lifts."""
    found = lifted_table(x, y, push, offset_x, offset_y)
    times = np.linspace(0.0, _duration(found), 31)
    return Film(
        [_pane(found, push, times, offset_x, offset_y)],
        times,
        Space("low", ground=0.0, window=WINDOW),
        title="A table is pushed up from below",
        caption="Drag the orange ball under the top. Of all f that carry the table, the shortest is drawn; "
        "a foot that lifts is played as it begins.",
        ending=_ending(found, push),
        numbers=_numbers(found),
        speed=0.4,
    )  # fmt: skip


def _duration(found: LiftedTable) -> float:
    """Seconds for which d_ddot t^2/2 says where the feet are: while it has hardly turned or risen."""
    turning = 2 * 0.12 / max(float(np.linalg.norm(found.slope)), 1e-9)
    rising = 2 * 0.1 / max(float(found.acceleration.max()), 1e-9)
    return min(0.5, float(np.sqrt(min(turning, rising))))


def _pane(
    found: LiftedTable, push: float, times: Array, offset_x: float, offset_y: float
) -> Pane:
    centre = np.array([*found.centre, HEIGHT])
    under = np.array([*found.place, HEIGHT - 0.02])
    grown = 0.5 * times[:, None] ** 2
    turn = rotations.from_rotation_vector(
        grown * [found.slope[1], -found.slope[0], 0.0]
    )
    middle = centre + grown * [0.0, 0.0, found.rise + found.slope @ found.centre]
    # The feet hang below the centre: as they turn they would rise, to second order.
    tilt = grown[:, 0] * float(np.linalg.norm(found.slope))
    middle[:, 2] -= HEIGHT * (1.0 - np.cos(tilt))
    points = np.concatenate([[under], found.feet]) - centre
    moved = middle[:, None] + rotations.rotate(turn[:, None], points)
    place = np.concatenate([middle[:, None], moved], axis=1)
    orientation = np.repeat(turn[:, None], place.shape[1], axis=1)
    pads = [
        replace(labelled(ball(0.022, color="black"), str(k)), what=f"foot {k}")
        for k in (1, 2, 3, 4)
    ]
    return Pane(
        [_table(found), replace(ball(0.025, color="orange"), what="push"), *pads],
        place,
        orientation,
        arrows=_arrows(found, push, place),
        segments=_still_line(found, push, offset_x, offset_y),
    )


def _table(found: LiftedTable) -> Solid:
    """About its centre of mass."""
    centre = np.array([*found.centre, HEIGHT])
    top = box(
        (*HALF, 0.012), center=np.array([0, 0, HEIGHT + 0.012]) - centre, color="sky"
    )
    half = 0.5 * (HEIGHT - 0.02)
    legs = [
        box((0.012, 0.012, half), center=foot + [0, 0, half + 0.02] - centre, color="blue")
        for foot in found.feet
    ]  # fmt: skip
    return joined(top, *legs, what="table")


def _arrows(found: LiftedTable, push: float, place: Array) -> list[Arrows]:
    up = np.array([0.0, 0.0, 1.0])
    beside = np.sign(found.feet) * [0.05, 0.05, 0.0]
    feet = place[:, 2:]
    pushed = push * up
    return [
        Arrows("force f", np.outer(found.force, up), "N", at=feet + beside, scale=FORCE,
               color="green", numbers=True),
        Arrows("push", pushed[None], "N", at=place[:, 1:2] - FORCE * pushed - [0, 0, 0.025], scale=FORCE,
               color="orange", numbers=True),
        Arrows("d̈ of a foot that lifts", np.outer(found.acceleration, up), "m/s²", at=feet + 2 * beside,
               scale=ACCELERATION, color="vermillion", numbers=True),
        Arrows("1 N without a ground", np.outer(found.response, up), "m/s²", at=feet - beside,
               scale=RESPONSE, color="purple", shown=False, numbers=True),
        Arrows("weight", [[0.0, 0.0, -9.81]], "N", at=place[:, :1], scale=FORCE, color="black"),
    ]  # fmt: skip


def _still_line(
    found: LiftedTable, push: float, offset_x: float, offset_y: float
) -> list[Segments]:
    """Where the top would not move at first if there were no ground, within its sides."""
    x, y = found.place
    ends = study.pushed_table(x, y, offset_x, offset_y).still
    if ends is None:
        return []
    along = np.linspace(ends[0], ends[1], 4001)
    inside = along[np.all(np.abs(along) <= HALF, axis=1)]
    if len(inside) < 2:
        return []
    low, high = (np.array([[*p, HEIGHT + 0.03]]) for p in (inside[0], inside[-1]))
    return [Segments("not moved by the push", low, high, color="black")]


def _numbers(found: LiftedTable) -> list[Number]:
    return [
        Number(f"d̈ of foot {k} for 1 N, no ground", (float(r) + 0.0,), "m/s²")
        for k, r in enumerate(found.response, start=1)
    ] + [Number("f₁ + f₂ + f₃ + f₄", (float(found.force.sum()),), "N")]


def _ending(found: LiftedTable, push: float) -> str:
    lifted = [str(k + 1) for k in np.flatnonzero(found.lifting)]
    if not lifted:
        least = int(np.argmin(found.force)) + 1
        return f"With {push:g} N all four feet stay; foot {least} presses least, with {found.force.min():.2f} N"
    if len(lifted) == 4:
        return f"With {push:g} N the whole table rises"
    one = len(lifted) == 1
    words = f"foot {lifted[0]} lifts" if one else f"feet {', '.join(lifted)} lift"
    return f"With {push:g} N {words}, and the ground carries {found.force.sum():.2f} N"
