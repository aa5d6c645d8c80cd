"""The grader's page: points by exercise, the commonest mistakes, links to all pages."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

from course.exercises.definition import Lesson
from course.exercises.message import SYMBOLS
from course.grading.feedback import template, trusted
from course.grading.reasons import causes_in
from course.grading.report import cell_text, exercises_of
from course.grading.writing import write_whole

COMMONEST = 12
WORDS_FOR_MANY = {"needs a person": "need a person"}


def write_index(
    path: Path,
    rows: Sequence[Mapping[str, str]],
    overviews: Mapping[str, str],
    lessons: Sequence[Lesson],
    *,
    seed: int,
) -> None:
    """Write the page from the table's rows; raises ``CannotWrite``.

    ``overviews`` maps a submission's page to its student's page.
    """
    by_lesson = [_lesson(lesson, rows, overviews) for lesson in lessons]
    marked = {row["page"] for lesson in by_lesson for row in lesson["rows"]}
    text = template(_INDEX).render(
        title="All submissions", seed=seed, broken=_broken,
        states=[f"{n} {WORDS_FOR_MANY.get(state, state) if n > 1 else state}"
                for state, n in Counter(row["state"] for row in rows).most_common()],
        lessons=[lesson for lesson in by_lesson if lesson["rows"]], mistakes=commonest_mistakes(rows),
        others=[_line(row, overviews) for row in rows if quote(row["page"]) not in marked],
        trusted=trusted(row["isolation"] for row in rows),
        refused=[_line(row, overviews) for row in rows if row["refused"]],
    )  # fmt: skip
    write_whole(path, text)


def commonest_mistakes(
    rows: Sequence[Mapping[str, str]],
) -> list[tuple[int, str, str]]:
    """(how many, exercise, finding), the most frequent first; only what occurs twice or
    more.
    """
    count: Counter[tuple[str, str]] = Counter()
    for row in rows:
        for name in exercises_of(row):
            causes = causes_in(row[f"{name}_reason"])
            count.update((name, cause) for cause in causes)
    ranked = sorted(count.items(), key=lambda one: (-one[1], one[0]))
    return [(n, name, cause) for (name, cause), n in ranked if n > 1][:COMMONEST]


def _lesson(
    lesson: Lesson, rows: Sequence[Mapping[str, str]], overviews: Mapping[str, str]
) -> dict[str, Any]:
    name = lesson.stem
    names = [exercise.name for exercise in lesson.exercises]
    return {
        "title": f"{lesson.number} {lesson.title}",
        "exercises": names,
        "rows": [
            _line(row, overviews) | {"cells": [_cell(row, name) for name in names]}
            for row in rows
            if row["lesson"] == name
        ],
    }


def _line(row: Mapping[str, str], overviews: Mapping[str, str]) -> dict[str, Any]:
    cells = {name: cell_text(cell) for name, cell in row.items()}
    return cells | {
        "student": cells["student"] or cells["file"],
        "page": quote(row["page"]),
        "overview": quote(overviews.get(row["page"], "")),
    }


def _broken(name: str) -> Any:
    """A name that may be broken at its underscores: nine of them have to stand side by side."""
    from markupsafe import Markup, escape

    return Markup("_<wbr>").join(escape(part) for part in name.split("_"))


def _cell(row: Mapping[str, str], name: str) -> dict[str, str]:
    state, points = row.get(f"{name}_state", ""), row.get(name, "")
    return {"state": state, "text": f"{_SYMBOL.get(state, '')} {points}".strip()}


_SYMBOL: Mapping[str, str] = {str(state): symbol for state, symbol in SYMBOLS.items()}

_INDEX = """\
<header>
<h1>{{ title }}</h1>
<p>For the grader: this page shows everybody's marks.
{{ states | join(", ") }}.</p>
</header>
<main>
{% for lesson in lessons %}
<div class="wide"><table class="points">
<caption>{{ lesson.title }}</caption>
<thead><tr><th scope="col">student</th>
{% for name in lesson.exercises %}<th scope="col">{{ broken(name) }}</th>{% endfor %}
<th scope="col">total</th><th scope="col">state</th></tr></thead>
<tbody>
{% for row in lesson.rows %}
<tr><th scope="row"><a href="{{ row.page }}">{{ row.student }}</a>
{%- if row.overview %} (<a href="{{ row.overview }}">all</a>){% endif %}<br><small>{{ row.file }}</small></th>
{% for cell in row.cells %}<td title="{{ cell.state }}">{{ cell.text }}</td>{% endfor %}
<td class="whole">{{ row.total }} of {{ row.out_of }}</td><td>{{ row.state }}</td></tr>
{% endfor %}
</tbody>
</table></div>
{% endfor %}
{% if mistakes %}
<table class="points">
<caption>Commonest mistakes</caption>
<thead><tr><th scope="col">times</th><th scope="col">exercise</th><th scope="col">what was said</th></tr></thead>
<tbody>
{% for times, name, cause in mistakes %}
<tr><td>{{ times }}</td><th scope="row">{{ name }}</th><td>{{ cause }}</td></tr>
{% endfor %}
</tbody>
</table>
{% endif %}
{% if others %}
<table class="points">
<caption>Not marked</caption>
<thead><tr><th scope="col">file</th><th scope="col">state</th><th scope="col">reason</th></tr></thead>
<tbody>
{% for row in others %}
<tr><th scope="row"><a href="{{ row.page }}">{{ row.file }}</a></th>
<td>{{ row.state }}</td><td>{{ row.reason }}</td></tr>
{% endfor %}
</tbody>
</table>
{% endif %}
{% if refused %}
<table class="points">
<caption>What was refused while answers ran</caption>
<thead><tr><th scope="col">file</th><th scope="col">refused</th></tr></thead>
<tbody>
{% for row in refused %}
<tr><th scope="row"><a href="{{ row.page }}">{{ row.file }}</a></th><td>{{ row.refused }}</td></tr>
{% endfor %}
</tbody>
</table>
{% endif %}
</main>
"""
