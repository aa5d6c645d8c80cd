"""The exercise ``swept_spheres_time``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_06_moving_objects.shared import (
    HORIZON,
    TIME,
    in_turn,
    moves,
)
from course.exercises.slips import slip

_ARGUMENTS = (
    Value("center_a", "(..., 3)", "m", "centre of A at the start"),
    Value("radius_a", "(...)", "m", "its radius"),
    Value("velocity_a", "(..., 3)", "m/s", "its velocity, which does not change"),
    Value("center_b", "(..., 3)", "m", "centre of B at the start"),
    Value("radius_b", "(...)", "m", "its radius"),
    Value("velocity_b", "(..., 3)", "m/s", "its velocity"),
    HORIZON,
)
_BARS = (
    "The bars make a root of what has none. Below 0 under the root the spheres pass each other: ask for inside >= 0 as "
    "well; np.maximum(inside, 0) only keeps NumPy quiet."
)
#: The first root as a difference, where a is above 0; NaN at a = 0.
_AS_DIFFERENCE = (
    "below = np.where(meets, -b + np.sqrt(np.maximum(inside_root, 0)), 1.0)",
    "root = (-b - np.sqrt(np.maximum(inside_root, 0))) / np.where(a > 0, a, np.nan)",
)
_LAST = "np.where(time <= horizon, time, np.inf)"


def _pair(*values: Any) -> dict[str, Any]:
    return {
        v.name: np.asarray(x, float) for v, x in zip(_ARGUMENTS, values, strict=True)
    }


def _drawn(
    rng: np.random.Generator, kinds: Sequence[str], shape: tuple[int, ...]
) -> dict[str, Any]:
    """Pairs of unequal radii, both moving, away from the origin."""
    k = len(kinds)
    found = moves(rng, kinds)
    reach = rng.uniform(0.5, 2.0, k)
    share = rng.uniform(0.2, 0.8, k)
    center, carried = rng.uniform(-4.0, 4.0, (k, 3)), rng.uniform(-2.0, 2.0, (k, 3))
    pair = _pair(
        center + reach[:, None] * found["offset"], share * reach, carried + reach[:, None] * found["velocity"],
        center, (1 - share) * reach, carried, found["horizon"],
    )  # fmt: skip
    return {name: x.reshape((*shape, *x.shape[1:])) for name, x in pair.items()}


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    zero, one = np.zeros(3), lambda kind: _drawn(rng, [kind], ())
    away, right, up = [2.0, 3.0, 6.0], [4.0, 6.0, 12.0], [0.0, 3.0, 0.0]
    return [
        Case("centres 10 m apart, 1 m of radii, 2 m/s", _pair(
            zero, 0.25, [2.0, 0, 0], [10.0, 0, 0], 0.75, zero, 9.0)),
        Case("both move, and they meet", one("meet")),
        Case("they pass each other", one("pass")),
        Case("they part", one("part")),
        Case("they would meet after the horizon", one("late")),
        Case("they overlap at the start, and part", one("overlap")),
        Case("they graze", _pair(zero, 1.0, [2.0, 0, 0], [6.0, 4.0, 0], 3.0, zero, 9.0), "edge"),
        Case("touching, and approaching", _pair(zero, 2.0, right, away, 5.0, zero, 9.0), "edge"),
        Case("touching, and parting", _pair(away, 2.0, right, zero, 5.0, zero, 9.0), "edge"),
        Case("touching, and sliding", _pair(zero, 1.0, up, [3.0, 0, 0], 2.0, zero, 9.0), "edge"),
        Case("touching, and carried along together", _pair(zero, 1.0, up, [3.0, 0, 0], 2.0, up, 9.0), "edge"),
        Case("apart, and carried along together", _pair(zero, 1.0, up, [7.0, 0, 0], 2.0, up, 9.0), "edge"),
        Case("slow and small", _pair(zero, 0.25, [0.5, 0, 0], [1.0, 0, 0], 0.25, zero, 9.0)),
        Case("slow and small, and parting", _pair([1.0, 0, 0], 0.25, [0.25, 0, 0], zero, 0.25, zero, 9.0)),
        Case("they pass at 25 cm", _pair(zero, 0.25, [1.0, 0, 0], [2.0, 0.75, 0], 0.25, zero, 9.0)),
        Case("they meet soon", _pair(zero, 0.5, [4.0, 0, 0], [2.0, 0, 0], 0.5, zero, 0.5)),
        Case("just at the horizon", _pair(zero, 0.5, [2.0, 0, 0], [9.0, 0, 0], 0.5, zero, 4.0), "edge"),
        Case("three pairs", _drawn(rng, ("meet", "pass", "overlap"), (3,)), "batch"),
        Case("20 pairs", _drawn(rng, in_turn(20), (20,)), "batch"),
        Case("a 2 by 5 batch", _drawn(rng, in_turn(10), (2, 5)), "batch"),
    ]  # fmt: skip


def _wrong(name: str, *edits: str, message: str) -> Mistake:
    return Mistake(name, slip(formulas.swept_spheres_time, *edits), message)


SWEPT_SPHERES_TIME = Exercise(
    name="swept_spheres_time",
    rows=(12,),
    points=3,
    minutes=14,
    task="Return when two moving spheres first touch: 0 where they overlap, or touch and approach; inf where they "
    "never do within the horizon.",
    arguments=_ARGUMENTS,
    results=(TIME,),
    reference=formulas.swept_spheres_time,
    cases=_cases,
    mistakes=(
        _wrong(
            "velocity of A alone",
            "velocity_a - velocity_b",
            "velocity_a + 0 * velocity_b",
            message="B moves as well. What counts is how A moves as seen from B: v_A - v_B.",
        ),
        _wrong(
            "velocities added",
            "velocity_a - velocity_b",
            "velocity_a + velocity_b",
            message="As seen from B, A moves by the *difference* of the velocities.",
        ),
        _wrong(
            "seen from the other side",
            "velocity_a - velocity_b",
            "velocity_b - velocity_a",
            message="m runs from B to A, so v must be A's velocity as seen from B, v_A - v_B. You turned one of the "
            "two round, and those that part seem to meet.",
        ),
        _wrong(
            "one radius",
            "radius_a + radius_b",
            "radius_a + 0 * radius_b",
            message="They touch when the centres are r_A + r_B apart. You take A's radius alone.",
        ),
        _wrong(
            "the other radius",
            "radius_a + radius_b",
            "radius_b + 0 * radius_a",
            message="They touch when the centres are r_A + r_B apart. You take B's radius alone.",
        ),
        _wrong(
            "radius not squared",
            "- r**2",
            "- r",
            message="c is m.m - r^2: a square of metres minus a square of metres. Your r is not squared.",
        ),
        _wrong(
            "the later root, and nothing asked",
            "time = np.where(c < 0, 0.0, np.where(meets, c / below, np.inf))",
            "time = (-b + np.sqrt(inside_root)) / a",
            message="You return the later root, at which they part again on the far side. And you ask neither "
            "whether they overlap at the start, nor whether they approach and meet at all.",
        ),
        _wrong(
            "the later root",
            "-b + np.sqrt",
            "-b - np.sqrt",
            message="You return the later root, at which they part again on the far side.",
        ),
        _wrong(
            "those that part",
            "(b < 0) & (inside_root >= 0)",
            "(b != 0) & (inside_root >= 0)",
            message="Of spheres that part, both roots lie in the past. They meet only if they approach: b < 0.",
        ),
        _wrong(
            "those that part, as the first root",
            "(b < 0) & (inside_root >= 0)",
            "inside_root >= 0",
            *_AS_DIFFERENCE,
            "c / below",
            "root",
            message="You do not ask whether they approach: b < 0. Of spheres that part, both roots lie in the past; "
            "those that slide along have t = 0 and never meet.",
        ),
        _wrong(
            "those that part, as the first root, guarded at rest",
            "(b < 0) & (inside_root >= 0)",
            "inside_root >= 0",
            _AS_DIFFERENCE[0],
            _AS_DIFFERENCE[1].replace("np.nan", "1.0"),
            "c / below",
            "root",
            message="You do not ask whether they approach: b < 0. Of spheres that part, both roots lie in the past; "
            "those that slide along, or are carried along together, have t = 0 and never meet.",
        ),
        _wrong(
            "a time above 0",
            "(b < 0) & (inside_root >= 0)",
            "inside_root >= 0",
            *_AS_DIFFERENCE,
            "np.where(meets, c / below, np.inf)",
            "np.where(meets & (root > 0), root, np.inf)",
            message="Those that touch and approach meet at t = 0, which t > 0 leaves out. Whether they approach says "
            "b < 0.",
        ),
        _wrong(
            "those that pass",
            "(b < 0) & (inside_root >= 0)",
            "b < 0",
            message="Below 0 under the root there is no root: the spheres pass each other. You let them meet at the "
            "nearest approach.",
        ),
        _wrong(
            "the sign under the root taken off",
            "(b < 0) & (inside_root >= 0)",
            "b < 0",
            "np.maximum(inside_root, 0)",
            "np.abs(inside_root)",
            message=_BARS,
        ),
        _wrong(
            "the sign under the root taken off, as the first root",
            "(b < 0) & (inside_root >= 0)",
            "b < 0",
            "below = np.where(meets, -b + np.sqrt(np.maximum(inside_root, 0)), 1.0)",
            "root = (-b - np.sqrt(np.abs(inside_root))) / np.where(a > 0, a, 1.0)",
            "c / below",
            "root",
            message=f"{_BARS} The time that you give them is that of no touch.",
        ),
        _wrong(
            "a time that is not below 0",
            "(b < 0) & (inside_root >= 0)",
            "(a > 0) & (inside_root >= 0)",
            "below = np.where(meets, -b + np.sqrt(np.maximum(inside_root, 0)), 1.0)",
            "root = (-b - np.sqrt(np.maximum(inside_root, 0))) / np.where(a > 0, a, 1.0)",
            "np.where(meets, c / below, np.inf)",
            "np.where(meets & (root >= 0), root, np.inf)",
            message="t >= 0 is not the question whether they approach. Those that touch and slide along have b = 0 and "
            "c = 0, so that t = 0, and nothing is going to happen: ask b < 0.",
        ),
        _wrong(
            "grazing left out",
            "inside_root >= 0",
            "inside_root > 0",
            message="Where it is 0 under the root they touch in one moment: they graze, and closed spheres that touch "
            "meet.",
        ),
        _wrong(
            "overlap forgotten",
            "np.where(c < 0, 0.0, np.where(meets, c / below, np.inf))",
            "np.where(meets, c / below, np.inf)",
            message="Spheres that overlap at the start, c < 0, have met already: 0. Your formula gives a time in the "
            "past, or inf if they part.",
        ),
        _wrong(
            "touching is overlapping",
            "c < 0",
            "c <= 0",
            message="Those that only touch, c = 0, meet at 0 if they approach. If they part or slide along, nothing is "
            "going to happen: inf.",
        ),
        _wrong(
            "horizon forgotten",
            _LAST,
            "time",
            message="Some of these meet only after the horizon: for them the answer is inf.",
        ),
        _wrong(
            "horizon itself left out",
            "time <= horizon",
            "time < horizon",
            message="Those that meet just at the horizon do meet: time <= horizon.",
        ),
        _wrong(
            "the horizon for never",
            _LAST,
            "np.minimum(time, horizon)",
            message="For those that do not meet you return the horizon, so that nobody can tell them from those that "
            "meet in that moment. Never is inf.",
        ),
        _wrong(
            "one verdict for the batch",
            "np.sum(m * v, axis=-1)",
            "np.sum(m * v)",
            message="Right for one pair, not for a batch: np.sum without axis=-1 adds up all pairs.",
        ),
    ),  # fmt: skip
    hints=(
        "m = x_A - x_B, v = v_A - v_B and r = r_A + r_B give a, b and c, each with np.sum(..., axis=-1). Then four "
        "kinds: overlapping, approaching and hitting, all others, and those after the horizon.",
        "c < 0: 0. Else, where b < 0 and b^2 - a c >= 0: the first root. Else inf. np.where computes both branches, so "
        "make sure that nothing below 0 comes under a root, and that nothing is divided by 0.",
        "root = np.sqrt(np.maximum(____, 0))\n"
        "meets = (b < 0) & (____ >= 0)\n"
        "time = np.where(c < 0, 0.0, np.where(meets, ____, np.inf))\n"
        "return np.where(time <= ____, time, np.inf)",
    ),
)
