"""The exercise ``shadow_gap``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

_FORMULA = "np.maximum(lower_b - upper_a, lower_a - upper_b)"


def _ends(*ends: float) -> dict[str, Any]:
    return dict(zip(("lower_a", "upper_a", "lower_b", "upper_b"), ends, strict=True))


def _drawn(rng: np.random.Generator, shape: tuple[int, ...]) -> dict[str, Any]:
    """Intervals that lie apart on either side, overlap, and lie inside each other."""
    length = rng.uniform(0.2, 3.0, (2, *shape))
    lower = rng.uniform(-2.0, 2.0, (2, *shape))
    kind = np.arange(int(np.prod(shape))).reshape(shape) % 3
    inside = lower[0] + 0.3 * length[0], 0.4 * length[0]  # B in A
    lower[1] = np.where(kind == 0, inside[0], lower[1])
    length[1] = np.where(kind == 0, inside[1], length[1])
    ends = lower[0], lower[0] + length[0], lower[1], lower[1] + length[1]
    return _ends(*(np.round(end, 3) for end in ends))


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    x = np.round(rng.uniform(0.2, 0.9, 4), 3)
    return [
        Case("B above A", _ends(0.0, 2.0, 3.0, 5.0)),
        Case("B below A", _ends(1.0 + x[0], 4.0, -2.0, 1.0 - x[1])),
        Case("they overlap", _ends(0.0, 3.0, 2.0 + x[2], 5.0)),
        Case("A lies in B", _ends(2.0, 2.0 + x[3], 0.0, 10.0), "edge"),
        Case("B lies in A", _ends(-4.0, 8.0, 6.0, 6.0 + x[0]), "edge"),
        Case("they touch", _ends(0.5, 2.0, 2.0, 2.5), "edge"),
        Case("A is a single point", _ends(1.0, 1.0, 3.0, 4.0), "edge"),
        Case("both below 0", _ends(-9.0, -7.5, -4.0, -3.0 + x[1])),
        Case("three pairs", _drawn(rng, (3,)), "batch"),
        Case("nine pairs", _drawn(rng, (9,)), "batch"),
        Case("a 2 by 4 batch", _drawn(rng, (2, 4)), "batch"),
    ]


SHADOW_GAP = Exercise(
    name="shadow_gap",
    rows=(5, 10),
    points=1,
    minutes=6,
    task="Return the gap between two intervals: above 0 apart, 0 touching, below 0 the least shift that parts them, "
    "with a minus sign.",
    arguments=(
        Value("lower_a", "(...)", "m", "lower end of A's shadow"),
        Value("upper_a", "(...)", "m", "upper end, not below lower_a"),
        Value("lower_b", "(...)", "m", "lower end of B's shadow"),
        Value("upper_b", "(...)", "m", "upper end, not below lower_b"),
    ),
    results=(Value("gap", "(...)", "m", "gap along the axis"),),
    reference=formulas.shadow_gap,
    cases=_cases,
    mistakes=(
        Mistake(
            "B above A only",
            slip(formulas.shadow_gap, _FORMULA, "lower_b - upper_a"),
            "Right while B lies above A on the axis. It may as well lie below: then the gap runs from upper_b to "
            "lower_a. Of the two numbers, which one is the gap?",
        ),
        Mistake(
            "A above B only",
            slip(formulas.shadow_gap, _FORMULA, "lower_a - upper_b"),
            "Right while A lies above B on the axis. It may as well lie below: then the gap runs from upper_a to "
            "lower_b. Of the two numbers, which one is the gap?",
        ),
        Mistake(
            "minimum",
            slip(formulas.shadow_gap, "maximum", "minimum"),
            "Both numbers are right, but you take the smaller one. Two intervals are apart as soon as *one* of them "
            "is above 0.",
        ),
        Mistake(
            "by the lower ends",
            slip(
                formulas.shadow_gap,
                _FORMULA,
                "np.where(lower_a < lower_b, lower_b - upper_a, lower_a - upper_b)",
            ),
            "Which of the two numbers is the gap does not hang on the lower ends. Where one interval lies inside the "
            "other, the shorter way out may be past the other end: of the two numbers it is the larger one.",
        ),
        Mistake(
            "the other number wherever B is not above A",
            slip(
                formulas.shadow_gap,
                _FORMULA,
                "np.where(lower_b > upper_a, lower_b - upper_a, lower_a - upper_b)",
            ),
            "Right where they are apart. Where they overlap you return lower_a - upper_b in every case: the other "
            "number may be nearer to 0, and then that is the shorter shift.",
        ),
        Mistake(
            "the other number wherever A is not above B",
            slip(
                formulas.shadow_gap,
                _FORMULA,
                "np.where(lower_a > upper_b, lower_a - upper_b, lower_b - upper_a)",
            ),
            "Right where they are apart. Where they overlap you return lower_b - upper_a in every case: the other "
            "number may be nearer to 0, and then that is the shorter shift.",
        ),
        Mistake(
            "sign",
            slip(formulas.shadow_gap, "np.maximum", "-np.maximum"),
            "The size is right and the sign reversed: above 0 means apart.",
        ),
        Mistake(
            "0 where they overlap",
            slip(formulas.shadow_gap, _FORMULA, f"np.maximum(0.0, {_FORMULA})"),
            "Right where they are apart. Where they overlap, 0 hides by how much: return the number below 0, it says "
            "how far one has to be shifted.",
        ),
        Mistake(
            "size",
            slip(formulas.shadow_gap, _FORMULA, f"np.abs({_FORMULA})"),
            "Right where they are apart. Where they overlap, the minus sign is lost: nobody can tell then which of "
            "the two it is.",
        ),
        Mistake(
            "length in common",
            slip(
                formulas.shadow_gap,
                _FORMULA,
                "np.maximum(lower_a, lower_b) - np.minimum(upper_a, upper_b)",
            ),
            "Right unless one lies inside the other. There you return the length that they have in common, and a "
            "shift by so much does not part them: it must go out past the nearer end.",
        ),
        Mistake(
            "length in common, above 0",
            slip(
                formulas.shadow_gap,
                _FORMULA,
                "np.minimum(upper_a, upper_b) - np.maximum(lower_a, lower_b)",
            ),
            "That is the length that they have in common: above 0 where they overlap, so the sign is reversed. And "
            "where one lies inside the other it is no shift that parts them: the way out is past the nearer end.",
        ),
        Mistake(
            "between the middles",
            slip(
                formulas.shadow_gap,
                _FORMULA,
                "np.abs(lower_b + upper_b - lower_a - upper_a) / 2",
            ),
            "You return the distance of the middles. The gap is what remains of it when both half lengths are taken "
            "off.",
        ),
    ),  # fmt: skip
    hints=(
        "Draw two intervals on a line. Either B lies above A, and the gap runs from upper_a to lower_b; or the other "
        "way round.",
        "Work out both numbers, lower_b - upper_a and lower_a - upper_b. If they are apart, just one of them is above "
        "0. If they overlap, each is a shift that parts them, with a minus sign: which is the shorter shift?",
        "return np.maximum(lower_b - ____, ____)",
    ),
)
