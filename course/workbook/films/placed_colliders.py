"""A mug flies and turns, and its box collider, carried by a ``place`` of one's own beside the right one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course import formulas, rotations
from course.arrays import Array
from course.study.asking import asked
from course.study.mug_colliders import mug
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.films.mug_colliders import MIDDLE, mug_solid
from course.workbook.stage import (
    Curves,
    Exhibit,
    Film,
    Knob,
    Number,
    Pane,
    Preset,
    Segments,
    Space,
    ball,
)
from course.workbook.stage.words import shown_number

TIMES = np.linspace(0.0, 1.2, 61)
WINDOW = ((-0.13, -0.08, -0.11), (0.13, 0.08, 0.1))
FAR = 2.0  # a corner farther away is drawn there [m]
KNOBS = (Knob("spin", "turns at", 300.0, 0.0, 720.0, 20.0, "°/s"),)
PRESETS = (
    Preset("it only flies", {"spin": 0.0}),
    Preset("it turns over", {"spin": 300.0}),
)
AXIS = np.array([0.36, 0.8, 0.48])  # of the turning, of length 1
#: Corners of a box by their signs, and the pairs of them that are its edges.
SIGNS = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1.0)])
EDGES = np.array([
    (a, b) for a in range(8) for b in range(a) if np.abs(SIGNS[a] - SIGNS[b]).sum() == 2
])  # fmt: skip


@dataclass(frozen=True, eq=False)
class Flight:
    """The mug's poses, the corners of its collider (t, 8, 3) [m], and how far they are off (t,) [m]."""

    center: Array
    rotation: Array
    corners: Array
    off: Array


def placed(against: Any = None) -> Exhibit:
    """A mug thrown from left to right, and the eight corners of its box.

    Args:
        against: plays a second one beside it: a ``place`` of your own.
    """
    answer, attempt = asked_of(against)

    def film(spin: float) -> Film:
        right = _flight(formulas.place, spin)
        if against is None:
            return _film(right, right, None)
        other = attempt.motion(lambda: _flight(answer, spin))
        return _film(right, other, attempt)

    return Exhibit(film, KNOBS, presets=PRESETS)


def _flight(function: Any, spin: float) -> Flight:
    """Both are given the whole flight as a batch of poses."""
    center = np.zeros((len(TIMES), 3))
    center[:, 0] = -0.06 + 0.12 * TIMES / TIMES[-1]
    center[:, 2] = -0.04 + 0.24 * TIMES - 0.2 * TIMES**2
    turning = np.radians(20.0 + spin * TIMES)[:, None] * AXIS
    rotation = rotations.to_matrix(rotations.from_rotation_vector(turning))
    low, high = mug().vertices.min(axis=0) - MIDDLE, mug().vertices.max(axis=0) - MIDDLE
    box = 0.5 * (low + high) + SIGNS * 0.5 * (high - low)
    points = np.broadcast_to(box, (len(TIMES), 8, 3))
    true = points @ np.swapaxes(rotation, -1, -2) + center[:, None]
    (corners,) = asked(function, [true.shape], points, rotation, center)
    corners = np.clip(corners, -FAR, FAR)
    return Flight(
        center, rotation, corners, np.linalg.norm(corners - true, axis=-1).max(axis=-1)
    )


def _film(right: Flight, other: Any, attempt: Attempt | None) -> Film:
    motions = moved(right, other) if attempt else [right]
    names = attempt.names if attempt else ("off",)
    off = {n: 1e3 * m.off for n, m in zip(names, motions, strict=False)}
    across = {n: 1e3 * _diagonal(m) for n, m in zip(names, motions, strict=False)}
    colors = ["blue", "vermillion"][: len(off)]
    panes = attempt.panes("right", _pane, right, other) if attempt else [_pane("", right)]  # fmt: skip
    return Film(
        panes,
        TIMES,
        Space("low", window=WINDOW),
        title="A mug and the box that stands for it",
        caption="The mug flies as it does in truth; the formula puts the eight corners of its collider. Do they stay "
        "around it?",
        ending=_ending(motions, attempt, other),
        charts=[
            Curves("how far a corner is off", "mm", off, limits=(0.0, 300.0), colors=colors),
            Curves("from a corner to the one across", "mm", across, limits=(0.0, 300.0), colors=colors),
        ],
        numbers=[Number("farthest off", tuple(round(1e3 * float(m.off.max()), 3) + 0.0 for m in motions), "mm")],
        speed=0.3,
    )  # fmt: skip


def _diagonal(flight: Flight) -> Array:
    """From the first corner of the box to the last one, (t,) [m]."""
    between = flight.corners[:, -1] - flight.corners[:, 0]
    return np.asarray(np.linalg.norm(between, axis=-1))


def _pane(title: str, flight: Flight) -> Pane:
    place = np.concatenate([flight.center[:, None], flight.corners], axis=1)
    turn = rotations.from_matrix(flight.rotation)[:, None]
    still = np.broadcast_to(rotations.identity(1), (len(TIMES), 8, 4))
    corner = replace(ball(0.005, color="vermillion"), what="corner")
    ends = flight.corners[:, EDGES]
    return Pane(
        [mug_solid(), *[corner] * 8],
        place,
        np.concatenate([turn, still], axis=1),
        title=title,
        segments=[
            Segments("collider", ends[:, :, 0], ends[:, :, 1], color="vermillion")
        ],
    )


def _ending(motions: list[Flight], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    last = float(motions[-1].off.max())
    whose = attempt.whose if attempt else "the formula"
    if last < 1e-9:
        return f"With {whose} the collider stays around the mug"
    return f"With {whose} a corner of the collider is up to {shown_number(100 * last, 3)} cm away from its place"
