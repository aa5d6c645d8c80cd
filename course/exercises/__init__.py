"""One definition of an exercise, three uses: the check, the grader, the project's
tests.

Data flows one way: definition -> cases (inputs) -> answer (outcomes) -> verdict ->
message.
"""

from course.exercises.definition import (
    Case,
    Exercise,
    Lesson,
    Mistake,
    Prediction,
    Property,
    Value,
    all_lessons,
    find_exercise,
    find_lesson,
    find_prediction,
)

__all__ = [
    "Case",
    "Exercise",
    "Lesson",
    "Mistake",
    "Prediction",
    "Property",
    "Value",
    "all_lessons",
    "find_exercise",
    "find_lesson",
    "find_prediction",
]
