"""Words in a still: they cover neither each other nor an arrow, and keep off bodies where
there is room. The browser's labels, js/labels.js, follow the same rules.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array
from course.workbook.stage import marks
from course.workbook.stage.words import shown_number

LETTER, HEIGHT = 7.8, 17.0  # of the stills' letters: mean width, and of a line [pixels]
#: What a place costs, beside 1 for each place that would be liked better.
OVER_LABEL, OVER_ARROW, OVER_BODY, OVER_LINE, FARTHER = 1e6, 1000.0, 40.0, 30.0, 4.0
OVER_FIXED = 3.0  # a floor or a wall
THIN = 1.0  # half as wide as a line that is no arrow [pixels]


@dataclass(frozen=True, eq=False)
class Shape:
    """What a body covers of a picture: the hull of points (k, 2), grown by a radius [pixels]."""

    points: Array
    radius: float
    fixed: bool = False


@dataclass(frozen=True, eq=False)
class Line:
    """An arrow or a measured line.

    Args:
        ends: start and tip, (2, 2) [pixels].
        half: how far beside it is still the line [pixels].
    """

    ends: Array
    half: float


@dataclass(frozen=True, eq=False)
class Label:
    """Words, and where they may go.

    Args:
        text, color: what is written, and how.
        places: middles in order of preference, (k, 2) [pixels].
        anchor: the middle of what it belongs to, (2,) [pixels].
        inside, fill: the body that is named, and its colour.
    """

    text: str
    color: str
    places: Array
    anchor: Array
    inside: Shape | None = None
    fill: str = ""


def lettered(
    labels: Iterable[Label], lines: Sequence[Line], bodies: Sequence[Shape], size: Array
) -> list[str]:
    """All labels as SVG, each at the place that costs least, in a picture of a size (2,)."""
    taken: list[Array] = []
    out = []
    for label in labels:
        if np.any(label.anchor < 0) or np.any(label.anchor > size):
            continue  # a name of what is outside names nothing
        half = 0.5 * np.array([LETTER * len(label.text) + 4.0, HEIGHT])
        around = _around(label.anchor)
        places = np.clip(np.concatenate([label.places, around]), half, size - half)
        liked = np.concatenate(
            [
                np.arange(len(label.places)),
                len(label.places)
                + FARTHER * np.hypot(*((around - label.anchor) / HEIGHT).T),
            ]
        )
        costs = np.full(len(places), np.inf)
        for k, (place, cost) in enumerate(zip(places, liked, strict=True)):
            if cost < costs.min():  # what stands there can only add to it
                costs[k] = cost + _cost(place, half, label, taken, lines, bodies)
        best = int(np.argmin(costs))
        if costs[best] >= OVER_LABEL:
            continue
        place = places[best]
        taken.append(np.stack([place - half, place + half]))
        within = label.inside is not None and _within(place, half, label.inside)
        out.append(_written(label, place, within))
    return out


def _written(label: Label, place: Array, within: bool) -> str:
    color, behind = (
        (marks.ink_on(label.fill), label.fill) if within else (label.color, "#fff")
    )
    weight = "600" if label.inside else "400"
    return marks.text(place, label.text, color, weight, behind=behind)


def arrow_label(text: str, color: str, start: Array, tip: Array) -> Label:
    """What stands beside an arrow: its size, or the name of a direction."""
    along = (tip - start) / max(float(np.linalg.norm(tip - start)), 1e-9)
    reach = np.array([0.5 * LETTER * len(text) + 8.0, HEIGHT])
    aside, on = np.array([-along[1], along[0]]) * reach, along * reach
    aside = aside if aside[1] <= 0 else -aside
    middle = (start + tip) / 2
    near = [middle + aside, middle - aside, tip + on, tip + aside, tip - aside]
    return Label(text, color, np.array(near), middle)


def segment_label(name: str, value: float, unit: str, color: str, ends: Array) -> Label:
    """What stands beside a measured line."""
    words = f"{name} {shown_number(value, 3)} {unit}".strip()
    (x, y), right = ends.mean(axis=0), 0.5 * LETTER * len(words) + 8.0
    places = [[x + right, y], [x - right, y], [x, y - HEIGHT], [x, y + HEIGHT]]
    return Label(words, color, np.array(places), ends.mean(axis=0))


def _around(place: Array) -> Array:
    """Places farther and farther away."""
    far = np.arange(1.2, 9.0, 0.65)[:, None, None]
    turn = np.linspace(0, 2 * np.pi, 12, endpoint=False)[None, :, None]
    ring = np.concatenate([1.6 * np.cos(turn), np.sin(turn)], axis=-1)
    return np.asarray((place + far * HEIGHT * ring).reshape(-1, 2))


def _cost(
    place: Array, half: Array, label: Label, taken: Any, lines: Any, bodies: Any
) -> float:
    box = np.stack([place - half, place + half])
    cost = OVER_LABEL * any(np.all((box[0] < b[1]) & (b[0] < box[1])) for b in taken)
    within = label.inside is not None and _within(place, half, label.inside)
    for line in lines:
        if crosses(box, line):
            thin = 1.0 if within else OVER_LINE
            cost += thin if line.half <= THIN else OVER_ARROW
    if not within:
        costs = (
            OVER_FIXED if shape.fixed else OVER_BODY
            for shape in bodies
            if covers(box, shape)
        )
        cost += sum(costs)
    return float(cost)


def crosses(box: Array, line: Line) -> bool:
    """Whether a line runs through a box, its lower and upper corner (2, 2)."""
    start, way = line.ends[0], line.ends[1] - line.ends[0]
    low, high = box[0] - line.half, box[1] + line.half
    flat = np.abs(way) < 1e-9
    if np.any(flat & ((start <= low) | (start >= high))):
        return False
    way = np.where(flat, 1.0, way)
    enter = np.where(flat, 0.0, np.minimum((low - start) / way, (high - start) / way))
    leave = np.where(flat, 1.0, np.maximum((low - start) / way, (high - start) / way))
    return bool(max(0.0, *enter) < min(1.0, *leave))


def covers(box: Array, shape: Shape) -> bool:
    """Whether a box lies over some of a body, by separating axes."""
    corners = np.array([[x, y] for x in box[:, 0] for y in box[:, 1]])
    edges = np.roll(shape.points, -1, axis=0) - shape.points
    if len(edges) == 1:
        edges = np.array([[-1, 1]]) * (shape.points[0] - box.mean(axis=0))[::-1]
    axes = np.concatenate([np.eye(2), np.stack([-edges[:, 1], edges[:, 0]], axis=-1)])
    size = np.linalg.norm(axes, axis=1)
    axes = axes[size > 1e-9] / size[size > 1e-9, None]
    mine, other = corners @ axes.T, shape.points @ axes.T
    low, high = other.min(axis=0) - shape.radius, other.max(axis=0) + shape.radius
    return bool(np.all((mine.min(axis=0) < high) & (low < mine.max(axis=0))))


def _within(place: Array, half: Array, shape: Shape) -> bool:
    """Whether letters lie within a body's outline, their corners at least."""
    letters = half - [2.0, 0.25 * HEIGHT]
    corners = place + letters * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    points = shape.points
    if len(points) == 1:
        return bool(np.all(np.linalg.norm(corners - points[0], axis=1) <= shape.radius))
    edges = np.roll(points, -1, axis=0) - points
    normals = np.stack([-edges[:, 1], edges[:, 0]], axis=-1)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-9)[:, None]
    side = np.einsum("cej,ej->ce", corners[:, None] - points, normals)
    return bool(np.all(side >= -shape.radius) or np.all(side <= shape.radius))
