"""Lesson 11: the wall bounce, in closed form and step by step."""

from __future__ import annotations

from course.exercises.definition import Lesson
from course.exercises.definitions.lesson_11_wall_bounce.bounce_times import BOUNCE_TIMES
from course.exercises.definitions.lesson_11_wall_bounce.bouncing_ball_step import (
    BOUNCING_BALL_STEP,
)
from course.exercises.definitions.lesson_11_wall_bounce.predictions import PREDICTIONS
from course.exercises.definitions.lesson_11_wall_bounce.rest_time import REST_TIME
from course.exercises.definitions.lesson_11_wall_bounce.wall_bounce import WALL_BOUNCE

LESSON = Lesson(
    number="11",
    name="wall-bounce",
    title="The wall bounce",
    question="One line moved: why 400 times the energy error?",
    minutes=75,
    exercises=(REST_TIME, WALL_BOUNCE, BOUNCE_TIMES, BOUNCING_BALL_STEP),
    predictions=PREDICTIONS,
)
