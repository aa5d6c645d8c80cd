"""Lesson 05: the separating axis theorem, and its second notebook."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_05_separating_axis.half_shadow import (
    HALF_SHADOW,
)
from course.exercises.definitions.lesson_05_separating_axis.hulls_overlap import (
    HULLS_OVERLAP,
)
from course.exercises.definitions.lesson_05_separating_axis.least_translation import (
    LEAST_TRANSLATION,
)
from course.exercises.definitions.lesson_05_separating_axis.oriented_boxes_overlap import (
    ORIENTED_BOXES_OVERLAP,
)
from course.exercises.definitions.lesson_05_separating_axis.polygons_overlap import (
    POLYGONS_OVERLAP,
)
from course.exercises.definitions.lesson_05_separating_axis.predictions import (
    DEEPER_PREDICTIONS,
    PREDICTIONS,
)
from course.exercises.definitions.lesson_05_separating_axis.shadow_gap import SHADOW_GAP

LESSON = Lesson(
    number="05",
    name="separating-axis",
    title="Separating axis",
    question="All six face shadows overlap, yet the boxes are apart. How?",
    minutes=75,
    exercises=(
        HALF_SHADOW,
        SHADOW_GAP,
        POLYGONS_OVERLAP,
        ORIENTED_BOXES_OVERLAP,
    ),
    predictions=PREDICTIONS,
)

MORE = Lesson(
    number="05-more",
    name="separating-axis",
    title="Separating axis, deeper",
    question="How far must two shapes move to part, and what when they have a thousand faces?",
    minutes=60,
    exercises=(LEAST_TRANSLATION, HULLS_OVERLAP),
    predictions=DEEPER_PREDICTIONS,
)
