"""Lesson 06: moving objects, and its second notebook."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_06_moving_objects.conservative_advancement import (
    CONSERVATIVE_ADVANCEMENT,
)
from course.exercises.definitions.lesson_06_moving_objects.meeting_time import (
    MEETING_TIME,
)
from course.exercises.definitions.lesson_06_moving_objects.miss_probability import (
    MISS_PROBABILITY,
)
from course.exercises.definitions.lesson_06_moving_objects.predictions import (
    DEEPER_PREDICTIONS,
    PREDICTIONS,
)
from course.exercises.definitions.lesson_06_moving_objects.swept_boxes_time import (
    SWEPT_BOXES_TIME,
)
from course.exercises.definitions.lesson_06_moving_objects.swept_spheres_time import (
    SWEPT_SPHERES_TIME,
)

LESSON = Lesson(
    number="06",
    name="moving-objects",
    title="Moving objects",
    question="A bullet 4 mm across at 900 m/s, a wall of 10 cm, 60 steps a second: why do 99 in 100 pass?",
    minutes=75,
    exercises=(MEETING_TIME, MISS_PROBABILITY, SWEPT_SPHERES_TIME, SWEPT_BOXES_TIME),
    predictions=PREDICTIONS,
)

MORE = Lesson(
    number="06-more",
    name="moving-objects",
    title="Moving objects, deeper",
    question="A rod turns half round within one step: when does its tip meet the ball?",
    minutes=43,
    exercises=(CONSERVATIVE_ADVANCEMENT,),
    predictions=DEEPER_PREDICTIONS,
)
