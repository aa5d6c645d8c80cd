"""The exercise ``least_translation``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.arrays import Array
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_05_separating_axis.polygons_overlap import (
    touching,
)
from course.exercises.definitions.lesson_05_separating_axis.shared import (
    VERTICES_A,
    VERTICES_B,
    polygon_pairs,
)
from course.exercises.slips import slip

_AXES = "edge_normals(vertices_a), edge_normals(vertices_b)"
#: Kinds of pairs that take turns in a batch.
_KINDS = ("across A", "across B", "above only", "across B", "across A", "below only")


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    square = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])
    corner = np.array([[3.0, 1.0], [6.0, 0.0], [6.0, 3.0]])
    return [
        Case("the corner of a triangle in a square", {"vertices_a": square, "vertices_b": corner}),
        Case("across an edge of A", polygon_pairs(rng, "across A")),
        Case("across an edge of B", polygon_pairs(rng, "across B")),
        Case("across an edge of B, other corners", polygon_pairs(rng, "across B", (), (6, 3))),
        Case("apart", polygon_pairs(rng, "above only"), "edge"),
        Case("apart, on the other side", polygon_pairs(rng, "below only"), "edge"),
        Case("they touch", touching(), "edge"),
        Case("two pairs", polygon_pairs(rng, _KINDS, (2,)), "batch"),
        Case("twelve pairs", polygon_pairs(rng, _KINDS, (12,)), "batch"),
        Case("a 2 by 5 batch", polygon_pairs(rng, _KINDS, (2, 5)), "batch"),
    ]  # fmt: skip


LEAST_TRANSLATION = Exercise(
    name="least_translation",
    rows=(6, 10),
    points=4,
    minutes=12,
    level="stretch",
    task="Return the shortest shift of A after which two convex polygons only touch; 0 where they are apart.",
    arguments=(VERTICES_A, VERTICES_B),
    results=(Value("shift", "(..., 2)", "m", "added to A's vertices"),),
    reference=formulas.least_translation,
    cases=_cases,
    properties=(
        Property(
            "parted",
            lambda given, answer: np.maximum(_overlap_after(given, answer), 0.0),
            "After your shift they still overlap.",
        ),
    ),
    mistakes=(
        Mistake(
            "sign",
            slip(
                formulas.least_translation,
                "ahead, back = upper_b - lower_a, lower_b - upper_a",
                "ahead, back = upper_b - lower_a, lower_b - upper_a; axes = -axes",
            ),
            "The length is right and the direction reversed: you push A into B. A leaves along +n when the shorter "
            "way is past B's upper end.",
        ),
        Mistake(
            "always along +n",
            slip(
                formulas.least_translation,
                "np.where(ahead < -back, ahead, back)",
                "ahead",
            ),
            "You always push A along +n, past B's upper end. On many axes the way back, along -n past its lower end, "
            "is the shorter one.",
        ),
        Mistake(
            "the longest",
            slip(formulas.least_translation, "np.argmin", "np.argmax"),
            "You take the axis on which the shift is longest. Any of them parts the polygons: the shortest is asked.",
        ),
        Mistake(
            "axes of A only",
            slip(formulas.least_translation, _AXES, "edge_normals(vertices_a)"),
            "You try A's edges only. Often the shortest way out is across an edge of B.",
        ),
        Mistake(
            "axes of B only",
            slip(formulas.least_translation, _AXES, "edge_normals(vertices_b)"),
            "You try B's edges only. Often the shortest way out is across an edge of A.",
        ),
        Mistake(
            "pairs that are apart",
            slip(formulas.least_translation, "np.where(apart, 0.0, least)", "least"),
            "Pairs that are apart need no shift: return 0 where any gap is above 0.",
        ),
        Mistake(
            "least value, not least size",
            slip(
                formulas.least_translation,
                "np.argmin(np.abs(shift), axis=-1)",
                "np.argmin(shift, axis=-1)",
            ),
            "You look for the least number, and the shifts along -n are below 0: so you find the longest of those. "
            "Compare their sizes.",
        ),
    ),  # fmt: skip
    hints=(
        "On one axis there are two ways out: A goes along +n past B's upper end, or along -n past B's lower end. How "
        "long is each?",
        "Take the shorter of the two on each axis, with its sign, and of all axes the one where its size is least. "
        "np.take_along_axis picks it out of a batch.",
        "ahead, back = upper_b - lower_a, ____\n"
        "shift = np.where(ahead < -back, ahead, ____)\n"
        "best = np.argmin(np.abs(shift), axis=-1)[..., None, None]\n"
        "least = np.take_along_axis(shift[..., None] * ____, best, axis=-2)[..., 0, :]\n"
        "apart = np.any((ahead < 0) | (back > 0), axis=-1, keepdims=True)\n"
        "return np.where(apart, ____, least)",
    ),
)


def _overlap_after(given: object, shift: object) -> Array:
    """By how much they overlap after the shift [m], below 0 where they are apart."""
    a = np.asarray(given["vertices_a"]) + np.asarray(shift)[..., None, :]  # type: ignore[index]
    b = np.asarray(given["vertices_b"])  # type: ignore[index]
    axes = np.concatenate([formulas.edge_normals(a), formulas.edge_normals(b)], axis=-2)
    gap = formulas.shadow_gap(*formulas.project(a, axes), *formulas.project(b, axes))
    return np.asarray(-gap.max(axis=-1))
