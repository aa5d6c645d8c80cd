"""Lesson 04: overlap tests of spheres, upright boxes and capsules, and its second notebook."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_04_overlap_tests.boxes_overlap import (
    BOXES_OVERLAP,
)
from course.exercises.definitions.lesson_04_overlap_tests.capsule_gap import CAPSULE_GAP
from course.exercises.definitions.lesson_04_overlap_tests.closest_point_on_segment import (
    CLOSEST_POINT_ON_SEGMENT,
)
from course.exercises.definitions.lesson_04_overlap_tests.foot_share import FOOT_SHARE
from course.exercises.definitions.lesson_04_overlap_tests.predictions import (
    DEEPER_PREDICTIONS,
    PREDICTIONS,
)
from course.exercises.definitions.lesson_04_overlap_tests.sphere_box_gap import (
    SPHERE_BOX_GAP,
)
from course.exercises.definitions.lesson_04_overlap_tests.sphere_capsule_gap import (
    SPHERE_CAPSULE_GAP,
)
from course.exercises.definitions.lesson_04_overlap_tests.spheres_overlap import (
    SPHERES_OVERLAP,
)

LESSON = Lesson(
    number="04",
    name="overlap-tests",
    title="Overlap tests",
    question="At 100,000 km from the origin float32 moves in steps of 8 m: do these spheres touch?",
    minutes=72,
    exercises=(
        FOOT_SHARE,
        SPHERES_OVERLAP,
        BOXES_OVERLAP,
        CLOSEST_POINT_ON_SEGMENT,
        SPHERE_CAPSULE_GAP,
    ),
    predictions=PREDICTIONS,
)

MORE = Lesson(
    number="04-more",
    name="overlap-tests",
    title="Overlap tests, deeper",
    question="Where are two sticks nearest to each other, and how does a sphere leave a box?",
    minutes=53,
    exercises=(CAPSULE_GAP, SPHERE_BOX_GAP),
    predictions=DEEPER_PREDICTIONS,
)
