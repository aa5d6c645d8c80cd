"""What the stage plays: bodies with their poses over time, arrows, gaps and curves,
checked, and described in words.

A film is plain data. Whoever makes one has computed everything that is to be seen; the
stage interpolates between its moments, in the browser, and draws. Where something jumps,
a velocity at an impact, the same time stands twice: before and after.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from course import rotations
from course.arrays import (
    Array,
    ArrayLike,
    choice,
    failure,
    read_only,
    scalar,
    scalars,
    shaped,
    unit_quaternions,
    vectors,
    written,
)
from course.workbook.plots.figure import PALETTE
from course.workbook.stage.solids import Solid

#: Where a camera in space looks from (a direction), and what is up in its picture.
CAMERAS = {
    "corner": ((0.62, -0.72, 0.42), (0.0, 0.0, 1.0)),
    "low": ((0.42, -0.9, 0.27), (0.0, 0.0, 1.0)),
    "front": ((0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
    "side": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "top": ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
}
#: Flat views: what points right and up in the picture.
PLANES = {
    "xz": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "xy": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    "yz": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
}
COLORS = ("vermillion", "green", "purple", "orange", "sky", "blue", "black", "grey")


@dataclass(frozen=True, eq=False)
class Flat:
    """A view onto a plane of the world, drawn to scale.

    Args:
        plane: "xz", "xy" or "yz".
        window: left, bottom, right, top of what is seen [m]; none: all that ever shows.
    """

    plane: str = "xz"
    window: tuple[float, float, float, float] | None = None

    def __post_init__(self) -> None:
        choice("plane", self.plane, tuple(PLANES))
        if self.window is not None:
            left, bottom, right, top = scalars("window", self.window)
            if not (left < right and bottom < top):
                raise failure(
                    "window",
                    "left < right and bottom < top",
                    written(np.array(self.window)),
                )


@dataclass(frozen=True, eq=False)
class Space:
    """A view into space, to be turned with the hand.

    Args:
        camera: "corner", "low", "front", "side" or "top".
        ground: height z of a ground plane on which shadows fall [m]; None: there is none.
        window: two opposite corners of what is seen, lowest and highest, (2, 3) [m]; none:
            all that ever shows. With it the picture stands still while a knob moves.
    """

    camera: str = "corner"
    ground: float | None = None
    window: ArrayLike | None = None

    def __post_init__(self) -> None:
        choice("camera", self.camera, tuple(CAMERAS))
        if self.ground is not None:
            scalar("ground", self.ground)
        if self.window is not None:
            corners = vectors("window", self.window)
            shaped("window", corners, (2, 3))
            low, high = corners
            if not np.all(low < high):
                raise failure("window", "lowest < highest corner", written(high - low))


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


@dataclass(frozen=True, eq=False)
class Curves:
    """A chart beside the film: curves over time, through which the cursor runs.

    Args:
        title: what is drawn, "kinetic energy".
        unit: of all curves.
        curves: (t,) numbers by name; NaN where there is none.
        stacked: whether the curves are drawn as areas on top of each other.
        limits: lowest and highest value shown; none: from the curves.
        colors: names of the palette, one a curve; none: the bodies' order of colours.
        logarithmic: whether equal steps upward are equal factors; what is not above 0
            is left out.
    """

    title: str
    unit: str
    curves: Mapping[str, ArrayLike]
    stacked: bool = False
    limits: tuple[float, float] | None = None
    colors: Sequence[str] = ()
    logarithmic: bool = False

    def __post_init__(self) -> None:
        if not self.logarithmic:
            return
        if self.stacked:
            raise failure(f"charts {self.title}", "stacked or logarithmic", "both")
        if self.limits is not None and not 0 < self.limits[0] < self.limits[1]:
            raise failure(
                f"charts {self.title}, limits",
                "0 < lowest < highest",
                written(np.array(self.limits)),
            )


@dataclass(frozen=True, eq=False)
class Path:
    """A chart of one number against another as time goes: a circle of equal energy.

    Args:
        title: what is drawn.
        across, up: names of the two axes, unit included, "v1 [m/s]".
        x, y: (t,) numbers.
        guides: other lines in the same plane by name, each (k, 2): the circle itself.
        equal: whether both axes have the same scale.
        limits: left, bottom, right, top of the axes; none: all that ever shows.
        answers: whether it answers the exhibit's question at once: it then waits until
            the film has been played, or the answer is shown.
    """

    title: str
    across: str
    up: str
    x: ArrayLike
    y: ArrayLike
    guides: Mapping[str, ArrayLike] = field(default_factory=dict)
    equal: bool = True
    limits: tuple[float, float, float, float] | None = None
    answers: bool = False


@dataclass(frozen=True)
class Number:
    """A key number of the film, one value a pane, for the table and the text alternative.

    Args:
        name: "impulse p̂".
        values: one for each pane, or one for all.
        unit: "N s".
        digits: significant ones that are shown.
    """

    name: str
    values: tuple[float, ...]
    unit: str = ""
    digits: int = 3


@dataclass(frozen=True, eq=False)
class Film:
    """Everything that is played together; ``stage.show`` plays it.

    Args:
        panes: at least one; all have the film's times.
        times: (t,) [s], not descending; a time that stands twice is a jump.
        view: ``Flat()`` or ``Space()``, for all panes.
        title: one line.
        caption: a sentence on what there is to see: what moves.
        ending: a sentence on how it ends.
        charts: ``Curves`` and ``Path``, beside the panes.
        counters: (t,) numbers by name that count something, "collisions".
        numbers: the key numbers.
        events: times to which single steps go besides the film's moments [s]; the jumps
            are among them anyway.
        speed: seconds of motion in a second of playing.
    Raises:
        ValueError: what does not fit together, named.
    """

    panes: Sequence[Pane]
    times: ArrayLike
    view: Flat | Space = field(default_factory=Flat)
    title: str = ""
    caption: str = ""
    ending: str = ""
    charts: Sequence[Curves | Path] = ()
    counters: Mapping[str, ArrayLike] = field(default_factory=dict)
    numbers: Sequence[Number] = ()
    events: Sequence[float] = ()
    speed: float = 1.0

    def __post_init__(self) -> None:
        times = scalars("times", self.times)
        if times.ndim != 1 or not times.size or np.any(np.diff(times) < 0):
            raise failure(
                "times", "numbers of shape (t,) that do not descend", written(times)
            )
        if not self.panes:
            raise failure("panes", "at least one", "none")
        if not scalar("speed", self.speed) > 0:
            raise failure("speed", "a number above 0", written(self.speed))
        object.__setattr__(self, "times", read_only(times))
        object.__setattr__(self, "panes", tuple(_checked(p, times) for p in self.panes))
        for chart in self.charts:
            _check_chart(chart, len(times))
        for name, values in self.counters.items():
            _over_time(f"counters {name}", scalars(name, values), (), times)
        for number in self.numbers:
            if len(number.values) not in (1, len(self.panes)):
                raise failure(
                    f"numbers {number.name}",
                    f"one value, or {len(self.panes)}",
                    f"{len(number.values)}",
                )

    @property
    def moves(self) -> bool:
        """Whether there is more than one moment."""
        times = np.asarray(self.times)
        return bool(times[-1] > times[0])

    @property
    def bounds(self) -> tuple[Array, Array]:
        """The lowest and highest corner of all that is ever seen, (3,) each [m]."""
        if isinstance(self.view, Space) and self.view.window is not None:
            low, high = np.asarray(self.view.window, dtype=float)
            return low, high
        flat = np.concatenate([_reached(pane) for pane in self.panes])
        return flat.min(axis=0), flat.max(axis=0)

    @property
    def middle(self) -> Array:
        """The middle of all that is ever seen, (3,) [m]: positions travel from here."""
        low, high = self.bounds
        return np.asarray(0.5 * (low + high))

    def index_at(self, time: float) -> int:
        """The last moment that is not after a time [s]."""
        after = np.searchsorted(
            np.asarray(self.times), scalar("time", time), side="right"
        )
        return max(0, int(after) - 1)


def _checked(pane: Pane, times: Array) -> Pane:
    """The pane with arrays over time: position (t, n, 3), orientation (t, n, 4)."""
    solids = tuple(pane.solids)
    for solid in solids:
        if not isinstance(solid, Solid):
            raise failure("solids", "solids, as stage.ball(...)", type(solid).__name__)
    n = len(solids)
    x = _over_time("position", vectors("position", pane.position), (n, 3), times)
    turned = (
        rotations.identity(n)
        if pane.orientation is None
        else unit_quaternions("orientation", pane.orientation)
    )
    q = _over_time("orientation", turned, (n, 4), times)
    for body in pane.trails:
        if not 0 <= body < n:
            raise failure("trails", f"numbers of bodies from 0 to {n - 1}", f"{body}")
    arrows = tuple(_placed(a, i, x, times) for i, a in enumerate(pane.arrows))
    segments = tuple(_measured(s, times) for s in pane.segments)
    return Pane(solids, x, q, pane.title, arrows, segments, tuple(pane.trails))


def _over_time(name: str, array: Array, core: tuple[int, ...], times: Array) -> Array:
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
    vector = _over_time(name, vector, core, times)
    start = position if arrows.at is None else vectors(f"{name}, at", arrows.at)
    start = _over_time(f"{name}, at", start, core, times)
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
        else _over_time(name, scalars(name, segments.value), core[:1], times)
    )
    choice(f"{name}, color", segments.color, tuple(PALETTE))
    return Segments(
        segments.name,
        _over_time(name, start, core, times),
        _over_time(name, end, core, times),
        value, segments.unit, segments.color, segments.shown,
    )  # fmt: skip


def _check_chart(chart: Curves | Path, count: int) -> None:
    numbers = (
        {"x": chart.x, "y": chart.y} if isinstance(chart, Path) else dict(chart.curves)
    )
    for name, values in numbers.items():
        shape = np.asarray(values, dtype=float).shape
        if shape != (count,):
            raise failure(
                f"charts {chart.title}, {name}", f"shape ({count},)", f"shape {shape}"
            )


def _reached(pane: Pane) -> Array:
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
