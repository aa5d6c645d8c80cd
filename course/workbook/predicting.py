"""``predict``: a student commits to an answer, and sees the outcome after it."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import written
from course.exercises.definition import Prediction, find_prediction
from course.exercises.letters import with_letters
from course.exercises.message import Message, Part
from course.workbook import recording
from course.workbook.notebook import display_message
from course.workbook.numbers import show


def predict(name: str, answer: Any = None) -> None:
    """Commit to an answer, then see the outcome. Nothing is shown before an answer is
    given.

    Where the lesson answers a question only later, the answer is recorded, and
    ``predict(name)`` shows the outcome there. An answer that is neither a number nor a
    choice is rejected with what is expected. Raises ``ValueError`` for an unknown name.
    """
    _, prediction = find_prediction(name)
    if answer is Ellipsis or (answer is None and recording.predicted(name) is None):
        choices = tuple(
            Part(key, text, "prose") for key, text in prediction.choices.items()
        )
        way = f"put {_wanted(prediction)} where the ... stands, then run the cell again"
        first = f"commit first: predict({name!r}, ...) with {_wanted(prediction)}"
        ask = Part("answer", way if answer is Ellipsis else first)
        display_message(
            Message(
                "not attempted",
                f"Your prediction: {with_letters(prediction.question)}",
                (*choices, ask),
            )
        )
        return
    try:
        given = (
            recording.predicted(name) if answer is None else _given(prediction, answer)
        )
    except ValueError as error:
        display_message(Message("not attempted", f"Not an answer yet: {error}", ()))
        return
    if answer is not None:
        recording.record("predict", name, answer=given)
        if prediction.later:
            said = _said(prediction, given) + _unit(prediction)
            noted = Part("answer", f"in the section {prediction.later}")
            display_message(
                Message(
                    "not attempted", f"Noted: you said {with_letters(said)}", (noted,)
                )
            )
            return
    display_message(_outcome_message(prediction, given))


def _outcome_message(prediction: Prediction, given: Any) -> Message:
    """How a prediction turned out."""
    outcome, unit = prediction.outcome(), _unit(prediction)
    right = _close(prediction, given, outcome)
    parts = [
        Part("you said", _said(prediction, given) + unit, "prose"),
        Part("it is", _said(prediction, outcome) + unit, "prose"),
    ]
    if not right:
        tempting = next(
            (
                text
                for key, text in prediction.wrong.items()
                if _close(prediction, given, key)
            ),
            "",
        )
        parts += [Part("tempting", tempting, "prose")] if tempting else []
    parts.append(Part("why", prediction.explanation, "prose"))
    headline = "As you predicted" if right else "Not what you predicted"
    return Message("passed" if right else "wrong", headline, tuple(parts))


def _unit(prediction: Prediction) -> str:
    return f" {prediction.unit}" if prediction.unit else ""


def _wanted(prediction: Prediction) -> str:
    if prediction.choices:
        return " or ".join(f'"{key}"' for key in prediction.choices)
    return f"a number in {prediction.unit}" if prediction.unit else "a number"


def _given(prediction: Prediction, answer: Any) -> Any:
    if prediction.choices:
        if isinstance(answer, int) and str(answer) in prediction.choices:
            return str(answer)  # a choice that is a number, without its quotes
        if not isinstance(answer, str) or answer not in prediction.choices:
            raise ValueError(f"expected {_wanted(prediction)}; got {written(answer)}")
        return answer
    try:
        number = float(answer)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(
            f"expected {_wanted(prediction)}; got {written(answer)}"
        ) from None
    if np.isnan(number):  # infinity is an answer: never, forever
        raise ValueError(f"expected {_wanted(prediction)}; got {written(answer)}")
    return number


def _close(prediction: Prediction, given: Any, outcome: Any) -> bool:
    if prediction.choices:
        return bool(given == outcome)
    return (
        abs(given - float(outcome))
        <= prediction.tolerance * abs(float(outcome)) + 1e-12
    )


def _said(prediction: Prediction, value: Any) -> str:
    if prediction.choices:
        return f"{value}: {prediction.choices[value]}"
    return (
        "0"
        if abs(float(value)) < 1e-12
        else str(show(float(value), 4 if abs(float(value)) < 1e4 else 8))
    )
