"""Lesson 13: how far two bodies are apart, and how fast that changes."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_13_separation.edge_normal_rate import (
    EDGE_NORMAL_RATE,
)
from course.exercises.definitions.lesson_13_separation.normal_rate import NORMAL_RATE
from course.exercises.definitions.lesson_13_separation.predictions import PREDICTIONS
from course.exercises.definitions.lesson_13_separation.separation import SEPARATION
from course.exercises.definitions.lesson_13_separation.separation_rate import (
    SEPARATION_RATE,
)
from course.exercises.definitions.lesson_13_separation.top_rate import TOP_RATE

LESSON = Lesson(
    number="13",
    name="separation",
    title="Separation",
    question="Both centres stand still, yet the gap closes. What moves?",
    minutes=80,
    exercises=(TOP_RATE, SEPARATION, NORMAL_RATE, SEPARATION_RATE, EDGE_NORMAL_RATE),
    predictions=PREDICTIONS,
)
