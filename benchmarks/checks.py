"""How long a student waits for a check: against a tenth of a second."""

from __future__ import annotations

import contextlib
import io
import statistics

from benchmarks.measure import Row, seconds
from course.exercises.definition import Exercise, all_lessons
from course.exercises.explanation import verdict_message
from course.workbook.judging import judge_here

WAIT = 0.1


def rows() -> list[Row]:
    """The median over all exercises, for a right answer and for each planted mistake (a diagnosis costs more)."""
    exercises = [
        e for lesson in all_lessons() for e in lesson.exercises if e.kind == "function"
    ]
    right = [_check(e, e.reference) for e in exercises]
    wrong = [_check(e, m.function) for e in exercises for m in e.mistakes]
    return [
        Row(
            "a tenth of a second / right answer, median",
            WAIT / statistics.median(right),
            1.0,
            _remark(right),
        ),
        Row(
            "a tenth of a second / wrong answer, median",
            WAIT / statistics.median(wrong),
            1.0,
            _remark(wrong),
        ),
    ]


def _check(exercise: Exercise, function) -> float:
    def once() -> None:
        with contextlib.redirect_stdout(io.StringIO()):
            verdict_message(exercise, judge_here(exercise, function)).html()

    return seconds(once, repeats=3)


def _remark(times: list[float]) -> str:
    return f"{len(times)} answers: median {1e3 * statistics.median(times):.1f} ms, longest {1e3 * max(times):.1f} ms"
