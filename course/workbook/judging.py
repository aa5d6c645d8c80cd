"""An answer judged in this process, on the cases that every notebook uses."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Iterator
from typing import Any

from course.exercises.answer import answer_to
from course.exercises.definition import Exercise
from course.exercises.inputs import Inputs, inputs_of
from course.exercises.message import Message, Part
from course.exercises.verdict import Verdict, judge_answer
from course.workbook.notebook import display_message, in_notebook

#: Seconds until a check says that the answer is still running; the longest right one
#: takes a fifth of a second.
RUNS_ON = 10


def judge_here(exercise: Exercise, answer: Any) -> Verdict:
    """The verdict on an answer to an exercise."""
    return judge_on(inputs_of(exercise), answer)


def judge_on(inputs: Inputs, answer: Any) -> Verdict:
    """The verdict on an answer, on these inputs."""
    name = inputs.exercise.name
    try:
        with _says_if_it_runs_on(name):
            given = answer_to(inputs.question, answer)
    except KeyboardInterrupt:
        words = (
            "Stopped by hand: it was still running. Look for a loop that never ends."
        )
        display_message(Message("error", f"{name}: {words}", ()))
        raise
    return judge_answer(inputs, given)


@contextlib.contextmanager
def _says_if_it_runs_on(name: str) -> Iterator[None]:
    """After some seconds, say that the answer is still running: a busy cell alone says
    nothing.
    """
    way = Part(
        "stop it", "with the square button in the toolbar (interrupt the kernel)"
    )
    look = Part("look for", "a loop that never ends")
    message = Message(
        "error", f"{name}: still running after {RUNS_ON} seconds", (way, look)
    )
    timer = threading.Timer(RUNS_ON, display_message, (message,))
    timer.daemon = True
    if in_notebook():
        timer.start()
    try:
        yield
    finally:
        timer.cancel()
