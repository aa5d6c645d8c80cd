"""The exercise ``impulse_central``: inputs, comparison and planted mistakes."""

from __future__ import annotations

import numpy as np

from course import formulas
from course.exercises.definition import Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_10_impulse.shared import (
    MASS_1,
    MASS_2,
    NORMAL,
    RESTITUTION,
    VELOCITY_1,
    VELOCITY_2,
    impacts,
)
from course.exercises.slips import slip

IMPULSE_CENTRAL = Exercise(
    name="impulse_central",
    rows=(16, 17),
    points=3,
    minutes=10,
    task="Return p_hat for a central impact, and 0 for bodies that do not approach; mass_2 may be infinite.",
    arguments=(MASS_1, MASS_2, VELOCITY_1, VELOCITY_2, NORMAL, RESTITUTION),
    results=(Value("p_hat", "(...)", "N s", "impulse along n, never below 0"),),
    reference=formulas.impulse_central,
    cases=impacts,
    properties=(
        Property(
            "pushes",
            lambda given, answer: np.minimum(answer, 0.0),
            "A negative impulse pulls the bodies together. A collision can only push.",
        ),
    ),
    mistakes=(
        Mistake(
            "no guard",
            slip(
                formulas.impulse_central,
                "np.where(closing > 0, impulse, 0.0)",
                "impulse",
            ),
            "Right while they approach. For bodies that already part your impulse is negative: it pulls them back "
            "together. Where (v1 - v2).n >= 0 the impulse is 0.",
        ),
        Mistake(
            "only e",
            slip(formulas.impulse_central, "(1 + restitution)", "restitution"),
            "The factor is e where it must be 1 + e: the 1 stops the approach, the e sends them back. At e = 0 you "
            "would let them pass through each other.",
        ),
        Mistake(
            "no e",
            slip(formulas.impulse_central, "(1 + restitution) * ", ""),
            "e is missing: you stop the approach and no more.",
        ),
        Mistake(
            "as printed",
            slip(formulas.impulse_central, "1 + restitution", "1 - restitution"),
            "The factor is 1 - e, what the slide's restitution line gives as it is printed. With the missing minus "
            "sign it is 1 + e.",
        ),
        Mistake(
            "sign",
            slip(formulas.impulse_central, "(1 + restitution)", "-(1 + restitution)"),
            "The sign is reversed: this impulse pulls approaching bodies together. Along n, take v2 - v1.",
        ),
        Mistake(
            "guard the wrong way round",
            slip(formulas.impulse_central, "closing > 0", "closing < 0"),
            "Bodies that part get an impulse from you, and those that approach none. They approach where "
            "(v1 - v2).n < 0.",
        ),
        Mistake(
            "sum of masses",
            slip(
                formulas.impulse_central,
                "/ (1 / mass_1 + 1 / mass_2)",
                "* (mass_1 + mass_2)",
            ),
            "You multiply by m1 + m2. The inverse masses add: divide by 1/m1 + 1/m2. (A wall, 1/m2 = 0, then leaves "
            "m1.)",
        ),
        Mistake(
            "divided by the sum of masses",
            slip(
                formulas.impulse_central, "1 / mass_1 + 1 / mass_2", "mass_1 + mass_2"
            ),
            "You divide by m1 + m2. Divide by the sum of the inverse masses, 1/m1 + 1/m2.",
        ),
        Mistake(
            "the size for all",
            slip(
                formulas.impulse_central,
                "np.where(closing > 0, impulse, 0.0)",
                "np.abs(impulse)",
            ),
            "Right while they approach. With the absolute value you push bodies that already part: for them the "
            "impulse is 0.",
        ),
        Mistake(
            "the speed for those that part",
            slip(formulas.impulse_central, "0.0", "-closing"),
            "For bodies that part you return their speed. What is asked for is an impulse, and there is none: 0.",
        ),
        Mistake(
            "reduced mass as a fraction",
            slip(
                formulas.impulse_central,
                "/ (1 / mass_1 + 1 / mass_2)",
                "* mass_1 * mass_2 / (mass_1 + mass_2)",
            ),
            "Right for two bodies, NaN for a wall. Infinity over infinity, as in m1 m2/(m1 + m2), or infinity times 0 "
            "has no value; 1/(1/m1 + 1/m2) does, because 1/infinity is 0.",
        ),
        Mistake(
            "mean of masses",
            slip(
                formulas.impulse_central,
                "/ (1 / mass_1 + 1 / mass_2)",
                "* 0.5 * (mass_1 + mass_2)",
            ),
            "You use the mean of the masses. The inverse masses add: divide by 1/m1 + 1/m2.",
        ),
        Mistake(
            "whole speed",
            slip(
                formulas.impulse_central,
                "* closing /",
                "* np.linalg.norm(velocity_2 - velocity_1, axis=-1) /",
            ),
            "You take the length of the relative velocity. Without friction only its part along n matters: the dot "
            "product with n.",
        ),
        Mistake(
            "a vector",
            slip(
                formulas.impulse_central,
                "np.where(closing > 0, impulse, 0.0)",
                "np.where(closing > 0, impulse, 0.0)[..., None] * normal",
            ),
            "You return the vector p_hat n. Return the number p_hat, one for each pair.",
        ),
    ),  # fmt: skip
    hints=(
        "The formula for p_hat under On the slide, with two things added: the dot product over the last axis, and "
        "what happens to bodies that part.",
        "The closing speed is (v2 - v1).n. Where it is positive the impulse is (1 + e) times it, divided by the sum "
        "of the inverse masses; elsewhere it is 0.",
        "closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)\n"
        "impulse = (1 + restitution) * closing / (____ + ____)\n"
        "return np.where(closing > 0, impulse, ____)",
    ),
)
