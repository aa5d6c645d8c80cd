"""Lesson 16: the slope of the objective, the student's step of the derivation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip


def _slopes(rng: np.random.Generator) -> Sequence[Case]:
    names = ("a_11", "a_12", "f_1", "f_2", "b_1")
    draws = {name: np.round(rng.uniform(0.5, 3.0, 8), 2) for name in names}
    one = {"a_11": 2.0, "a_12": 0.5, "f_1": 3.0, "f_2": 4.0, "b_1": -9.0}
    return [Case("one pair of forces", one), Case("eight pairs", draws, "batch")]


SLOPE = Exercise(
    name="slope_1",
    kind="expression",
    rows=(25,),
    points=2,
    minutes=6,
    task="Give the derivative of q = (a_11 f_1^2 + 2 a_12 f_1 f_2 + a_22 f_2^2)/2 + b_1 f_1 + b_2 f_2 by f_1.",
    arguments=(
        Value("a_11", "scalar", "1/kg", "entry of A"),
        Value("a_12", "scalar", "1/kg", "entry of A, and its mirror image a_21"),
        Value("f_1", "scalar", "N", "force at contact 1"),
        Value("f_2", "scalar", "N", "force at contact 2"),
        Value("b_1", "scalar", "m/s²", "entry of b"),
    ),
    results=(Value("slope_1", "(...)", "m/s²", "how q changes with f_1"),),
    reference=formulas.slope_1,
    cases=_slopes,
    mistakes=(
        Mistake("half kept",
                slip(formulas.slope_1, "a_11 * f_1 + a_12 * f_2", "(a_11 * f_1 + a_12 * f_2) / 2"),
                "The half stays in front of A. The square brings a 2 down, and the mixed term stands twice."),
        Mistake("half of the mixed term", slip(formulas.slope_1, "a_12 * f_2", "a_12 * f_2 / 2"),
                "Half of the mixed term is missing: a_12 and a_21 = a_12 both bring f_1 f_2."),
        Mistake("half forgotten",
                slip(formulas.slope_1, "a_11 * f_1 + a_12 * f_2", "2 * (a_11 * f_1 + a_12 * f_2)"),
                "The half in front of f'A f is forgotten: A comes out twice as large as it is."),
        Mistake("mixed term twice", slip(formulas.slope_1, "a_12", "2 * a_12"),
                "The mixed term is twice too large: the half before the bracket and the 2 in it cancel."),
        Mistake("square left standing", slip(formulas.slope_1, "f_1 +", "f_1**2 +"),
                "f_1 still stands squared: the derivative of f_1^2 is 2 f_1."),
        Mistake("mixed term lost", slip(formulas.slope_1, " + a_12 * f_2", ""),
                "The mixed term is missing. It is how a force at contact 2 is felt at contact 1."),
        Mistake("b lost", slip(formulas.slope_1, " + b_1", ""),
                "b_1 is missing: the term b_1 f_1 is linear, its slope is b_1."),
        Mistake("sign of b", slip(formulas.slope_1, "+ b_1", "- b_1"),
                "The sign of b_1 is reversed: q has + b_1 f_1."),
        Mistake("f_1 for f_2", slip(formulas.slope_1, "f_2", "f_1"),
                "Both entries of row 1 multiply f_1. The mixed term is a_12 f_1 f_2: what is left of it is not f_1."),
        Mistake("q itself",
                slip(
                    formulas.slope_1,
                    "a_11 * f_1 + a_12 * f_2 + b_1",
                    "(a_11 * f_1 / 2 + a_12 * f_2 + b_1) * f_1",
                ),
                "This is q, or its terms with f_1, and not yet its slope: differentiate each of them by f_1."),
        Mistake("half of the square", slip(formulas.slope_1, "a_11 * f_1", "a_11 * f_1 / 2"),
                "The 2 of the square is lost: the slope of f_1^2/2 is f_1."),
    ),
    hints=(
        "Three terms of q hold f_1; the others do not change with it.",
        "The square gives twice the half, the mixed term loses its f_1 and keeps f_2, the linear term leaves b_1.",
        "slope_1 = a_11 * ____ + a_12 * ____ + b_1",
    ),
)  # fmt: skip
