"""The exercise ``impulse_central``: its inputs, its comparison, and the slips it knows."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.dynamics import impulse
from course.exercises.definition import Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_10_impulse.shared import (
    MASS_1,
    MASS_2,
    NORMAL,
    RESTITUTION,
    VELOCITY_1,
    VELOCITY_2,
    along,
    approaching,
    closing_speed,
    impacts,
    reduced,
)


def _impulse(
    *,
    mass: Any = reduced,
    closing: Any = closing_speed,
    factor: Any = None,
    guard: bool = True,
) -> Any:
    """The impulse with one of its parts changed."""
    factor = factor or (lambda e: 1 + np.asarray(e))

    def function(
        mass_1: Any,
        mass_2: Any,
        velocity_1: Any,
        velocity_2: Any,
        normal: Any,
        restitution: Any,
    ) -> Any:
        speed = closing(velocity_1, velocity_2, normal)
        value = factor(restitution) * speed * mass(mass_1, mass_2)
        return (
            approaching(closing_speed(velocity_1, velocity_2, normal), value)
            if guard
            else value
        )

    return function


IMPULSE_CENTRAL = Exercise(
    name="impulse_central",
    rows=(16, 17),
    points=3,
    minutes=10,
    task="Return p_hat for a central impact, and 0 for bodies that do not approach; mass_2 may be infinite.",
    arguments=(MASS_1, MASS_2, VELOCITY_1, VELOCITY_2, NORMAL, RESTITUTION),
    results=(Value("p_hat", "(...)", "N s", "impulse along n, never below 0"),),
    reference=impulse.impulse_central,
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
            _impulse(guard=False),
            "Right while they approach. For bodies that already part your impulse is negative: it pulls them back "
            "together. Where (v1 - v2).n >= 0 the impulse is 0.",
        ),
        Mistake(
            "only e",
            _impulse(factor=lambda e: np.asarray(e)),
            "The factor is e where it must be 1 + e: the 1 stops the approach, the e sends them back. At e = 0 you "
            "would let them pass through each other.",
        ),
        Mistake(
            "no e",
            _impulse(factor=lambda e: 1.0),
            "e is missing: you stop the approach and no more.",
        ),
        Mistake(
            "as printed",
            _impulse(factor=lambda e: 1 - np.asarray(e)),
            "The factor is 1 - e, what the slide's restitution line gives as it is printed. With its minus sign "
            "mended it is 1 + e.",
        ),
        Mistake(
            "sign",
            _impulse(closing=lambda a, b, n: -closing_speed(a, b, n)),
            "The sign is turned round: this impulse pulls approaching bodies together. Along n, take v2 - v1.",
        ),
        Mistake(
            "guard the wrong way round",
            lambda mass_1, mass_2, velocity_1, velocity_2, normal, restitution: (
                np.where(
                    closing_speed(velocity_1, velocity_2, normal) < 0,
                    (1 + np.asarray(restitution))
                    * closing_speed(velocity_1, velocity_2, normal)
                    * reduced(mass_1, mass_2),
                    0.0,
                )
            ),
            "Your condition picks the bodies that part. They approach where (v1 - v2).n < 0.",
        ),
        Mistake(
            "sum of masses",
            _impulse(mass=lambda a, b: np.asarray(a) + b),
            "You multiply by m1 + m2. The inverse masses add: divide by 1/m1 + 1/m2. (A wall, 1/m2 = 0, then leaves "
            "m1.)",
        ),
        Mistake(
            "divided by the sum of masses",
            _impulse(mass=lambda a, b: 1 / (np.asarray(a) + b)),
            "You divide by m1 + m2. Divide by the sum of the inverse masses, 1/m1 + 1/m2.",
        ),
        Mistake(
            "the size for all",
            lambda *given: np.abs(_impulse(guard=False)(*given)),
            "Right while they approach. With the absolute value you push bodies that already part: for them the "
            "impulse is 0.",
        ),
        Mistake(
            "the speed for those that part",
            lambda mass_1, mass_2, velocity_1, velocity_2, normal, restitution: (
                np.where(
                    closing_speed(velocity_1, velocity_2, normal) > 0,
                    _impulse(guard=False)(
                        mass_1, mass_2, velocity_1, velocity_2, normal, restitution
                    ),
                    -closing_speed(velocity_1, velocity_2, normal),
                )
            ),
            "For bodies that part you return their speed. Asked is an impulse, and there is none: 0.",
        ),
        Mistake(
            "reduced mass as a fraction",
            _impulse(mass=lambda a, b: np.asarray(a) * b / (np.asarray(a) + b)),
            "Right for two bodies, NaN for a wall. Infinity over infinity, as in m1 m2/(m1 + m2), or infinity times 0 "
            "has no value; 1/(1/m1 + 1/m2) does, because 1/infinity is 0.",
        ),
        Mistake(
            "mean of masses",
            _impulse(mass=lambda a, b: 0.5 * (np.asarray(a) + b)),
            "You use the mean of the masses. The inverse masses add: divide by 1/m1 + 1/m2.",
        ),
        Mistake(
            "whole speed",
            _impulse(
                closing=lambda a, b, n: np.linalg.norm(np.asarray(b) - a, axis=-1)
            ),
            "You take the length of the relative velocity. Without friction only its part along n matters: the dot "
            "product with n.",
        ),
        Mistake(
            "a vector",
            lambda *given: along(_impulse()(*given), given[4]),
            "You return the vector p_hat n. Return the number p_hat, one for each pair.",
        ),
    ),  # fmt: skip
    hints=(
        "The formula for p_hat under On the slide, with two things added: the dot product over the last axis, and "
        "what happens to bodies that part.",
        "The closing speed is (v2 - v1).n. Where it is positive the impulse is (1 + e) times it, divided by the sum "
        "of the inverse masses; elsewhere it is 0.",
        "closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)\n"
        "value = (1 + restitution) * closing / (____ + ____)\n"
        "return np.where(closing > 0, value, ____)",
    ),
)
