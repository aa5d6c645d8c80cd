"""A still of a flat view, as SVG: bodies as outlines, to scale, and what is drawn on them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course import rotations
from course.arrays import Array
from course.workbook.plots.figure import PALETTE
from course.workbook.stage import lettering, marks
from course.workbook.stage.film import Film
from course.workbook.stage.lettering import Label, Line, Shape
from course.workbook.stage.panes import Pane
from course.workbook.stage.views import PLANES, Flat
from course.workbook.stage.words import shown_number

#: Radius below which a ball is no more than the place of its label [pixels], as in ``flat.js``.
POINT = 0.25


def window_of(film: Film) -> tuple[float, float, float, float]:
    """Left, bottom, right and top of what is seen [m]."""
    assert isinstance(film.view, Flat)
    if film.view.window is not None:
        return film.view.window
    right, up = (np.array(v) for v in PLANES[film.view.plane])
    low, high = film.bounds
    (a, c), (b, d) = (sorted((low @ v, high @ v)) for v in (right, up))
    margin = 0.06 * max(c - a, d - b) or 1.0
    return a - margin, b - margin, c + margin, d + margin


@dataclass(frozen=True, eq=False)
class Plane:
    """How the plane of a film lies on a canvas: the whole window, to one scale."""

    axes: Array
    middle: Array
    scale: float
    size: Array

    def screen(self, points: Any) -> Array:
        """Where points (..., 3) are on the canvas, (..., 2) [pixels]."""
        across = np.asarray(points) @ self.axes.T - self.middle
        return np.asarray(0.5 * self.size + self.scale * across * [1, -1])


def plane_picture(
    film: Film, pane: Pane, index: int, width: float, height: float
) -> str:
    """A pane of a flat film at one of its moments."""
    assert isinstance(film.view, Flat)
    left, bottom, right, top = window_of(film)
    scale = min(width / (right - left), height / (top - bottom))
    middle = np.array([(left + right) / 2, (bottom + top) / 2])
    axes = np.array(PLANES[film.view.plane])
    plane = Plane(axes, middle, scale, np.array([width, height]))
    bodies, names, shapes = _bodies(pane, index, plane)
    out = [*_trails(pane, index, plane), *bodies]
    lines: list[Line] = []
    labels: list[Label] = []
    for s in pane.segments:
        if s.shown:
            out += marks.segments(s, index, plane.screen)
            _measured(s, index, plane, lines, labels)
    for a in pane.arrows:
        if a.shown:
            out += _arrows(a, index, plane, lines, labels)
    out += lettering.lettered([*names, *labels], lines, shapes, plane.size)
    return "".join(out)


def _trails(pane: Pane, index: int, plane: Plane) -> list[str]:
    out = []
    for body in pane.trails:
        path = plane.screen(np.asarray(pane.position)[: index + 1, body])
        color = PALETTE[pane.solids[body].parts[0].color]
        out.append(marks.line(path, color, 1.5, 0.55))
    return out


def _bodies(
    pane: Pane, index: int, plane: Plane
) -> tuple[list[str], list[Label], list[Shape]]:
    """Their outlines, what is fixed first; their names; and what they cover."""
    turn = rotations.to_matrix(np.asarray(pane.orientation)[index])
    place = np.asarray(pane.position)[index]
    drawn: list[str] = []
    names: list[Label] = []
    shapes: list[Shape] = []
    for k in sorted(range(len(pane.solids)), key=lambda k: not pane.solids[k].fixed):
        solid = pane.solids[k]
        parts = [
            Shape(
                marks.hull(plane.screen(p.core @ turn[k].T + place[k])),
                p.radius * plane.scale,
                solid.fixed,
            )
            for p in solid.parts
        ]
        colors = [marks.FIXED if solid.fixed else PALETTE[p.color] for p in solid.parts]
        drawn += [
            marks.outline(p.points, p.radius, c)
            for p, c in zip(parts, colors, strict=True)
            if len(p.points) > 1 or p.radius >= POINT
        ]
        shapes += parts
        if solid.label:
            names.append(_name(solid.label, plane.screen(place[k]), parts, colors[0]))
    return drawn, names, shapes


def _name(words: str, place: Array, parts: list[Shape], color: str) -> Label:
    """A body's name: within it where there is room, else beside it."""
    at = np.stack([place - 1, place + 1])
    inside = next((p for p in parts if lettering.covers(at, p)), parts[0])
    reach = inside.radius if len(inside.points) == 1 else 9.0
    aside = 0.5 * lettering.LETTER * len(words) + 4.0 + reach
    near = reach * np.array([[0, 0], [0, 0.5], [0, -0.5], [0.5, 0], [-0.5, 0]])
    over = 11.0 + reach
    beside = np.array([[aside, 0], [-aside, 0], [0, -over], [0, over]])
    places = place + np.concatenate([near, beside])
    return Label(words, marks.INK, places, place, inside, color)


def _measured(
    shown: Any, index: int, plane: Plane, lines: list[Line], labels: list[Label]
) -> None:
    """What a pane's measured lines, and the numbers beside them, take of the picture."""
    color = PALETTE[shown.color]
    ends = [np.asarray(v)[index] for v in (shown.start, shown.end)]
    for k, both in enumerate(zip(*map(plane.screen, ends), strict=True)):
        line = np.array(both)
        lines.append(Line(line, lettering.THIN))
        if shown.value is not None:
            value = float(np.asarray(shown.value)[index][k])
            labels.append(
                lettering.segment_label(shown.name, value, shown.unit, color, line)
            )


def _arrows(
    arrows: Any, index: int, plane: Plane, lines: list[Line], labels: list[Label]
) -> list[str]:
    vector = np.asarray(arrows.vector)[index]
    start = np.asarray(arrows.at)[index] + np.outer(arrows.lift, plane.axes[1])
    tip = start + float(arrows.scale or 1) * vector
    out = []
    for k, (a, b) in enumerate(
        zip(plane.screen(start), plane.screen(tip), strict=True)
    ):
        color = PALETTE[arrows.color[k]]
        out.append(marks.arrow(a, b, color))
        if np.linalg.norm(b - a) < 3:
            continue
        lines.append(Line(np.stack([a, b]), 3.5))
        if arrows.numbers:
            labels.append(
                lettering.arrow_label(size_in_words(arrows, vector[k]), color, a, b)
            )
    return out


def size_in_words(arrows: Any, vector: Array) -> str:
    """What stands beside an arrow: "2 m/s", or the name of a direction."""
    if not arrows.unit:
        return str(arrows.name)
    return f"{shown_number(float(np.linalg.norm(vector)), 3)} {arrows.unit}"
