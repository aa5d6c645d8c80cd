"""A verdict in words for the student: plain text, or HTML for notebooks and feedback.

The order is always the same: the verdict in a symbol and a word; the counterexample,
ready to paste; expected, got, tolerance and unit; the diagnosis; what to try next.
"""

from __future__ import annotations

import textwrap
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

import numpy as np

from course.exercises.comparison import Difference
from course.exercises.definition import Exercise, Value
from course.exercises.verdict import State, Verdict

SYMBOLS: dict[State, str] = {
    "passed": "✓",
    "wrong": "✗",
    "error": "✗",
    "not attempted": "○",
    "needs a person": "?",
}
WORDS: dict[State, str] = {
    "passed": "Right",
    "wrong": "Not yet",
    "error": "Not yet",
    "not attempted": "Not attempted",
    "needs a person": "Needs a person",
}
# Dark enough on white, light enough on a dark theme; the meaning is in the symbol and
# the word.
COLOURS: dict[State, str] = {
    "passed": "#009E73",
    "wrong": "#D55E00",
    "error": "#D55E00",
    "not attempted": "#7f7f7f",
    "needs a person": "#0072B2",
}
SHOWN_WHOLE = 12  # numbers; of a longer element only the wrong entry is shown
PASTED_LIMIT = 5_000  # characters of arguments


@dataclass(frozen=True)
class Part:
    """One labelled part of a message; code keeps its line breaks and can be pasted."""

    label: str
    text: str
    style: Literal["text", "code"] = "text"


@dataclass(frozen=True)
class Message:
    """A headline and its parts.

    Displays itself in a notebook as HTML, elsewhere as text.
    """

    state: State
    headline: str
    parts: tuple[Part, ...] = ()

    def __str__(self) -> str:
        lines = [f"{SYMBOLS[self.state]} {self.headline}"]
        width = max((len(p.label) for p in self.parts), default=0)
        for part in self.parts:
            text = part.text if part.style == "code" else textwrap.fill(part.text, 96)
            lines.append(
                f"  {part.label:<{width}}  "
                + text.replace("\n", "\n" + " " * (width + 4))
            )
        return "\n".join(line.rstrip() for line in lines)

    __repr__ = __str__

    def html(self) -> str:
        """The message as one HTML block with inline styles: a notebook's page has none
        of ours.
        """
        return _template().render(
            colour=COLOURS[self.state],
            symbol=SYMBOLS[self.state],
            headline=self.headline,
            parts=self.parts,
        )

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html()}


def verdict_message(
    exercise: Exercise, verdict: Verdict, *, after: tuple[Part, ...] = ()
) -> Message:
    """The message for a verdict; ``after`` comes last (the next exercise, how to get a
    hint).
    """
    headline = f"{WORDS[verdict.state]}: {exercise.name}"
    if verdict.state == "passed":
        return Message("passed", f"{headline} ({verdict.tried} cases)", after)
    if verdict.state == "not attempted":
        advice = Part(
            "next",
            f"write your answer where the ... stands, then run the cell again. {exercise.task}",
        )
        return Message("not attempted", headline, (advice, *after))
    parts = []
    if verdict.case is not None:
        parts.append(Part("case", f"{verdict.case.label} ({verdict.case.kind})"))
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
    return Message(verdict.state, headline, (*parts, *after))


def _why(verdict: Verdict) -> list[Part]:
    parts = [Part("look at", verdict.mistake.message)] if verdict.mistake else []
    return parts + [
        Part("look at" if i == 0 and not parts else "also", r)
        for i, r in enumerate(verdict.reason)
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
        return [Part("expected", wanted), Part("got", came), *printed]
    if outcome.kind in plain:
        return [
            Part(
                "got",
                plain[outcome.kind],
                "code" if outcome.kind == "raised" else "text",
            ),
            *printed,
        ]
    declared = next(r for r in exercise.results if r.name == difference.result)
    if difference.fault in {p.message for p in exercise.properties}:
        # a broken property is reported below; these are the numbers that break it
        names = ", ".join(result.name for result in exercise.results)
        came = ", ".join(short(value) for value in outcome.values)
        return [Part("got", f"{names} = {came}", "code"), *printed]
    if difference.fault:
        at = (
            f", at index {list(difference.index)} of the batch"
            if difference.index
            else ""
        )
        return [Part("got", f"{declared.name}: {difference.fault}{at}"), *printed]
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
        Part("expected", f"{name}{texts[0]}{unit}{where}", "code"),
        Part("got", f"{name}{texts[1]}{unit}", "code"),
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


def code(value: Any) -> str:
    """A value as code that reproduces it exactly, where NumPy is imported as ``np``."""
    if isinstance(value, tuple):
        return f"({', '.join(code(part) for part in value)}{',' if len(value) == 1 else ''})"
    if isinstance(value, np.ndarray) and value.ndim:
        if not value.size:
            return f"np.zeros({value.shape}, dtype={value.dtype.name!r})"
        form: Any = {"float_kind": _number} if value.dtype.kind == "f" else None
        text = np.array2string(
            value,
            separator=", ",
            threshold=10_000,
            max_line_width=100,
            formatter=form,
            prefix="np.array(",
        )
        return f"np.array({text})"
    plain = value.item() if isinstance(value, (np.ndarray, np.generic)) else value
    return _number(plain) if isinstance(plain, float) else repr(plain)


def short(value: Any) -> str:
    """A value for reading: ten digits."""
    array = np.asarray(value)
    if array.dtype.kind == "f":
        if array.ndim == 0:
            return f"{float(array):.10g}"
        return np.array2string(
            array, separator=", ", precision=10, threshold=12, max_line_width=90
        )
    return repr(value.item()) if isinstance(value, np.generic) else str(value)


def _number(value: float) -> str:
    if np.isfinite(value):
        return repr(float(value))
    return "np.nan" if np.isnan(value) else "np.inf" if value > 0 else "-np.inf"


@cache
def _template() -> Any:
    import jinja2

    environment = jinja2.Environment(
        autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    return environment.from_string(_HTML)


_HTML = """\
<div style="border-left: 4px solid {{ colour }}; padding: 0.3em 0.8em; margin: 0.3em 0; max-width: 60em">
<div style="font-weight: 600; font-size: 1.05em"><span style="color: {{ colour }}">{{ symbol }}</span> \
{{ headline }}</div>
{% if parts %}
<table style="margin: 0.3em 0 0 0; border: none; border-collapse: collapse; color: inherit; font-size: inherit">
{% for part in parts %}
<tr style="background: none"><td style="text-align: right; vertical-align: top; opacity: 0.7; padding: 0.15em 0.8em \
0.15em 0; white-space: nowrap; border: none">{{ part.label }}</td>
<td style="text-align: left; border: none; padding: 0.15em 0; overflow-wrap: anywhere">\
{% if part.style == "code" %}\
<pre style="margin: 0; white-space: pre-wrap; color: inherit; background: none">{{ part.text }}</pre>\
{% else %}{{ part.text }}{% endif %}</td></tr>
{% endfor %}
</table>
{% endif %}
</div>
"""
