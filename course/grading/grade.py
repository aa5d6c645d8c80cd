"""Mark a folder of submissions, or check one notebook: what ``course grade`` and ``course check`` call."""

from __future__ import annotations

import os
import secrets
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from dataclasses import dataclass
from pathlib import Path

from course.exercises.definition import Lesson, all_lessons
from course.exercises.message import SYMBOLS, WORDS, verdict_message
from course.exercises.notebook_file import read_notebook
from course.grading.feedback import write_overview, write_page
from course.grading.judge import Judge, Row
from course.grading.limits import Limits
from course.grading.report import (
    Submission,
    Table,
    cells_of,
    key_of,
    read_table,
    safe_cell,
)
from course.grading.sandbox import Cancelled, SandboxFailure, isolation
from course.grading.submissions import Task, find_tasks, page_name

#: Called with how many submissions are done, how many there are, and the file just done ("" at the start).
Progress = Callable[[int, int, str], None]


@dataclass(frozen=True)
class Summary:
    """What a batch came to: counts of submissions by state, the seed, and how answers were shut in."""

    out: Path
    feedback: Path
    seed: int
    submissions: int
    kept: int
    marked: int
    needs_person: int
    unusable: int
    seconds: float
    isolation: tuple[str, ...]

    def __str__(self) -> str:
        return (
            f"{self.submissions} submissions in {self.seconds:.1f} s, {self.kept} of them as they were: "
            f"{self.marked} marked, {self.needs_person} need a person, {self.unusable} cannot be used\n"
            f"table {self.out}, pages in {self.feedback}\n"
            f"seed {self.seed} (repeat with --seed {self.seed}); shut in by: {', '.join(self.isolation)}"
        )


@dataclass(frozen=True)
class Check:
    """The rows of one notebook; as text a table, with what was found below it."""

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
            str(verdict_message(r.exercise, r.verdict))
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
    """Run a notebook's exercises on the inputs of its own check; ``on_row`` sees each row as it is found out.

    Raises ``UnusableNotebook`` (a ``ValueError``) where the file cannot be marked.
    """
    judge = Judge(None, Limits(time_limit, memory_mb))
    notebook = read_notebook(Path(path), lessons)
    rows = []
    for row in judge.rows(notebook):
        rows.append(row)
        if on_row is not None:
            on_row(row)
    return Check(notebook.lesson, tuple(rows))


def grade_folder(
    folder: Path, out: Path, *, seed: int | None = None, time_limit: float = 10.0, memory_mb: int = 2000,
    feedback: Path | None = None, on_progress: Progress | None = None, lessons: Sequence[Lesson] | None = None,
    workers: int | None = None,
) -> Summary:  # fmt: skip
    """Mark every file in a folder and below it: a table (CSV) at ``out`` and a page (HTML) a submission.

    A student who handed in several gets a page of their own as well, with all of them.

    ``seed`` draws the inputs; without one, a table that is there gives its own, so that a batch cut off goes on, and
    else it is random. ``time_limit`` [s] and ``memory_mb`` hold for each exercise; ``feedback`` is the folder of the
    pages (default: beside the table). Rows whose submission, seed and limits are as they were are kept. On
    ``KeyboardInterrupt`` what is done is in the table, and the next call goes on from there.

    Raises ``ValueError`` for arguments that cannot be used, ``SandboxFailure`` where no answer can be run at all.
    """
    started = time.monotonic()
    folder, out = Path(folder), Path(out)
    feedback = (
        Path(feedback)
        if feedback is not None
        else out.with_name(f"{out.stem}-feedback")
    )
    limits = Limits(time_limit, memory_mb)
    _require(folder, out, feedback, seed)
    exercises, old = read_table(out)
    known = all_lessons() if lessons is None else tuple(lessons)
    tasks = find_tasks(folder, known, feedback, own=(out, feedback))
    files = {safe_cell(task.file) for task in tasks}
    if seed is None:
        seeds = [
            int(row["seed"])
            for row in old
            if row["file"] in files and row["seed"].isdigit()
        ]
        seed = seeds[-1] if seeds else secrets.randbelow(2**32)
    keys = {key_of(task.digest, seed, limits): task for task in tasks}
    kept = [
        row for row in old if row["file"] not in files or _stands(keys.get(row["key"]))
    ]
    done = {row["key"] for row in kept}
    todo = {key: task for key, task in keys.items() if key not in done}
    shut_in = isolation(limits) if todo else ()
    table = Table(out, _exercises(known, tasks, exercises), kept)
    try:
        batch = _Batch(
            Judge(seed, limits, threading.Event()), seed, table, ", ".join(shut_in)
        )
        batch.mark(
            todo, len(tasks), workers or os.cpu_count() or 1, on_progress or _quietly
        )
    finally:
        table.close()
    ours = [row for row in table.rows if row["key"] in keys]
    _overviews(feedback, keys, {row["key"]: row for row in ours}, seed)
    states = [row["state"] for row in ours]
    return Summary(
        out, feedback, seed, len(tasks), len(tasks) - len(todo), states.count("marked"),
        states.count("needs a person"), states.count("unusable"), time.monotonic() - started,
        shut_in or tuple(ours[0]["isolation"].split(", ")),
    )  # fmt: skip


@dataclass(frozen=True)
class _Batch:
    """What the submissions of a batch share while they are marked."""

    judge: Judge
    seed: int
    table: Table
    isolation: str

    def mark(
        self, todo: Mapping[str, Task], total: int, workers: int, tell: Progress
    ) -> None:
        """Judge several at a time; rows and pages are written here, by one thread, as they come."""
        done = total - len(todo)
        tell(done, total, "")
        with ThreadPoolExecutor(workers) as pool:
            tasks = {
                pool.submit(self._judged, key, task): task for key, task in todo.items()
            }
            running = set(tasks)
            try:
                while running:
                    # Woken now and then: a wait without end does not hear Ctrl-C on every platform.
                    ready, running = wait(
                        running, timeout=0.5, return_when=FIRST_COMPLETED
                    )
                    for future in ready:
                        submission = future.result()
                        write_page(tasks[future].page, submission, seed=self.seed)
                        self.table.add(cells_of(submission, self.seed, self.isolation))
                        done += 1
                        tell(done, total, submission.file)
            except BaseException:
                assert self.judge.cancel is not None
                self.judge.cancel.set()
                for future in running:
                    future.cancel()
                raise

    def _judged(self, key: str, task: Task) -> Submission:
        """The submission with its rows. A fault of ours with one of them is told in its row and stops no other."""
        if task.notebook is None:
            return Submission(task.file, task.student, key, reason=task.reason)
        try:
            rows = tuple(self.judge.rows(task.notebook))
        except (SandboxFailure, Cancelled):
            raise
        except Exception as error:
            reason = f"marking it failed, which is not its author's fault: {type(error).__name__}: {error}"
            return Submission(task.file, task.student, key, reason=reason)
        return Submission(task.file, task.student, key, task.notebook.lesson, rows)


def _stands(task: Task | None) -> bool:
    """Whether a row found in the table is still right: its submission is there as it was, and so is its page."""
    return task is not None and task.page.exists()


def _overviews(
    feedback: Path,
    tasks: Mapping[str, Task],
    rows: Mapping[str, Mapping[str, str]],
    seed: int,
) -> None:
    """A page for every student with more than one submission; told apart by name, as their pages are."""
    by_student: dict[str, list[tuple[str, Mapping[str, str]]]] = {}
    for key, task in tasks.items():
        if task.student and key in rows:
            by_student.setdefault(task.student, []).append((task.page.name, rows[key]))
    for student, handed_in in by_student.items():
        if len(handed_in) > 1:
            handed_in.sort(key=lambda one: one[1]["file"])
            write_overview(
                feedback / f"{page_name(student)}.html", student, handed_in, seed=seed
            )


def _quietly(done: int, total: int, file: str) -> None:
    return None


def _require(folder: Path, out: Path, feedback: Path, seed: int | None) -> None:
    if not folder.is_dir():
        raise ValueError(
            f"folder: expected a folder of submissions; got {folder}, which is none"
        )
    if out.is_dir():
        raise ValueError(
            f"out: expected the name of a table, as in grades.csv; got the folder {out}"
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
        raise ValueError(
            f"out: {error.filename} cannot be written ({error.strerror}): is it open elsewhere?"
        ) from None


def _exercises(
    known: Sequence[Lesson], tasks: Sequence[Task], old: Sequence[str]
) -> tuple[str, ...]:
    """The exercises that get columns: of the lessons that were handed in, in their order, then those of old rows."""
    found = {task.notebook.lesson.number for task in tasks if task.notebook}
    names = [
        e.name for lesson in known if lesson.number in found for e in lesson.exercises
    ]
    return (*names, *(name for name in old if name not in names))
