"""Mark a folder of submissions, or check one notebook.

What ``course grade`` and ``course check`` call.
"""

from __future__ import annotations

import contextlib
import os
import secrets
import threading
import time
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from course.exercises.definition import Lesson, all_lessons
from course.exercises.message import SYMBOLS, WORDS
from course.grading.batch import Batch, Progress, standing
from course.grading.feedback import INDEX, write_overview
from course.grading.fingerprints import grader_version, key_of
from course.grading.index import write_index
from course.grading.judge import Judge, Row
from course.grading.lock import Lock
from course.grading.naming import page_names
from course.grading.report import AGAIN, TRUSTED, TRUSTED_MEANS, safe_cell
from course.grading.stopping import Stopping
from course.grading.submissions import (
    Task,
    find_tasks,
    read_plain_file,
    write_marker,
)
from course.grading.table import Found, Table, read_table
from course.grading.writing import CannotWrite
from course.sandbox.box import Isolation
from course.sandbox.limits import Limits
from course.sandbox.running import Sandbox, find_isolation
from course.sandbox.session import SandboxFailure

#: For the causes of a submission's wrong answers.
REPAIR_SECONDS = 2.0


@dataclass(frozen=True)
class Summary:
    """The result of a batch: submissions counted by state, the seed, the isolation.

    Of those that need a person, ``again`` failed through no fault of their author; the
    next call judges them again. ``unwritten`` says for each page that could not be
    written which it is, why, and what to do about it.
    """

    out: Path
    feedback: Path
    seed: int
    submissions: int
    kept: int
    marked: int
    needs_person: int
    unusable: int
    seconds: float
    isolation: str
    again: int = 0
    unwritten: tuple[str, ...] = ()

    def __str__(self) -> str:
        lines = [
            f"{self.submissions} submissions in {self.seconds:.1f} s, {self.kept} of them unchanged: "
            f"{self.marked} marked, {self.needs_person} need a person, {self.unusable} cannot be used",
            f"table {self.out}, pages in {self.feedback}, all of them in {self.feedback / INDEX}",
            f"seed {self.seed} (repeat with --seed {self.seed}); isolated by: {self.isolation}",
        ]
        if self.isolation.startswith(TRUSTED):
            lines.append(TRUSTED_MEANS)
        if self.again:
            lines.append(
                f"{self.again} could not be marked, through no fault of their authors; the same command retries them"
            )
        if self.unwritten:
            lines.append(
                f"{len(self.unwritten)} pages are missing: {self.unwritten[0]}"
            )
        return "\n".join(lines)


@dataclass(frozen=True)
class Check:
    """The rows of one notebook; as text a table, with the findings below it."""

    lesson: Lesson
    rows: tuple[Row, ...]

    @property
    def passed(self) -> bool:
        """Whether every exercise is right."""
        return all(row.state == "passed" for row in self.rows)

    def __iter__(self) -> Iterator[Row]:
        return iter(self.rows)

    def __len__(self) -> int:
        return len(self.rows)

    def __str__(self) -> str:
        width = max((len(row.exercise.name) for row in self.rows), default=0)
        lines = [
            f"{SYMBOLS[r.state]} {r.exercise.name:<{width}}  {'?' if r.points is None else r.points}"
            f"/{r.exercise.points}  {WORDS[r.state]}"
            for r in self.rows
        ]
        found = [
            str(r.message)
            for r in self.rows
            if r.state not in ("passed", "not attempted")
        ]
        return "\n".join(
            [f"{self.lesson.number} {self.lesson.title}", *lines]
        ) + "".join("\n\n" + f for f in found)


def check_notebook(
    path: Path, *, time_limit: float = 10.0, memory_mb: int = 2000, lessons: Sequence[Lesson] | None = None,
    on_row: Callable[[Row], None] | None = None,
) -> Check:  # fmt: skip
    """Run a notebook's exercises on the inputs of its own check.

    ``on_row`` is called with each row as soon as it is known. Raises
    ``UnusableNotebook`` (a ``ValueError``) where the file cannot be marked.
    """
    limits = Limits(time_limit, memory_mb)
    known = all_lessons() if lessons is None else tuple(lessons)
    path = Path(path)
    content = read_plain_file(path)
    judge = Judge(None, Sandbox(limits, find_isolation(limits).boxed), known)
    lesson, found = judge.rows(content, path.name)
    rows = []
    for row in found:
        rows.append(row)
        if on_row is not None:
            on_row(row)
    return Check(lesson, tuple(rows))


def grade_folder(
    folder: Path, out: Path, *, seed: int | None = None, time_limit: float = 10.0, memory_mb: int = 2000,
    feedback: Path | None = None, on_progress: Progress | None = None, lessons: Sequence[Lesson] | None = None,
    workers: int | None = None, force: bool = False, require_sandbox: bool = False,
    repair_seconds: float = REPAIR_SECONDS,
) -> Summary:  # fmt: skip
    """Mark every file in a folder and below: a table (CSV) and an HTML page each.

    A student with several submissions gets a page of their own as well, and the grader
    gets one for everybody (``index.html``). The table is written to ``out``.

    ``seed`` draws the inputs; without one, an existing table's seed is used, so that an
    interrupted batch continues, and otherwise a random one. ``time_limit`` [s] and
    ``memory_mb`` apply to each exercise; ``feedback`` is the folder of the pages
    (default: beside the table). Rows whose submission, seed, limits and grader are
    unchanged are kept, unless ``force``. With ``require_sandbox`` nothing is run where
    submissions would have to be trusted. ``repair_seconds`` is for how long a
    submission's wrong answers that no planted mistake explains are searched for their
    cause, after their marks are decided; 0 for no search. Rows that are kept keep theirs.

    On Ctrl-C, SIGTERM and SIGHUP (``Stopped``, a ``KeyboardInterrupt``) finished rows
    are in the table, and the next call continues from there.

    Raises ``ValueError`` for unusable arguments and where another grader writes to the
    table (``Locked``), ``SandboxFailure`` where no answer can be run at all,
    ``CannotWrite`` where the disk is full.
    """
    started = time.monotonic()
    folder, out = Path(folder), Path(out)
    beside = out.with_name(f"{out.stem}-feedback")
    feedback = Path(feedback) if feedback is not None else beside
    limits = Limits(time_limit, memory_mb)
    _require(folder, out, feedback, seed)
    known = all_lessons() if lessons is None else tuple(lessons)
    with Stopping() as stopping, _locked(out, feedback) as locks:
        tasks = find_tasks(folder, known, feedback, own=(out, feedback, *locks))
        found = read_table(out)
        seed = _seed(found, tasks) if seed is None else seed
        version = grader_version(known)
        keys = {key_of(task.digest, version, seed, limits): task for task in tasks}
        stand, stale = standing(
            found.rows, {} if force else keys, tasks, boxed=require_sandbox
        )
        done = {row["key"] for row in stand}
        todo = [task for key, task in keys.items() if key not in done]
        with stopping.put_off():  # its process has ended and its folder is gone
            isolation = find_isolation(limits) if todo or require_sandbox else None
        stopping.check()
        if require_sandbox and isolation and not isolation.boxed:
            raise SandboxFailure(
                f"no box for submissions ({isolation.reason}), and --require-sandbox was given"
            )
        write_marker(feedback)
        table = Table(out, _exercises(known), stand, stale=stale, more=found.more)
        boxed = isolation is not None and isolation.boxed
        judge = Judge(
            seed, Sandbox(limits, boxed, threading.Event()), known, repair_seconds
        )
        batch = Batch(judge, seed, version, table, str(isolation or ""))
        try:
            many = workers or os.cpu_count() or 1
            batch.mark(todo, len(tasks), many, on_progress or _quietly, stopping)
        finally:
            with stopping.put_off():
                table.close()
        rows = _rows_of(tasks, table)
        missing = _pages_of_all(feedback, tasks, rows, known, seed)
    states = [row["state"] for row in rows]
    return Summary(
        out, feedback, seed, len(tasks), len(tasks) - len(todo), states.count("marked"),
        states.count("needs a person"), states.count("unusable"), time.monotonic() - started,
        _isolation(isolation, rows),
        sum(row["key"].startswith(AGAIN) for row in rows), (*batch.unwritten, *missing),
    )  # fmt: skip


def _isolation(isolation: Isolation | None, rows: Sequence[Mapping[str, str]]) -> str:
    """What shut submissions in: where some were trusted, in this call or before, theirs."""
    isolations = [
        *([str(isolation)] if isolation else []),
        *(row["isolation"] for row in rows),
    ]
    return next((one for one in isolations if one.startswith(TRUSTED)), isolations[0])


@contextlib.contextmanager
def _locked(out: Path, feedback: Path) -> Iterator[tuple[Path, Path]]:
    """Lock the table and the pages; yields the lock files' paths."""
    table, pages = (path.with_name(path.name + ".lock") for path in (out, feedback))
    with contextlib.ExitStack() as held:
        for lock, what in ((table, out), (pages, feedback)):
            try:
                lock.parent.mkdir(parents=True, exist_ok=True)
                held.enter_context(Lock(lock, str(what)))
            except OSError as error:
                raise CannotWrite(lock, error) from error
        yield table, pages


def _exercises(lessons: Sequence[Lesson]) -> list[str]:
    return [exercise.name for lesson in lessons for exercise in lesson.exercises]


def _seed(found: Found, tasks: Sequence[Task]) -> int:
    """The seed of these files' rows in the table; a random one where there is none."""
    files = {safe_cell(task.file) for task in tasks}
    seeds = [
        int(row["seed"])
        for row in found.rows
        if row["file"] in files and row["seed"].isdigit()
    ]
    return seeds[-1] if seeds else secrets.randbelow(2**32)


def _rows_of(tasks: Sequence[Task], table: Table) -> list[dict[str, str]]:
    """The rows of these submissions in the table's order, each with its own page."""
    pages = {safe_cell(task.page.name) for task in tasks}
    return [row for row in table.rows if row["page"] in pages]


def _pages_of_all(
    feedback: Path,
    tasks: Sequence[Task],
    rows: Sequence[Mapping[str, str]],
    lessons: Sequence[Lesson],
    seed: int,
) -> list[str]:
    """Write the grader's page, and one per student with several submissions.

    Returns the reasons for the pages that could not be written.
    """
    students = {task.page.name: task.student for task in tasks}
    by_student = defaultdict(list)
    for row in rows:
        by_student[students[row["page"]].identity].append(row)
    several = [(who, own) for who, own in by_student.items() if len(own) > 1]
    first = [students[own[0]["page"]] for _, own in several]
    names = page_names([(s.name, s.identity) for s in first], prefix="student")
    overviews: dict[str, str] = {}
    missing = []
    for student, name, (_, own) in zip(first, names, several, strict=True):
        try:
            write_overview(feedback / name, student.name, own, seed=seed)
            overviews |= {row["page"]: name for row in own}
        except CannotWrite as error:
            missing.append(str(error))
    try:
        write_index(feedback / INDEX, rows, overviews, lessons, seed=seed)
    except CannotWrite as error:
        missing.append(str(error))
    return missing


def _quietly(done: int, total: int, file: str) -> None:
    return None


def _require(folder: Path, out: Path, feedback: Path, seed: int | None) -> None:
    if not folder.is_dir():
        raise ValueError(
            f"folder: expected a folder of submissions; got {folder}, which is none"
        )
    if out.exists() and not out.is_file():
        kind = "folder" if out.is_dir() else "device"
        raise ValueError(
            f"out: expected the name of a table, as in grades.csv; got the {kind} {out}"
        )
    if feedback.exists() and not feedback.is_dir():
        raise ValueError(f"feedback: expected a folder; got the file {feedback}")
    if seed is not None and not 0 <= seed < 2**63:
        raise ValueError(f"seed: expected a whole number from 0; got {seed!r}")
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        if out.exists():
            with out.open("a"):
                pass
    except OSError as error:
        raise CannotWrite(out, error) from None
