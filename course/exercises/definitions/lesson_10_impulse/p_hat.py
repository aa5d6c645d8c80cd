"""The exercise ``p_hat``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

# p_hat, the last step of the derivation, as an expression.


def _points(rng: np.random.Generator) -> Sequence[Case]:
    v_1 = rng.uniform(-3.0, -1.0, 8)
    draws = {
        "m_1": rng.uniform(0.5, 2.0, 8),
        "m_2": rng.uniform(3.0, 6.0, 8),
        "v_1": v_1,
        "v_2": v_1 + rng.uniform(0.5, 3.0, 8),
        "e": rng.uniform(0.2, 0.9, 8),
    }
    by_hand = {"m_1": 2.0, "m_2": 1.0, "v_1": -3.0, "v_2": 1.0, "e": 0.5}
    return [
        Case("the numbers worked by hand", by_hand),
        Case("eight drawn points", draws, "batch"),
    ]


P_HAT = Exercise(
    name="p_hat",
    kind="expression",
    rows=(16, 17),
    points=2,
    minutes=8,
    task="Give p_hat in the symbols m_1, m_2, v_1, v_2 and e, where v_1 and v_2 are the speeds along n.",
    arguments=(
        Value("m_1", "scalar", "kg", "mass of body 1"),
        Value("m_2", "scalar", "kg", "mass of body 2"),
        Value("v_1", "scalar", "m/s", "v1.n before"),
        Value("v_2", "scalar", "m/s", "v2.n before"),
        Value("e", "scalar", "", "restitution"),
    ),
    results=(Value("p_hat", "(...)", "N s", "impulse along n"),),
    reference=formulas.p_hat,
    cases=_points,
    mistakes=(
        Mistake(
            "sign",
            slip(formulas.p_hat, "(v_2 - v_1)", "(v_1 - v_2)"),
            "The sign is reversed. While they approach, v_1 < v_2 along n, and an impulse that pushes them apart "
            "is positive: it must contain v_2 - v_1.",
        ),
        Mistake(
            "as printed",
            slip(formulas.p_hat, "1 + e", "1 - e"),
            "You used the restitution line as the slide prints it, without its minus sign. It gives 1 - e: no impulse "
            "at all when nothing is lost. Take (v1' - v2').n = -e (v1 - v2).n.",
        ),
        Mistake(
            "only e",
            slip(formulas.p_hat, "(1 + e)", "e"),
            "The factor is e where it must be 1 + e. The 1 stops the approach, the e sends them back; at e = 0 there "
            "is still an impulse.",
        ),
        Mistake(
            "no e",
            slip(formulas.p_hat, "(1 + e) * ", ""),
            "e is missing. This impulse only stops the approach, which is right for e = 0.",
        ),
        Mistake(
            "sum of masses",
            slip(formulas.p_hat, "/ (1 / m_1 + 1 / m_2)", "* (m_1 + m_2)"),
            "You multiply by m_1 + m_2. The same impulse changes v_1 by p_hat/m_1 and v_2 by p_hat/m_2, so the "
            "inverse masses add: divide by 1/m_1 + 1/m_2.",
        ),
        Mistake(
            "divided by the sum of masses",
            slip(formulas.p_hat, "1 / m_1 + 1 / m_2", "m_1 + m_2"),
            "You divide by m_1 + m_2. The velocities change by p_hat/m_1 and p_hat/m_2, so what adds up are the "
            "inverse masses. (Look at the unit: an impulse is kg m/s.)",
        ),
        Mistake(
            "multiplied by the inverse masses",
            slip(formulas.p_hat, "/ (1", "* (1"),
            "You multiply by 1/m_1 + 1/m_2 where you must divide: that bracket stands beside p_hat, not beside the "
            "speeds.",
        ),
        Mistake(
            "difference of inverse masses",
            slip(formulas.p_hat, "+ 1 / m_2", "- 1 / m_2"),
            "You have 1/m_1 - 1/m_2. Body 2 gets -p_hat, and it is subtracted: v1' - v2' holds "
            "p_hat/m_1 - (-p_hat/m_2), a sum.",
        ),
    ),
    hints=(
        "You have v_1' = v_1 + p/m_1, v_2' = v_2 - p/m_2 and v_1' - v_2' = -e (v_1 - v_2): three equations, and p is "
        "the only unknown you want.",
        "Subtract the second from the first, put the third in its place, collect p on one side, and divide by what "
        "stands before it.",
        "p_hat = (1 + e) * (____ - ____) / (1/m_1 ____ 1/m_2)",
    ),
)
