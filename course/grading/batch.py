"""Mark many submissions, several at a time.

A fault in one of them, whether ours or its own, stops no other.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass, field
from itertools import islice

from course.exercises.definition import Lesson
from course.exercises.notebook_file import UnusableNotebook
from course.grading.feedback import write_page
from course.grading.fingerprints import key_of
from course.grading.judge import Judge, Row
from course.grading.report import TRUSTED, Submission, cells_of, safe_cell
from course.grading.stopping import Stopping
from course.grading.submissions import Task, digest_of, read_content
from course.grading.table import Table
from course.grading.writing import CannotWrite
from course.sandbox.session import Cancelled, SandboxFailure

#: Called with how many submissions are done, how many there are, and the file just
#: finished ("" at the start).
Progress = Callable[[int, int, str], None]
PAUSE = 1.0  # seconds before an answer whose process did not start is tried again


@dataclass(frozen=True)
class Batch:
    """What the submissions of a batch share while they are marked.

    ``unwritten`` collects the pages that could not be written.
    """

    judge: Judge
    seed: int
    version: str
    table: Table
    isolation: str
    unwritten: list[str] = field(default_factory=list)

    def key(self, digest: str) -> str:
        """The digest of everything that the marks of a submission with this digest
        depend on.
        """
        return key_of(digest, self.version, self.seed, self.judge.sandbox.limits)

    def mark(
        self,
        todo: Sequence[Task],
        total: int,
        workers: int,
        tell: Progress,
        stopping: Stopping,
    ) -> None:
        """Judge several at a time; one thread writes rows and pages as they arrive.

        Only as many are started as will soon be judged, so that memory stays flat.
        Raises ``Stopped`` on a signal, after ending what was running, and
        ``CannotWrite`` where the disk has no room for the table.
        """
        done = total - len(todo)
        tell(done, total, "")
        waiting = iter(todo)
        running: dict[Future[Submission], Task] = {}
        with stopping.put_off(), ThreadPoolExecutor(workers) as pool:
            try:
                while True:
                    for task in islice(waiting, 2 * workers - len(running)):
                        running[pool.submit(self._judged, task)] = task
                    if not running:
                        break
                    # Wakes up now and then to look for a signal, which an endless wait
                    # may not let through.
                    ready, _ = wait(running, timeout=0.2, return_when=FIRST_COMPLETED)
                    for future in sorted(ready, key=list(running).index):
                        submission = future.result()
                        self._write(running.pop(future), submission)
                        done += 1
                        tell(done, total, submission.file)
                    stopping.check()
            except BaseException:
                assert self.judge.sandbox.cancel is not None
                self.judge.sandbox.cancel.set()
                for future in running:
                    future.cancel()
                raise

    def _write(self, task: Task, submission: Submission) -> None:
        """Write the page and then the row: a row without its page is made again by the
        next call.
        """
        try:
            write_page(task.page, submission, seed=self.seed, isolation=self.isolation)
        except CannotWrite as error:
            self.unwritten.append(str(error))
        except Exception as error:
            words = f"{task.page} could not be made: {type(error).__name__}: {error}"
            self.unwritten.append(words)
        self.table.add(cells_of(submission, self.seed, self.isolation, task.page.name))

    def _judged(self, task: Task) -> Submission:
        """The submission with its rows, or with the reason why there are none."""
        made = Submission(
            task.file, task.student.name, self.key(task.digest), reason=task.reason
        )
        if task.reason:
            return made
        problem = ""
        for pause in (PAUSE, 0.0):
            try:
                return self._with_rows(task)
            except UnusableNotebook as error:
                return _but(made, str(error))
            except Cancelled:
                raise
            except SandboxFailure as error:
                problem = str(error)
                time.sleep(pause)
            except OSError as error:
                words = f"cannot be read: {error.strerror or error}"
                return _but(made, words, again=True)
            except Exception as error:
                problem = f"{type(error).__name__}: {error}"
                break
        words = f"marking it failed, which is not its author's fault: {problem}"
        return _but(made, words, again=True)

    def _with_rows(self, task: Task) -> Submission:
        content = read_content(task)
        lesson, rows, refused = judged(self.judge, task, content)
        key = self.key(digest_of(task, content))
        return Submission(
            task.file, task.student.name, key, lesson, rows, refused=refused
        )


def judged(
    judge: Judge, task: Task, content: bytes
) -> tuple[Lesson, tuple[Row, ...], tuple[str, ...]]:
    """The judge's result for a submission: its lesson, the rows, what its code was
    refused.
    """
    lesson, found = judge.rows(content, task.file)
    rows = tuple(found)
    return lesson, rows, tuple(dict.fromkeys(r for row in rows for r in row.refused))


def _but(made: Submission, reason: str, *, again: bool = False) -> Submission:
    return Submission(made.file, made.student, made.key, reason=reason, again=again)


def standing(
    rows: Sequence[Mapping[str, str]],
    keys: Mapping[str, Task],
    tasks: Iterable[Task],
    *,
    boxed: bool = False,
) -> tuple[list[dict[str, str]], list[dict[str, str]]]:
    """The rows of an old table that are kept, and those whose submission is marked
    again.

    A row stands whose key is one of ``keys`` and whose page is there, and one whose
    file is none of these ``tasks``; with ``boxed`` none whose submission was trusted.
    """
    files = {safe_cell(task.file) for task in tasks}
    stand, stale = [], []
    for row in rows:
        task = keys.get(row["key"])
        enough = not (boxed and row["isolation"].startswith(TRUSTED))
        if task is not None and task.page.exists() and enough:
            # A spreadsheet may have made a date or a number of a name.
            stand.append(_named(row, task))
        elif task is not None or row["file"] in files:
            stale.append(dict(row))
        else:
            stand.append(dict(row))
    return stand, stale


def _named(row: Mapping[str, str], task: Task) -> dict[str, str]:
    return {
        **row, "file": safe_cell(task.file), "student": safe_cell(task.student.name),
        "page": safe_cell(task.page.name),
    }  # fmt: skip
