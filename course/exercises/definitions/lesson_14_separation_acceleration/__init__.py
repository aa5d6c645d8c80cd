"""Lesson 14: how fast the rate of a gap changes without contact forces, b."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_14_separation_acceleration.angular_acceleration_free import (
    ANGULAR_ACCELERATION_FREE,
)
from course.exercises.definitions.lesson_14_separation_acceleration.contact_bias import (
    CONTACT_BIAS,
)
from course.exercises.definitions.lesson_14_separation_acceleration.free_point_acceleration import (
    FREE_POINT_ACCELERATION,
)
from course.exercises.definitions.lesson_14_separation_acceleration.predictions import (
    PREDICTIONS,
)
from course.exercises.definitions.lesson_14_separation_acceleration.top_acceleration import (
    TOP_ACCELERATION,
)

LESSON = Lesson(
    number="14",
    name="separation-acceleration",
    title="The acceleration of the separation",
    question="The formula says the particle leaves the dome at 37 degrees, nature says 48: what was counted twice?",
    minutes=90,
    exercises=(
        TOP_ACCELERATION,
        FREE_POINT_ACCELERATION,
        CONTACT_BIAS,
        ANGULAR_ACCELERATION_FREE,
    ),
    predictions=PREDICTIONS,
)
