"""A film as JSON for the browser: arrays as base64, places from the film's middle.

A browser's drawing knows single precision only, which at x = 1e8 m cannot tell 1 m: the
middle is taken away in double precision first, and the browser never needs it back but
for the numbers that it prints.
"""

from __future__ import annotations

import base64
from collections.abc import Sequence
from typing import Any

import numpy as np

from course.workbook.plots.figure import PALETTE
from course.workbook.stage.beside import Curves, Path
from course.workbook.stage.film import Film
from course.workbook.stage.panes import Arrows, Pane, Segments
from course.workbook.stage.solids import Solid
from course.workbook.stage.views import CAMERAS, PLANES, Flat, Space
from course.workbook.stage.words import description, shown_number


def encoded(film: Film) -> dict[str, Any]:
    """The film as plain JSON, to be played by the stage's module in the browser."""
    middle, space = film.middle, isinstance(film.view, Space)
    return {
        "title": film.title,
        "caption": film.caption,
        "ending": film.ending,
        "description": description(film),
        "times": _array(film.times, np.float64),
        "speed": film.speed,
        "events": [float(t) for t in film.events],
        "view": _view(film),
        "palette": PALETTE,
        "panes": [_pane(pane, middle, space=space) for pane in film.panes],
        "charts": [_chart(chart) for chart in film.charts],
        "counters": [
            {"name": name, "values": _over(film, values)}
            for name, values in film.counters.items()
        ],
        "numbers": {
            "panes": [pane.title for pane in film.panes],
            "rows": [
                [n.name, n.unit, *(shown_number(v, n.digits) for v in n.values)]
                for n in film.numbers
            ],
        },
    }


def _over(film: Film, values: Any) -> dict[str, Any]:
    shape = (len(np.asarray(film.times)),)
    return _array(np.broadcast_to(np.asarray(values, dtype=float), shape))


def _array(values: Any, kind: Any = np.float32) -> dict[str, Any]:
    """Little-endian bytes in base64, with their shape.

    What stands still over time (a stride of 0) is sent once, with ``still``.
    """
    array = np.asarray(values)
    still = array.ndim > 1 and len(array) > 1 and array.strides[0] == 0
    sent = np.ascontiguousarray(array[:1] if still else array, dtype=kind)
    code = np.dtype(kind).newbyteorder("<")
    return {
        "kind": np.dtype(kind).str[1:],
        "shape": list(sent.shape),
        "still": bool(still),
        "bytes": base64.b64encode(sent.astype(code).tobytes()).decode("ascii"),
    }


def _from_middle(places: Any, middle: Any) -> dict[str, Any]:
    array = np.asarray(places)
    if array.ndim > 1 and len(array) > 1 and array.strides[0] == 0:
        return _array(np.broadcast_to(array[:1] - middle, array.shape))
    return _array(array - middle)


def _view(film: Film) -> dict[str, Any]:
    low, high = film.bounds
    middle = film.middle
    view: dict[str, Any] = {
        "middle": middle.tolist(),
        "low": (low - middle).tolist(),
        "high": (high - middle).tolist(),
    }
    if isinstance(film.view, Flat):
        right, up = (np.array(v) for v in PLANES[film.view.plane])
        window = film.view.window
        if window is not None:
            across, along = middle @ right, middle @ up
            left, bottom, end, top = window
            window = (left - across, bottom - along, end - across, top - along)
        return view | {
            "kind": "flat",
            "right": right.tolist(),
            "up": up.tolist(),
            "window": window,
            "origin": [float(middle @ right), float(middle @ up)],
            "axes": list(film.view.plane),
        }
    assert isinstance(film.view, Space)
    ground = film.view.ground
    return view | {
        "kind": "space",
        "camera": film.view.camera,
        "cameras": CAMERAS,
        "ground": None if ground is None else float(ground - middle[2]),
    }


def _pane(pane: Pane, middle: Any, *, space: bool) -> dict[str, Any]:
    meshes, which = _meshes(pane.solids) if space else ([], [0] * len(pane.solids))
    return {
        "title": pane.title,
        "solids": [_solid(s, mesh) for s, mesh in zip(pane.solids, which, strict=True)],
        "meshes": meshes,
        "position": _from_middle(pane.position, middle),
        "orientation": _array(pane.orientation),
        "arrows": [_arrows(a, middle) for a in pane.arrows],
        "segments": [_segments(s, middle) for s in pane.segments],
        "trails": list(pane.trails),
    }


def _solid(solid: Solid, mesh: int) -> dict[str, Any]:
    return {
        "what": solid.what,
        "label": solid.label,
        "fixed": solid.fixed,
        "endless": solid.endless,
        "mesh": mesh,
        "parts": [
            {"core": p.core.tolist(), "radius": p.radius, "color": p.color}
            for p in solid.parts
        ],
    }


def _meshes(solids: Sequence[Solid]) -> tuple[list[dict[str, Any]], list[int]]:
    """Each different mesh once, and which of them each solid has."""
    known: dict[Any, int] = {}
    meshes: list[dict[str, Any]] = []
    which = []
    for s in solids:
        key = (s.vertices.tobytes(), s.triangles.tobytes(), s.colors, s.smooth, s.fixed)
        if key not in known:
            known[key] = len(meshes)
            names = sorted(set(s.colors))
            meshes.append(
                {
                    "smooth": s.smooth,
                    "fixed": s.fixed,
                    "vertices": _array(s.vertices),
                    "triangles": _array(s.triangles, np.uint32),
                    "colors": [names.index(c) for c in s.colors],
                    "names": names,
                }
            )
        which.append(known[key])
    return meshes, which


def _arrows(arrows: Arrows, middle: Any) -> dict[str, Any]:
    return {
        "name": arrows.name,
        "unit": arrows.unit,
        "scale": arrows.scale,
        "colors": list(arrows.color),
        "shown": arrows.shown,
        "numbers": arrows.numbers,
        "lift": [float(v) for v in np.atleast_1d(arrows.lift)],
        "at": _from_middle(arrows.at, middle),
        "vector": _array(arrows.vector),
    }


def _segments(segments: Segments, middle: Any) -> dict[str, Any]:
    return {
        "name": segments.name,
        "unit": segments.unit,
        "color": segments.color,
        "shown": segments.shown,
        "start": _from_middle(segments.start, middle),
        "end": _from_middle(segments.end, middle),
        "value": None if segments.value is None else _array(segments.value),
    }


def _chart(chart: Curves | Path) -> dict[str, Any]:
    if isinstance(chart, Curves):
        return {
            "kind": "curves",
            "title": chart.title,
            "unit": chart.unit,
            "stacked": chart.stacked,
            "logarithmic": chart.logarithmic,
            "limits": chart.limits,
            "colors": list(chart.colors),
            "curves": [
                {"name": name, "values": _array(np.asarray(v, dtype=float), np.float64)}
                for name, v in chart.curves.items()
            ],
        }
    return {
        "kind": "path",
        "title": chart.title,
        "across": chart.across,
        "up": chart.up,
        "equal": chart.equal,
        "answers": chart.answers,
        "limits": chart.limits,
        "x": _array(np.asarray(chart.x, dtype=float), np.float64),
        "y": _array(np.asarray(chart.y, dtype=float), np.float64),
        "guides": [
            {"name": name, "points": np.asarray(line, dtype=float).tolist()}
            for name, line in chart.guides.items()
        ],
    }
