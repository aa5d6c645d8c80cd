"""What the stage draws: boxes, balls, capsules, walls, any mesh, several joined.

Each is triangles in body axes for a view into space, and for a flat one its parts: the
convex hull of a few points, grown by a radius. A ball is one point grown, a capsule two,
a box eight points not grown; what is seen of them from any side is the hull of their
projections, grown by the same radius.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    IntArray,
    choice,
    failure,
    indices,
    positive,
    read_only,
    shaped,
    vectors,
)
from course.workbook.plots.figure import PALETTE

#: How finely round things are drawn: points around, and from pole to pole.
AROUND, POLE_TO_POLE = 24, 13


@dataclass(frozen=True, eq=False)
class Part:
    """A convex part: the hull of some points grown by a radius.

    Args:
        core: (k, 3) points in body axes [m].
        radius: by which they are grown [m].
        color: a name of the palette.
    """

    core: Array
    radius: float
    color: str


@dataclass(frozen=True, eq=False)
class Solid:
    """A body's looks: triangles in body axes, about its centre of mass.

    Args:
        vertices: (v, 3) [m].
        triangles: (f, 3) whole numbers, anticlockwise seen from outside.
        colors: (v,) names of the palette.
        what: one word for alternative text, "box".
        smooth: whether shading hides the edges between triangles.
        parts: the same body as convex parts.
        label: stands on the body in a flat view, "1".
        fixed: drawn as what does not move: a floor, a wall, a peg.
        endless: reaches as far as the picture does, which does not grow for it.
    Raises:
        ValueError: shapes that do not fit, a vertex that is not there, an unknown
            colour.
    """

    vertices: Array
    triangles: IntArray
    colors: tuple[str, ...]
    what: str
    smooth: bool = False
    parts: tuple[Part, ...] = ()
    label: str = ""
    fixed: bool = False
    endless: bool = False

    def __post_init__(self) -> None:
        vertices = vectors("vertices", self.vertices)
        triangles = indices(
            "triangles", self.triangles, len(vertices) if vertices.ndim == 2 else 0
        )
        if vertices.ndim != 2 or not len(vertices):
            raise failure(
                "vertices", "shape (v, 3) with at least one", f"shape {vertices.shape}"
            )
        if triangles.ndim != 2 or triangles.shape[1] != 3:
            raise failure("triangles", "shape (f, 3)", f"shape {triangles.shape}")
        if len(self.colors) != len(vertices):
            raise failure(
                "colors", f"{len(vertices)} names, one a vertex", f"{len(self.colors)}"
            )
        for name in set(self.colors):
            choice("colors", name, tuple(PALETTE))
        object.__setattr__(self, "vertices", read_only(vertices))
        object.__setattr__(self, "triangles", read_only(triangles))

    @property
    def reach(self) -> float:
        """How far the body reaches from its centre [m]."""
        return float(np.linalg.norm(self.vertices, axis=-1).max())


def box(
    half_extents: ArrayLike,
    *,
    center: ArrayLike = (0.0, 0.0, 0.0),
    rotation: ArrayLike | None = None,
    color: str | tuple[str, str, str] = "blue",
) -> Solid:
    """A box; three colours paint the pairs of faces across its axes 1, 2 and 3, so that
    its turning shows.

    Args:
        half_extents: (3,) [m].
        center: of the box in body axes, (3,) [m].
        rotation: (3, 3), columns the box's axes in body axes; none turns nothing.
        color: a name of the palette, or three.
    """
    size = positive("half_extents", vectors("half_extents", half_extents))
    shaped("half_extents", size, (3,))
    corners: list[Array] = []
    triangles: list[tuple[int, int, int]] = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            first, second = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
            turns = (
                ((-1, -1), (1, -1), (1, 1), (-1, 1))
                if side > 0
                else ((-1, -1), (-1, 1), (1, 1), (1, -1))
            )
            start = len(corners)
            corners += [
                side * np.eye(3)[axis] + a * first + b * second for a, b in turns
            ]
            triangles += [(start, start + 1, start + 2), (start, start + 2, start + 3)]
    names = (color,) * 3 if isinstance(color, str) else tuple(color)
    if len(names) != 3:
        raise failure("color", "one name or three", f"{len(names)}")
    placed = _placed(np.array(corners) * size, center, rotation)
    return Solid(
        placed,
        np.array(triangles),
        tuple(name for name in names for _ in range(8)),
        "box",
        parts=(Part(np.unique(placed, axis=0), 0.0, names[0]),),
    )


def ball(
    radius: float, *, center: ArrayLike = (0.0, 0.0, 0.0), color: str = "blue"
) -> Solid:
    """A ball of this radius [m]."""
    size = float(positive("radius", radius))
    vertices, triangles = _round(np.zeros(POLE_TO_POLE), size)
    return Solid(
        _placed(vertices, center, None),
        triangles,
        (color,) * len(vertices),
        "ball",
        smooth=True,
        parts=(Part(_placed(np.zeros((1, 3)), center, None), size, color),),
    )


def capsule(
    start: ArrayLike, end: ArrayLike, radius: float, *, color: str = "blue"
) -> Solid:
    """A capsule: all points within ``radius`` [m] of the segment from ``start`` to
    ``end``, each (3,) [m].
    """
    a, b, size = (
        vectors("start", start),
        vectors("end", end),
        float(positive("radius", radius)),
    )
    shaped("start", a, (3,))
    shaped("end", b, (3,))
    half = 0.5 * float(np.linalg.norm(b - a))
    middle = POLE_TO_POLE // 2
    shift = np.concatenate(
        [np.full(middle, -half), [-half, half], np.full(middle, half)]
    )
    vertices, triangles = _round(shift, size)
    turn = _frames((b - a)[None])[0]
    return Solid(
        vertices @ turn.T + 0.5 * (a + b),
        triangles,
        (color,) * len(vertices),
        "capsule",
        smooth=True,
        parts=(Part(np.stack([a, b]), size, color),),
    )


def mesh(
    vertices: ArrayLike,
    triangles: ArrayLike,
    *,
    color: str = "blue",
    smooth: bool = False,
) -> Solid:
    """Any surface of triangles: vertices (v, 3) [m] in body axes, triangles (f, 3),
    anticlockwise from outside.
    """
    array = vectors("vertices", vertices)
    part = Part(array, 0.0, color)
    colors = (color,) * len(array)
    return Solid(array, np.asarray(triangles), colors, "mesh", smooth, (part,))


def joined(*solids: Solid, what: str = "body") -> Solid:
    """Several solids as the parts of one body, in the same body axes.

    ``what`` is one word for alternative text.
    """
    if not solids:
        raise failure("solids", "at least one", "none")
    if any(s.smooth for s in solids):  # what has edges keeps them: no shared corners
        solids = tuple(s if s.smooth else _apart(s) for s in solids)
    counts = np.cumsum([0, *(len(s.vertices) for s in solids)])
    triangles = [s.triangles + start for s, start in zip(solids, counts, strict=False)]
    return Solid(
        np.concatenate([s.vertices for s in solids]),
        np.concatenate(triangles),
        tuple(name for s in solids for name in s.colors),
        what,
        smooth=any(s.smooth for s in solids),
        parts=tuple(part for s in solids for part in s.parts),
    )


def _apart(solid: Solid) -> Solid:
    """The same with corners of its own for each triangle."""
    corners = solid.triangles.ravel()
    return replace(
        solid,
        vertices=solid.vertices[corners],
        triangles=np.arange(len(corners)).reshape(-1, 3),
        colors=tuple(solid.colors[k] for k in corners),
    )


def standing(solid: Solid, *, endless: bool = False) -> Solid:
    """The solid as one that does not move: grey and hatched, a floor, a wall, a peg.

    Args:
        endless: whether it reaches as far as the picture does.
    """
    parts = tuple(replace(part, color="grey") for part in solid.parts)
    colors = ("grey",) * len(solid.colors)
    return replace(solid, parts=parts, colors=colors, fixed=True, endless=endless)


def labelled(solid: Solid, label: str) -> Solid:
    """The solid with a word or a number on it."""
    return replace(solid, label=label)


def _round(shift: Array, radius: float) -> tuple[Array, IntArray]:
    """Rings from the south to the north pole along axis 3, each moved along it by its
    shift.
    """
    rings = len(shift)
    extra = rings - POLE_TO_POLE  # a capsule has its equator twice
    latitude = np.linspace(-0.5 * np.pi, 0.5 * np.pi, POLE_TO_POLE)
    latitude = np.concatenate(
        [latitude[: POLE_TO_POLE // 2 + 1], latitude[POLE_TO_POLE // 2 + 1 - extra :]]
    )
    turn = np.linspace(0, 2 * np.pi, AROUND, endpoint=False)
    x = radius * np.cos(latitude)[:, None] * np.cos(turn)
    y = radius * np.cos(latitude)[:, None] * np.sin(turn)
    z = np.broadcast_to((radius * np.sin(latitude) + shift)[:, None], x.shape)
    below = np.arange(AROUND) + AROUND * np.arange(rings - 1)[:, None]
    beside = (np.arange(AROUND) + 1) % AROUND + AROUND * np.arange(rings - 1)[:, None]
    triangles = np.concatenate(
        [
            np.stack([below, beside, beside + AROUND], axis=-1).reshape(-1, 3),
            np.stack([below, beside + AROUND, below + AROUND], axis=-1).reshape(-1, 3),
        ]
    )
    return np.stack([x, y, z], axis=-1).reshape(-1, 3), triangles


def _frames(direction: Array) -> Array:
    """Rotations (..., 3, 3) that take axis 3 to each direction (..., 3).

    The identity for a zero one.
    """
    length = np.linalg.norm(direction, axis=-1, keepdims=True)
    along = np.where(
        length > 0, direction / np.where(length > 0, length, 1.0), [0.0, 0.0, 1.0]
    )
    aside = np.where(np.abs(along[..., :1]) < 0.7, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])
    second = np.cross(along, aside)
    second /= np.linalg.norm(second, axis=-1, keepdims=True)
    return np.stack([np.cross(second, along), second, along], axis=-1)


def _placed(vertices: Array, center: ArrayLike, rotation: ArrayLike | None) -> Array:
    middle = vectors("center", center)
    shaped("center", middle, (3,))
    turn = np.eye(3) if rotation is None else np.asarray(rotation, dtype=float)
    shaped("rotation", turn, (3, 3))
    return vertices @ turn.T + middle
