"""The exercise ``oriented_boxes_overlap``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_05_separating_axis.shared import (
    BOX_KINDS,
    Pairs,
    box_pairs,
    turns,
    values_of_box,
)
from course.exercises.slips import slip

_ARGUMENTS = (*values_of_box("a"), *values_of_box("b"))
_HALF_A = "np.sum(np.abs(axes @ rotation_a) * e_a, axis=-1)"
_HALF_B = "np.sum(np.abs(axes @ rotation_b) * e_b, axis=-1)"


def _pair(*values: object) -> Pairs:
    return {
        v.name: np.asarray(x, float) for v, x in zip(_ARGUMENTS, values, strict=True)
    }


#: Kinds of pairs that take turns in a batch.
_KINDS = (*BOX_KINDS, "near", "deep", "overlap", "deep")


def _parallel(rng: np.random.Generator, gap: float) -> Pairs:
    """Two boxes of the same turn, one beside the other, this far apart."""
    rotation = turns(rng, 1)[0]
    e_a, e_b = rng.uniform(0.3, 1.0, (2, 3)).round(3)
    way = np.array([e_a[0] + e_b[0] + gap, 0.2, -0.1])
    center = rng.normal(size=3)
    return _pair(center, rotation, e_a, center + rotation @ way, rotation, e_b)


def _hair_apart(given: Mapping[str, Any], answer: Any) -> Any:
    """Where a pair is said to overlap which does only if it is a thousandth larger."""
    larger = dict(given)
    for name in ("half_extents_a", "half_extents_b"):
        larger[name] = 1.001 * given[name]
    now, then = (formulas.oriented_boxes_overlap(**g) for g in (given, larger))
    return then & ~now & answer


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    c = np.sqrt(0.5)
    upright, about_x = np.eye(3), np.array([[1, 0, 0], [0, c, -c], [0, c, c]])
    about_y = np.array([[c, 0, c], [0, 1, 0], [-c, 0, c]])
    ones, axes_in_turn = np.ones(3), np.eye(3)[[1, 2, 0]]
    return [
        Case("a cube below a cube, turned about x and about y", _pair(
            np.zeros(3), about_x, ones, [0.0, 0.0, 3.0], about_y, ones)),
        Case("the same, nearer", _pair(np.zeros(3), about_x, ones, [0.0, 0.0, 2.5], about_y, ones)),
        Case("apart, and only faces of A show it", box_pairs(rng, "seen by A only")),
        Case("apart, and only faces of B show it", box_pairs(rng, "seen by B only")),
        Case("apart, and only two edges show it", box_pairs(rng, "seen by edges only")),
        Case("they overlap", box_pairs(rng, "overlap")),
        Case("parallel and touching", _pair(
            np.zeros(3), upright, [1.0, 2.0, 0.5], [1.5, 0.5, 0.25], axes_in_turn, [1.0, 0.5, 2.0]), "edge"),
        Case("parallel and overlapping", _parallel(rng, -0.2), "edge"),
        Case("parallel and apart", _parallel(rng, 0.2), "edge"),
        Case("parallel, 0.1 mm apart", _parallel(rng, 1e-4), "edge"),
        Case("parallel, 0.1 mm deep", _parallel(rng, -1e-4), "edge"),
        Case("edges crossed, 0.1 mm apart", _pair(
            np.zeros(3), about_x, ones, [0.1, -0.2, np.sqrt(8) + 1e-4], about_y, ones), "edge"),
        Case("edges crossed, 0.1 mm deep", _pair(
            np.zeros(3), about_x, ones, [-0.2, 0.1, np.sqrt(8) - 1e-4], about_y, ones), "edge"),
        Case("three pairs", box_pairs(rng, _KINDS, (3,)), "batch"),
        Case("35 pairs", box_pairs(rng, _KINDS, (35,)), "batch"),
        Case("a 2 by 14 batch", box_pairs(rng, _KINDS, (2, 14)), "batch"),
    ]  # fmt: skip


def _without(name: str, *edits: str, message: str) -> Mistake:
    return Mistake(name, slip(formulas.oriented_boxes_overlap, *edits), message)


ORIENTED_BOXES_OVERLAP = Exercise(
    name="oriented_boxes_overlap",
    rows=(4, 10),
    points=3,
    minutes=10,
    task="Return whether two oriented boxes overlap, by the 15 axes of box_axes; touching counts.",
    arguments=_ARGUMENTS,
    results=(Value("overlap", "(...)", "", "True where they overlap", dtype="bool"),),
    reference=formulas.oriented_boxes_overlap,
    cases=_cases,
    properties=(
        Property(
            "a hair apart",
            _hair_apart,
            "Pairs that are a hair apart overlap by it. A gap above 0, however small, is proof that they are apart.",
        ),
    ),
    mistakes=(
        _without(
            "six axes",
            "box_axes(rotation_a, rotation_b)",
            "box_axes(rotation_a, rotation_b)[..., :6, :]",
            message="You try the six face normals only. Pairs whose edges pass each other like crossed swords "
            "are apart, and you say that they overlap: the nine products of edges belong to it.",
        ),
        _without(
            "edges only",
            "box_axes(rotation_a, rotation_b)",
            "box_axes(rotation_a, rotation_b)[..., 6:, :]",
            message="You try the nine products of edges only. The six face normals belong to the axes too.",
        ),
        _without(
            "half of A left out",
            "<= half_a + half_b",
            "<= half_b",
            message="A's half shadow is missing: you ask whether A's *centre* is in reach of B. Both half "
            "shadows add up.",
        ),
        _without(
            "half of B left out",
            "<= half_a + half_b",
            "<= half_a",
            message="B's half shadow is missing: you ask whether B's *centre* is in reach of A. Both half "
            "shadows add up.",
        ),
        _without(
            "rows of A",
            "axes @ rotation_a",
            "axes @ np.swapaxes(rotation_a, -1, -2)",
            message="For A you multiply by the rows of its rotation. Its axes are the columns: the cosines n.r_i are "
            "axes @ rotation_a.",
        ),
        _without(
            "rows of B",
            "axes @ rotation_b",
            "axes @ np.swapaxes(rotation_b, -1, -2)",
            message="For B you multiply by the rows of its rotation. Its axes are the columns: the cosines n.r_i are "
            "axes @ rotation_b.",
        ),
        _without(
            "rows of both",
            "axes @ rotation_a",
            "axes @ np.swapaxes(rotation_a, -1, -2)",
            "axes @ rotation_b",
            "axes @ np.swapaxes(rotation_b, -1, -2)",
            message="You multiply by the rows of the rotations. A box's axes are the columns: the cosines "
            "n.r_i of all axes "
            "are axes @ rotation.",
        ),
        _without(
            "signs of the cosines",
            "np.abs(axes @ rotation_a)",
            "(axes @ rotation_a)",
            "np.abs(axes @ rotation_b)",
            "(axes @ rotation_b)",
            message="By your verdict every pair is apart. Two things do that. Either half shadows are too short: the "
            "cosines keep their signs, so that terms cancel, or one box is taken off the other; np.abs belongs around "
            "each `axes @ rotation`, and the two add up. Or the comparison is the wrong way round: on every axis the "
            "distance must be <= the two half shadows together.",
        ),
        _without(
            "sign of the distance",
            "np.abs(between)",
            "between",
            message="You compare n.(x_B - x_A) without its size: on an axis that points from B to A it is "
            "below 0, and the "
            "boxes seem to overlap however far they are.",
        ),
        _without(
            "centre of B from the origin",
            "(center_b - center_a)",
            "center_b",
            message="You take B's centre from the origin. What counts is its place from A's centre, x_B - x_A.",
        ),
        _without(
            "ellipsoids",
            _HALF_A,
            "np.sqrt(np.sum(((axes @ rotation_a) * e_a) ** 2, axis=-1))",
            _HALF_B,
            "np.sqrt(np.sum(((axes @ rotation_b) * e_b) ** 2, axis=-1))",
            message="The root of the sum of squares is the half shadow of an ellipsoid inside the box. A "
            "box's corner reaches "
            "farther: the sizes of the three terms add up.",
        ),
        _without(
            "the largest term",
            _HALF_A,
            "np.max(np.abs(axes @ rotation_a) * e_a, axis=-1)",
            _HALF_B,
            "np.max(np.abs(axes @ rotation_b) * e_b, axis=-1)",
            message="You take the largest of the three terms: so far the middle of a face reaches. A corner lies away "
            "from the centre along all three axes of the box, so the sizes of the three terms add up.",
        ),
        _without(
            "sides halved",
            "<= half_a + half_b",
            "<= (half_a + half_b) / 2",
            message="Your half shadows are half as long as they should be: half_extents are already half the sides.",
        ),
        _without(
            "one axis is enough",
            "np.all",
            "np.any",
            message="By your verdict every pair overlaps. Two things do that. Either one axis is enough for it: np.any "
            "where np.all belongs, for the shadows must overlap on all 15. Or the half shadows are far too long: each "
            "counts once, half_extents are already half the sides, and np.sum without axis=-1 adds up all 15 axes.",
        ),
        _without(
            "the other way round",
            "np.all(np.abs(between) <= half_a + half_b, axis=-1)",
            "np.any(np.abs(between) > half_a + half_b, axis=-1)",
            message="Your answer is reversed: it is True for pairs that are apart.",
        ),
        _without(
            "touching left out",
            "<= half_a",
            "< half_a",
            message="Boxes with parallel edges never overlap by your verdict, because the product of parallel edges "
            "is the zero vector. With < it asks whether 0 < 0: shapes are closed, so it is <=. If you divide the axes "
            "by their lengths, it is 0/0 there, NaN, and every comparison with NaN is false: leave them as they are.",
        ),
        _without(
            "almost touching is an overlap",
            "<= half_a + half_b",
            "<= half_a + half_b + 1e-3",
            message="You make the half shadows a little longer: boxes that are 0.1 mm apart overlap by your verdict. A "
            "gap above 0, however small, is proof that they are apart.",
        ),
        _without(
            "a fixed length less",
            "<= half_a + half_b",
            "<= half_a + half_b - 1e-3",
            message="You take something off the half shadows: boxes that are 0.1 mm deep in each other are apart by "
            "your verdict, and so are all boxes with parallel edges, for the product of these is the zero vector, "
            "where 0 is compared with 0. Touching counts: <= half_a + half_b.",
        ),
        _without(
            "A's cosines for B",
            "axes @ rotation_b",
            "axes @ rotation_a",
            message="Both half shadows are made with A's cosines. B's half sides belong to B's directions: "
            "axes @ rotation_b.",
        ),
        _without(
            "B's cosines for A",
            "axes @ rotation_a",
            "axes @ rotation_b",
            message="Both half shadows are made with B's cosines. A's half sides belong to A's directions: "
            "axes @ rotation_a.",
        ),
        _without(
            "half sides exchanged",
            "rotation_a) * e_a",
            "rotation_a) * e_b",
            "rotation_b) * e_b",
            "rotation_b) * e_a",
            message="A's cosines meet B's half sides, and B's those of A: exchange the two.",
        ),
        _without(
            "A's half sides for both",
            "rotation_b) * e_b",
            "rotation_b) * e_a",
            message="Both half shadows are made with A's half sides. B has its own: e_b, of half_extents_b.",
        ),
        _without(
            "B's half sides for both",
            "rotation_a) * e_a",
            "rotation_a) * e_b",
            message="Both half shadows are made with B's half sides. A has its own: e_a, of half_extents_a.",
        ),
        _without(
            "A's reach twice",
            "<= half_a + half_b",
            "<= half_a + half_a",
            message="You take A's half shadow twice and B's not at all: half_a + half_b.",
        ),
        _without(
            "B's reach twice",
            "<= half_a + half_b",
            "<= half_b + half_b",
            message="You take B's half shadow twice and A's not at all: half_a + half_b.",
        ),
        _without(
            "faces of A only",
            "box_axes(rotation_a, rotation_b)",
            "box_axes(rotation_a, rotation_b)[..., :3, :]",
            message="You try the three face normals of A only. The three of B and the nine products belong to it.",
        ),
        _without(
            "faces of B only",
            "box_axes(rotation_a, rotation_b)",
            "box_axes(rotation_a, rotation_b)[..., 3:6, :]",
            message="You try the three face normals of B only. The three of A and the nine products belong to it.",
        ),
        _without(
            "squares added",
            "np.abs(between) <= half_a + half_b",
            "between**2 <= half_a**2 + half_b**2",
            message="You compare squares, but the square of a sum is not the sum of the squares: the twofold product "
            "is missing, and boxes that overlap seem apart. Compare np.abs(between) with half_a + half_b.",
        ),
        _without(
            "a verdict for each axis",
            "np.all(np.abs(between) <= half_a + half_b, axis=-1)",
            "np.abs(between) <= half_a + half_b",
            message="You return a verdict for each of the 15 axes. The pair has one: it overlaps if the shadows do on "
            "all of them, np.all(..., axis=-1).",
        ),
        _without(
            "almost parted is apart",
            "<= half_a + half_b",
            "<= 0.9999 * (half_a + half_b)",
            message="You make the half shadows a little shorter: boxes that touch, or are 0.1 mm deep in each other, "
            "are apart by your verdict. Reach is half_a + half_b, and touching counts.",
        ),
        _without(
            "the size of the sum",
            _HALF_A,
            "np.abs(np.sum((axes @ rotation_a) * e_a, axis=-1))",
            _HALF_B,
            "np.abs(np.sum((axes @ rotation_b) * e_b, axis=-1))",
            message="You add up the three terms and take the size of the sum: that is one corner of the eight. The "
            "farthest corner has the sum of the three sizes, as in your half shadow: abs first, then the sum.",
        ),
        _without(
            "sum of the centres",
            "(center_b - center_a)",
            "(center_b + center_a)",
            message="You add the two centres. What counts is the way from one to the other, x_B - x_A.",
        ),
        _without(
            "the longer one alone",
            "<= half_a + half_b",
            "<= np.maximum(half_a, half_b)",
            message="You compare with the longer of the two half shadows. They reach toward each other from both "
            "centres, so together they cover half_a + half_b.",
        ),
        _without(
            "one verdict for the batch",
            "half_b, axis=-1)",
            "half_b)",
            message="Right for one pair. For a batch you give a single verdict for all: np.all(..., axis=-1).",
        ),
    ),  # fmt: skip
    hints=(
        "On each axis: how far are the centres apart along it, and how far do the two half shadows reach together?",
        "axes = box_axes(...) has shape (..., 15, 3). The cosines of all axes with A's axes are axes @ rotation_a, and "
        "your half shadow is the sum of their sizes times e_a, over the last axis. The same for B.",
        "half_a = np.sum(np.abs(axes @ rotation_a) * ____, axis=-1)\n"
        "half_b = ____\n"
        "return np.all(np.abs(between) <= ____, axis=-1)",
    ),
)
