"""A submission's process as the grader sees it: start it, have the notebook read, ask for exercises, end it.

What comes back is data from a stranger: it is checked here, nothing of it is run.
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
from course.sandbox.ending import ENDS, End, end_of
from course.sandbox.limits import Limits
from course.sandbox.reply import Reply, checked_reply, clean
from course.sandbox.watching import START_SECONDS, Seen, watches_memory

#: For a notebook to be read, once its process has started; a lesson of fifty cells takes a hundredth of that.
READ_SECONDS = 10.0
#: Beyond the limits of a run, for its process to tell of it.
GRACE_SECONDS = 15.0
#: Messages that wait to be looked at; a process that sends more waits itself.
MOST_WAITING = 4
#: Numbers and text of a reply but its arrays [bytes]: for each case and each cell.
REPLY_HEADER = 20_000
#: Exit codes of a process that somebody else ended, of a box (128 and the signal) too.
KILLED = frozenset(n for s in (1, 9, 15) for n in (-s, 128 + s))
#: For a process to take what it is sent.
SEND_SECONDS = 60.0
#: Without forks a process answers one question.
FORKS = sys.platform != "win32"


class SandboxFailure(RuntimeError):
    """The process of a submission did not even start: a fault of this machine, not of the submission."""


class Cancelled(Exception):
    """The batch was stopped while a submission ran."""


@dataclass(frozen=True)
class Question:
    """An exercise to be answered: its place in the lesson, the answer's name and kind, the declared arguments, how
    many results, the inputs of every case, and how many numbers each may give at most."""

    index: int
    name: str
    kind: str
    arguments: tuple[str, ...]
    results: int
    cases: tuple[Mapping[str, Any], ...]
    most: tuple[int, ...]


@dataclass(frozen=True)
class Found:
    """What reading found of an exercise: "blank", "fault" (with why), or "run", with how many cells."""

    state: str
    fault: str = ""
    nearest: str = ""
    needs_person: bool = False
    cells: int = 0


@dataclass(frozen=True)
class Reading:
    """What a notebook is: its lesson's number, and what was found of each exercise, in the lesson's order."""

    lesson: str
    exercises: tuple[Found, ...]


@dataclass(frozen=True)
class Run:
    """How the run of an exercise ended, where it stood then (``stage`` "cell" or "case", and its index), the reply if
    one came, what it tried and was refused, and for a run that was "blocked", ``by`` which exercise's."""

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
    """How submissions are run on this machine: in a box or, where ``boxed`` is false, in a plain process."""

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
        self._room = threading.Semaphore(MOST_WAITING)
        self._listener = threading.Thread(target=self._listen, daemon=True)
        self._listener.start()
        self._ready = False
        self.reading = Reading("", ())

    def read(self, content: bytes, file: str, lessons: Sequence[Outline]) -> None:
        """Have the notebook read; afterwards ``reading`` says what it is."""
        if self._next(START_SECONDS) != (messages.READY, b""):
            raise SandboxFailure(f"the process did not start: {self._last_words()}")
        self._ready = True
        outlines = [[lesson.number, list(lesson.exercises)] for lesson in lessons]
        request = {"notebook": np.frombuffer(content, np.uint8), "file": file,
                   "lessons": outlines, "limits": list(asdict(self._sandbox.limits).values())}  # fmt: skip
        self._send(request)
        message = self._next(READ_SECONDS)
        if message is None:
            raise self._unread()
        letter, payload = message
        if letter == messages.UNUSABLE:
            raise UnusableNotebook(clean(payload.decode("utf-8", "replace"), 300))
        self.reading = _reading(wire.unpack(payload), lessons)

    def _unread(self) -> Exception:
        """Why there is no answer to a notebook: its own fault, or somebody's who ended the process."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(1.0)
        code = self._process.poll()
        if code in KILLED:
            return SandboxFailure("the process was ended from outside")
        why = "it takes too long" if code is None else "its reader ended"
        return UnusableNotebook(f"cannot be read within its limits: {why}")

    def answers(self, questions: Sequence[Question]) -> Iterator[Run]:
        """Run the exercises and give how each ended, in their order.

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
        """End the process and all that it started.

        It ends by itself when it sees that nobody asks it any more. It is killed only where it does not, and not
        while it starts: a box that loses its maker half built would wait for it for ever.
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
        self._room.release(1_000_000)  # what it still reads is nobody's any more
        self._listener.join(1.0)
        if not self._listener.is_alive():  # to close what it reads would wait for it
            for pipe in (self._process.stdout, self._process.stderr):
                if pipe:
                    pipe.close()

    def _seen(self, patience: float) -> dict[str, Any] | None:
        """What the process tells of a run; None where it is gone."""
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
        """The next message; None where none comes in time or the process is gone."""
        deadline = time.monotonic() + patience
        while (left := deadline - time.monotonic()) > 0:
            if self._sandbox.cancel is not None and self._sandbox.cancel.is_set():
                raise Cancelled
            with contextlib.suppress(queue.Empty):
                message = self._inbox.get(timeout=min(left, 0.2))
                self._room.release()
                return message
        return None

    def _listen(self) -> None:
        pipe = self._process.stdout
        assert pipe is not None
        message: tuple[bytes, bytes] | None = None
        with contextlib.suppress(OSError, ValueError):
            while (message := messages.receive(pipe.read)) is not None:
                self._inbox.put(message)
                self._room.acquire()
        self._inbox.put(None)

    def _send(self, request: Mapping[str, Any]) -> None:
        pipe = self._process.stdin
        assert pipe is not None
        packed = wire.pack(dict(request))
        # One that takes nothing would be waited for without end.
        late = threading.Timer(SEND_SECONDS, self._process.kill)
        late.start()
        try:
            messages.send(pipe.fileno(), messages.ASK, packed)
        except BrokenPipeError:
            pass  # that it is gone is found out when its answer is missed
        finally:
            late.cancel()

    def _last_words(self) -> str:
        self._process.kill()
        self._process.wait()
        assert self._process.stderr is not None
        errors = self._process.stderr.read()
        words = errors[-2000:].decode("utf-8", "replace").strip()
        return f"exit code {self._process.returncode}: {words}"


def find_isolation(limits: Limits) -> Isolation:
    """What shuts submissions in on this machine, found out by a run; raises ``SandboxFailure`` if none is possible."""
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
    """What the process said of a notebook it had only parsed."""
    lesson = next((o for o in lessons if o.number == told["lesson"]), None)
    if lesson is None or len(told["exercises"]) != len(lesson.exercises):
        raise SandboxFailure("what came of reading is not of this lesson")
    found = tuple(
        Found(one["state"], clean(one["fault"], 300), clean(one["nearest"], 100),
              bool(one["person"]), int(one["cells"]))
        for one in told["exercises"]
    )  # fmt: skip
    return Reading(lesson.number, found)


def _run(seen: Mapping[str, Any] | None, question: Question, cells: int) -> Run:
    """A run out of what was told of it; whatever a stranger's data may bring about, it is their reply that is wrong."""
    if seen is None:
        return Run("killed", detail="its process was ended from outside")
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
        room = REPLY_HEADER * (cells + len(question.cases))
        told = wire.unpack(seen["reply"].tobytes(), header=room)
        reply = checked_reply(told, cells, question.most, question.results)
        return replace(run, reply=reply)
    except Exception as error:
        return replace(run, end="unreadable", detail=clean(str(error), 200))


def _stage(told: str, cells: int, cases: int) -> tuple[str, int]:
    """Where the run stood; a student's code can say so too, so nothing in it is taken unseen."""
    words = told.split()
    if len(words) == 2 and words[0] in ("cell", "case") and words[1].isdecimal():
        index = int(words[1]) if len(words[1]) < 9 else cells + cases
        if index < (cells if words[0] == "cell" else cases):
            return words[0], index
    return ("ready", 0) if words else ("", 0)


@contextlib.contextmanager
def _as_failures() -> Iterator[None]:
    """Errors of this machine, told as such."""
    try:
        yield
    except OSError as error:
        raise SandboxFailure(f"no process for a submission: {error}") from error


def _remove(folder: tempfile.TemporaryDirectory[str]) -> None:
    with contextlib.suppress(
        RecursionError
    ):  # folders in folders, deeper than Python can follow
        folder.cleanup()
