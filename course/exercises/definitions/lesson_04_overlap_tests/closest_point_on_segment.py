"""The exercise ``closest_point_on_segment``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_04_overlap_tests.shared import (
    Given,
    beside,
    place,
    point,
    segment,
)
from course.exercises.slips import slip

_CLAMPED = "np.clip(share, 0.0, 1.0)"
_SAFE = "np.where(square == 0, 1.0, square)"
#: Edits that are often made by who has not yet thought of a segment that is only a point, with what is said of them.
_UNGUARDED = (
    ("not limited", "You go on along the line before the start and beyond the end.", _CLAMPED, "share"),
    ("limited at the start only", "Beyond the end you go on along the line.", _CLAMPED, "np.maximum(share, 0.0)"),
    ("limited at the end only", "Before the start you go on along the line.", _CLAMPED, "np.minimum(share, 1.0)"),
    ("point from the origin", "You take the dot product of the point as seen from the *origin*. Both have to be seen "
     "from the start.", "(point - start)", "point"),
    ("divided by the length", "You divide the dot product by the length of the segment, so your share is in metres. "
     "It has to be divided by the square of the length.", _SAFE, "np.sqrt(square)"),
    ("seen from the start", "You return the way from the start to the nearest point. Asked is the place: add the "
     "start.", "return start + ", "return "),
)  # fmt: skip


def _given(p: Any, a: Any, b: Any) -> Given:
    return {
        "point": np.asarray(p, float),
        "start": np.asarray(a, float),
        "end": np.asarray(b, float),
    }


def _drawn(
    rng: np.random.Generator, shape: tuple[int, ...] = (), turn: int = 0
) -> Given:
    """Points beside, beyond and before segments, in turn."""
    count = int(np.prod(shape)) + turn
    start, end = segment(rng, (count,))
    p = beside(rng, start, end, rng.uniform(0.3, 2.0, count))
    return _given(*(x[turn:].reshape(*shape, 3) for x in (p, start, end)))


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    a, b = np.array([1.0, 1, 0]), np.array([5.0, 4, 0])
    start, end = segment(rng, (4,))
    end[1], end[3] = start[1], start[3]
    return [
        Case("beside the middle", _given([1.0, 4, 2], [1.0, 1, 0], [4.0, 1, 3])),
        Case("beside it, drawn", _drawn(rng)),
        Case("beyond the end, drawn", _drawn(rng, turn=1)),
        Case("before the start, drawn", _drawn(rng, turn=2)),
        Case("on the segment", _given(a + 0.25 * (b - a), a, b), "edge"),
        Case("on its line, beyond it", _given(a + 1.5 * (b - a), a, b), "edge"),
        Case("far before its start", _given([-9.0, -5, 3], a, b), "edge"),
        Case("at its start", _given(a, a, b), "edge"),
        Case("the segment is only a point", _given(place(rng), a, a), "edge"),
        Case("a segment of 0.1 mm", _given(a + [3e-5, 0, 2], a, a + [1e-4, 0, 0]), "edge"),
        Case("three of them", _drawn(rng, (3,)), "batch"),
        Case("twelve of them", _drawn(rng, (12,)), "batch"),
        Case("a 2 by 6 batch", _drawn(rng, (2, 6)), "batch"),
        Case("four, two of them only points", _given(place(rng, (4,)), start, end), "batch"),
    ]  # fmt: skip


def _off_the_segment(given: Mapping[str, Any], answer: Any) -> Array:
    """By how much the way over the answer is longer than the segment [m]."""
    ends = [
        np.linalg.norm(np.asarray(answer) - given[e], axis=-1) for e in ("start", "end")
    ]
    return np.asarray(ends[0] + ends[1] - np.linalg.norm(given["end"] - given["start"], axis=-1))  # fmt: skip


def _wrong(name: str, message: str, *edits: str) -> Mistake:
    return Mistake(name, slip(formulas.closest_point_on_segment, *edits), message)


CLOSEST_POINT_ON_SEGMENT = Exercise(
    name="closest_point_on_segment",
    rows=(3,),
    points=3,
    minutes=9,
    task="Return the point of a segment that is nearest to a point; the start where the segment is only a point.",
    arguments=(
        point("point", "from where it is looked for"),
        point("start", "one end of the segment"),
        point("end", "the other end"),
    ),
    results=(Value("nearest", "(..., 3)", "m", "the nearest point of the segment"),),
    reference=formulas.closest_point_on_segment,
    cases=_cases,
    properties=(
        Property(
            "on the segment",
            _off_the_segment,
            "Some of your points do not lie on the segment.",
            tolerance=1e-7,
        ),
    ),
    mistakes=(
        _wrong(
            "not limited",
            "Right while the foot lies on the segment. Before its start and beyond its end you go on along the line.",
            _CLAMPED,
            "share",
        ),
        _wrong(
            "limited at the start only",
            "Right before the start, but beyond the end you go on along the line.",
            _CLAMPED,
            "np.maximum(share, 0.0)",
        ),
        _wrong(
            "limited at the end only",
            "Right beyond the end, but before the start you go on along the line.",
            _CLAMPED,
            "np.minimum(share, 1.0)",
        ),
        _wrong(
            "from -1 to 1",
            "You let the share run from -1 to 1. At -1 is a place as far *before* the start as the end lies behind it.",
            _CLAMPED,
            "np.clip(share, -1.0, 1.0)",
        ),
        _wrong(
            "the nearer end",
            "You return one of the two ends. Beside the segment the nearest point lies between them.",
            _CLAMPED,
            "np.where(share < 0.5, 0.0, 1.0)",
        ),
        _wrong(
            "divided by the length",
            "You divide the dot product by the length of the segment, so your share is in metres. It has to be "
            "divided by the square of the length.",
            _SAFE,
            "np.sqrt(np.where(square == 0, 1.0, square))",
        ),
        _wrong(
            "short ones taken for points",
            "You divide by something else than the square of the length where that is small. A segment of 0.1 mm is "
            "no point: only a square of exactly 0 must be replaced.",
            _SAFE,
            "np.maximum(square, 1e-6)",
        ),
        *(
            _wrong(
                f"{added} added",
                f"You add {added} m^2 to the square of the length. That makes every share a little smaller, and with "
                "a segment of 0.1 mm it is seen. Only a square of exactly 0 must be replaced.",
                _SAFE,
                f"(square + {added})",
            )
            for added in ("1e-12", "1e-10", "1e-9", "1e-8", "1e-6")
        ),
        _wrong(
            "below a metre",
            "Where the squared length is below 1 m^2 you divide by 1. Only a square of exactly 0 must be replaced.",
            _SAFE,
            "np.where(square < 1, 1.0, square)",
        ),
        _wrong(
            "the share",
            "You return the share, a number without unit. Asked is the place: start + share * way.",
            "start + np.clip(share, 0.0, 1.0) * way",
            "np.clip(share, 0.0, 1.0)[..., 0]",
        ),
        _wrong(
            "the share, with its axis",
            "You return the share, a number without unit. The place that is asked for is start + share * way.",
            "start + np.clip(share, 0.0, 1.0) * way",
            "np.clip(share, 0.0, 1.0)",
        ),
        _wrong(
            "not divided",
            "The dot product with the way is in m^2. A share of the way has no unit: divide by the square of the "
            "length.",
            f"along / {_SAFE}",
            "along",
        ),
        _wrong(
            "point from the origin",
            "You take the dot product of the point as seen from the *origin*. Both have to be seen from the start.",
            "(point - start)",
            "point",
        ),
        _wrong(
            "both from the origin",
            "You take the dot product of two places as seen from the *origin*. Both have to be seen from the start: "
            "point - start, and end - start.",
            "(point - start) * way",
            "point * end",
        ),
        _wrong(
            "end from the origin",
            "In the dot product the end is seen from the *origin*, and the point from the start. Both have to be seen "
            "from the start: end - start.",
            "(point - start) * way",
            "(point - start) * end",
        ),
        _wrong(
            "each coordinate limited",
            "You limit x, y and z one by one, each to the ends' own. That gives a place in the upright box around the "
            "segment. One share for all three keeps it on the segment.",
            "start + np.clip(share, 0.0, 1.0) * way",
            "np.clip(point, start, end)",
        ),
        _wrong(
            "each coordinate limited, in order",
            "You limit x, y and z one by one: that is the nearest place of the upright box around the segment. One "
            "share for all three keeps it on the segment.",
            "start + np.clip(share, 0.0, 1.0) * way",
            "np.clip(point, np.minimum(start, end), np.maximum(start, end))",
        ),
        _wrong(
            "seen from the start",
            "You return the way from the start to the nearest point. Asked is the place: add the start.",
            "return start + ",
            "return ",
        ),
        _wrong(
            "from the end backward",
            "You start from the other end, but the share was measured from the start.",
            "start + np.clip(share, 0.0, 1.0) * way",
            "end - np.clip(share, 0.0, 1.0) * way",
        ),
        _wrong(
            "one share for the batch",
            "Right for one segment. In a batch you take the dot products of all of them together: sum over the last "
            "axis only.",
            "np.sum((point - start) * way, axis=-1, keepdims=True)",
            "np.sum((point - start) * way)",
        ),
        *(
            _wrong(
                f"as derived, {where}",
                "That is the share of the derivation as it stands there, with the origin at the start. Here the start "
                f"is elsewhere: see both from it, point - start and end - start. {more}",
                "(point - start) * way",
                "point * end",
                "way * way",
                "end * end",
                *edits,
            )
            for where, more, *edits in (
                ("along the way", "From the start you go along the way, as it should be."),
                ("along the end", "The place is then the start and a share of the way.",
                 "return start + ", "return ", f"{_CLAMPED} * way", f"{_CLAMPED} * end"),
                ("from the start along the end", "From the start you go along the way, not along the end.",
                 f"{_CLAMPED} * way", f"{_CLAMPED} * end"),
            )
        ),
        *(
            _wrong(
                f"{name}, not guarded",
                f"{said} And where the segment is only a point you divide 0 by 0.",
                *edits,
                *(() if _SAFE in edits else (_SAFE, "square")),
            )
            for name, said, *edits in _UNGUARDED
        ),
    ),
    hints=(
        "See everything from the start of the segment: then your step of the derivation says where on the line the "
        "foot is. What if that is before the start, or beyond the end?",
        "share = (point - start).way / way.way with way = end - start, limited to between 0 and 1; keepdims=True "
        "keeps the last axis, so that it can be multiplied with a vector. Where way.way is 0 divide by 1 instead.",
        "way = end - start\n"
        "square = np.sum(way * way, axis=-1, keepdims=True)\n"
        "along = np.sum((____) * way, axis=-1, keepdims=True)\n"
        "share = along / np.where(square == 0, 1.0, ____)\n"
        "return start + np.clip(share, ____, ____) * way",
    ),
)  # fmt: skip
