"""The exercise ``half_shadow``, the last step of the derivation: inputs and planted mistakes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.vectors import unit_vector
from course.exercises.slips import slip

_FORMULA = "e_1 * abs(c_1) + e_2 * abs(c_2) + e_3 * abs(c_3)"


def _points(rng: np.random.Generator) -> Sequence[Case]:
    """Cosines of both signs: with positive ones alone nobody misses the bars."""
    cosines = unit_vector(rng, (4,))
    cosines *= np.sign(cosines) * np.array([1, 1, -1])
    cosines[::2] *= -1
    cosines[1::3, 0] *= -1
    extents = np.tile(rng.uniform(0.5, 3.0, (4, 3)), (2, 1))
    turned = [[-1, 1, 1], [1, -1, 1], [1, 1, -1], [-1, -1, -1]]
    cosines = np.concatenate([cosines, cosines * turned])
    drawn = {f"e_{i + 1}": extents[:, i] for i in range(3)}
    drawn |= {f"c_{i + 1}": cosines[:, i] for i in range(3)}
    by_hand = {"e_1": 3.0, "e_2": 2.0, "e_3": 1.0, "c_1": 0.6, "c_2": 0.0, "c_3": -0.8}
    return [
        Case("the numbers worked by hand", by_hand),
        Case("eight drawn points", drawn, "batch"),
    ]


def _longest(e_1, e_2, e_3, c_1, c_2, c_3):
    import sympy as sp

    return sp.Max(e_1 * abs(c_1), e_2 * abs(c_2), e_3 * abs(c_3))


def _changed_by_a_turn(given: Mapping[str, Any], answer: Any) -> Any:
    """What the sign of a cosine changes; of one number alone nothing can be said."""
    if np.shape(answer) != (8,):
        return 0.0
    return answer[:4] - answer[4:]


HALF_SHADOW = Exercise(
    name="half_shadow",
    kind="expression",
    rows=(4, 10),
    points=2,
    minutes=7,
    task="Give half the length of a box's shadow on a unit axis, in e_1, e_2, e_3 and the cosines c_1, c_2, c_3.",
    arguments=(
        *(
            Value(f"e_{i}", "scalar", "m", f"half extent along box axis {i}")
            for i in (1, 2, 3)
        ),
        *(
            Value(
                f"c_{i}",
                "scalar",
                "",
                f"n.r_{i}, cosine between the axis and box axis {i}",
            )
            for i in (1, 2, 3)
        ),
    ),
    results=(Value("half_shadow", "(...)", "m", "half the length of the shadow"),),
    reference=formulas.half_shadow,
    cases=_points,
    properties=(
        Property(
            "signs of the cosines",
            _changed_by_a_turn,
            "Your number changes where a single cosine changes its sign. It must not: -r_i is an axis of the same box.",
        ),
    ),
    mistakes=(
        Mistake(
            "one corner",
            slip(formulas.half_shadow, _FORMULA, "e_1 * c_1 + e_2 * c_2 + e_3 * c_3"),
            "That is the corner with three plus signs. Which corner is farthest depends on the axis: each sign is "
            "chosen so that its own term is not below 0.",
        ),
        Mistake(
            "the size of one corner's place",
            slip(
                formulas.half_shadow, _FORMULA, "abs(e_1 * c_1 + e_2 * c_2 + e_3 * c_3)"
            ),
            "You take the size of the sum, so it is the corner with three plus signs or the one across. Each of the "
            "three signs can be chosen by itself: the size belongs around each term.",
        ),
        Mistake(
            "root of squares",
            slip(
                formulas.half_shadow,
                _FORMULA,
                "((e_1 * c_1)**2 + (e_2 * c_2)**2 + (e_3 * c_3)**2) ** 0.5",
            ),
            "The root of the sum of squares is the half shadow of an ellipsoid that lies inside the box. A box has "
            "corners: at the farthest one the three terms add up.",
        ),
        Mistake(
            "the longest alone",
            _longest,
            "You take the largest of the three terms: how far the middle of a face reaches. A corner lies away from "
            "the centre along all three axes of the box, so all three terms count.",
        ),
        Mistake(
            "sines",
            slip(
                formulas.half_shadow,
                _FORMULA,
                "e_1 * (1 - c_1**2)**0.5 + e_2 * (1 - c_2**2)**0.5 + e_3 * (1 - c_3**2)**0.5",
            ),
            "You take the sines, the root of 1 - c^2: how far the step e r_i leads *across* the axis. How far it "
            "leads along n is e times the cosine.",
        ),
        Mistake(
            "the signs of the worked number",
            slip(formulas.half_shadow, _FORMULA, "e_1 * c_1 + e_2 * c_2 - e_3 * c_3"),
            "These signs are right for the worked number, whose c_3 is below 0. Each cosine may have any sign, and "
            "each term is to be as large as it can be.",
        ),
        Mistake(
            "whole shadow",
            slip(formulas.half_shadow, _FORMULA, f"2 * ({_FORMULA})"),
            "Twice too long: this is the whole shadow. Asked is the half, from the centre to the farthest corner.",
        ),
        Mistake(
            "squared cosines",
            slip(
                formulas.half_shadow,
                _FORMULA,
                "e_1 * c_1**2 + e_2 * c_2**2 + e_3 * c_3**2",
            ),
            "Squares are never below 0, but they are not the cosines' sizes: a step of length e along r_i moves the "
            "place along n by e c_i.",
        ),
        Mistake(
            "cosines left out",
            slip(formulas.half_shadow, _FORMULA, "e_1 + e_2 + e_3"),
            "The axis does not occur in it. A step along r_i moves the place along n only by its cosine c_i.",
        ),
    ),  # fmt: skip
    hints=(
        "A corner is the centre plus s_1 e_1 r_1 + s_2 e_2 r_2 + s_3 e_3 r_3, each s_i being +1 or -1. Take the dot "
        "product with n.",
        "It is s_1 e_1 c_1 + s_2 e_2 c_2 + s_3 e_3 c_3. Choose each sign so that the sum is as large as it can be: "
        "what is then left of a term whose c_i is below 0? SymPy writes sizes as sp.Abs(x), or abs(x).",
        "half_shadow = e_1 * abs(____) + e_2 * ____ + ____",
    ),
)
