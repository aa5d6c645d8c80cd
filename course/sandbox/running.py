"""A submission's process as the grader sees it: start, read, ask for exercises, end.

What comes back is untrusted data: it is checked here, and nothing of it is executed.
"""

from __future__ import annotations

import contextlib
import json
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from course.exercises.notebook_file import Outline, UnusableNotebook
from course.sandbox import messages, wire
from course.sandbox.box import Isolation, Start, bubblewrap, start_in_box, start_plain
from course.sandbox.ending import ENDS, WITHOUT_REPLY, End, end_of
from course.sandbox.limits import Limits
from course.sandbox.reply import Reply, checked_reply, clean
from course.sandbox.watching import START_SECONDS, Seen, watches_memory

#: Seconds for reading a notebook, once its process has started; a lesson of fifty cells
#: takes a hundredth of that.
READ_SECONDS = 10.0
#: Seconds beyond the limits of a run, for its process to report.
GRACE_SECONDS = 15.0
#: Without forks a process answers one question.
FORKS = sys.platform != "win32"


class SandboxFailure(RuntimeError):
    """A submission's process could not be started: this machine's fault, not the
    author's.
    """


class Cancelled(Exception):
    """The batch was stopped while a submission was running."""


@dataclass(frozen=True)
class Question:
    """An exercise to be answered.

    Its place in the lesson, the answer's name and kind, the declared arguments, how
    many results, the inputs of every case, and how many numbers each may give at most.
    """

    index: int
    name: str
    kind: str
    arguments: tuple[str, ...]
    results: int
    cases: tuple[Mapping[str, Any], ...]
    most: tuple[int, ...]


@dataclass(frozen=True)
class Found:
    """What reading found for an exercise: "blank", "fault" (and why), or "run".

    ``cells`` is how many cells are run.
    """

    state: str
    fault: str = ""
    nearest: str = ""
    needs_person: bool = False
    cells: int = 0


@dataclass(frozen=True)
class Reading:
    """What a notebook is: its lesson's number, and what was found for each exercise."""

    lesson: str
    exercises: tuple[Found, ...]


@dataclass(frozen=True)
class Run:
    """How the run of an exercise ended.

    ``stage`` ("cell" or "case") and ``index`` say where; ``reply`` is set if one came;
    ``refused`` is what it attempted in vain; ``by`` is the exercise that blocked a
    "blocked" run.
    """

    end: End
    stage: str = ""
    index: int = 0
    reply: Reply | None = None
    detail: str = ""
    seconds: float = 0.0
    refused: tuple[str, ...] = ()
    by: int = -1


@dataclass(frozen=True)
class Sandbox:
    """How submissions are run on this machine: boxed, or in a plain process."""

    limits: Limits = field(default_factory=Limits)
    boxed: bool = False
    cancel: threading.Event | None = None

    @contextlib.contextmanager
    def submission(
        self, content: bytes, file: str, lessons: Sequence[Outline]
    ) -> Iterator[Session]:
        """A session with the process of one submission; leaves neither process nor file
        behind.

        Raises ``UnusableNotebook`` with the reason, ``SandboxFailure``, ``Cancelled``.
        """
        with contextlib.ExitStack() as stack:
            stack.enter_context(_as_failures())
            session = Session(self, self._start(stack))
            stack.callback(session.close)
            session.read(content, file, lessons)
            yield session

    def _start(self, stack: contextlib.ExitStack) -> Start:
        if self.boxed:
            return start_in_box(self.limits.memory_mb, self.limits.file_mb)
        folder = tempfile.TemporaryDirectory(prefix="course-", ignore_cleanup_errors=True)  # fmt: skip
        stack.callback(_remove, folder)
        return start_plain(Path(folder.name).resolve())


class Session:
    """A running process that serves one submission."""

    def __init__(self, sandbox: Sandbox, start: Start) -> None:
        self._sandbox = sandbox
        flags = getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0)  # on Windows
        own_group: dict[str, Any] = (
            {"creationflags": flags} if flags else {"start_new_session": True}
        )
        self._process = subprocess.Popen(
            start.command, cwd=start.folder, env=start.environment, stdin=subprocess.PIPE,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, close_fds=True, **own_group,
        )  # fmt: skip
        self._inbox: queue.SimpleQueue[tuple[bytes, bytes] | None] = queue.SimpleQueue()
        self._listener = threading.Thread(target=self._listen, daemon=True)
        self._listener.start()
        self._ready = False
        self._submission: tuple[bytes, str, Sequence[Outline]] = b"", "", ()
        self.reading = Reading("", ())

    def read(self, content: bytes, file: str, lessons: Sequence[Outline]) -> None:
        """Have the notebook read; afterwards ``reading`` says what it is."""
        if self._next(START_SECONDS) != (messages.READY, b""):
            raise SandboxFailure(f"the process did not start: {self._last_words()}")
        self._ready, self._submission = True, (content, file, lessons)
        outlines = [[lesson.number, list(lesson.exercises)] for lesson in lessons]
        request = {"notebook": np.frombuffer(content, np.uint8), "file": file,
                   "lessons": outlines, "limits": list(asdict(self._sandbox.limits).values())}  # fmt: skip
        self._send(request)
        message = self._next(READ_SECONDS)
        if message is None:
            why = "it takes too long" if self._process.poll() is None else "its reader ended"  # fmt: skip
            raise UnusableNotebook(f"cannot be read within its limits: {why}")
        letter, payload = message
        if letter == messages.UNUSABLE:
            raise UnusableNotebook(clean(payload.decode("utf-8", "replace"), 300))
        self.reading = _reading(wire.unpack(payload), lessons)

    def runs(self, questions: Sequence[Question]) -> Iterator[Run]:
        """Run the exercises and yield how each ended, in their order.

        One that ended without a reply is run once more, alone: another exercise may
        have taken its process with it. Without forks each has a process of its own.
        """
        runs = self.answers(questions) if FORKS else self._each(questions)
        for question, run in zip(questions, runs, strict=True):
            if run.end not in WITHOUT_REPLY:
                yield run
                continue
            (again,) = self._each([question])
            refused = dict.fromkeys((*run.refused, *again.refused))
            yield replace(again, refused=tuple(refused))

    def _each(self, questions: Sequence[Question]) -> Iterator[Run]:
        """The runs of the exercises, each in a process of its own."""
        for question in questions:
            with self._sandbox.submission(*self._submission) as alone:
                yield from alone.answers([question])

    def answers(self, questions: Sequence[Question]) -> Iterator[Run]:
        """The runs of the exercises in this process, in their order.

        Those after one that took the whole process with it are "killed".
        """
        if not questions:
            return
        self._send({"questions": [_told(q) for q in questions]})
        patience = START_SECONDS + self._sandbox.limits.seconds + GRACE_SECONDS
        gone = False
        for question in questions:
            cells = self.reading.exercises[question.index].cells
            seen = None if gone else self._seen(patience)
            gone = gone or seen is None
            yield _run(seen, question, cells)

    def close(self) -> None:
        """End the process and everything it started.

        It ends by itself when its input closes. It is killed only if it does not, and
        never while it starts: a half-built box that loses its parent would wait for it
        forever.
        """
        with contextlib.suppress(OSError):
            if self._process.stdin:
                self._process.stdin.close()
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(1.0 if self._ready else START_SECONDS)
        if not self._sandbox.boxed and sys.platform != "win32":
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(self._process.pid, signal.SIGKILL)
        self._process.kill()
        self._process.wait()
        self._listener.join(1.0)
        if not self._listener.is_alive():  # closing what it reads would wait for it
            for pipe in (self._process.stdout, self._process.stderr):
                if pipe:
                    pipe.close()

    def _seen(self, patience: float) -> dict[str, Any] | None:
        """What the process reports of a run; None where it is gone."""
        seen, deadline = Seen(), time.monotonic() + patience
        while True:
            message = self._next(deadline - time.monotonic())
            if message is None:
                if FORKS:
                    return None
                over = self._process.poll() is None
                seen.end, seen.detail = ("time", "") if over else end_of(self._process.returncode)  # fmt: skip
            elif message[0] == messages.END:
                try:
                    return dict(wire.unpack(message[1]))
                except (wire.Unreadable, ValueError, TypeError):
                    return None
            elif not seen.take(*message):
                if seen.stage == "ready 0":
                    deadline = time.monotonic() + self._sandbox.limits.seconds
                continue
            return {**vars(seen), "reply": np.frombuffer(seen.reply, np.uint8)}

    def _next(self, patience: float) -> tuple[bytes, bytes] | None:
        """The next message; None where none arrives in time or the process is gone."""
        deadline = time.monotonic() + patience
        while (left := deadline - time.monotonic()) > 0:
            if self._sandbox.cancel is not None and self._sandbox.cancel.is_set():
                raise Cancelled
            with contextlib.suppress(queue.Empty):
                return self._inbox.get(timeout=min(left, 0.2))
        return None

    def _listen(self) -> None:
        pipe = self._process.stdout
        assert pipe is not None
        message: tuple[bytes, bytes] | None = None
        with contextlib.suppress(OSError, ValueError):
            while (message := messages.receive(pipe.read)) is not None:
                self._inbox.put(message)
        self._inbox.put(None)

    def _send(self, request: Mapping[str, Any]) -> None:
        pipe = self._process.stdin
        assert pipe is not None
        with contextlib.suppress(
            BrokenPipeError
        ):  # that it is gone shows when its answer does not come
            messages.send(pipe.fileno(), messages.ASK, wire.pack(dict(request)))

    def _last_words(self) -> str:
        self._process.kill()
        self._process.wait()
        assert self._process.stderr is not None
        errors = self._process.stderr.read()
        words = errors[-2000:].decode("utf-8", "replace").strip()
        return f"exit code {self._process.returncode}: {words}"


def find_isolation(limits: Limits) -> Isolation:
    """How submissions are isolated on this machine, found by a trial run.

    Raises ``SandboxFailure`` if they cannot be run at all.
    """
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
    """The limits that took effect on a plain answer."""
    cell = {"cell_type": "code", "source": "def probe(): return 1.0", "metadata": {}}
    notebook = json.dumps({"nbformat": 4, "cells": [cell]})
    outline, question = Outline("00", ("probe",)), Question(0, "probe", "function", (), 1, ({},), (1,))  # fmt: skip
    try:
        with sandbox.submission(notebook.encode(), "probe.ipynb", [outline]) as session:
            (run,) = session.answers([question])
    except UnusableNotebook as error:
        raise SandboxFailure(str(error)) from error
    if run.reply is None or [o.kind for o in run.reply.outcomes] != ["value"]:
        raise SandboxFailure(f"a plain answer could not be run: {run.end} {run.detail}")
    return ("clock", *run.reply.held)


def _told(question: Question) -> dict[str, Any]:
    told = {name: getattr(question, name) for name in question.__dataclass_fields__}
    lists = {k: list(v) for k, v in told.items() if isinstance(v, tuple)}
    return {**told, **lists, "cases": [dict(case) for case in question.cases]}


def _reading(told: Any, lessons: Sequence[Outline]) -> Reading:
    """What the process said of a notebook that it had only parsed."""
    lesson = next((o for o in lessons if o.number == told["lesson"]), None)
    if lesson is None or len(told["exercises"]) != len(lesson.exercises):
        raise SandboxFailure("the reading does not fit this lesson")
    found = tuple(
        Found(one["state"], clean(one["fault"], 300), clean(one["nearest"], 100),
              bool(one["person"]), int(one["cells"]))
        for one in told["exercises"]
    )  # fmt: skip
    return Reading(lesson.number, found)


def _run(seen: Mapping[str, Any] | None, question: Question, cells: int) -> Run:
    """A run from what was reported of it; whatever untrusted data causes here, the
    reply is at fault.
    """
    if seen is None:
        return Run("killed", detail="its process was killed from outside")
    end: End = next((e for e in ENDS if e == seen.get("end")), "unreadable")
    if end == "blocked":
        return Run("blocked", by=int(seen["by"]))
    stage, index = _stage(str(seen.get("stage", "")), cells, len(question.cases))
    run = Run(
        end, stage, index, detail=clean(seen.get("detail"), 200),
        seconds=float(seen.get("seconds", 0.0)), refused=tuple(clean(r, 200) for r in seen.get("refused", [])[:20]),
    )  # fmt: skip
    if end != "replied":
        return run
    try:
        told = wire.unpack(seen["reply"].tobytes())
        reply = checked_reply(told, cells, question.most, question.results)
        return replace(run, reply=reply)
    except Exception as error:
        return replace(run, end="unreadable", detail=clean(str(error), 200))


def _stage(told: str, cells: int, cases: int) -> tuple[str, int]:
    """How far the run had got. A student's code can send this too, so it is checked."""
    words = told.split()
    if len(words) == 2 and words[0] in ("cell", "case") and words[1].isdigit():
        index = int(words[1]) if len(words[1]) < 9 else cells + cases
        if index < (cells if words[0] == "cell" else cases):
            return words[0], index
    return ("ready", 0) if words else ("", 0)


@contextlib.contextmanager
def _as_failures() -> Iterator[None]:
    """Errors of this machine, raised as ``SandboxFailure``."""
    try:
        yield
    except OSError as error:
        raise SandboxFailure(f"no process for a submission: {error}") from error


def _remove(folder: tempfile.TemporaryDirectory[str]) -> None:
    with contextlib.suppress(
        RecursionError
    ):  # folders nested more deeply than Python can follow
        folder.cleanup()
