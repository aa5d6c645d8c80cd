"""Lesson 12: impulses on bodies that turn, and laws for many contacts at once."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_12_impulse_and_spin.apply_impulse import (
    APPLY_IMPULSE,
)
from course.exercises.definitions.lesson_12_impulse_and_spin.effective_mass import (
    EFFECTIVE_MASS,
)
from course.exercises.definitions.lesson_12_impulse_and_spin.impulse_at_point import (
    IMPULSE_AT_POINT,
)
from course.exercises.definitions.lesson_12_impulse_and_spin.point_velocity import (
    POINT_VELOCITY,
)
from course.exercises.definitions.lesson_12_impulse_and_spin.predictions import (
    PREDICTIONS,
)
from course.exercises.definitions.lesson_12_impulse_and_spin.rod_impulse import (
    ROD_IMPULSE,
)
from course.exercises.definitions.lesson_12_impulse_and_spin.simultaneous_impulses import (
    SIMULTANEOUS_IMPULSES,
)

LESSON = Lesson(
    number="12",
    name="impulse-and-spin",
    title="Impulse and spin",
    question="Hit a rod at its end: why does it take only a quarter of the impulse?",
    minutes=80,
    exercises=(
        ROD_IMPULSE,
        POINT_VELOCITY,
        EFFECTIVE_MASS,
        IMPULSE_AT_POINT,
        APPLY_IMPULSE,
        SIMULTANEOUS_IMPULSES,
    ),
    predictions=PREDICTIONS,
)
