"""How submissions are run on this machine, and how they are isolated while they run."""

from __future__ import annotations

import contextlib
import json
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from course.exercises.notebook_file import Outline, UnusableNotebook
from course.exercises.question import Question
from course.sandbox.box import Isolation, Start, bubblewrap, start_in_box, start_plain
from course.sandbox.findings import Run
from course.sandbox.limits import Limits
from course.sandbox.session import SandboxFailure, Session
from course.sandbox.watching import watches_memory


@dataclass(frozen=True)
class Sandbox:
    """How submissions are run: in a box or, where ``boxed`` is false, in a plain process."""

    limits: Limits = field(default_factory=Limits)
    boxed: bool = False
    cancel: threading.Event | None = None

    @contextlib.contextmanager
    def submission(
        self, content: bytes, file: str, lessons: Sequence[Outline]
    ) -> Iterator[Session]:
        """A session with the process of one submission; nothing of it is left afterwards, neither process nor file.

        Raises ``UnusableNotebook`` with the reason, ``SandboxFailure``, ``Cancelled``.
        """
        with contextlib.ExitStack() as stack:
            stack.enter_context(_as_failures())
            start = self._start(stack)
            session = Session(start, self.limits, boxed=self.boxed, cancel=self.cancel)
            stack.callback(session.close)
            session.read(content, file, lessons)
            yield session

    def _start(self, stack: contextlib.ExitStack) -> Start:
        if self.boxed:
            return start_in_box(self.limits.memory_mb, self.limits.file_mb)
        folder = tempfile.TemporaryDirectory(prefix="course-", ignore_cleanup_errors=True)  # fmt: skip
        stack.callback(_remove, folder)
        return start_plain(Path(folder.name).resolve())


def find_isolation(limits: Limits) -> Isolation:
    """How submissions are isolated here, found out by a run; raises ``SandboxFailure`` where none can run."""
    linux = sys.platform.startswith("linux")
    reason = "bubblewrap is not installed" if linux else "this system has no bubblewrap"
    if bubblewrap() is not None:
        try:
            return Isolation(
                True, ("bubblewrap", *_probe(Sandbox(limits, boxed=True)), "audit hook")
            )
        except SandboxFailure as failure:
            reason = " ".join(str(failure).split())[:300]
    watched = ("memory by watching",) if watches_memory() else ()
    parts = ("separate process", *_probe(Sandbox(limits)), *watched, "audit hook")
    return Isolation(False, parts, reason)


def _probe(sandbox: Sandbox) -> tuple[str, ...]:
    """The limits that took hold on a plain answer."""
    cell = {"cell_type": "code", "source": "def probe(): return 1.0", "metadata": {}}
    notebook = json.dumps({"nbformat": 4, "cells": [cell]})
    outline = Outline("00", ("probe",))
    question = Question("probe", "function", (), 1, ({},), (1,))
    try:
        with sandbox.submission(notebook.encode(), "probe.ipynb", [outline]) as session:
            (answers,) = session.answers([question])
    except UnusableNotebook as error:
        raise SandboxFailure(str(error)) from error
    run = answers.runs[-1] if answers.runs else Run("ended", detail="no answer")
    outcomes = run.reply.answer.outcomes if run.reply else ()
    if run.reply is None or [o.kind for o in outcomes] != ["value"]:
        raise SandboxFailure(f"a plain answer could not be run: {run.end} {run.detail}")
    return ("clock", *run.reply.held)


@contextlib.contextmanager
def _as_failures() -> Iterator[None]:
    """Errors of this machine, raised as such."""
    try:
        yield
    except OSError as error:
        raise SandboxFailure(f"no process for a submission: {error}") from error


def _remove(folder: tempfile.TemporaryDirectory[str]) -> None:
    with contextlib.suppress(
        RecursionError
    ):  # folders in folders, deeper than Python can follow
        folder.cleanup()
