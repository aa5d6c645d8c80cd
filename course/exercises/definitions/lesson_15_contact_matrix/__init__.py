"""Lesson 15: how each contact force changes each d_ddot, the contact matrix A."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_15_contact_matrix.contact_matrix import (
    CONTACT_MATRIX,
)
from course.exercises.definitions.lesson_15_contact_matrix.contact_matrix_entry import (
    CONTACT_MATRIX_ENTRY,
)
from course.exercises.definitions.lesson_15_contact_matrix.ladder_entry import (
    LADDER_ENTRY,
)
from course.exercises.definitions.lesson_15_contact_matrix.point_response import (
    POINT_RESPONSE,
)
from course.exercises.definitions.lesson_15_contact_matrix.predictions import (
    PREDICTIONS,
)

LESSON = Lesson(
    number="15",
    name="contact-matrix",
    title="The contact matrix",
    question="Push on one foot of a table: which of the other feet feel it?",
    minutes=75,
    exercises=(LADDER_ENTRY, POINT_RESPONSE, CONTACT_MATRIX_ENTRY, CONTACT_MATRIX),
    predictions=PREDICTIONS,
)
