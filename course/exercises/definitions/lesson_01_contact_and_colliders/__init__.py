"""Lesson 01: what two bodies are to each other, and what stands for them."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_01_contact_and_colliders.contact_state import (
    CONTACT_STATE,
)
from course.exercises.definitions.lesson_01_contact_and_colliders.hidden_drop import (
    HIDDEN_DROP,
)
from course.exercises.definitions.lesson_01_contact_and_colliders.place import PLACE
from course.exercises.definitions.lesson_01_contact_and_colliders.predictions import (
    PREDICTIONS,
)
from course.exercises.definitions.lesson_01_contact_and_colliders.tightness import (
    TIGHTNESS,
)

LESSON = Lesson(
    number="01",
    name="contact-and-colliders",
    title="Contact and colliders",
    question="At 60 steps a second gravity gives your resting box 0.16 m/s each step: is it resting or colliding?",
    minutes=75,
    exercises=(HIDDEN_DROP, CONTACT_STATE, PLACE, TIGHTNESS),
    predictions=PREDICTIONS,
)
