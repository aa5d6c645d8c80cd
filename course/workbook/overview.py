"""All lessons at a glance: what is done of each, minutes left, what comes next; as text,
as HTML, and as a page of links beside the lessons.
"""

from __future__ import annotations

import contextlib
import html
import os
import secrets
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from course.exercises.definition import Lesson, all_lessons

PAGE = "Lessons.md"
OURS = "<!-- made by the course: what you write here is lost -->"


@dataclass(frozen=True)
class Row:
    """A notebook's state: exercises done, of how many, minutes left, the next one.

    Those of a notebook that goes ``deeper`` are not among the minutes left in all.
    """

    number: str
    title: str
    file_name: str
    done: int
    total: int
    minutes: int
    following: str
    deeper: bool = False

    @property
    def bar(self) -> str:
        """How much is done, in letters."""
        return "█" * self.done + "░" * (self.total - self.done)


@dataclass(frozen=True)
class Table:
    """Progress by lesson; displays itself as a table."""

    rows: tuple[Row, ...]

    def __str__(self) -> str:
        width = max((len(r.title) for r in self.rows), default=0)
        lines = [
            f"{r.number}  {r.title:<{width}}  {r.bar} {r.done}/{r.total}"
            + (
                f"  {r.minutes} min left  next: {r.following}"
                if r.following
                else "  done"
            )
            for r in self.rows
        ]
        return "\n".join(lines) if lines else "no lessons yet"

    __repr__ = __str__

    def _repr_html_(self) -> str:
        cells = "".join(
            f"<tr>{_cell(f'{r.number} {r.title}', 'th')}{_cell(_bar(r))}{_cell(f'{r.done} of {r.total}')}"
            f"{_cell(_left(r))}{_cell(html.escape(r.following), code=True)}</tr>"
            for r in self.rows
        )
        head = "".join(
            _cell(word, "th", scope="col")
            for word in ("lesson", "", "exercises", "left", "next")
        )
        return f'<table class="course-progress"><tr>{head}</tr>{cells}</table>'


def minutes_left(lesson: Lesson, passed: Collection[str]) -> int:
    """The estimated minutes of the exercises that count and have not passed yet."""
    return sum(e.minutes for e in lesson.counted if e.name not in passed)


def table(passed: Collection[str]) -> Table:
    """The state of every lesson, where these exercises have passed."""
    return Table(
        tuple(
            Row(
                lesson.number,
                lesson.title,
                lesson.file_name,
                sum(e.name in passed for e in lesson.counted),
                len(lesson.counted),
                minutes_left(lesson, passed),
                next((e.name for e in lesson.counted if e.name not in passed), ""),
                lesson.deeper,
            )
            for lesson in all_lessons()
        )
    )


def page(names: Collection[str], passed: Collection[str] | None = None) -> str:
    """A page of the lessons with these file names, as Markdown; without ``passed`` as they
    are handed out, without bars.
    """
    rows = [row for row in table(passed or ()).rows if row.file_name in names]
    begun = passed is not None
    lines = [OURS, "", "# All lessons", ""]
    core = [row for row in rows if not row.deeper]
    following = next((row for row in core if row.following), None)
    if begun and following is not None:
        lines += [
            f"**Next:** {_link(following)}, exercise `{following.following}`. "
            f"About {sum(row.minutes for row in core)} minutes of core exercises are left in all.",
            "",
        ]
    elif begun and rows:
        lines += ["All core exercises have passed.", ""]
    heads = ("lesson", "exercises done", "left", "next") if begun else (
        "lesson", "exercises", "minutes",
    )  # fmt: skip
    lines += [_line(heads), _line(["---"] * len(heads))]
    for row in rows:
        if begun:
            after = f"`{row.following}`" if row.following else ""
            done = f"{_bar(row)} {row.done} of {row.total}"
            lines.append(_line((_link(row), done, _left(row), after)))
        else:
            lines.append(_line((_link(row), str(row.total), f"about {row.minutes}")))
    return "\n".join(lines) + "\n"


def write_page(work: Path, passed: Collection[str]) -> None:
    """Bring the page in work/ up to date; a file of the student's by that name, or a folder
    that cannot be written, is left.
    """
    names = {path.name for path in (work.parent / "lessons").glob("*.ipynb")}
    target, text = work / PAGE, page(names, passed)
    with contextlib.suppress(OSError, UnicodeDecodeError):
        if target.exists():
            there = target.read_text(encoding="utf-8")
            if there == text or not there.startswith(OURS):
                return
        beside = work / f".{secrets.token_hex(8)}.part"
        try:
            beside.write_text(text, encoding="utf-8", newline="\n")
            os.replace(beside, target)
        finally:
            beside.unlink(missing_ok=True)


def _link(row: Row) -> str:
    return f"[{row.number} {row.title}]({row.file_name})"


def _left(row: Row) -> str:
    return f"{row.minutes}\N{NO-BREAK SPACE}min" if row.following else "done"


def _bar(row: Row) -> str:
    return f'<progress max="{max(row.total, 1)}" value="{row.done}"></progress>'


def _line(cells: Collection[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def _cell(
    inner: str, tag: str = "td", *, scope: str = "row", code: bool = False
) -> str:
    extra = f' scope="{scope}"' if tag == "th" else ""
    if code and inner:  # a long name may break, or the titles get no room
        inner = f"<code>{inner.replace('_', '_<wbr>')}</code>"
    nowrap = "" if tag == "th" or code else "; white-space: nowrap"
    return f'<{tag}{extra} style="text-align: left{nowrap}">{inner}</{tag}>'
