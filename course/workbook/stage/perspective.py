"""A still of a view into space, as SVG: the browser's camera, light and shadows, and what
is far painted before what is near.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from course import rotations
from course.arrays import Array
from course.workbook.plots.figure import PALETTE
from course.workbook.stage import marks
from course.workbook.stage.film import Film
from course.workbook.stage.flat_still import size_in_words
from course.workbook.stage.lettering import (
    HEIGHT,
    LETTER,
    THIN,
    Label,
    Line,
    Shape,
    arrow_label,
    lettered,
    segment_label,
)
from course.workbook.stage.panes import Pane
from course.workbook.stage.solids import Solid
from course.workbook.stage.views import CAMERAS, Space

# As in js/space.js: from foot to top of the picture, the way the light shines, room
# around what is seen.
ANGLE, ROOM = np.radians(32.0), 1.06
LIGHT = np.array([-0.45, 0.62, -1.0]) / np.linalg.norm([-0.45, 0.62, -1.0])
SHADOW, GRID = "#d1d1d1", "#e2e6ea"
SEAM = "0.9"  # what an edge is wide, so that nothing shows between neighbours
#: Triangles with an edge longer than this part of what is seen are cut: painted as wholes
#: from far to near, large ones would cover what lies before their middle.
FINE = 0.2
THROUGH = 0.35  # how much of a hidden arrow is seen
TOGETHER = 4  # moments of a trail that are one piece
#: Something to paint: how far from the eye it is [m], and its SVG.
Piece = tuple[float, str]


@dataclass(frozen=True, eq=False)
class Eye:
    """A camera, and the canvas it paints.

    Args:
        axes: rows right, up and back in the world, (3, 3).
        middle: what it looks at, (3,) [m].
        distance: from there [m].
        size: width and height of the canvas [pixels].
        reach: half the diagonal of what is seen [m].
    """

    axes: Array
    middle: Array
    distance: float
    size: Array
    reach: float

    def depth(self, points: Array) -> Array:
        """How far before the eye points (..., 3) lie, along its line of sight [m]."""
        return np.asarray(self.distance - (points - self.middle) @ self.axes[2])

    def screen(self, points: Any) -> Array:
        """Where points (..., 3) are on the canvas, (..., 2) [pixels]."""
        away = np.asarray(points, dtype=float) - self.middle
        depth = np.maximum(self.depth(away + self.middle), 1e-3 * self.distance)
        scale = 0.5 * self.size[1] / np.tan(ANGLE / 2) / depth
        across = (away @ self.axes[:2].T) * [1, -1]
        return np.asarray(0.5 * self.size + scale[..., None] * across)

    def pixels(self, length: float, point: Array) -> float:
        """How long a length across the line of sight [m] is drawn there."""
        depth = float(self.depth(point))
        return length * 0.5 * float(self.size[1]) / float(np.tan(ANGLE / 2)) / depth


def eye_of(film: Film, width: float, height: float) -> Eye:
    """The camera as near as shows all of the window, ``cameraOf`` in js/space.js."""
    assert isinstance(film.view, Space)
    direction, up = (np.array(v, dtype=float) for v in CAMERAS[film.view.camera])
    back = direction / np.linalg.norm(direction)
    right = np.cross(up, back)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(back, right), back])
    low, high = film.bounds
    signs = np.stack(np.meshgrid(*[[-0.5, 0.5]] * 3), axis=-1).reshape(-1, 3)
    x, y, z = axes @ (signs * (high - low)).T
    wide = np.maximum(np.abs(x) / 1.2, np.abs(y))
    near = float(np.max(z + ROOM * wide / np.tan(ANGLE / 2)))
    distance = (near or 1.0) * max(1.0, 1.2 * height / width)
    reach = 0.5 * float(np.linalg.norm(high - low)) or 1.0
    size = np.array([width, height])
    return Eye(axes, 0.5 * (low + high), distance, size, reach)


def space_picture(
    film: Film, pane: Pane, index: int, width: float, height: float
) -> str:
    """A pane of a film in space at one of its moments."""
    assert isinstance(film.view, Space)
    eye = eye_of(film, width, height)
    turn = rotations.to_matrix(np.asarray(pane.orientation)[index])
    place = np.asarray(pane.position)[index]
    out = []
    ground = film.view.ground
    if ground is not None:
        out.append(_grid(eye, ground))
        for k, solid in enumerate(pane.solids):
            if not solid.fixed:
                out.append(_shadow(solid, turn[k], place[k], ground, eye))
    pieces: list[Piece] = []
    for k, solid in enumerate(pane.solids):
        pieces += _body(solid, turn[k], place[k], eye)
    for body in pane.trails:
        color = PALETTE[pane.solids[body].parts[0].color]
        pieces += _trail(np.asarray(pane.position)[: index + 1, body], color, eye)
    arrows, words = _arrows(pane, index, eye)
    pieces += arrows
    out += [drawn for _, drawn in sorted(pieces, key=lambda p: -p[0])]
    # What a body hides of an arrow shines through it.
    hidden = "".join(drawn for _, drawn in sorted(arrows, key=lambda p: -p[0]))
    out.append(f'<g opacity="{THROUGH}">{hidden}</g>')
    for s in pane.segments:
        if s.shown:
            out += marks.segments(s, index, eye.screen)
    return "".join(out + _labels(pane, index, place, turn, words, eye))


def _arrows(pane: Pane, index: int, eye: Eye) -> tuple[list[Piece], list[Any]]:
    """Pieces of all arrows that are shown; where each is on the canvas, its colour and its words."""
    pieces: list[Piece] = []
    words = []
    for a in pane.arrows:
        if not a.shown:
            continue
        vector = np.asarray(a.vector)[index]
        start = np.asarray(a.at)[index]
        tip = start + float(a.scale or 1) * vector
        for b, e, v, color in zip(start, tip, vector, a.color, strict=True):
            drawn = list(_arrow(b, e, PALETTE[color], eye))
            pieces += drawn
            if drawn:
                said = size_in_words(a, v) if a.numbers else ""
                words.append((eye.screen(np.stack([b, e])), PALETTE[color], said))
    return pieces, words


def _trail(path: Array, color: str, eye: Eye) -> Iterator[Piece]:
    """A body's way in pieces, each as far from the eye as its middle."""
    view = eye.middle + eye.distance * eye.axes[2]
    for k in range(0, len(path) - 1, TOGETHER):
        some = path[k : k + TOGETHER + 1]
        far = float(np.linalg.norm(some.mean(axis=0) - view))
        yield far, marks.line(eye.screen(some), color, 1.5, 0.6)


def _labels(
    pane: Pane, index: int, place: Array, turn: Array, words: list[Any], eye: Eye
) -> list[str]:
    """Names of bodies, sizes of arrows, values of measured lines: where they cover nothing."""
    lines = [Line(ends, 4.0) for ends, _, _ in words]
    labels = []
    for k, solid in enumerate(pane.solids):
        if solid.label:
            x, y = eye.screen(place[k])
            aside = 0.5 * LETTER * len(solid.label) + 12.0
            near = [[x, y + HEIGHT], [x, y - HEIGHT], [x + aside, y], [x - aside, y]]
            labels.append(
                Label(solid.label, marks.INK, np.array(near), np.array([x, y]))
            )
    for ends, color, said in words:
        if said:
            labels.append(arrow_label(said, color, *ends))
    for s in pane.segments:
        if not s.shown:
            continue
        both = [eye.screen(np.asarray(v)[index]) for v in (s.start, s.end)]
        for k, (a, b) in enumerate(zip(*both, strict=True)):
            lines.append(Line(np.stack([a, b]), THIN))
            if s.value is not None:
                value = float(np.asarray(s.value)[index][k])
                ends = np.stack([a, b])
                color = PALETTE[s.color]
                labels.append(segment_label(s.name, value, s.unit, color, ends))
    shapes = [
        Shape(marks.hull(eye.screen(part.core @ turn[k].T + place[k])), eye.pixels(part.radius, place[k]))
        for k, solid in enumerate(pane.solids) if not solid.fixed for part in solid.parts
    ]  # fmt: skip
    return lettered(labels, lines, shapes, eye.size)


def _body(solid: Solid, turn: Array, place: Array, eye: Eye) -> Iterator[Piece]:
    if len(solid.parts) == 1 and len(solid.parts[0].core) == 1:
        yield _ball(solid, turn, place, eye)
        return
    corners = (solid.vertices @ turn.T + place)[solid.triangles]
    colors = [
        marks.FIXED if solid.fixed else PALETTE[solid.colors[row]]
        for row in solid.triangles[:, 0]
    ]
    view = eye.middle + eye.distance * eye.axes[2]
    for face, color in zip(corners, colors, strict=True):
        normal = np.cross(face[1] - face[0], face[2] - face[0])
        size = float(np.linalg.norm(normal))
        if size == 0.0 or normal @ (view - face[0]) <= 0:
            continue
        shade = marks.shaded(color, lit(normal / size))
        for part in _fine(face, FINE * eye.reach):
            middle = float(np.linalg.norm(part.mean(axis=0) - view))
            yield middle, marks.polygon(eye.screen(part), shade, SEAM, shade)


def lit(normal: Array) -> float:
    """How light a face is: as the browser's shader has it."""
    return float(0.76 + 0.28 * max(-0.8, float(-normal @ LIGHT)))


def _fine(face: Array, longest: float) -> list[Array]:
    """The triangle, or its halves, cut across its longest edge, where that is too long."""
    edges = np.linalg.norm(np.roll(face, -1, axis=0) - face, axis=1)
    k = int(edges.argmax())
    if edges[k] <= longest or edges[k] > 64 * longest:
        return [face]
    a, b, c = np.roll(face, -k, axis=0)
    middle = (a + b) / 2
    halves = np.array([[a, middle, c], [middle, b, c]])
    return [part for half in halves for part in _fine(half, longest)]


def _ball(solid: Solid, turn: Array, place: Array, eye: Eye) -> Piece:
    """One circle, with the light on the side from where it shines."""
    part = solid.parts[0]
    middle = turn @ part.core[0] + place
    color = marks.FIXED if solid.fixed else PALETTE[part.color]
    radius = eye.pixels(part.radius, middle)
    toward = -LIGHT @ eye.axes[:2].T * [1, -1]
    view = eye.middle + eye.distance * eye.axes[2]
    drawn = marks.round_ball(eye.screen(middle), radius, color, toward)
    return float(np.linalg.norm(middle - view)), drawn


def _arrow(start: Array, tip: Array, color: str, eye: Eye) -> Iterator[Piece]:
    """In pieces, so that it can come out of a body."""
    view = eye.middle + eye.distance * eye.axes[2]
    length = float(np.linalg.norm(tip - start))
    if length < 1e-4 * eye.reach:
        return
    thick = 0.012 * eye.reach
    head = min(5 * thick, 0.6 * length)
    neck = tip + (start - tip) * head / length
    count = max(1, int(np.ceil(length / (FINE * eye.reach))))
    along = np.linspace(start, neck, count + 1)
    wide = 2 * eye.pixels(min(thick, 0.2 * length), start)
    for a, b in zip(along[:-1], along[1:], strict=True):
        far = float(np.linalg.norm((a + b) / 2 - view))
        yield far - thick, marks.line(eye.screen(np.array([a, b])), color, wide)
    far = float(np.linalg.norm((neck + tip) / 2 - view))
    half = 2.4 * eye.pixels(min(thick, 0.2 * length), tip)
    yield far - thick, marks.head(eye.screen(neck), eye.screen(tip), half, color)


def _shadow(solid: Solid, turn: Array, place: Array, ground: float, eye: Eye) -> str:
    """The hull of each convex part, thrown along the light onto the ground."""
    out = []
    for part in solid.parts:
        points = part.core @ turn.T + place
        if part.radius > 0:  # a grown core: points around each of its own
            sides = np.stack([np.cross(LIGHT, [1, 0, 0]), np.cross(LIGHT, [0, 1, 0])])
            first = sides[0] / np.linalg.norm(sides[0])
            second = np.cross(LIGHT, first)
            turns = np.linspace(0, 2 * np.pi, 24, endpoint=False)
            ring = np.outer(np.cos(turns), first) + np.outer(np.sin(turns), second)
            points = (points[:, None] + part.radius * ring).reshape(-1, 3)
        fallen = points + ((ground - points[:, 2]) / LIGHT[2])[:, None] * LIGHT
        out.append(marks.polygon(marks.hull(eye.screen(fallen)), SHADOW))
    return "".join(out)


def _grid(eye: Eye, ground: float) -> str:
    """Lines at round distances, as far as the browser draws them."""
    half = 1.5 * eye.reach
    power = 10.0 ** np.floor(np.log10(half / 4))
    step = power * max(s for s in (1.0, 2.0, 5.0) if s * power <= half / 4)
    out = []
    low, high = eye.middle[:2] - half, eye.middle[:2] + half
    for axis in (0, 1):
        for k in np.arange(np.ceil(low[axis] / step), high[axis] / step):
            ends = np.array([[*low, ground], [*high, ground]])
            ends[:, axis] = k * step
            pieces = np.linspace(ends[0], ends[1], 12)
            seen = pieces[eye.depth(pieces) > 0.05 * eye.distance]
            out.append(marks.line(eye.screen(seen), GRID, 1.0))
    return "".join(out)
