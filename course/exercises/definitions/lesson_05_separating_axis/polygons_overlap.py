"""The exercise ``polygons_overlap``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array, BoolArray
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_05_separating_axis.shared import (
    KINDS,
    VERTICES_A,
    VERTICES_B,
    Pairs,
    polygon_gaps,
    polygon_pairs,
    polygons,
)
from course.exercises.slips import slip

_AXES = "edge_normals(vertices_a), edge_normals(vertices_b)"


_BAR = np.array([[-3.0, -1.0], [3.0, -1.0], [3.0, 1.0], [-3.0, 1.0]])


def _plus() -> Pairs:
    """Two bars that cross like a plus sign: no corner of one lies in the other."""
    return {"vertices_a": _BAR, "vertices_b": _BAR[:, ::-1] * [-1.0, 1.0]}


def _crossing(rng: np.random.Generator, count: int) -> Pairs:
    """Slim quadrangles that cross far from their ends, at 60 degrees and more."""
    slim = _BAR * [0.7, 0.2] + rng.uniform(-0.08, 0.08, (2, count, 4, 2))
    first = rng.uniform(0.0, 2 * np.pi, count)
    angle = np.stack([first, first + rng.uniform(1.05, 2.09, count)])
    c, s = np.cos(angle)[..., None, None], np.sin(angle)[..., None, None]
    x, y = slim[..., :1], slim[..., 1:]
    place = rng.uniform(-2.0, 2.0, (count, 1, 2))
    aside = place + rng.uniform(-0.3, 0.3, (count, 1, 2))
    a, b = np.concatenate([c * x - s * y, s * x + c * y], axis=-1)
    return {"vertices_a": np.round(a + place, 3), "vertices_b": np.round(b + aside, 3)}


def _one_inside(rng: np.random.Generator) -> Pairs:
    """A small pentagon inside a large triangle."""
    large = np.array([[-3.0, -2.0], [4.0, -2.5], [0.5, 3.5]])
    small = np.round(0.3 * polygons(rng, 5, 1)[0] + rng.uniform(-0.3, 0.3, 2), 3)
    return {"vertices_a": large, "vertices_b": small}


def touching() -> Pairs:
    """A corner of B on an upright edge of A, in numbers that are exact."""
    return {
        "vertices_a": np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 3.0]]),
        "vertices_b": np.array([[2.0, 1.0], [3.0, 0.5], [4.0, 2.0], [3.0, 2.5]]),
    }


def _beside(rng: np.random.Generator, gap: float) -> Pairs:
    """Two upright edges a hair off, at another height: an edge of either shows this gap [m]."""
    rise = round(float(rng.uniform(-0.3, 0.4)), 3)
    upright = np.array([[2.0, 1.0], [3.0, 0.5], [4.0, 2.0], [2.0, 2.5]])
    return touching() | {"vertices_b": upright + [gap, rise]}


def _hair_apart(given: Mapping[str, Any], answer: Any) -> Any:
    """Where a pair less than a millimetre apart is said to overlap."""
    gaps = polygon_gaps(dict(given))
    gap = np.maximum(gaps["A"], gaps["B"])
    return (gap > 0) & (gap < 1e-3) & answer


def _corner_inside(vertices_a: Array, vertices_b: Array) -> BoolArray:
    """Whether some corner of one lies in the other."""

    def inside(points: Array, polygon: Array) -> BoolArray:
        normals = formulas.edge_normals(polygon)
        along = points @ np.swapaxes(normals, -1, -2)
        reach = np.sum(normals * polygon, axis=-1)[..., None, :]
        return np.asarray(np.any(np.all(along <= reach + 1e-12, axis=-1), axis=-1))

    return inside(vertices_a, vertices_b) | inside(vertices_b, vertices_a)


def _either(vertices_a: Array, vertices_b: Array) -> BoolArray:
    """Whether the shadows overlap on all axes of one of the two."""
    gaps = polygon_gaps({"vertices_a": vertices_a, "vertices_b": vertices_b})
    return np.asarray((gaps["A"] <= 0) | (gaps["B"] <= 0))


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    triangle = np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]])
    return [
        Case("two triangles whose boxes overlap", {
            "vertices_a": triangle, "vertices_b": np.array([[2.0, 1.0], [2.0, 2.0], [1.0, 2.0]])}),
        Case("the same, nearer", {
            "vertices_a": triangle, "vertices_b": np.array([[1.5, 0.2], [1.5, 1.2], [0.5, 1.2]])}),
        Case("0.1 mm apart", _beside(rng, 1e-4), "edge"),
        Case("0.1 mm deep", _beside(rng, -1e-4), "edge"),
        Case("apart, and only an edge of A shows it", polygon_pairs(rng, "seen by A only")),
        Case("apart, and only an edge of B shows it", polygon_pairs(rng, "seen by B only")),
        Case("they overlap", polygon_pairs(rng, "overlap")),
        Case("a corner touches an edge", touching(), "edge"),
        Case("one lies in the other", _one_inside(rng), "edge"),
        Case("they cross like a plus sign", _plus()),
        Case("three pairs", polygon_pairs(rng, [*KINDS], (3,), (4, 3)), "batch"),
        Case("twelve pairs", polygon_pairs(rng, [*KINDS], (12,)), "batch"),
        Case("twelve pairs, other corners", polygon_pairs(rng, [*KINDS], (12,), (6, 4)), "batch"),
        Case("five that cross", _crossing(rng, 5), "batch"),
        Case("a 2 by 4 batch", polygon_pairs(rng, [*KINDS], (2, 4)), "batch"),
    ]  # fmt: skip


POLYGONS_OVERLAP = Exercise(
    name="polygons_overlap",
    rows=(6, 7, 10),
    points=3,
    minutes=9,
    task="Return whether two convex polygons overlap; touching counts.",
    arguments=(VERTICES_A, VERTICES_B),
    results=(Value("overlap", "(...)", "", "True where they overlap", dtype="bool"),),
    reference=formulas.polygons_overlap,
    cases=_cases,
    properties=(
        Property(
            "a hair apart",
            _hair_apart,
            "Pairs that are a hair apart overlap by it. A gap above 0, however small, is proof that they are apart.",
        ),
    ),
    mistakes=(
        Mistake(
            "axes of A only",
            slip(formulas.polygons_overlap, _AXES, "edge_normals(vertices_a)"),
            "You find the gaps on the normals of A's edges only. Some pairs are parted by an edge of B alone, and you "
            "say that they overlap: both polygons give axes, and on each of them it is A's shadow against B's.",
        ),
        Mistake(
            "axes of B only",
            slip(formulas.polygons_overlap, _AXES, "edge_normals(vertices_b)"),
            "You find the gaps on the normals of B's edges only. Some pairs are parted by an edge of A alone, and you "
            "say that they overlap: both polygons give axes, and on each of them it is A's shadow against B's.",
        ),
        Mistake(
            "a corner of one in the other",
            _corner_inside,
            "You say that they overlap where a corner of one lies in the other. Two bars that cross like a plus sign "
            "overlap without any such corner: ask the shadows, on the normals of all edges.",
        ),
        Mistake(
            "either's axes are enough",
            _either,
            "You ask for overlap on the axes of A *or* on those of B. One gap on any axis is proof that they are "
            "apart: on all axes of both the shadows must overlap, so it is & between the two.",
        ),
        Mistake(
            "corners as axes",
            slip(formulas.polygons_overlap, _AXES, "vertices_a, vertices_b"),
            "Your axes are the corners, taken as vectors from the origin. The axes are the normals of the edges: "
            "edge_normals(vertices_a), and B's.",
        ),
        Mistake(
            "a verdict for each axis",
            slip(
                formulas.polygons_overlap,
                "np.all(shadow_gap(*shadow_a, *shadow_b) <= 0, axis=-1)",
                "shadow_gap(*shadow_a, *shadow_b) <= 0",
            ),
            "You return a verdict for each axis. The pair has one: it overlaps if the shadows do on all axes, "
            "np.all(..., axis=-1).",
        ),
        Mistake(
            "almost touching is an overlap",
            slip(formulas.polygons_overlap, "<= 0", "<= 1e-3"),
            "You allow a gap: pairs that are 0.1 mm apart overlap by your verdict. A gap above 0, however small, is "
            "proof that they are apart; compare with 0.",
        ),
        Mistake(
            "almost parted is apart",
            slip(formulas.polygons_overlap, "<= 0", "<= -1e-3"),
            "You ask for some depth: pairs that are 0.1 mm deep in each other, or touch, are apart by your verdict. "
            "No gap above 0 on any axis means that they overlap; compare with 0.",
        ),
        Mistake(
            "edges as axes",
            slip(
                formulas.polygons_overlap,
                _AXES,
                "edge_normals(vertices_a)[..., ::-1] * [1, -1], edge_normals(vertices_b)[..., ::-1] * [1, -1]",
            ),
            "Your axes run along the edges. What separates two polygons along an edge is the direction across it: its "
            "normal. (For rectangles it would make no difference.)",
        ),
        Mistake(
            "x and y",
            slip(
                formulas.polygons_overlap,
                "axes = np.concatenate(axes, axis=-2)",
                "axes = np.eye(2)",
            ),
            "You compare along x and y only: that tests the boxes around the polygons, not the polygons.",
        ),
        Mistake(
            "centre to centre",
            slip(
                formulas.polygons_overlap,
                "axes = np.concatenate(axes, axis=-2)",
                "axes = (np.mean(vertices_b, axis=-2) - np.mean(vertices_a, axis=-2))[..., None, :]",
            ),
            "You try one axis, from middle to middle. That decides for circles; for polygons the axes are the normals "
            "of the edges.",
        ),
        Mistake(
            "one axis is enough",
            slip(formulas.polygons_overlap, "np.all", "np.any"),
            "By your verdict every pair overlaps. Two things do that. Either one axis is enough for it: np.any where "
            "np.all belongs. Or a shadow is compared with itself: project(vertices_a, ...) and project(vertices_b, "
            "...) each come once.",
        ),
        Mistake(
            "apart on every axis",
            slip(formulas.polygons_overlap, "<= 0", ">= 0"),
            "By your verdict every pair is apart. Two things do that. Either the comparison is the wrong way round: "
            "two shadows overlap where their gap is at most 0. Or the ends are: shadow_gap wants the lower one first.",
        ),
        Mistake(
            "the other way round",
            slip(
                formulas.polygons_overlap,
                "np.all(shadow_gap(*shadow_a, *shadow_b) <= 0, axis=-1)",
                "np.any(shadow_gap(*shadow_a, *shadow_b) > 0, axis=-1)",
            ),
            "Your answer is reversed: it is True for pairs that are apart.",
        ),
        Mistake(
            "touching left out",
            slip(formulas.polygons_overlap, "<= 0", "< 0"),
            "Right but for pairs that touch. Shapes are closed, so a gap of 0 counts as overlapping: <= 0.",
        ),
        Mistake(
            "one verdict for the batch",
            slip(formulas.polygons_overlap, " <= 0, axis=-1)", " <= 0)"),
            "Right for one pair. For a batch you give a single verdict for all: the axes are counted on the last "
            "axis, np.all(..., axis=-1).",
        ),
    ),  # fmt: skip
    hints=(
        "Which axes can show that they are apart? Collect them, of both polygons: np.concatenate([...], axis=-2).",
        "project gives both shadows on all axes at once, shadow_gap the gaps. They overlap if no gap is above 0.",
        "axes = np.concatenate([edge_normals(vertices_a), ____], axis=-2)\n"
        "shadow_a, shadow_b = project(vertices_a, axes), project(____, axes)\n"
        "return np.all(shadow_gap(*shadow_a, *shadow_b) ____ 0, axis=-1)",
    ),
)
