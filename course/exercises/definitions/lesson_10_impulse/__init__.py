"""Lesson 10: impulses between two bodies."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_10_impulse.impulse_central import (
    IMPULSE_CENTRAL,
)
from course.exercises.definitions.lesson_10_impulse.kinetic_energy_lost import (
    KINETIC_ENERGY_LOST,
)
from course.exercises.definitions.lesson_10_impulse.momentum_after import MOMENTUM_AFTER
from course.exercises.definitions.lesson_10_impulse.p_hat import P_HAT
from course.exercises.definitions.lesson_10_impulse.predictions import PREDICTIONS
from course.exercises.definitions.lesson_10_impulse.separation_speed import (
    SEPARATION_SPEED,
)

LESSON = Lesson(
    number="10",
    name="impulse",
    title="Impulse",
    question="A wall, 1 kg, 10,000 kg, nothing lost: how many collisions, exactly?",
    minutes=75,
    exercises=(
        P_HAT,
        MOMENTUM_AFTER,
        SEPARATION_SPEED,
        IMPULSE_CENTRAL,
        KINETIC_ENERGY_LOST,
    ),
    predictions=PREDICTIONS,
)
