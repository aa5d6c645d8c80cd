"""Lesson 16: contact forces, from complementarity to a quadratic programme and its
solvers.
"""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_16_contact_forces.complementarity_residual import (
    COMPLEMENTARITY_RESIDUAL,
)
from course.exercises.definitions.lesson_16_contact_forces.pivot import PIVOT
from course.exercises.definitions.lesson_16_contact_forces.predictions import (
    PREDICTIONS,
)
from course.exercises.definitions.lesson_16_contact_forces.projected_gauss_seidel import (
    PROJECTED_GAUSS_SEIDEL,
)
from course.exercises.definitions.lesson_16_contact_forces.slope_1 import SLOPE
from course.exercises.definitions.lesson_16_contact_forces.solve_contact_qp import (
    SOLVE_CONTACT_QP,
)

LESSON = Lesson(
    number="16",
    name="contact-forces",
    title="Contact forces",
    question="Four legs, five correct solvers, different forces: what do they agree on?",
    minutes=130,
    exercises=(
        SLOPE,
        COMPLEMENTARITY_RESIDUAL,
        SOLVE_CONTACT_QP,
        PROJECTED_GAUSS_SEIDEL,
        PIVOT,
    ),
    predictions=PREDICTIONS,
)
