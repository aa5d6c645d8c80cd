"""One moment of a film as SVG, written here: for saved notebooks and where nothing runs."""

from __future__ import annotations

import base64
import html
from typing import Any

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from course import rotations
from course.arrays import Array
from course.workbook.plots.figure import PALETTE
from course.workbook.stage.film import CAMERAS, PLANES, Film, Flat, Pane
from course.workbook.stage.words import description, scale_in_words, shown_number

WIDTH = 720.0  # of the whole picture, and the least a pane is high
_INK, _SOFT, _FIXED = "#16191d", "#5b6470", "#c9cfd6"
_LIGHT = np.array([0.45, -0.62, 1.0])


def svg(film: Film, *, time: float | None = None) -> str:
    """The film at a time [s] (default: its first): panes side by side, or one below the
    other where they are wide, with a legend of the arrows.
    """
    index = 0 if time is None else film.index_at(time)
    count = len(film.panes)
    aspect = _aspect(film)
    stacked = aspect > 1.9
    width = WIDTH if stacked else WIDTH / count
    height = min(width / aspect, 460.0)
    head = 22.0 if any(pane.title for pane in film.panes) else 0.0
    drawn = []
    for k, pane in enumerate(film.panes):
        x, y = (0.0, k * (height + head)) if stacked else (k * width, 0.0)
        body = _flat(film, pane, index, width, height) if isinstance(film.view, Flat) else \
            _space(film, pane, index, width, height)  # fmt: skip
        drawn.append(
            f'<g transform="translate({x:.1f} {y:.1f})">{_title(pane.title, width)}'
            f'<svg y="{head}" width="{width:.1f}" height="{height:.1f}">{body}</svg></g>'
        )
    foot = (height + head) * (count if stacked else 1)
    legend, rows = _legend(film, foot)
    total = foot + 20 * rows + 6
    said = html.escape(description(film, float(np.asarray(film.times)[index])))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:.0f} {total:.0f}" width="{WIDTH:.0f}" '
        f'height="{total:.0f}" font-family="system-ui, sans-serif" font-size="14" role="img"><title>{said}</title>'
        f'<rect width="100%" height="100%" fill="#fff"/>{"".join(drawn)}{legend}</svg>'
    )


def image(film: Film, *, time: float | None = None) -> str:
    """The same as an ``<img>`` with alternative text, for an HTML output."""
    text = svg(film, time=time)
    data = base64.b64encode(text.encode()).decode("ascii")
    at = None if time is None and not film.moves else (time or 0.0)
    alt = html.escape(description(film, at), quote=True)
    return f'<img alt="{alt}" style="max-width: 100%" src="data:image/svg+xml;base64,{data}">'


def _aspect(film: Film) -> float:
    if not isinstance(film.view, Flat):
        return 1.35
    left, bottom, right, top = _window(film)
    return float(np.clip((right - left) / (top - bottom), 0.6, 6.0))


def _window(film: Film) -> tuple[float, float, float, float]:
    assert isinstance(film.view, Flat)
    if film.view.window is not None:
        return film.view.window
    right, up = (np.array(v) for v in PLANES[film.view.plane])
    low, high = film.bounds
    (a, c), (b, d) = (sorted((low @ v, high @ v)) for v in (right, up))
    margin = 0.06 * max(c - a, d - b) or 1.0
    return a - margin, b - margin, c + margin, d + margin


def _title(words: str, width: float) -> str:
    if not words:
        return ""
    return (
        f'<text x="{width / 2:.0f}" y="16" text-anchor="middle" font-weight="600">'
        f"{html.escape(words)}</text>"
    )


def _flat(film: Film, pane: Pane, index: int, width: float, height: float) -> str:
    left, bottom, right, top = _window(film)
    assert isinstance(film.view, Flat)
    plane = np.array(PLANES[film.view.plane])
    scale = min(width / (right - left), height / (top - bottom))
    middle = np.array([(left + right) / 2, (bottom + top) / 2])

    def screen(p: Any) -> Array:
        return np.asarray(
            [width / 2, height / 2]
            + scale * (np.asarray(p) @ plane.T - middle) * [1, -1]
        )

    out = []
    turn = rotations.to_matrix(np.asarray(pane.orientation)[index])
    place = np.asarray(pane.position)[index]
    for k in sorted(range(len(pane.solids)), key=lambda k: not pane.solids[k].fixed):
        solid = pane.solids[k]
        for part in solid.parts:
            points = _hull(screen(part.core @ turn[k].T + place[k]))
            color = _FIXED if solid.fixed else PALETTE[part.color]
            out.append(_outline(points, part.radius * scale, color))
        if solid.label:
            out.append(_text(screen(place[k]), solid.label, "#fff", "600"))
    for s in pane.segments:
        if s.shown:
            out += _lines(s, index, screen)
    for a in pane.arrows:
        if a.shown:
            lift = np.outer(np.asarray(a.lift), plane[1])
            start = np.asarray(a.at)[index] + lift
            tip = start + float(a.scale or 1) * np.asarray(a.vector)[index]
            out += [
                _arrow(b, e, PALETTE[c])
                for b, e, c in zip(screen(start), screen(tip), a.color, strict=True)
            ]
    return "".join(out)


def _space(film: Film, pane: Pane, index: int, width: float, height: float) -> str:
    """Triangles from far to near, each as light as it faces the light."""
    from course.workbook.stage.film import Space

    assert isinstance(film.view, Space)
    low, high = film.bounds
    middle, reach = 0.5 * (low + high), 0.5 * float(np.linalg.norm(high - low)) or 1.0
    right, up, back = _eye(film.view.camera)
    scale = 0.5 * min(width, height) / reach

    def screen(p: Any) -> Array:
        seen = (np.asarray(p) - middle) @ np.stack([right, up], axis=-1)
        return np.asarray([width / 2, height / 2] + scale * seen * [1, -1])

    turn = rotations.to_matrix(np.asarray(pane.orientation)[index])
    place = np.asarray(pane.position)[index]
    faces, paint = [], []
    for k, solid in enumerate(pane.solids):
        corners = (solid.vertices @ turn[k].T + place[k])[solid.triangles]
        faces.append(corners)
        for row in solid.triangles[:, 0]:
            paint.append(_FIXED if solid.fixed else PALETTE[solid.colors[row]])
    triangles = np.concatenate(faces) if faces else np.zeros((0, 3, 3))
    normal = np.cross(
        triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    )
    normal /= np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-300)
    lit = 0.66 + 0.34 * np.clip(normal @ _LIGHT / np.linalg.norm(_LIGHT), -0.6, 1.0)
    facing = normal @ back > 0
    order = np.argsort(triangles.mean(axis=1) @ back)
    flat = screen(triangles)
    out = [
        _polygon(flat[f], _shaded(paint[f], lit[f])) for f in order if facing[f]
    ]  # fmt: skip
    for s in pane.segments:
        if s.shown:
            out += _lines(s, index, screen)
    for a in pane.arrows:
        if a.shown:
            start = np.asarray(a.at)[index]
            tip = start + float(a.scale or 1) * np.asarray(a.vector)[index]
            out += [
                _arrow(b, e, PALETTE[c])
                for b, e, c in zip(screen(start), screen(tip), a.color, strict=True)
            ]
    return "".join(out)


def _eye(camera: str) -> tuple[Array, Array, Array]:
    """What is right, up and toward the eye in a camera's picture."""
    direction, up = (np.array(v, dtype=float) for v in CAMERAS[camera])
    back = direction / np.linalg.norm(direction)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    return right, np.cross(back, right), back


def _shaded(color: str, lit: float) -> str:
    red, green, blue = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{min(255, round(lit * c)):02x}" for c in (red, green, blue))


def _hull(points: Array) -> Array:
    if len(points) < 3:
        return points
    try:
        return np.asarray(points[ConvexHull(points).vertices])
    except QhullError:  # all on a line
        along = points @ (points[-1] - points[0])
        return points[[along.argmin(), along.argmax()]]


def _outline(points: Array, radius: float, color: str) -> str:
    if len(points) == 1:
        x, y = points[0]
        return (
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{max(radius, 0.5):.1f}" fill="{color}" '
            f'stroke="{_INK}"/>'
        )
    around = _polygon(points, color, f"{2 * radius + 1.5:.1f}", _INK)
    return around + _polygon(points, color, f"{2 * radius:.1f}")


def _polygon(points: Array, fill: str, wide: str = "0.5", edge: str = "") -> str:
    listed = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return (
        f'<polygon points="{listed}" fill="{fill}" stroke="{edge or fill}" '
        f'stroke-width="{wide}" stroke-linejoin="round"/>'
    )


def _arrow(start: Array, tip: Array, color: str) -> str:
    length = float(np.linalg.norm(tip - start))
    if length < 0.5:
        return ""
    along = (tip - start) / length
    aside = np.array([-along[1], along[0]])
    head = min(11.0, 0.6 * length)
    neck = tip - head * along
    points = np.array([tip, neck + 0.42 * head * aside, neck - 0.42 * head * aside])
    (x, y), (a, b) = start, neck
    return (
        f'<path d="M{x:.1f} {y:.1f}L{a:.1f} {b:.1f}" stroke="{color}" '
        f'stroke-width="{min(2.4, 0.38 * head):.1f}"/>{_polygon(points, color, "0")}'
    )


def _lines(segments: Any, index: int, screen: Any) -> list[str]:
    color = PALETTE[segments.color]
    out = []
    ends = (np.asarray(segments.start)[index], np.asarray(segments.end)[index])
    for k, (start, end) in enumerate(zip(*ends, strict=True)):
        (x, y), (a, b) = screen(start), screen(end)
        out.append(
            f'<path d="M{x:.1f} {y:.1f}L{a:.1f} {b:.1f}" stroke="{color}" stroke-width="2"/>'
        )
        if segments.value is not None:
            value = float(np.asarray(segments.value)[index][k])
            words = f"{segments.name} {shown_number(value, 3)} {segments.unit}"
            place = np.array([(x + a) / 2 + 4, (y + b) / 2])
            out.append(_text(place, words.strip(), color, "400", "start"))
    return out


def _text(
    place: Array, words: str, color: str, weight: str, anchor: str = "middle"
) -> str:
    x, y = place
    # White around what is not written on a body: it may lie on lines or a floor.
    halo = "" if color == "#fff" else 'stroke="#fff" stroke-width="3" '
    return (
        f'<text x="{x:.1f}" y="{y + 5:.1f}" text-anchor="{anchor}" fill="{color}" {halo}'
        f'paint-order="stroke" font-weight="{weight}">{html.escape(words)}</text>'
    )


def _legend(film: Film, top: float) -> tuple[str, int]:
    """One row for each kind of arrow that is shown, with its scale."""
    kinds = {a.name: a for pane in film.panes for a in pane.arrows if a.shown}
    rows = []
    for row, (name, arrows) in enumerate(kinds.items()):
        y = top + 20 * row + 12
        color = PALETTE[arrows.color[0]] if len(set(arrows.color)) == 1 else _SOFT
        sample = _arrow(np.array([14.0, y]), np.array([40.0, y]), color)
        words = f"{name}: {scale_in_words(arrows)}"
        rows.append(sample + _text(np.array([48.0, y]), words, _SOFT, "400", "start"))
    return "".join(rows), len(rows)
