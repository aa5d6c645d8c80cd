"""The exercise ``boxes_overlap``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.arrays import Array, IntArray
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_04_overlap_tests.shared import (
    CLEAR,
    Given,
    place,
    point,
)
from course.exercises.slips import slip

_ARGUMENTS = (
    point("lower_a", "lowest corner of A"),
    point("upper_a", "highest corner of A"),
    point("lower_b", "lowest corner of B"),
    point("upper_b", "highest corner of B"),
)
_FIRST, _SECOND = "(lower_a <= upper_b)", "(lower_b <= upper_a)"
#: Whether an end of one interval lies in the other: together, whether a corner does.
_END_OF_B = "((lower_a <= lower_b) & (lower_b <= upper_a) | (lower_a <= upper_b) & (upper_b <= upper_a))"
_END_OF_A = "((lower_b <= lower_a) & (lower_a <= upper_b) | (lower_b <= upper_a) & (upper_a <= upper_b))"
#: How B lies on an axis: apart above, below, over A's upper or lower end, inside A, around A.
_LIES = ("above", "below", "upper end", "lower end", "inside", "around")
#: What takes turns in a batch: on the three axes.
_KINDS = (
    (2, 3, 4), (0, 2, 4), (3, 5, 2), (3, 1, 5), (4, 4, 4), (2, 5, 0), (5, 5, 5), (1, 4, 3),
    (4, 5, 4), (4, 0, 4), (2, 2, 2), (5, 3, 1), (3, 3, 3), (1, 1, 1), (0, 0, 0), (0, 1, 0),
)  # fmt: skip


def _pair(*values: object) -> Given:
    return {
        v.name: np.asarray(x, float) for v, x in zip(_ARGUMENTS, values, strict=True)
    }


def _lying(
    rng: np.random.Generator, lower: Array, upper: Array, kind: IntArray
) -> tuple[Array, Array]:
    """Ends of B's intervals beside A's, by kind, every end clear of A's."""
    step = CLEAR + rng.uniform(0.0, 0.8, (2, *lower.shape))
    inner = rng.uniform(0.1, 0.4, (2, *lower.shape)) * (upper - lower)
    ends = [
        (upper + step[0], upper + step[0] + step[1]),
        (lower - step[0] - step[1], lower - step[0]),
        (upper - inner[0], upper + step[1]),
        (lower - step[0], lower + inner[1]),
        (lower + inner[0], upper - inner[1]),
        (lower - step[0], upper + step[1]),
    ]
    low = np.choose(kind, [low for low, _ in ends])
    return low, np.choose(kind, [high for _, high in ends])


def _drawn(
    rng: np.random.Generator,
    shape: tuple[int, ...] = (),
    kinds: Sequence[tuple[int, int, int]] = _KINDS,
) -> Given:
    lower = place(rng, shape)
    upper = np.round(lower + rng.uniform(0.3, 2.0, (*shape, 3)), 2)
    count = int(np.prod(shape))
    kind = np.array([kinds[k % len(kinds)] for k in range(count)]).reshape(*shape, 3)
    return _pair(lower, upper, *_lying(rng, lower, upper, kind))


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    one = np.array([[-1.0, 1, 1], [3.0, 2, 3]])
    return [
        Case("a corner in a corner", _pair([0.0, 0, 0], [2.0, 2, 2], [1.0, 1, 1], [3.0, 3, 3])),
        Case("apart along z only", _pair([0.0, 0, 0], [2.0, 2, 2], [1.0, 1, 2.5], [3.0, 3, 4])),
        Case("drawn, B above on x", _drawn(rng, (), [(0, 2, 3)])),
        Case("drawn, B below on y", _drawn(rng, (), [(4, 1, 2)])),
        Case("drawn, they overlap", _drawn(rng, (), [(2, 3, 2)])),
        Case("faces touch", _pair([0.0, 0, 0], [2.0, 2, 2], [2.0, 0.5, 1], [3.0, 1, 5]), "edge"),
        Case("faces touch, B below", _pair([0.0, 0, 0], [2.0, 2, 2], [0.5, -3, 1], [3.0, 0, 5]), "edge"),
        Case("corners touch", _pair([0.0, 0, 0], [2.0, 2, 2], [-1.0, 2, -4], [0.0, 3, 0]), "edge"),
        Case("they cross, no corner of one in the other", _pair([0.0, 0, 0], [2.0, 3, 4], *one), "edge"),
        Case("one lies in the other", _drawn(rng, (), [(4, 4, 4)]), "edge"),
        Case("one lies around the other", _drawn(rng, (), [(5, 5, 5)]), "edge"),
        Case("three pairs", _drawn(rng, (3,)), "batch"),
        Case("32 pairs", _drawn(rng, (32,)), "batch"),
        Case("a 2 by 16 batch", _drawn(rng, (2, 16)), "batch"),
    ]  # fmt: skip


def _wrong(name: str, message: str, *edits: str) -> Mistake:
    return Mistake(name, slip(formulas.boxes_overlap, *edits), message)


BOXES_OVERLAP = Exercise(
    name="boxes_overlap",
    rows=(4, 11),
    points=2,
    minutes=6,
    task="Return whether two upright boxes overlap; touching counts.",
    arguments=_ARGUMENTS,
    results=(Value("overlap", "(...)", "", "True where they overlap", dtype="bool"),),
    reference=formulas.boxes_overlap,
    cases=_cases,
    mistakes=(
        _wrong(
            "one axis is enough",
            "You say that they overlap as soon as their intervals do on *one* axis. A common point needs all three.",
            "np.all",
            "np.any",
        ),
        _wrong(
            "A below B only",
            "You only ask whether A begins before B ends. It does so too where A lies wholly below B: there is a "
            "second condition.",
            f"{_FIRST} & {_SECOND}",
            _FIRST,
        ),
        _wrong(
            "B below A only",
            "You only ask whether B begins before A ends. It does so too where B lies wholly below A: there is a "
            "second condition.",
            f"{_FIRST} & {_SECOND}",
            _SECOND,
        ),
        _wrong(
            "corner of B in A",
            "You ask whether the lowest corner of B lies in A. Boxes can cross like a plus sign, and no corner of "
            "either lies in the other.",
            _FIRST,
            "(lower_a <= lower_b)",
        ),
        _wrong(
            "corner of A in B",
            "You ask whether the lowest corner of A lies in B. Boxes can cross like a plus sign, and no corner of "
            "either lies in the other.",
            _SECOND,
            "(lower_b <= lower_a)",
        ),
        _wrong(
            "any corner of B in A",
            "You ask whether a corner of B lies in A: on each axis, whether an end of B's interval lies in A's. B's "
            "may reach beyond A's on both sides, with neither end in it.",
            f"{_FIRST} & {_SECOND}",
            _END_OF_B,
        ),
        _wrong(
            "any corner of A in B",
            "You ask whether a corner of A lies in B: on each axis, whether an end of A's interval lies in B's. A's "
            "may reach beyond B's on both sides, with neither end in it.",
            f"{_FIRST} & {_SECOND}",
            _END_OF_A,
        ),
        _wrong(
            "a corner of either in the other",
            "You ask whether a corner of one lies in the other. Two planks that cross like a plus sign have a common "
            "point without: ask each axis by itself.",
            f"np.all({_FIRST} & {_SECOND}, axis=-1)",
            f"np.all({_END_OF_B}, axis=-1) | np.all({_END_OF_A}, axis=-1)",
        ),
        _wrong(
            "lowest corner of either in the other",
            "You ask whether the lowest corner of one box lies in the other. On x A may begin first and on y B, and "
            "then neither does: ask each axis by itself.",
            f"np.all({_FIRST} & {_SECOND}, axis=-1)",
            "np.all((lower_a <= lower_b) & (lower_b <= upper_a), axis=-1) | "
            "np.all((lower_b <= lower_a) & (lower_a <= upper_b), axis=-1)",
        ),
        _wrong(
            "B wholly in A",
            "You ask whether B lies wholly inside A. A common point is enough.",
            f"{_FIRST} & {_SECOND}",
            "(lower_a <= lower_b) & (upper_b <= upper_a)",
        ),
        _wrong(
            "touching left out",
            "Right but for boxes that touch. Shapes are closed: equality counts, on both ends.",
            f"{_FIRST} & {_SECOND}",
            "(lower_a < upper_b) & (lower_b < upper_a)",
        ),
        _wrong(
            "one touching end left out",
            "Right, but touching counts at one end of the intervals and not at the other.",
            _SECOND,
            "(lower_b < upper_a)",
        ),
        _wrong(
            "the other way round",
            "Your answer is reversed: it is True for pairs that are apart.",
            "np.all(",
            "~np.all(",
        ),
        _wrong(
            "either condition",
            "Each of the two conditions alone lets boxes through that are apart. Both must hold: &, not |.",
            " & ",
            " | ",
        ),
        _wrong(
            "both comparisons turned",
            "Both comparisons are turned: no two boxes fulfil both >=. Each one begins before the other ends: <=.",
            f"{_FIRST} & {_SECOND}",
            "(lower_a >= upper_b) & (lower_b >= upper_a)",
        ),
        _wrong(
            "and",
            "`and`, `if` and a <= b <= c want one True or False, and you have one for each axis. & joins two arrays "
            "of verdicts place by place: (... <= ...) & (... <= ...).",
            " & ",
            " and ",
        ),
        _wrong(
            "a verdict for each axis",
            "You give three verdicts a pair, one for each axis. The boxes overlap where all three are true: "
            "np.all(..., axis=-1).",
            f"np.all({_FIRST} & {_SECOND}, axis=-1)",
            f"{_FIRST} & {_SECOND}",
        ),
        _wrong(
            "one verdict for the batch",
            "Right for one pair. For a batch you give a single verdict for all: np.all(..., axis=-1).",
            ", axis=-1)",
            ")",
        ),
    ),
    hints=(
        "Draw two intervals on a line. When are they apart? There are two ways.",
        "On one axis they are apart where one begins after the other has ended. They overlap where neither is so. "
        "All three axes must agree: np.all over the last one.",
        "return np.all((lower_a <= ____) & (____ <= upper_a), axis=____)",
    ),
)
