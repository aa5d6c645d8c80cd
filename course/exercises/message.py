"""What a student is shown: a headline and labelled parts, as plain text or as HTML for notebooks and feedback."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Literal

from course.exercises.letters import with_letters
from course.exercises.verdict import State

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


@dataclass(frozen=True)
class Part:
    """One labelled part of a message; code keeps its line breaks and can be pasted, prose
    is shown with real letters (``letters``).

    ``about`` says what a table of marks makes of it: what one "run" gave, or a "cause", which is counted.
    """

    label: str
    text: str
    style: Literal["text", "prose", "code"] = "text"
    about: Literal["", "run", "cause"] = ""


@dataclass(frozen=True)
class Message:
    """A headline and its parts.

    Displays itself in a notebook as HTML, elsewhere as text.
    """

    state: State
    headline: str
    parts: tuple[Part, ...] = ()

    def followed_by(self, *parts: Part) -> Message:
        """The message with more parts at its end."""
        return replace(self, parts=(*self.parts, *parts))

    def _shown(self) -> tuple[Part, ...]:
        """The parts, prose with its letters."""
        return tuple(
            replace(p, text=with_letters(p.text)) if p.style == "prose" else p
            for p in self.parts
        )

    def __str__(self) -> str:
        lines = [f"{SYMBOLS[self.state]} {self.headline}"]
        width = max((len(p.label) for p in self.parts), default=0)
        for part in self._shown():
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
            parts=self._shown(),
        )

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        return {"text/plain": str(self), "text/html": self.html()}


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
{% else %}<div style="max-width: 66ch">{{ part.text }}</div>{% endif %}</td></tr>
{% endfor %}
</table>
{% endif %}
</div>
"""
