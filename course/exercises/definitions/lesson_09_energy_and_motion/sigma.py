"""The exercise ``sigma``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip


def _moments_drawn(rng: np.random.Generator) -> Sequence[Case]:
    least = rng.uniform(1.0, 1.5, 8)
    middle = least + rng.uniform(0.4, 1.0, 8)
    draws = {
        "I_1": least,
        "I_2": middle,
        "I_3": middle + rng.uniform(0.3, 0.9, 8),
        "Omega": rng.uniform(2.0, 5.0, 8),
    }
    by_hand = {"I_1": 1.0, "I_2": 2.0, "I_3": 3.0, "Omega": 6.0}
    return [
        Case("moments 1, 2, 3 and 6 rad/s", by_hand),
        Case("eight drawn points", draws, "batch"),
    ]


SIGMA = Exercise(
    name="sigma",
    kind="expression",
    rows=(14,),
    points=2,
    minutes=10,
    task="Give the growth rate sigma > 0 in the symbols I_1 < I_2 < I_3 and Omega.",
    arguments=(
        Value("I_1", "scalar", "kg m²", "least moment"),
        Value("I_2", "scalar", "kg m²", "middle moment"),
        Value("I_3", "scalar", "kg m²", "largest moment"),
        Value("Omega", "scalar", "rad/s", "spin about the middle axis"),
    ),
    results=(Value("sigma", "(...)", "1/s"),),
    reference=formulas.sigma,
    cases=_moments_drawn,
    mistakes=(
        Mistake(
            "square",
            slip(formulas.sigma, "Omega * sp.sqrt(", "Omega**2 * ("),
            "This is sigma^2: the second rate of exp(sigma t) is sigma^2 exp(sigma t). Take the root.",
        ),
        Mistake(
            "negative root",
            slip(formulas.sigma, "Omega * ", "-Omega * "),
            "This is the root that dies away. Both solve the equation; the one that grows is the positive one.",
        ),
        Mistake(
            "imaginary",
            slip(
                formulas.sigma, "(I_2 - I_1) * (I_3 - I_2)", "(I_2 - I_3) * (I_2 - I_1)"
            ),
            "What stands under your root is negative. The brackets of the two equations are I_2 - I_3 and I_1 - I_2, "
            "both negative: their product is positive. Is one of yours turned round?",
        ),
        Mistake(
            "no spin",
            slip(formulas.sigma, "Omega * ", ""),
            "Omega is missing: each of the two equations has it once, so sigma^2 has it twice.",
        ),
        Mistake(
            "spin under the root",
            slip(formulas.sigma, "Omega * sp.sqrt(", "sp.sqrt(Omega * "),
            "Omega stands under your root once. Each of the two equations has it once, so their product has Omega^2.",
        ),
        Mistake(
            "not divided",
            slip(formulas.sigma, " / (I_1 * I_3)", ""),
            "The moments on the left are missing: divide the first equation by I_1, the second by I_3, before you "
            "put one into the other.",
        ),
        Mistake(
            "divided by one moment",
            slip(formulas.sigma, " / (I_1 * I_3))", ") / I_2"),
            "You divide by I_2. Nothing on the left has I_2: the moments there are I_1 and I_3.",
        ),
        Mistake(
            "divided by the wrong pair",
            slip(formulas.sigma, "I_1 * I_3", "I_1 * I_2"),
            "You divide by I_1 and I_2. The second of the two equations has I_3 on its left, not I_2.",
        ),
        Mistake(
            "multiplied by the last moment",
            slip(formulas.sigma, "/ (I_1 * I_3)", "/ I_1 * I_3"),
            "a / I_1 * I_3 is (a / I_1) * I_3: Python divides by I_1 only. Put the product below the line in "
            "brackets.",
        ),
        Mistake(
            "square without its second spin",
            slip(formulas.sigma, "sp.sqrt(", "("),
            "The root is missing, and one Omega: both equations have an Omega, so sigma^2 has Omega^2, and sigma is "
            "the root of that.",
        ),
        Mistake(
            "outer difference for the first",
            slip(formulas.sigma, "I_2 - I_1", "I_3 - I_1"),
            "One bracket is I_3 - I_1, which belongs to the equation of the middle axis. The equation of omega_3 has "
            "I_1 - I_2.",
        ),
        Mistake(
            "outer difference for the second",
            slip(formulas.sigma, "I_3 - I_2", "I_3 - I_1"),
            "One bracket is I_3 - I_1, which belongs to the equation of the middle axis. The equation of omega_1 has "
            "I_2 - I_3.",
        ),
        Mistake(
            "spin squared outside the root",
            slip(formulas.sigma, "Omega", "Omega**2"),
            "Omega stands outside the root squared. sigma^2 holds Omega^2; the root of that is Omega.",
        ),
        Mistake(
            "one bracket",
            slip(
                formulas.sigma,
                "sp.sqrt((I_2 - I_1) * (I_3 - I_2) / (I_1 * I_3))",
                "(I_3 - I_1) / sp.sqrt(I_1 * I_3)",
            ),
            "The difference I_3 - I_1 belongs to the equation of the middle axis itself. The two that you need have "
            "I_2 - I_3 and I_1 - I_2.",
        ),
    ),
    hints=(
        "Two equations, each a rate: put the second into the rate of the first, and only omega_1 is left.",
        "omega_1'' = (a number) omega_1 grows as exp(sigma t), and sigma^2 is that number. It holds both brackets "
        "and Omega twice.",
        "sigma = Omega * sp.sqrt((____ - ____) * (____ - ____) / (I_1 * ____))",
    ),
)
