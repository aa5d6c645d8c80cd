"""Two polygons to drag and turn, and their shadows on the normals of all their edges."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from course.arrays import Array, IntArray
from course.study.shadow_cases import (
    PENTAGON,
    TRIANGLE,
    PolygonShadows,
    TurningAxis,
    common,
    polygon_shadows,
    turned,
    turning_axis,
)
from course.workbook.stage import (
    Arrows,
    Exhibit,
    Film,
    Flat,
    Hand,
    Knob,
    Number,
    Pane,
    Preset,
    Segments,
    Solid,
    ball,
    labelled,
    mesh,
    standing,
)

#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-3.7, -3.7, 3.7, 3.7)
BESIDE = 1.6  # how far from the middle the axis with its shadows is drawn [m]
ROW, TOP, NAMES_AT, NUMBERS_AT = 0.85, 3.0, -3.4, 3.0  # of the rows [m]
EDGE = (-2.4, 2.2)  # where the rows' shadows are cut off [m]
#: Where the rows have what is taken hold of: the handle of A belongs to the other pane.
OUT_OF_SIGHT = (-50.0, -50.0, 0.0)
SMALL = 0.75  # how much smaller the shadows of the rows are
TIMES, PACE = (
    np.linspace(0.0, 6.0, 61),
    30.0,
)  # [s], and how fast the axis turns [degrees/s]
KNOBS = (
    Knob("x", "A at x", -1.5, -1.7, 1.7, 0.05, "m"),
    Knob("y", "A at y", 1.3, -1.4, 1.4, 0.05, "m"),
    Knob("turn", "A turned by", -78.0, -180.0, 180.0, 2.0, "°"),
)
PRESETS = (
    Preset("apart", {"x": -1.5, "y": 1.3, "turn": -78}),
    Preset("only an edge of A shows it", {"x": -0.95, "y": 1.15, "turn": 34}),
    Preset("only an edge of B shows it", {"x": -1.3, "y": 1.2, "turn": -40}),
    Preset("overlapping", {"x": -0.6, "y": 0.4, "turn": 20}),
)


def shadows() -> Exhibit:
    """A triangle to drag and turn beside a pentagon."""
    return Exhibit(
        _film,
        KNOBS,
        [Hand({"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0)}, body=0)],
        PRESETS,
        question="Two polygons with three and five corners: on how many axes must their shadows overlap before you "
        "know that the polygons do?",
        answer="On eight: the normals of all their edges. One axis with a gap is enough to know that they are apart.",
    )


def _film(x: float, y: float, turn: float) -> Film:
    found = polygon_shadows(turned(TRIANGLE, turn, (x, y)), PENTAGON)
    turning = turning_axis(found, PACE * TIMES)
    return Film(
        [_picture(found, turning, (x, y)), _rows(found)],
        TIMES,
        Flat("xy", WINDOW),
        title="Two polygons and their shadows",
        caption="Drag the triangle A, or turn it. Left: an axis that turns, from the edge normal with the "
        "greatest gap on. "
        "Right: the normals of all eight edges.",
        ending=_ending(found),
        numbers=[
            Number("axes with a gap, of 8", (float(np.sum(found.gap > 0)),)),
            Number("greatest gap", (round(float(found.gap.max()), 4) + 0.0,), "m"),
        ],
    )


def flat(polygon: Array, color: str, label: str, place: tuple[float, float]) -> Solid:
    """A polygon of the plane as a body about a place."""
    corners = np.concatenate([polygon - place, np.zeros((len(polygon), 1))], axis=-1)
    fan = [(0, k, k + 1) for k in range(1, len(polygon) - 1)]
    return replace(
        labelled(mesh(corners, fan, color=color), label), what=f"polygon {label}"
    )


def _in_space(points: Array) -> Array:
    """Points of the plane, (..., 2), with z = 0."""
    return np.concatenate([points, np.zeros((*np.shape(points)[:-1], 1))], axis=-1)


def _picture(
    found: PolygonShadows, turning: TurningAxis, place: tuple[float, float]
) -> Pane:
    n = turning.axis
    across = np.stack([-n[:, 1], n[:, 0]], axis=-1)
    # Beside the polygons, where at the start there is more room.
    side = -1.0 if np.array(place) @ across[0] > 0 else 1.0

    def on_axis(along: Array, lift: float) -> Array:
        """Places along the axis, (t, k), beside it by a little: (t, k, 3)."""
        beside = (side * BESIDE + lift) * across[:, None]
        return _in_space(along[..., None] * n[:, None] + beside)

    lines = [
        Segments(
            name, on_axis(ends[:, :1], lift), on_axis(ends[:, 1:], lift), color=color
        )
        for name, ends, lift, color in (
            ("shadow of A", turning.shadow_a, 0.0, "blue"),
            ("shadow of B", turning.shadow_b, -0.08 * side, "orange"),
        )
    ]
    between = common(turning.shadow_a, turning.shadow_b)
    gaps = _gap(
        [on_axis(between[:, k : k + 1], 0.16 * side) for k in (0, 1)], turning.gap
    )
    corners = [polygon[k] for polygon, k in turning.bounding]
    ends = np.concatenate([turning.shadow_a, turning.shadow_b], axis=-1)
    feet = Segments(
        "where they begin and end", _in_space(np.stack(corners, axis=1)), on_axis(ends, 0.0), color="grey"
    )  # fmt: skip
    middle = [0.5 * (np.roll(p, -1, axis=0) + p) for p in (found.a, found.b)]
    return _pane(found, place, np.concatenate(middle), [feet, *lines, *gaps])


def _pane(
    found: PolygonShadows, place: tuple[float, float], middle: Array, segments: list[Segments]
) -> Pane:  # fmt: skip
    """The polygons with the normals at the middles of their edges, and the axis with its shadows."""
    best = np.arange(len(found.axes)) == found.best
    # Which edge a row belongs to: its name stands beyond the tip of its normal.
    beyond = middle + 0.42 * found.axes
    return Pane(
        [
            flat(found.a, "blue", "A", place),
            flat(found.b, "orange", "B", (0.0, 0.0)),
            *(labelled(standing(ball(0.001)), name) for name in _names(found)),
        ],
        _in_space(np.concatenate([[place, (0.0, 0.0)], beyond])),
        title="an axis that turns",
        arrows=[
            Arrows("normals of the edges", _in_space(found.axes), at=_in_space(middle), scale=0.25,
                   color=tuple("vermillion" if b else "black" for b in best)),
        ],
        segments=segments,
    )  # fmt: skip


def _gap(ends: list[Array], gap: Array) -> list[Segments]:
    """Green above 0, red below, and its number; at other times a line has no length."""
    middle = 0.5 * (ends[0] + ends[1])
    lines = []
    for on, color in ((gap > 0, "green"), (gap <= 0, "vermillion")):
        start, end = (np.where(on[:, None, None], x, middle) for x in ends)
        lines.append(Segments("gap", start, end, color=color))
    number = Segments(
        "gap", middle, middle, np.round(gap, 2)[:, None] + 0.0, color="black"
    )
    return [*lines, number]


def _names(found: PolygonShadows) -> list[str]:
    """Of the edges, and of the rows."""
    counts = {"A": len(found.a), "B": len(found.b)}
    return [f"{name}{k + 1}" for name, count in counts.items() for k in range(count)]


def _rows(found: PolygonShadows) -> Pane:
    height = TOP - ROW * np.arange(len(found.axes))
    names = _names(found)
    place = np.stack([np.full(len(names), NAMES_AT), height, 0 * height], axis=-1)
    apart = found.gap > 0

    def line(ends: Array, lift: float, rows: IntArray) -> tuple[Array, Array]:
        at = np.clip(SMALL * ends[rows] - 0.1, *EDGE)
        return tuple(
            np.stack([at[:, k], height[rows] + lift, 0 * height[rows]], axis=-1)
            for k in (0, 1)
        )  # type: ignore[return-value]

    every, between = np.arange(len(names)), common(found.shadow_a, found.shadow_b)
    marks = [
        Segments("gap", *line(between, -0.14, np.flatnonzero(rows)), color=color)
        for rows, color in ((apart, "green"), (~apart, "vermillion"))
    ]
    # The length of a row's gap is written at its end: beside the gap it lies on shadows.
    ends = place + [NUMBERS_AT - NAMES_AT, 0.0, 0.0]
    gaps = [f"{value:+.2f}".replace("-", "−") for value in np.round(found.gap, 2) + 0.0]
    # No corners are drawn here, so nothing leads from them to an axis.
    nothing = np.zeros((0, 3))
    return Pane(
        [standing(ball(0.001)), *(labelled(standing(ball(0.001)), text) for text in (*names, *gaps))],
        np.concatenate([[OUT_OF_SIGHT], place, ends]),
        title="all eight axes, gaps in m",
        arrows=[
            Arrows("normals of the edges", _in_space(found.axes), at=place + [0.6, 0.0, 0.0], scale=0.25,
                   color="black"),
        ],
        segments=[
            Segments("where they begin and end", nothing, nothing, color="grey"),
            Segments("shadow of A", *line(found.shadow_a, 0.0, every), color="blue"),
            Segments("shadow of B", *line(found.shadow_b, -0.07, every), color="orange"),
            *marks,
        ],
    )  # fmt: skip


def _ending(found: PolygonShadows) -> str:
    count = len(found.a)
    seen = [int(np.sum(part > 0)) for part in (found.gap[:count], found.gap[count:])]
    if found.overlap:
        return f"No axis has a gap: they overlap, and the least shift that parts them is {-found.gap.max():.2f} m"
    whose = (
        "edges of both show it"
        if all(seen)
        else f"only {'A' if seen[0] else 'B'} shows it"
    )
    have = "axis has" if sum(seen) == 1 else "axes have"
    return f"They are apart: {sum(seen)} of 8 {have} a gap, and {whose}"
