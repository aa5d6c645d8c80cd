"""The exercise ``swept_boxes_time``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_06_moving_objects.shared import (
    HORIZON,
    KINDS,
    TIME,
)
from course.exercises.slips import slip

_ARGUMENTS = (
    Value("lower_a", "(..., 3)", "m", "lower corner of A at the start"),
    Value("upper_a", "(..., 3)", "m", "its upper corner"),
    Value("velocity_a", "(..., 3)", "m/s", "its velocity, which does not change"),
    Value("lower_b", "(..., 3)", "m", "lower corner of B at the start"),
    Value("upper_b", "(..., 3)", "m", "its upper corner"),
    Value("velocity_b", "(..., 3)", "m/s", "its velocity"),
    HORIZON,
)


def _pair(*values: Any) -> dict[str, Any]:
    return {
        v.name: np.asarray(x, float) for v, x in zip(_ARGUMENTS, values, strict=True)
    }


def _cubes(
    center: Any, velocity: Any, carried: Any = (0.0, 0.0, 0.0)
) -> dict[str, Any]:
    """A cube of 2 m about a centre against one of 4 m about 0; all numbers exact."""
    c, v, w = (np.array(x, float) for x in (center, velocity, carried))
    return _pair(c - 1, c + 1, v, np.full(3, -2.0), np.full(3, 2.0), w, 9.0)


def _offsets(
    rng: np.random.Generator, kinds: Sequence[str]
) -> tuple[Array, Array, Array]:
    """Offset and velocity of A from B in units of the reach along each axis, and the horizon.

    It comes from outside on one, two or three axes to a place within B's reach; "pass"
    ends at 1.2 to 2 of it on one axis, on which it does not move enough; "corner" passes
    an edge of B.
    """
    k, kind = len(kinds), np.array(kinds)
    target = rng.uniform(-0.8, 0.8, (k, 3))
    way = rng.choice([-1.0, 1.0], (k, 3)) * rng.uniform(1.0, 3.0, (k, 3))
    out = np.where(kind == "overlap", 0.0, rng.uniform(1.1, 1.5, k))
    offset = target - out[:, None] * way
    turned = np.where(np.isin(kind, ("part",)), -1.0, 1.0)[:, None]
    passing = kind == "pass"
    axis = rng.integers(0, 3, k)
    offset[passing, axis[passing]] = rng.uniform(1.2, 2.0, passing.sum())
    way[passing, axis[passing]] = rng.uniform(0.05, 0.1, passing.sum())
    # "corner" comes within reach along one axis only after it has left another.
    corner = kind == "corner"
    late = 1.2 * (1 / np.abs(way[:, 0]) + 1 / np.abs(way[:, 1]))
    middle = 2 + late[:, None] * [0.0, 1.0, 0.5]
    offset[corner] = -(way * middle)[corner]
    outside = np.abs(offset).max(axis=-1)
    # "part" must not be within reach, nor come there: away from the outermost axis.
    parting = kind == "part"
    offset[parting] *= (2.0 / outside[parting])[:, None]
    horizon = np.where(kind == "late", 0.05, np.where(corner, 9.0, 2.0))
    return offset, turned * way, horizon


def _drawn(
    rng: np.random.Generator, kinds: Sequence[str], shape: tuple[int, ...]
) -> dict[str, Any]:
    """Boxes of unequal sides, both moving, away from the origin."""
    k = len(kinds)
    offset, velocity, horizon = _offsets(rng, kinds)
    half = rng.uniform(0.3, 1.5, (2, k, 3))
    reach = half.sum(axis=0)
    center, carried = rng.uniform(-4.0, 4.0, (k, 3)), rng.uniform(-2.0, 2.0, (k, 3))
    a, v = center + reach * offset, carried + reach * velocity
    pair = _pair(
        a - half[0],
        a + half[0],
        v,
        center - half[1],
        center + half[1],
        carried,
        horizon,
    )
    return {name: x.reshape((*shape, *x.shape[1:])) for name, x in pair.items()}


def _stacked(*pairs: dict[str, Any]) -> dict[str, Any]:
    return {name: np.stack([pair[name] for pair in pairs]) for name in pairs[0]}


def _in_turn(count: int) -> list[str]:
    kinds = (*KINDS, "corner")
    return [kinds[k % len(kinds)] for k in range(count)]


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    zero, one = np.zeros(3), lambda kind: _drawn(rng, [kind], ())
    return [
        Case("half extents of 1 m, centres 10 m apart, 2 m/s", _pair(
            -np.ones(3), np.ones(3), [2.0, 0, 0], [9.0, -1, -1], [11.0, 1, 1], zero, 9.0)),
        Case("both move, and they meet", one("meet")),
        Case("they pass each other", one("pass")),
        Case("they pass each other at an edge", one("corner")),
        Case("they pass at an edge, along z nothing moves", _cubes([-7.0, -14, 0], [2.0, 2, 0])),
        Case("they part", one("part")),
        Case("they would meet after the horizon", one("late")),
        Case("they overlap at the start, and part", one("overlap")),
        Case("overlapping, both at rest", _cubes([1.0, 0, 0], zero), "edge"),
        Case("apart on an axis on which nothing moves", _cubes([-8.0, 4, 0], [2.0, 0, 0]), "edge"),
        Case("the same on the other side", _cubes([8.0, 0, -4], [-2.0, 1, 0]), "edge"),
        Case("they graze", _cubes([-7.0, 3, 0], [2.0, 0, 0]), "edge"),
        Case("they graze on the other side", _cubes([-7.0, -3, 0], [2.0, 0, 0]), "edge"),
        Case("they graze soon", _cubes([-3.5, 3, 0], [2.0, 0, 0]), "edge"),
        Case("they pass at 25 cm", _cubes([-7.0, -3.25, 0], [2.0, 0, 0]), "edge"),
        Case("they graze, carried along together across", _cubes([-7.0, 3, 0], [2.0, 1, 0], [0.0, 1, 0]), "edge"),
        Case("A rests, and B comes", _cubes([-7.0, 1, 0], zero, [-2.0, 0, 0])),
        Case("they graze in one moment", _cubes([-7.0, 7, 0], [2.0, -1, 0], [0.0, 1, 0]), "edge"),
        Case("they graze at a corner", _cubes([-7.0, -1, 0], [2.0, 2, 0]), "edge"),
        Case("touching, and approaching", _cubes([-3.0, 1, 0], [2.0, 0, 0]), "edge"),
        Case("touching, and parting", _cubes([-3.0, 1, 0], [-2.0, 0, 0]), "edge"),
        Case("touching, and sliding", _cubes([-3.0, 1, 0], [0.0, 2, 0]), "edge"),
        Case("touching at the upper side, and sliding", _cubes([1.0, 3, 0], [1.0, 0, 2]), "edge"),
        Case("touching at an edge, approaching along x, parting along y", _cubes([-3.0, 3, 0], [2.0, 1, 0]), "edge"),
        Case("touching at an edge, approaching along x, sliding along y", _cubes([-3.0, 3, 0], [2.0, 0, 0]), "edge"),
        Case("apart, and carried along together", _cubes([-5.0, 0, 0], [2.0, 1, 0], [2.0, 1, 0]), "edge"),
        Case("just at the horizon", _cubes([-21.0, 0, 0], [2.0, 0, 0]), "edge"),
        Case("one slides, one overlaps, one grazes", _stacked(
            _cubes([-3.0, 1, 0], [0.0, 2, 0]), _cubes([1.0, 0, 0], zero), _cubes([-7.0, 3, 0], [2.0, 0, 0])), "batch"),
        Case("three pairs", _drawn(rng, ("meet", "pass", "overlap"), (3,)), "batch"),
        Case("30 pairs", _drawn(rng, _in_turn(30), (30,)), "batch"),
        Case("a 2 by 5 batch", _drawn(rng, _in_turn(10), (2, 5)), "batch"),
    ]  # fmt: skip


def _wrong(name: str, *edits: str, message: str) -> Mistake:
    return Mistake(name, slip(formulas.swept_boxes_time, *edits), message)


SWEPT_BOXES_TIME = Exercise(
    name="swept_boxes_time",
    rows=(12,),
    points=3,
    minutes=9,
    task="Return when two moving axis-aligned boxes first touch: 0 where they overlap, or touch and approach; "
    "inf where "
    "they never do within the horizon.",
    arguments=_ARGUMENTS,
    results=(TIME,),
    reference=formulas.swept_boxes_time,
    cases=_cases,
    mistakes=(
        _wrong(
            "velocity of A alone",
            "velocity_a - velocity_b",
            "velocity_a + 0 * velocity_b",
            message="B moves as well. What counts is how A moves as seen from B: v_A - v_B.",
        ),
        _wrong(
            "seen from the other side",
            "velocity_a - velocity_b",
            "velocity_b - velocity_a",
            message="The sign of v is turned round: A's velocity as seen from B is v_A - v_B.",
        ),
        _wrong(
            "the first axis",
            "np.max(enter, axis=-1)",
            "np.min(enter, axis=-1)",
            message="You take the *earliest* axis. On that axis the shadows overlap, on another they may still be "
            "apart: boxes meet when the last axis comes in.",
        ),
        _wrong(
            "the last to leave",
            "np.min(leave, axis=-1)",
            "np.max(leave, axis=-1)",
            message="As soon as *one* axis has been left they are apart again: the end is the earliest of the three, "
            "not the latest.",
        ),
        _wrong(
            "the first axis, and the last to leave",
            "np.max(enter, axis=-1), np.min(leave, axis=-1)",
            "np.min(enter, axis=-1), np.max(leave, axis=-1)",
            message="np.max and np.min changed places. Boxes meet when the *last* axis comes in, and are apart again "
            "as soon as the *first* is left.",
        ),
        _wrong(
            "neither sorted",
            "np.minimum(one, other), np.maximum(one, other)",
            "one, other",
            message="Which of the two times of an axis is the entry depends on the sign of v there: the smaller one "
            "is, the larger is the end. You take them as they come, which is wrong where v < 0.",
        ),
        _wrong(
            "a tiny speed",
            "v = velocity_a - velocity_b",
            "v = np.where(velocity_a == velocity_b, 1e-12, velocity_a - velocity_b)",
            message="On an axis on which nothing moves you let something move slowly. Shadows that touch there then "
            "seem to approach or to part; that axis has to be asked by itself.",
        ),
        _wrong(
            "entries not sorted",
            "np.minimum(one, other)",
            "one",
            message="Which of the two times is the entry depends on the sign of v on that axis: the smaller one. You "
            "take (l_B - u_A)/v always, which is wrong where v < 0.",
        ),
        _wrong(
            "ends not sorted",
            "np.maximum(one, other)",
            "other",
            message="Which of the two times is the end depends on the sign of v on that axis: the larger one.",
        ),
        _wrong(
            "not compared",
            "(first <= last) & (last > 0)",
            "(last > 0)",
            message="You do not ask whether all axes overlap at the *same* time: where the last entry comes after the "
            "first end, the boxes pass each other.",
        ),
        _wrong(
            "grazing left out",
            "first <= last",
            "first < last",
            message="Where the last entry is also the first end they touch in one moment: they graze, and closed boxes "
            "that touch meet.",
        ),
        _wrong(
            "those that part",
            "(first <= last) & (last > 0)",
            "(first <= last)",
            message="Where the end lies in the past, last <= 0, they have met before the start and are parting.",
        ),
        _wrong(
            "those that part, at times before the start",
            "(first <= last) & (last > 0)",
            "(first <= last)",
            "np.maximum(first, 0)",
            "first",
            message="You let boxes meet before the start. Where last <= 0 they are parting: inf. Where they overlap at "
            "the start, first < 0, the answer is 0.",
        ),
        _wrong(
            "those that part and those that slide",
            "(first <= last) & (last > 0)",
            "(first <= last)",
            " & ~slides",
            "",
            message="Where the first end is not after the start, last <= 0, they are parting: inf. So it is where they "
            "touch and slide along: use slides.",
        ),
        _wrong(
            "the last entry alone",
            "(first <= last) & (last > 0)",
            "(first <= np.inf)",
            message="You take the last entry and ask nothing of the ends. An axis that has been left before that, or "
            "before the start, keeps them apart: inf.",
        ),
        _wrong(
            "the last entry alone, and those that slide",
            "(first <= last) & (last > 0)",
            "(first <= np.inf)",
            " & ~slides",
            "",
            message="You take the last entry and ask nothing of the ends. An axis that has been left before that, or "
            "before the start, keeps them apart: inf. So does an axis on which they slide.",
        ),
        _wrong(
            "not compared, and those that slide",
            "(first <= last) & (last > 0)",
            "(last > 0)",
            " & ~slides",
            "",
            message="The last entry must not come after the first end, or the boxes pass each other. Besides, those "
            "that touch and slide along never meet.",
        ),
        _wrong(
            "sliding from the start on",
            "rubs & np.all(between, axis=-1)",
            "rubs & np.all(enter < 0, axis=-1)",
            message="Those whose last entry is just at the start, first = 0, touch already. Where their shadows rub "
            "on an axis besides, they slide: inf.",
        ),
        _wrong(
            "asked at the start",
            "(first <= last) & (last > 0)",
            "(first <= last) & (first >= 0)",
            message="Boxes that overlap at the start have their last entry in the past, and their answer is 0. Those "
            "that have parted already are told by the first end: it is not after the start.",
        ),
        _wrong(
            "touching and parting",
            "last > 0",
            "last >= 0",
            message="Right but for those that touch at the start and part: their end is 0, and the answer inf.",
        ),
        _wrong(
            "sliding",
            " & ~slides",
            "",
            message="Right but for those that touch at the start and slide along: on an axis on which nothing moves, "
            "their shadows touch and go on touching. That is inf.",
        ),
        _wrong(
            "sliding and grazing",
            "rubs & np.all(between, axis=-1)",
            "rubs",
            message="Those that slide along while they touch do not meet. But boxes that come from farther away at a "
            "gap of 0 on an axis on which nothing moves graze, and meet.",
        ),
        _wrong(
            "below 0",
            "np.maximum(first, 0)",
            "first",
            message="For boxes that overlap at the start you return the time at which they began to, below 0 or -inf. "
            "Asked is 0.",
        ),
        _wrong(
            "axis at rest always inside",
            "np.where(between, -np.inf, np.inf)",
            "-np.inf",
            message="On an axis on which nothing moves the shadows overlap always, or never. You take them to overlap "
            "always, and boxes that pass beside each other meet.",
        ),
        _wrong(
            "axis at rest never inside",
            "np.where(between, -np.inf, np.inf)",
            "np.inf",
            message="On an axis on which nothing moves the shadows overlap never, or always. You take them never to, "
            "and a box that flies along x can meet nothing.",
        ),
        _wrong(
            "horizon forgotten",
            " & (first <= horizon)",
            "",
            message="Some of these meet only after the horizon: for them the answer is inf.",
        ),
        _wrong(
            "horizon itself left out",
            "first <= horizon",
            "first < horizon",
            message="Those that meet just at the horizon do meet: first <= horizon.",
        ),
        _wrong(
            "one verdict for the batch",
            "np.max(enter, axis=-1)",
            "np.max(enter)",
            message="Right for one pair, not for a batch: np.max without axis=-1 takes the latest entry of all pairs.",
        ),
        _wrong(
            "one verdict for the batch, at both ends",
            "np.max(enter, axis=-1), np.min(leave, axis=-1)",
            "np.max(enter), np.min(leave)",
            message="Right for one pair, not for a batch: without axis=-1 the latest entry and the earliest end are "
            "those of all pairs together.",
        ),
    ),  # fmt: skip
    hints=(
        "Axis by axis: between which two times do the shadows overlap? Then all three at once: from the last entry to "
        "the first end.",
        "first is the last of the three entries, last the first of the three ends. They meet if first is not after "
        "last, last is after the start, first is within the horizon, and they do not slide. Then the time is first, or "
        "0 where that is in the past.",
        "first, last = np.max(enter, axis=-1), ____\n"
        "meets = (first <= ____) & (____ > 0) & (first <= horizon) & ~slides\n"
        "return np.where(meets, np.maximum(first, ____), np.inf)",
    ),
)
