"""The table of marks: one row a submission, written as each is judged, so that a batch cut off keeps what it has.

The table is its own memory: its last column, ``key``, is a digest of everything the marks hang on, and a row whose key
still fits is not made again. A row that was cut off has no key and is.
"""

from __future__ import annotations

import csv
import hashlib
import os
import re
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal

from course import __version__
from course.exercises.definition import Lesson
from course.exercises.notebook_file import NotebookFile
from course.grading.judge import Row
from course.grading.limits import Limits
from course.grading.reply import clean

FIRST = ("file", "student", "lesson", "total", "out_of", "state", "reason")
LAST = ("seed", "isolation", "key")
KEY = re.compile(r"[0-9a-f]{64}")
#: A spreadsheet takes a cell that begins with one of these (full-width forms too) for a formula.
FORMULA = tuple("=+-@\t\r\n\uff1d\uff0b\uff0d\uff20")
CELL_LIMIT = 2_000

State = Literal["marked", "needs a person", "unusable"]


@dataclass(frozen=True)
class Submission:
    """One file that was handed in: whose it is, which lesson, and the rows of its exercises.

    A file that cannot be marked has no lesson and no rows, and ``reason`` says why.
    """

    file: str
    student: str
    key: str
    lesson: Lesson | None = None
    rows: tuple[Row, ...] = ()
    reason: str = ""

    @property
    def state(self) -> State:
        """Whether it is marked, or a person has to look at it, or it cannot be used."""
        if self.lesson is None:
            return "unusable"
        return (
            "needs a person"
            if any(row.points is None for row in self.rows)
            else "marked"
        )

    @property
    def total(self) -> int:
        """The points that are certain; a person may add to them."""
        return sum(row.points or 0 for row in self.rows)

    @property
    def out_of(self) -> int:
        """The points of all exercises of the lesson, core and stretch."""
        return sum(row.exercise.points for row in self.rows)


def digest_of(content: bytes, file: str, notebook: NotebookFile | None) -> str:
    """A digest of what a submission is: its bytes, its name, the lesson it is judged by, and this version."""
    lesson = notebook.lesson if notebook else None
    exercises = (
        [(e.name, e.points, e.kind, len(e.mistakes)) for e in lesson.exercises]
        if lesson
        else []
    )
    told = [__version__, file, lesson.file_name if lesson else "", exercises]
    return hashlib.sha256(
        repr(told).encode("utf-8", "replace") + b"\0" + content
    ).hexdigest()


def key_of(digest: str, seed: int, limits: Limits) -> str:
    """A digest of all that a submission's marks hang on: what it is, the seed and the limits."""
    return hashlib.sha256(
        repr([digest, seed, sorted(asdict(limits).items())]).encode()
    ).hexdigest()


def columns(exercises: Iterable[str]) -> tuple[str, ...]:
    """The table's columns for these exercises: points, state and reason of each."""
    own = [
        column
        for name in exercises
        for column in (name, f"{name}_state", f"{name}_reason")
    ]
    return (*FIRST, *own, *LAST)


def cells_of(submission: Submission, seed: int, isolation: str) -> dict[str, str]:
    """A submission as cells of the table, by column, safe to open in a spreadsheet."""
    lesson = submission.lesson
    cells: dict[str, Any] = {
        "file": submission.file, "student": submission.student,
        "lesson": f"{lesson.number}-{lesson.name}" if lesson else "", "total": submission.total,
        "out_of": submission.out_of if lesson else "", "state": submission.state, "reason": submission.reason,
        "seed": seed, "isolation": isolation, "key": submission.key,
    }  # fmt: skip
    for row in submission.rows:
        name = row.exercise.name
        cells[name] = "" if row.points is None else row.points
        cells[f"{name}_state"], cells[f"{name}_reason"] = row.state, row.reason
    return {column: safe_cell(value) for column, value in cells.items()}


def safe_cell(value: Any) -> str:
    """A value as a cell's text: on one line, and never a formula (a leading apostrophe makes it text)."""
    if isinstance(value, int):
        return str(value)
    text = clean(" ".join(str(value).split()), CELL_LIMIT)
    return "'" + text if text.startswith(FORMULA) else text


def read_table(path: Path) -> tuple[tuple[str, ...], list[dict[str, str]]]:
    """The exercises and the whole rows of a table written before; nothing for a file that is none.

    Raises ``ValueError`` for a file that holds something else: it is not ours to write over.
    """
    if not path.exists() or path.stat().st_size == 0:
        return (), []
    try:
        with path.open(encoding="utf-8", errors="replace", newline="") as file:
            lines = list(csv.reader(file))
    except (OSError, csv.Error) as error:
        raise ValueError(
            f"out: expected a table of marks or a new file; {path} cannot be read ({error})"
        ) from None
    header = tuple(lines[0]) if lines else ()
    exercises = tuple(column for column in header if f"{column}_state" in header)
    if header != columns(exercises):
        raise ValueError(
            f"out: expected a table of marks or a new file; {path} holds something else"
        )
    rows = [
        dict(zip(header, line, strict=True))
        for line in lines[1:]
        if len(line) == len(header)
    ]
    return exercises, [row for row in rows if KEY.fullmatch(row["key"])]


class Table:
    """The table on disk: whole rows first, then one more with every ``add``."""

    def __init__(
        self, path: Path, exercises: Sequence[str], rows: Sequence[Mapping[str, str]]
    ) -> None:
        self.path = path
        self.columns = columns(exercises)
        self.rows = list(rows)
        self._write_whole()
        self._file = path.open("a", encoding="utf-8", newline="")
        self._writer = self._writer_to(self._file)

    def add(self, cells: Mapping[str, str]) -> None:
        """Append a row; it is in the file when this returns."""
        self.rows.append(dict(cells))
        self._writer.writerow(cells)
        self._file.flush()

    def close(self) -> None:
        """Order the rows by file: they came in the order in which they were done."""
        self._file.close()
        self.rows.sort(key=lambda row: row["file"])
        try:
            self._write_whole()
        except OSError:
            pass  # somebody has the table open: every row is in it, in the order of their coming

    def _writer_to(self, file: Any) -> Any:
        return csv.DictWriter(file, self.columns, restval="", lineterminator="\n")

    def _write_whole(self) -> None:
        def write(file: Any) -> None:
            writer = self._writer_to(file)
            writer.writeheader()
            writer.writerows(self.rows)

        write_whole(self.path, write)


def write_whole(path: Path, write: Any) -> None:
    """Write a text file whole or not at all; ``write`` is called with it open."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".part")
    try:
        with os.fdopen(
            handle, "w", encoding="utf-8", errors="replace", newline=""
        ) as file:
            write(file)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
