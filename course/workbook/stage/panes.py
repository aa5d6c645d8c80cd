"""A pane of a film: bodies with their poses over time, arrows and measured lines on them, checked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from course import rotations
from course.arrays import (
    Array,
    ArrayLike,
    choice,
    failure,
    scalar,
    scalars,
    unit_quaternions,
    vectors,
    written,
)
from course.workbook.plots.figure import PALETTE
from course.workbook.stage.solids import Solid

COLORS = ("vermillion", "green", "purple", "orange", "sky", "blue", "black", "grey")


@dataclass(frozen=True, eq=False)
class Arrows:
    """Arrows of one kind, that are switched on and off together.

    Args:
        name: as the legend has it, "velocity".
        vector: (m, 3), or (t, m, 3) where they change, in ``unit``.
        unit: of the vector, "m/s"; empty for a unit vector.
        at: where they start, (m, 3) or (t, m, 3) [m]; none: the bodies' centres.
        scale: how many metres are drawn for one unit; none: so that the longest is a
            quarter of the picture. The legend says it.
        color: a name of the palette; none: the next of a list. Several: one an arrow.
        shown: whether they are on when the film opens.
        lift: how far beside its start an arrow is drawn, along the picture's up
            [m]: a velocity above its ball.
        numbers: whether its size stands beside each
    """

    name: str
    vector: ArrayLike
    unit: str = ""
    at: ArrayLike | None = None
    scale: float | None = None
    color: str | tuple[str, ...] = ""
    shown: bool = True
    lift: ArrayLike = 0.0
    numbers: bool = False


@dataclass(frozen=True, eq=False)
class Segments:
    """Lines that are measured, gaps above all: drawn with their number beside them.

    Args:
        name: as the legend has it, "gap d".
        start, end: (m, 3) or (t, m, 3) [m].
        value: what stands beside each, (m,) or (t, m); none: nothing does.
        unit: of the value.
        color, shown: as for arrows.
    """

    name: str
    start: ArrayLike
    end: ArrayLike
    value: ArrayLike | None = None
    unit: str = "m"
    color: str = "purple"
    shown: bool = True


@dataclass(frozen=True, eq=False)
class Pane:
    """One of the pictures that play at the same time: a law, an answer, a formula.

    Args:
        solids: what the n bodies look like.
        position: of their centres, (n, 3) or (t, n, 3) [m].
        orientation: unit quaternions, scalar last, (n, 4) or (t, n, 4); none: not turned.
        title: above the picture, "as printed"; empty where there is one pane.
        arrows, segments: to be switched on and off by name, the same name in all panes.
        trails: numbers of the bodies that leave a line behind them.
    """

    solids: Sequence[Solid]
    position: ArrayLike
    orientation: ArrayLike | None = None
    title: str = ""
    arrows: Sequence[Arrows] = ()
    segments: Sequence[Segments] = ()
    trails: Sequence[int] = ()


def pane_over(pane: Pane, times: Array) -> Pane:
    """The pane with arrays over time: position (t, n, 3), orientation (t, n, 4)."""
    solids = tuple(pane.solids)
    for solid in solids:
        if not isinstance(solid, Solid):
            raise failure("solids", "solids, as stage.ball(...)", type(solid).__name__)
    n = len(solids)
    x = over_time("position", vectors("position", pane.position), (n, 3), times)
    turned = (
        rotations.identity(n)
        if pane.orientation is None
        else unit_quaternions("orientation", pane.orientation)
    )
    q = over_time("orientation", turned, (n, 4), times)
    for body in pane.trails:
        if not 0 <= body < n:
            raise failure("trails", f"numbers of bodies from 0 to {n - 1}", f"{body}")
    arrows = tuple(_placed(a, i, x, times) for i, a in enumerate(pane.arrows))
    segments = tuple(_measured(s, times) for s in pane.segments)
    return Pane(solids, x, q, pane.title, arrows, segments, tuple(pane.trails))


def over_time(name: str, array: Array, core: tuple[int, ...], times: Array) -> Array:
    """What is given once or for each time, for each time: (t, *core)."""
    full = (len(times), *core)
    if array.shape not in (core, full):
        once = f"shape {core} or " if core else ""
        raise failure(name, f"{once}shape {full}", f"shape {array.shape}")
    return np.broadcast_to(array, full)


def _placed(arrows: Arrows, number: int, position: Array, times: Array) -> Arrows:
    """The arrows with vector and start over time, (t, m, 3), and a scale."""
    name = f"arrows {arrows.name}"
    vector = vectors(name, arrows.vector)
    if vector.ndim < 2:
        raise failure(name, "shape (m, 3) or (t, m, 3)", f"shape {vector.shape}")
    core = (vector.shape[-2], 3)
    vector = over_time(name, vector, core, times)
    start = position if arrows.at is None else vectors(f"{name}, at", arrows.at)
    start = over_time(f"{name}, at", start, core, times)
    scale = arrows.scale
    if scale is not None and not scalar(f"{name}, scale", scale) > 0:
        raise failure(f"{name}, scale", "a number above 0", written(scale))
    colors = arrows.color or COLORS[number % len(COLORS)]
    every = (colors,) * core[0] if isinstance(colors, str) else tuple(colors)
    if len(every) != core[0]:
        raise failure(f"{name}, color", f"one name or {core[0]}", f"{len(every)}")
    for color in every:
        choice(f"{name}, color", color, tuple(PALETTE))
    lift = tuple(np.broadcast_to(scalars(f"{name}, lift", arrows.lift), core[:1]))
    return Arrows(
        arrows.name, vector, arrows.unit, start, scale or _scale(vector, position),
        every, arrows.shown, lift, arrows.numbers,
    )  # fmt: skip


def _scale(vector: Array, position: Array) -> float:
    """Metres for one unit, 1, 2 or 5 times a power of ten: the longest is about a
    quarter of what the bodies span.
    """
    longest = float(np.linalg.norm(vector, axis=-1).max(initial=0.0))
    flat = position.reshape(-1, 3)
    span = float(np.linalg.norm(np.ptp(flat, axis=0))) if len(flat) else 0.0
    if longest == 0.0:
        return 1.0
    wanted = 0.25 * (span or 1.0) / longest
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(power * max(s for s in (1.0, 2.0, 5.0) if s * power <= wanted * 1.001))


def _measured(segments: Segments, times: Array) -> Segments:
    name = f"segments {segments.name}"
    start, end = vectors(name, segments.start), vectors(name, segments.end)
    if start.ndim < 2:
        raise failure(name, "shape (m, 3) or (t, m, 3)", f"shape {start.shape}")
    core = (start.shape[-2], 3)
    value = (
        None
        if segments.value is None
        else over_time(name, scalars(name, segments.value), core[:1], times)
    )
    choice(f"{name}, color", segments.color, tuple(PALETTE))
    return Segments(
        segments.name,
        over_time(name, start, core, times),
        over_time(name, end, core, times),
        value, segments.unit, segments.color, segments.shown,
    )  # fmt: skip


def bounding_points(pane: Pane) -> Array:
    """Points that bound everything a pane ever shows, (k, 3) [m]."""
    x = np.asarray(pane.position)
    reach = np.array([s.reach for s in pane.solids])[:, None]
    # What has no end, a floor or a wall, is seen as far as the others need it.
    seen = np.array([not s.endless for s in pane.solids], dtype=bool)
    near = x[:, seen]
    points = [(near - reach[seen]).reshape(-1, 3), (near + reach[seen]).reshape(-1, 3)]
    for a in pane.arrows:
        at, vector = np.asarray(a.at), np.asarray(a.vector)
        points += [
            at.reshape(-1, 3),
            (at + float(a.scale or 1) * vector).reshape(-1, 3),
        ]
    for s in pane.segments:
        points += [np.asarray(s.start).reshape(-1, 3), np.asarray(s.end).reshape(-1, 3)]
    return np.concatenate(points) if any(map(len, points)) else np.zeros((1, 3))
