"""Two polygons to drag and turn, and their shadows on the normals of all their edges."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from course.arrays import Array
from course.study.shadow_cases import (
    PENTAGON,
    TRIANGLE,
    PolygonShadows,
    polygon_shadows,
    turned,
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
WINDOW = (-2.6, -2.4, 2.6, 2.4)
BESIDE = 1.9  # how far from the middle the axis with its shadows is drawn [m]
ROW, TOP, NAMES_AT, NUMBERS_AT = 0.52, 1.6, -2.4, 1.62  # of the rows [m]
SMALL = 0.62  # how much smaller the shadows of the rows are
KNOBS = (
    Knob("x", "A at x", -1.5, -1.9, 1.9, 0.05, "m"),
    Knob("y", "A at y", 1.3, -1.5, 1.5, 0.05, "m"),
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
    return Film(
        [_picture(found, (x, y)), _rows(found)],
        [0.0],
        Flat("xy", WINDOW),
        title="Two polygons and their shadows",
        caption="Drag the triangle A, or turn it. Left: their shadows on the axis of the greatest gap. "
        "Right: on the normals of all eight edges.",
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
    return replace(labelled(mesh(corners, fan, color=color), label), what=f"polygon {label}")


def _in_space(points: Array) -> Array:
    """Points of the plane, (..., 2), with z = 0."""
    return np.concatenate([points, np.zeros((*np.shape(points)[:-1], 1))], axis=-1)


def _picture(found: PolygonShadows, place: tuple[float, float]) -> Pane:
    n = found.axes[found.best]
    across = np.array([-n[1], n[0]])
    # On the side where there is more room, and A's shadow a little before B's.
    side = -1.0 if (np.array(place) @ across) > 0 else 1.0
    lines = {
        "shadow of A": (found.shadow_a[found.best], side * (BESIDE + 0.08), "blue"),
        "shadow of B": (found.shadow_b[found.best], side * BESIDE, "orange"),
    }
    drawn = [
        Segments(name, *(_in_space(np.array([end * n + at * across])) for end in ends), color=color)
        for name, (ends, at, color) in lines.items()
    ]
    middle = 0.5 * (np.roll(found.a, -1, axis=0) + found.a), 0.5 * (np.roll(found.b, -1, axis=0) + found.b)
    best = np.zeros(len(found.axes), dtype=bool)
    best[found.best] = True
    return Pane(
        [flat(found.a, "blue", "A", place), flat(found.b, "orange", "B", (0.0, 0.0))],
        _in_space(np.array([place, (0.0, 0.0)])),
        title="the axis of the greatest gap",
        arrows=[
            Arrows("normals of the edges", _in_space(found.axes), at=_in_space(np.concatenate(middle)), scale=0.22,
                   color=tuple("vermillion" if b else "black" for b in best)),
        ],
        segments=[*drawn, *_feet(found, side, n, across), _between(found, side, n, across)],
    )  # fmt: skip


def _feet(found: PolygonShadows, side: float, n: Array, across: Array) -> list[Segments]:
    """From the corners that bound a shadow straight to the axis."""
    start, end = [], []
    for polygon in (found.a, found.b):
        along = polygon @ n
        for k in (int(np.argmin(along)), int(np.argmax(along))):
            start.append(polygon[k])
            end.append(along[k] * n + side * (BESIDE + 0.04) * across)
    return [Segments("where they begin and end", _in_space(np.array(start)), _in_space(np.array(end)), color="grey")]


def _between(found: PolygonShadows, side: float, n: Array, across: Array) -> Segments:
    """The gap, or where it is below 0 what they have in common, with its number."""
    ends = _common(found)[found.best]
    start, end = (_in_space(np.array([at * n + side * (BESIDE - 0.1) * across])) for at in ends)
    color = "green" if found.gap[found.best] > 0 else "vermillion"
    return Segments("gap", start, end, [round(float(found.gap[found.best]), 3) + 0.0], color=color)


def _common(found: PolygonShadows) -> Array:
    """Between which two places the gap lies, or what is in common, (k, 2) [m]."""
    ends = np.stack([
        np.maximum(found.shadow_a[:, 0], found.shadow_b[:, 0]),
        np.minimum(found.shadow_a[:, 1], found.shadow_b[:, 1]),
    ], axis=-1)  # fmt: skip
    return np.sort(ends, axis=-1)


def _rows(found: PolygonShadows) -> Pane:
    height = TOP - ROW * np.arange(len(found.axes))
    names = [f"A{k + 1}" for k in range(len(found.a))] + [f"B{k + 1}" for k in range(len(found.b))]
    place = np.stack([np.full(len(names), NAMES_AT), height, 0 * height], axis=-1)
    apart = found.gap > 0

    def line(ends: Array, lift: float, rows: Array) -> tuple[Array, Array]:
        at = np.clip(SMALL * ends[rows] - 0.35, -2.15, 1.55)
        return tuple(
            np.stack([at[:, k], height[rows] + lift, 0 * height[rows]], axis=-1) for k in (0, 1)
        )  # type: ignore[return-value]

    every, common = np.arange(len(names)), _common(found)
    numbers = np.stack([np.full(len(names), NUMBERS_AT), height - 0.06, 0 * height], axis=-1)
    kinds = (("apart", apart, "green"), ("overlapping", ~apart, "vermillion"))
    marks = [
        Segments(name, *line(common, -0.14, np.flatnonzero(rows)), color=color)
        for name, rows, color in kinds
    ]
    values = [
        Segments("gap", numbers[rows], numbers[rows], np.round(found.gap[rows], 2) + 0.0, color=color)
        for name, rows, color in kinds
    ]
    return Pane(
        [labelled(standing(ball(0.001)), name) for name in names],
        place,
        title="all eight axes",
        segments=[
            Segments("shadow of A", *line(found.shadow_a, 0.0, every), color="blue"),
            Segments("shadow of B", *line(found.shadow_b, -0.07, every), color="orange"),
            *marks,
            *values,
        ],
    )  # fmt: skip


def _ending(found: PolygonShadows) -> str:
    count = len(found.a)
    seen = [int(np.sum(part > 0)) for part in (found.gap[:count], found.gap[count:])]
    if found.overlap:
        return f"No axis has a gap: they overlap, and the least shift that parts them is {-found.gap.max():.2f} m"
    whose = "edges of both show it" if all(seen) else f"only {'A' if seen[0] else 'B'} shows it"
    have = "axis has" if sum(seen) == 1 else "axes have"
    return f"They are apart: {sum(seen)} of 8 {have} a gap, and {whose}"
