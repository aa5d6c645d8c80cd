"""A batch's findings on one file, and its row in the table of marks."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from course.exercises.definition import Lesson
from course.exercises.untrusted_text import clean
from course.grading.judge import Row

FIRST = (
    "file", "student", "lesson", "total", "out_of", "state", "reason", "refused"
)  # fmt: skip
LAST = ("seed", "isolation", "page", "key")
#: Before the key of a row whose submission the next call judges again: the fault was
#: the machine's.
AGAIN = "again-"
#: A spreadsheet takes a cell that begins with one of these (full-width forms too) for a
#: formula.
FORMULA = tuple("=+-@\t\r\n\uff1d\uff0b\uff0d\uff20")
#: Where a semicolon separates cells, one of these behind it would begin a formula, too.
INNER_FORMULA = re.compile(r"(;[\s\"]*)(?=[=+\-@\uff1d\uff0b\uff0d\uff20])")
CELL_LIMIT = 2_000
#: How the isolation of a row begins if its submission could do whatever the grader can.
TRUSTED = "trusted"
TRUSTED_MEANS = (
    "Submissions were trusted: nothing but a hook stood between them "
    "and what the grader may read and write."
)

State = Literal["marked", "needs a person", "unusable"]


@dataclass(frozen=True)
class Submission:
    """One file that was handed in: whose it is, which lesson, and its exercises' rows.

    A file that cannot be marked has no lesson and no rows, and ``reason`` says why.
    ``refused`` is what its code attempted and was denied. With ``again`` a fault of
    this machine stood in the way: a person has to look, or the next call judges it
    again.
    """

    file: str
    student: str
    key: str
    lesson: Lesson | None = None
    rows: tuple[Row, ...] = ()
    reason: str = ""
    refused: tuple[str, ...] = ()
    again: bool = False

    @property
    def state(self) -> State:
        """Whether it is marked, needs a person, or cannot be used."""
        if self.again or any(row.points is None for row in self.rows):
            return "needs a person"
        return "marked" if self.lesson else "unusable"

    @property
    def total(self) -> int:
        """The points that are certain; a person may add to them."""
        return sum(row.points or 0 for row in self.rows)

    @property
    def out_of(self) -> int:
        """The points of all exercises of the lesson, core and stretch."""
        return sum(row.exercise.points for row in self.rows)


def columns(exercises: Iterable[str], more: Iterable[str] = ()) -> tuple[str, ...]:
    """The table's columns: points, state and reason of each exercise between the
    others.

    ``more`` are columns that a person added.
    """
    own = [
        column
        for name in exercises
        for column in (name, f"{name}_state", f"{name}_reason")
    ]
    return (*FIRST, *own, *more, *LAST)


def exercises_of(cells: Mapping[str, str]) -> list[str]:
    """The exercises that a header or a row has columns for."""
    return [
        name for name in cells if f"{name}_state" in cells and f"{name}_reason" in cells
    ]


def cells_of(
    submission: Submission, seed: int, isolation: str, page: str = ""
) -> dict[str, str]:
    """A submission as cells of the table, by column, safe to open in a spreadsheet."""
    lesson = submission.lesson
    cells: dict[str, Any] = {
        "file": submission.file, "student": submission.student,
        "lesson": lesson.stem if lesson else "", "total": submission.total,
        "out_of": submission.out_of if lesson else "", "state": submission.state, "reason": submission.reason,
        "refused": "; ".join(submission.refused), "seed": seed, "isolation": isolation, "page": page,
        "key": AGAIN * submission.again + submission.key,
    }  # fmt: skip
    for row in submission.rows:
        name = row.exercise.name
        cells[name] = "" if row.points is None else row.points
        cells[f"{name}_state"], cells[f"{name}_reason"] = row.state, row.reason
    return {column: safe_cell(value) for column, value in cells.items()}


def safe_cell(value: Any) -> str:
    """A value as a cell's text: on one line, and never a formula.

    A leading apostrophe makes it text.
    """
    if isinstance(value, int):
        return str(value)
    text = clean(" ".join(str(value).split()), CELL_LIMIT)
    text = INNER_FORMULA.sub(r"\1'", text)
    return "'" + text if text.startswith(FORMULA) else text


def cell_text(cell: str) -> str:
    """The text of a cell without the apostrophe that stops a spreadsheet from
    evaluating it.
    """
    return cell[1:] if cell[:1] == "'" and cell[1:].startswith(FORMULA) else cell
