"""From a verdict to its message, in words for the student.

The order is always the same: the verdict in a symbol and a word; the counterexample,
ready to paste; expected, got, tolerance and unit; the diagnosis; what to try next.
"""

from __future__ import annotations

import textwrap
from typing import Any

import numpy as np

from course.exercises.comparison import Difference
from course.exercises.definition import Exercise, Value
from course.exercises.message import WORDS, Message, Part
from course.exercises.numbers_as_text import code, short
from course.exercises.verdict import Verdict

SHOWN_WHOLE = 12  # numbers; of a longer element only the wrong entry is shown
PASTED_LIMIT = 5_000  # characters of arguments


def verdict_message(exercise: Exercise, verdict: Verdict) -> Message:
    """The message for a verdict; what depends on where it is shown is added there (``Message.followed_by``)."""
    headline = f"{WORDS[verdict.state]}: {exercise.name}"
    if verdict.state == "passed":
        return Message("passed", f"{headline} ({verdict.tried} cases)")
    if verdict.state == "not attempted":
        advice = Part(
            "next",
            f"write your answer where the ... stands, then run the cell again. {exercise.task}",
            # an expression is written in the symbols that its task names
            "text" if exercise.kind == "expression" else "prose",
        )
        return Message("not attempted", headline, (advice,))
    parts = []
    if verdict.case is not None:
        parts.append(
            Part("case", f"{verdict.case.label} ({verdict.case.kind})", about="run")
        )
        if exercise.kind == "function":
            parts.append(Part("try it", pasteable(exercise, verdict), "code"))
        else:
            parts.append(
                Part(
                    "at",
                    ", ".join(f"{k} = {short(v)}" for k, v in point(verdict).items()),
                    "code",
                )
            )
    if verdict.outcome is not None and verdict.difference is not None:
        parts += _what_came(exercise, verdict)
    parts += _why(verdict)
    return Message(verdict.state, headline, tuple(parts))


def _why(verdict: Verdict) -> list[Part]:
    """The causes; what is said of the code as it stands is no prose."""
    prose = [verdict.mistake.message] if verdict.mistake else []
    causes = [*prose, *verdict.reason, *verdict.violated]
    return [
        Part(
            "also" if i else "look at",
            cause,
            "text" if cause in verdict.reason else "prose",
            about="cause",
        )
        for i, cause in enumerate(causes)
    ]


def _what_came(exercise: Exercise, verdict: Verdict) -> list[Part]:
    outcome, difference = verdict.outcome, verdict.difference
    assert outcome is not None and difference is not None
    printed = (
        [Part("it printed", outcome.printed.rstrip(), "code")]
        if outcome.printed.strip()
        else []
    )
    plain = {
        "raised": f"it stopped with {outcome.text}",
        "none": "it returned None: a way through it ends without `return ...`, or what it returns there is None",
        "unreadable": outcome.text,
        "wrote": f"it wrote into its input ({outcome.text}): `+=` and `name[...] = ...` change the caller's array. "
        "Work on a copy (.copy()), or make a new array",
    }
    if outcome.kind == "unreadable" and outcome.text.startswith("expected "):
        wanted, _, came = outcome.text.removeprefix("expected ").partition("; got ")
        wanted_and_came = [
            Part("expected", wanted, about="run"),
            Part("got", came, about="run"),
        ]
        return [*wanted_and_came, *printed]
    if outcome.kind in plain:
        return [
            Part(
                "got",
                plain[outcome.kind],
                "code" if outcome.kind == "raised" else "text",
                "run",
            ),
            *printed,
        ]
    declared = next(r for r in exercise.results if r.name == difference.result)
    if difference.fault in {p.message for p in exercise.properties}:
        # a broken property is reported below; these are the numbers that break it
        names = ", ".join(result.name for result in exercise.results)
        came = ", ".join(short(value) for value in outcome.values)
        return [Part("got", f"{names} = {came}", "code", "run"), *printed]
    if difference.fault:
        at = (
            f", at index {list(difference.index)} of the batch"
            if difference.index
            else ""
        )
        fault = f"{declared.name}: {difference.fault}{at}"
        return [Part("got", fault, about="run"), *printed]
    return [
        *_expected_and_got(declared, difference, many=len(exercise.results) > 1),
        *printed,
    ]


def _expected_and_got(
    declared: Value, difference: Difference, *, many: bool
) -> list[Part]:
    name = f"{declared.name} = " if many else ""
    unit = f" {declared.unit}" if declared.unit else ""
    where = (
        f", at index {list(difference.index)} of the batch" if difference.index else ""
    )
    wanted, came = difference.expected, difference.got
    if declared.dtype == "float":
        wanted, came = (_without_noise(v, declared.absolute) for v in (wanted, came))
    if np.size(wanted) > SHOWN_WHOLE:
        wanted, came = wanted[difference.entry], came[difference.entry]
        where += (
            f", entry {list(difference.entry)} of it"
            if where
            else f", at index {list(difference.entry)}"
        )
    texts = short(wanted), short(came)
    if texts[0] == texts[1]:
        texts = code(wanted), code(came)  # they differ past the tenth digit
    parts = [
        Part("expected", f"{name}{texts[0]}{unit}{where}", "code", "run"),
        Part("got", f"{name}{texts[1]}{unit}", "code", "run"),
    ]
    if declared.dtype == "float":
        parts.append(
            Part(
                "tolerance",
                f"{declared.relative:g} relative, {declared.absolute:g}{unit} absolute",
            )
        )
    return parts


def _without_noise(value: Any, absolute: float) -> Any:
    """Numbers with 0 for those that the tolerance does not tell from 0."""
    if np.asarray(value).dtype.kind != "f":
        return value
    return np.where(np.abs(value) <= absolute, 0.0, value)[()]


def pasteable(exercise: Exercise, verdict: Verdict) -> str:
    """The failing call as code.

    A batch is shown whole, because an answer that mixes it up is right for each element
    alone.
    """
    assert verdict.case is not None
    arguments = verdict.case.arguments
    one_line = f"{exercise.name}({', '.join(code(v) for v in arguments.values())})"
    if len(one_line) <= 90:
        return one_line
    # By position, with the declared name as a comment: the student's parameter names
    # may differ.
    lines = textwrap.indent(
        "\n".join(f"{code(value)},  # {name}" for name, value in arguments.items()),
        "    ",
    )
    if len(lines) > PASTED_LIMIT:
        return f"{exercise.name}(...)  # {verdict.case.label}: too long to show"
    return f"{exercise.name}(\n{lines}\n)"


def point(verdict: Verdict) -> dict[str, Any]:
    """Where an expression was found wrong: the values of its symbols, all of them
    numbers.
    """
    assert verdict.case is not None
    index = verdict.difference.index if verdict.difference else ()
    return {
        name: v[index] if isinstance(v, np.ndarray) else v
        for name, v in verdict.case.arguments.items()
    }
