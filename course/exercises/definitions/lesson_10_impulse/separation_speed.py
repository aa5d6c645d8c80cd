"""The exercise ``separation_speed``: its inputs, its comparison, and the slips it knows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.dynamics import impulse
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_10_impulse.shared import (
    NORMAL,
    RESTITUTION,
    VELOCITY_1,
    VELOCITY_2,
    closing_speed,
    impacts,
)


def _only(names: Sequence[str], cases: Sequence[Case]) -> list[Case]:
    return [
        Case(c.label, {name: c.arguments[name] for name in names}, c.kind)
        for c in cases
    ]


def _speed_mistake(factor: Any) -> Any:
    """A wrong separation speed: factor(e) times the closing speed, and the guard kept."""

    def function(
        velocity_1: Any, velocity_2: Any, normal: Any, restitution: Any
    ) -> Any:
        closing = closing_speed(velocity_1, velocity_2, normal)
        return np.where(closing > 0, factor(restitution) * closing, -closing)

    return function


def _no_normal(velocity_1: Any, velocity_2: Any, normal: Any, restitution: Any) -> Any:
    closing = closing_speed(velocity_1, velocity_2, normal)
    speed = np.linalg.norm(np.asarray(velocity_2) - velocity_1, axis=-1)
    return np.where(closing > 0, restitution * speed, -closing)


SEPARATION_SPEED = Exercise(
    name="separation_speed",
    rows=(17,),
    points=1,
    minutes=7,
    task="Return (v1' - v2').n after the impact: e times the closing speed; bodies that part keep their speed.",
    arguments=(VELOCITY_1, VELOCITY_2, NORMAL, RESTITUTION),
    results=(
        Value("separation_speed", "(...)", "m/s", "(v1' - v2').n, never below 0"),
    ),
    reference=impulse.separation_speed,
    cases=lambda rng: _only(
        ("velocity_1", "velocity_2", "normal", "restitution"), impacts(rng)
    ),
    mistakes=(
        Mistake(
            "as printed",
            _speed_mistake(lambda e: -np.asarray(e)),
            "The sign is the one the slide prints: after the impact your bodies still approach. Before it "
            "(v1 - v2).n is negative; after it, it must be positive: -e (v1 - v2).n.",
        ),
        Mistake(
            "restitution left out",
            _speed_mistake(lambda e: 1.0),
            "They leave as fast as they came, whatever e is. Multiply the closing speed by e.",
        ),
        Mistake(
            "v2 - v1",
            lambda velocity_1, velocity_2, normal, restitution: np.where(
                closing_speed(velocity_1, velocity_2, normal) < 0,
                -np.asarray(restitution)
                * closing_speed(velocity_1, velocity_2, normal),
                closing_speed(velocity_1, velocity_2, normal),
            ),
            "Your u is (v2 - v1).n, which is positive while they approach. Then u < 0 picks the pairs that part. Take "
            "(v1 - v2).n.",
        ),
        Mistake(
            "guard the wrong way round",
            lambda velocity_1, velocity_2, normal, restitution: np.where(
                closing_speed(velocity_1, velocity_2, normal) < 0,
                np.asarray(restitution) * closing_speed(velocity_1, velocity_2, normal),
                -closing_speed(velocity_1, velocity_2, normal),
            ),
            "Your condition picks the pairs that part and leaves those that approach as they are. They approach where "
            "(v1 - v2).n < 0.",
        ),
        Mistake(
            "0 for those that part",
            lambda velocity_1, velocity_2, normal, restitution: np.maximum(
                np.asarray(restitution) * closing_speed(velocity_1, velocity_2, normal),
                0.0,
            ),
            "Right while they approach. Bodies that part have no *impulse*, but they do have a separation speed: the "
            "one they came with.",
        ),
        Mistake(
            "the size for all",
            lambda velocity_1, velocity_2, normal, restitution: np.abs(
                np.asarray(restitution) * closing_speed(velocity_1, velocity_2, normal)
            ),
            "Right while they approach. With the absolute value you slow down bodies that part by themselves: nothing "
            "happens to them, return u.",
        ),
        Mistake(
            "1 + e",
            _speed_mistake(lambda e: 1 + np.asarray(e)),
            "1 + e is how much the relative speed *changes*. What is left after the impact is e times the closing "
            "speed.",
        ),
        Mistake(
            "squared",
            _speed_mistake(lambda e: np.asarray(e) ** 2),
            "e^2 is what remains of the energy of approach; of the speed, e remains.",
        ),
        Mistake(
            "whole speed",
            _no_normal,
            "You take the length of the whole relative velocity. Only its part along the normal changes; sliding "
            "across it goes on: take the dot product with n.",
        ),
        Mistake(
            "no guard",
            lambda velocity_1, velocity_2, normal, restitution: (
                restitution * closing_speed(velocity_1, velocity_2, normal)
            ),
            "Right for bodies that approach; those that part you send into each other. Where (v1 - v2).n >= 0 nothing "
            "happens: return it as it is (np.where).",
        ),
    ),  # fmt: skip
    hints=(
        "Restitution speaks of one number only: the relative velocity along the normal, u = (v1 - v2).n.",
        "While u is negative they approach, and afterwards it is -e times what it was. Where u is not negative, it "
        "stays. np.where chooses element by element.",
        "u = np.sum((velocity_1 - velocity_2) * normal, axis=____)\nreturn np.where(u < 0, ____ * u, u)",
    ),
)
