"""The exercise ``capsule_gap``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_04_overlap_tests.shared import (
    Given,
    length,
    point,
    radius,
    segment,
)
from course.exercises.definitions.vectors import unit_vector
from course.exercises.slips import slip

_ARGUMENTS = (
    point("start_a", "one end of A's segment"),
    point("end_a", "the other end"),
    length("radius_a", "radius of A"),
    point("start_b", "one end of B's segment"),
    point("end_b", "the other end"),
    length("radius_b", "radius of B"),
)
_S, _T = "np.clip(s, 0.0, 1.0)", "np.clip(t, 0.0, 1.0)"
_FEET = f"[{_S} * u - w - {_T} * v]"
_ENDS_OF_A = "between += [p - closest_point_on_segment(p, *ends_b) for p in ends_a]"
_ENDS_OF_B = "between += [p - closest_point_on_segment(p, *ends_a) for p in ends_b]"
#: Where the nearest points lie, as shares of both ways: inside both, ends of A, of B, of both.
_FEET_AT = (
    (None, None), (0.0, None), (None, 1.0), (1.0, 0.0), (None, None), (1.0, None), (None, 0.0), (0.0, 1.0),
)  # fmt: skip


def _given(*values: object) -> Given:
    return {
        v.name: np.asarray(x, float) for v, x in zip(_ARGUMENTS, values, strict=True)
    }


def _one(rng: np.random.Generator, kind: int) -> list[np.ndarray]:
    """Two capsules whose nearest points lie where the kind says."""
    start, end = segment(rng)
    u = end - start
    s, t = _FEET_AT[kind % len(_FEET_AT)]
    r, big = radius(rng), radius(rng)
    distance = r + big + (0.3 if kind % 2 else -0.15) * min(1.0, float(r + big))
    across = np.cross(u, unit_vector(rng))
    across /= np.linalg.norm(across)
    along = u / np.linalg.norm(u)
    if s is not None:  # beyond an end of A: aslant
        across = across + (2 * s - 1) * rng.uniform(0.3, 1.0) * along
        across /= np.linalg.norm(across)
    foot = start + (rng.uniform(0.2, 0.8) if s is None else s) * u
    there = foot + distance * across
    # B's way is across what is between, or leads away from it where an end is nearest.
    v = np.cross(across, unit_vector(rng))
    v *= rng.uniform(0.8, 2.5) / np.linalg.norm(v)
    share = rng.uniform(0.2, 0.8) if t is None else t
    if t is not None:
        v += (1 - 2 * t) * rng.uniform(0.2, 0.8) * across
    return [start, end, r, there - share * v, there + (1 - share) * v, big]


def _drawn(
    rng: np.random.Generator, shape: tuple[int, ...] = (), turn: int = 0
) -> Given:
    count = int(np.prod(shape))
    pairs = [_one(rng, k + turn) for k in range(count)]
    stacked = (np.array(x) for x in zip(*pairs, strict=True))
    return _given(*(x.reshape((*shape, *x.shape[1:])) for x in stacked))


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    a, b = np.array([1.0, 1, 1]), np.array([5.0, 1, 1])
    return [
        Case("crossed like swords", _given(a, b, 0.5, [3.0, -1, 4], [3.0, 3, 4], 1.0)),
        Case("end to end", _given(a, b, 0.5, [8.0, 5, 1], [9.0, 9, 1], 1.0)),
        *(Case(f"drawn, {k + 1}", _drawn(rng, (), k)) for k in range(4)),
        Case("parallel, side by side", _given(a, b, 0.5, [2.0, 4, 5], [9.0, 4, 5], 1.0), "edge"),
        Case("on one line", _given(a, b, 0.5, [9.0, 1, 1], [7.0, 1, 1], 0.25), "edge"),
        Case("segments that cross", _given(a, b, 0.5, [2.0, 0, 1], [2.0, 4, 1], 0.75), "edge"),
        Case("B is a sphere", _given(a, b, 0.5, [3.0, 4, 5], [3.0, 4, 5], 1.0), "edge"),
        Case("A is a sphere", _given(a, a, 0.5, [4.0, 4, 0], [4.0, 8, 0], 1.0), "edge"),
        Case("three pairs", _drawn(rng, (3,)), "batch"),
        Case("sixteen pairs", _drawn(rng, (16,)), "batch"),
        Case("a 2 by 8 batch", _drawn(rng, (2, 8)), "batch"),
    ]  # fmt: skip


def _wrong(name: str, message: str, *edits: str) -> Mistake:
    return Mistake(name, slip(formulas.capsule_gap, *edits), message)


CAPSULE_GAP = Exercise(
    name="capsule_gap",
    rows=(3,),
    points=4,
    minutes=14,
    level="stretch",
    task="Return the gap of two capsules: above 0 apart, 0 touching, below 0 overlapping.",
    arguments=_ARGUMENTS,
    results=(Value("gap", "(...)", "m", "signed gap", relative=1e-8),),
    reference=formulas.capsule_gap,
    cases=_cases,
    mistakes=(
        _wrong(
            "ends only",
            "You try the four ends only. Two capsules that cross like swords are nearest between their ends.",
            f"between = {_FEET}",
            "between = []",
        ),
        _wrong(
            "feet only",
            "You limit both shares, each by itself, and stop there. Where one foot is moved to an end, the nearest "
            "point of the other segment moves as well: try the ends, each with its nearest point.",
            f"{_ENDS_OF_A}\n    {_ENDS_OF_B}",
            "pass",
        ),
        _wrong(
            "not limited",
            "Your feet may lie beyond the ends: that is the distance of two endless lines.",
            _FEET,
            "[s * u - w - t * v]",
        ),
        _wrong(
            "ends of B left out",
            "You try the ends of A, but not those of B.",
            _ENDS_OF_B,
            "pass",
        ),
        _wrong(
            "ends of A left out",
            "You try the ends of B, but not those of A.",
            _ENDS_OF_A,
            "pass",
        ),
        _wrong(
            "radius of A left out",
            "The radius of A is missing: a capsule reaches beyond its segment.",
            " - radius_a",
            "",
        ),
        _wrong(
            "radius of B left out",
            "The radius of B is missing: a capsule reaches beyond its segment.",
            " - radius_b",
            "",
        ),
        _wrong(
            "the largest",
            "You take the largest of the distances that you tried. Nearest is the least.",
            "np.min(",
            "np.max(",
        ),
        _wrong(
            "0 where they overlap",
            "Right where they are apart. Where they overlap the gap is below 0, and says how deep.",
            "return distance - radius_a - radius_b",
            "return np.maximum(distance - radius_a - radius_b, 0.0)",
        ),
    ),
    hints=(
        "Either the nearest points lie between the ends of both segments: then what is between them stands at right "
        "angles to both. Or one of them is an end: then you know how to find the other.",
        "Five candidates: the feet s and t, limited to between 0 and 1, and each of the four ends with its nearest "
        "point of the other segment. The least distance, less both radii. For parallel segments n is 0: divide by "
        "np.inf.",
        "ends_a, ends_b = (start_a, end_a), (start_b, end_b)\n"
        "u, v, w = end_a - start_a, end_b - start_b, start_b - start_a\n"
        "n = np.cross(u, v)\n"
        "square = np.sum(n * n, axis=-1, keepdims=True)\n"
        "square = np.where(square == 0, np.inf, square)\n"
        "s = np.sum(np.cross(w, v) * n, axis=-1, keepdims=True) / square\n"
        "t = np.sum(np.cross(w, ____) * n, axis=-1, keepdims=True) / square\n"
        "between = [np.clip(s, 0.0, 1.0) * u - w - ____]\n"
        "between += [p - closest_point_on_segment(p, *____) for p in ends_a]\n"
        "between += [p - closest_point_on_segment(p, *ends_a) for p in ____]\n"
        "distance = np.min([np.linalg.norm(x, axis=-1) for x in between], axis=0)\n"
        "return distance - radius_a - radius_b",
    ),
)
