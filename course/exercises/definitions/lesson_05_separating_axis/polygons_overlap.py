"""The exercise ``polygons_overlap``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_05_separating_axis.shared import (
    KINDS,
    VERTICES_A,
    VERTICES_B,
    Pairs,
    polygon_pairs,
    polygons,
)
from course.exercises.slips import slip

_AXES = "edge_normals(vertices_a), edge_normals(vertices_b)"


def _crossing(rng: np.random.Generator) -> Pairs:
    """Two slim kites that cross like a plus sign: no corner of one lies in the other."""
    a = np.array([[-2.0, 0.1], [0.2, -0.3], [2.2, 0.0], [-0.1, 0.4]])
    shift = np.round(rng.uniform(-0.2, 0.2, 2), 3)
    return {"vertices_a": a, "vertices_b": a[:, ::-1] * [-1.0, 1.0] + shift}


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


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    triangle = np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]])
    return [
        Case("two triangles whose boxes overlap", {
            "vertices_a": triangle, "vertices_b": np.array([[2.0, 1.0], [2.0, 2.0], [1.0, 2.0]])}),
        Case("the same, nearer", {
            "vertices_a": triangle, "vertices_b": np.array([[1.5, 0.2], [1.5, 1.2], [0.5, 1.2]])}),
        Case("apart, and only an edge of A shows it", polygon_pairs(rng, "seen by A only")),
        Case("apart, and only an edge of B shows it", polygon_pairs(rng, "seen by B only")),
        Case("they overlap", polygon_pairs(rng, "overlap")),
        Case("a corner touches an edge", touching(), "edge"),
        Case("one lies in the other", _one_inside(rng), "edge"),
        Case("they cross, no corner of one in the other", _crossing(rng), "edge"),
        Case("three pairs", polygon_pairs(rng, [*KINDS], (3,), (4, 3)), "batch"),
        Case("twelve pairs", polygon_pairs(rng, [*KINDS], (12,)), "batch"),
        Case("twelve pairs, other corners", polygon_pairs(rng, [*KINDS], (12,), (6, 4)), "batch"),
        Case("a 2 by 4 batch", polygon_pairs(rng, [*KINDS], (2, 4)), "batch"),
    ]  # fmt: skip


POLYGONS_OVERLAP = Exercise(
    name="polygons_overlap",
    rows=(6, 7, 10),
    points=3,
    minutes=8,
    task="Return whether two convex polygons overlap; touching counts.",
    arguments=(VERTICES_A, VERTICES_B),
    results=(Value("overlap", "(...)", "", "True where they overlap", dtype="bool"),),
    reference=formulas.polygons_overlap,
    cases=_cases,
    mistakes=(
        Mistake(
            "axes of A only",
            slip(formulas.polygons_overlap, _AXES, "edge_normals(vertices_a)"),
            "You take the normals of A's edges only. Some pairs are separated by an edge of B alone, and you say that "
            "they overlap: both polygons give axes.",
        ),
        Mistake(
            "axes of B only",
            slip(formulas.polygons_overlap, _AXES, "edge_normals(vertices_b)"),
            "You take the normals of B's edges only. Some pairs are separated by an edge of A alone, and you say that "
            "they overlap: both polygons give axes.",
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
            "You say that they overlap as soon as their shadows do on *one* axis. They overlap only if the shadows do "
            "on all of them.",
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
