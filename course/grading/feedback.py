"""A feedback page per submission: points, findings, what to try next.

A student with several submissions gets one of their own as well. Nothing is loaded from
outside. ``index`` makes the page for the grader, with everybody on it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import quote

from course.exercises.message import SYMBOLS, WORDS, Part
from course.grading.judge import Row
from course.grading.report import TRUSTED, TRUSTED_MEANS, Submission, cell_text
from course.grading.writing import write_whole

#: The grader's page, beside the others.
INDEX = "index.html"


def write_page(
    path: Path, submission: Submission, *, seed: int, isolation: str = ""
) -> None:
    """Write the page of a submission, with a link to the grader's.

    Raises ``CannotWrite``.
    """
    write_whole(path, page(submission, seed=seed, index=INDEX, isolation=isolation))


def page(
    submission: Submission, *, seed: int, index: str = "", isolation: str = ""
) -> str:
    """The page as HTML; everything a student wrote is escaped."""
    from markupsafe import Markup

    lesson = submission.lesson
    sections = [
        {
            "name": row.exercise.name,
            "signature": row.exercise.signature
            if row.exercise.kind == "function"
            else row.exercise.name,
            "task": row.exercise.task,
            "word": WORDS[row.state],
            "symbol": SYMBOLS[row.state],
            "points": _points(row),
            "message": Markup(row.message.followed_by(*_after(row)).html()),
        }
        for row in submission.rows
    ]
    return str(
        template(_PAGE).render(
            title=f"Lesson {lesson.number}: {lesson.title}" if lesson else "This file could not be marked",
            submission=submission, sections=sections, following=_following(submission), seed=seed,
            index=index, trusted=trusted([isolation]),
        )
    )  # fmt: skip


def write_overview(
    path: Path,
    student: str,
    handed_in: Sequence[Mapping[str, str]],
    *,
    seed: int,
) -> None:
    """Write a student's own page: each submission's points, from its table row."""
    rows = [
        {"page": quote(row["page"]), "file": cell_text(row["file"]),
         "lesson": row["lesson"] or cell_text(row["reason"]),
         "state": row["state"], "points": f"{row['total']} of {row['out_of']}" if row["lesson"] else ""}
        for row in handed_in
    ]  # fmt: skip
    title = f"Handed in by {student}"
    warning = trusted([row["isolation"] for row in handed_in])
    text = template(_OVERVIEW).render(
        title=title, rows=rows, seed=seed, index=INDEX, trusted=warning
    )
    write_whole(path, text)


def trusted(isolations: Iterable[str]) -> str:
    """The warning for a batch whose submissions could do whatever the grader can."""
    return TRUSTED_MEANS if any(i.startswith(TRUSTED) for i in isolations) else ""


def _points(row: Row) -> str:
    return f"{'?' if row.points is None else row.points} of {row.exercise.points}"


def _after(row: Row) -> tuple[Part, ...]:
    """The first hint, where an answer is wrong and nothing says yet how."""
    if row.verdict.failed and row.verdict.mistake is None and row.repair is None:
        return (Part("hint", row.exercise.hints[0], "prose"),)
    return ()


def _following(submission: Submission) -> str:
    """What to try next: the first exercise that is not right, core before stretch."""
    left = [r for r in submission.rows if r.state not in ("passed", "needs a person")]
    left.sort(key=lambda row: row.exercise.level != "core")
    if submission.again:
        return "A person will look at it."
    if not submission.rows:
        return "Hand in the notebook itself, the file that ends in .ipynb, as JupyterLab saves it."
    if not left:
        return (
            "Nothing is left to do in this lesson."
            if submission.state == "marked"
            else ""
        )
    first = left[0].exercise
    minutes = sum(row.exercise.minutes for row in left if row.exercise.level == "core")
    rest = (
        f" About {minutes} minutes of core exercises are left in this lesson."
        if minutes
        else ""
    )
    return (
        f"Next: {first.name}. Open the lesson, change its cell and run it: check judges it at once, and "
        f"hint({first.name!r}) gives the first of three hints.{rest}"
    )


@cache
def template(page: str) -> Any:
    """A page's body between the common head and foot, as a template that escapes its
    values.
    """
    import jinja2

    environment = jinja2.Environment(
        autoescape=True, trim_blocks=True, lstrip_blocks=True
    )
    return environment.from_string(_HEAD + page + _FOOT)


_HEAD = """\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<title>{{ title }}{% if submission and submission.student %} - {{ submission.student }}{% endif %}</title>
<style>
:root { color-scheme: light dark; }
body { font: 1rem/1.5 system-ui, sans-serif; max-width: 60rem; margin: 0 auto; padding: 1rem; }
table.points { border-collapse: collapse; margin-bottom: 1.5rem; }
table.points th, table.points td { text-align: left; padding: 0.2rem 1rem 0.2rem 0; border-bottom: 1px solid #888; }
table.points small { font-weight: normal; }
.wide { overflow-x: auto; }
.whole { white-space: nowrap; }
caption { text-align: left; font-weight: 600; padding-bottom: 0.3rem; }
pre { overflow-x: auto; }
section { margin: 1.5rem 0; }
h2 { font-size: 1.15rem; }
footer { margin-top: 2rem; font-size: 0.9rem; }
</style>
</head>
<body>
"""

_PAGE = """\
<header>
<h1>{{ title }}</h1>
<p>{% if submission.student %}{{ submission.student }}, {% endif %}{{ submission.file }}</p>
</header>
<main>
{% if submission.lesson %}
<p><strong>{{ submission.total }} of {{ submission.out_of }} points</strong>
{%- if submission.state == "needs a person" %}, and a person has still to look at what is marked with ?{% endif %}.</p>
{% else %}
<p><strong>{{ submission.reason }}</strong></p>
{% endif %}
{% if submission.refused %}
<p>While it ran it was refused: {{ submission.refused | join("; ") }}. Marking works without these.</p>
{% endif %}
{% if following %}
<p>{{ following }}</p>
{% endif %}
{% if sections %}
<table class="points">
<caption>Points by exercise</caption>
<thead><tr><th scope="col">exercise</th><th scope="col">result</th><th scope="col">points</th></tr></thead>
<tbody>
{% for s in sections %}
<tr><th scope="row"><a href="#{{ s.name }}">{{ s.name }}</a></th><td>{{ s.symbol }} {{ s.word }}</td>\
<td>{{ s.points }}</td></tr>
{% endfor %}
</tbody>
</table>
{% for s in sections %}
<section id="{{ s.name }}" aria-labelledby="{{ s.name }}-heading">
<h2 id="{{ s.name }}-heading"><code>{{ s.signature }}</code></h2>
<p>{{ s.task }} ({{ s.points }} points)</p>
{{ s.message }}
</section>
{% endfor %}
{% endif %}
</main>
"""

_OVERVIEW = """\
<header>
<h1>{{ title }}</h1>
</header>
<main>
<table class="points">
<caption>Points by lesson</caption>
<thead><tr><th scope="col">lesson</th><th scope="col">state</th><th scope="col">points</th></tr></thead>
<tbody>
{% for row in rows %}
<tr><th scope="row"><a href="{{ row.page }}">{{ row.lesson }}</a><br><small>{{ row.file }}</small></th>\
<td>{{ row.state }}</td><td>{{ row.points }}</td></tr>
{% endfor %}
</tbody>
</table>
</main>
"""

_FOOT = """\
<footer>Marked by program with the seed {{ seed }}; the same seed gives the same inputs again.
{%- if trusted %} {{ trusted }}{% endif %}
{%- if index %} <a href="{{ index }}">For the grader: all submissions</a>{% endif %}</footer>
</body>
</html>
"""
