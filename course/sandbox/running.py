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
from course.sandbox.watching import START_SECONDS, watches_memory

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
    """What reading found of an exercise: "blank", "fault" (with why), or "run"."""

    state: str
    fault: str = ""
    nearest: str = ""
    needs_person: bool = False


@dataclass(frozen=True)
class Reading:
    """What a notebook is: its lesson's number, and what was found of each exercise, in the lesson's order."""

    lesson: str
    exercises: tuple[Found, ...]


@dataclass(frozen=True)
class Run:
    """How one answer to an exercise ended, the case it stood at then (-1: none), and the reply if one came."""

    end: End
    case: int = -1
    reply: Reply | None = None
    detail: str = ""
    seconds: float = 0.0


@dataclass(frozen=True)
class Answers:
    """What a notebook gave for an exercise: a run for every time it was checked, or one at the notebook's end.

    ``own`` is how the exercise's own cell was stopped, ``others`` whether other cells were (end, detail); ``notes``
    are what cells raised, each with whether it is the exercise's own; ``refused`` what was tried and refused.
    """

    runs: tuple[Run, ...] = ()
    own: tuple[End, str] | None = None
    others: tuple[tuple[End, str], ...] = ()
    notes: tuple[tuple[bool, str], ...] = ()
    refused: tuple[str, ...] = ()
    whole: bool = True


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
        self._over = threading.Event()
        self._listener = threading.Thread(target=self._listen, daemon=True)
        self._listener.start()
        self._ready = False
        self.reading = Reading("", ())

    def read(self, content: bytes, file: str, lessons: Sequence[Outline]) -> None:
        """Have the notebook read; afterwards ``reading`` says what it is."""
        if self._next(START_SECONDS) != (messages.READY, b""):
            raise SandboxFailure(f"the process did not start: {self._last_words()}")
        self._ready = True
        outlines = [
            [o.number, list(o.exercises), sorted(o.handed_out)] for o in lessons
        ]
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

    def answers(self, questions: Sequence[Question]) -> Iterator[Answers]:
        """Run the notebook and give what came of each exercise, in their order.

        Those that were not heard of, because the process went, have a run that was "killed".
        """
        if not questions:
            return
        self._send({"questions": [_told(q) for q in questions]})
        # A notebook is begun at most a few times, and each time has its limit.
        once = self._sandbox.limits.seconds * (len(questions) + 2)
        patience = 4 * (START_SECONDS + once) + GRACE_SECONDS
        for question in questions:
            seen = self._seen(question, patience)
            patience = GRACE_SECONDS if seen is not None else 0.0
            yield _answers(seen, question)

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
        self._over.set()  # what it still reads is nobody's any more
        self._room.release()
        self._listener.join(1.0)
        if not self._listener.is_alive():  # to close what it reads would wait for it
            for pipe in (self._process.stdout, self._process.stderr):
                if pipe:
                    pipe.close()

    def _seen(self, question: Question, patience: float) -> dict[str, Any] | None:
        """What the process tells of an exercise; None where it is gone."""
        if not FORKS:
            return self._watched(question)
        while (message := self._next(patience)) is not None:
            if message[0] == messages.END:
                try:
                    return dict(wire.unpack(message[1]))
                except (wire.Unreadable, ValueError, TypeError):
                    return None
        return None

    def _watched(self, question: Question) -> dict[str, Any]:
        """The same without forks: the notebook runs in the process itself, and is watched from here."""
        seconds = self._sandbox.limits.seconds
        one: dict[str, Any] = {
            "end": "ended",
            "detail": "",
            "stage": "",
            "seconds": 0.0,
        }
        refused: list[str] = []
        deadline, reply = time.monotonic() + START_SECONDS + seconds, b""
        while not reply:
            message = self._next(deadline - time.monotonic())
            if message is None:
                over = self._process.poll() is None
                code = self._process.returncode
                one["end"], one["detail"] = ("time", "") if over else end_of(code)
                break
            letter, payload = message
            if letter == messages.STAGE:
                one["stage"] = payload[:32].decode("ascii", "replace")
                deadline = time.monotonic() + seconds
            elif letter == messages.TRIED and len(refused) < 20:
                refused.append(payload[:400].decode("utf-8", "replace"))
            elif letter == messages.REPLY:
                reply, one["end"] = payload[4:], "replied"
        run = {**one, "reply": np.frombuffer(reply, np.uint8)}
        return {"runs": [run], "refused": refused, "whole": True}

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
                if not self._over.is_set():
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
            (answers,) = session.answers([question])
    except UnusableNotebook as error:
        raise SandboxFailure(str(error)) from error
    run = answers.runs[-1] if answers.runs else Run("ended", detail="no answer")
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
              bool(one["person"]))
        for one in told["exercises"]
    )  # fmt: skip
    return Reading(lesson.number, found)


def _answers(seen: Mapping[str, Any] | None, question: Question) -> Answers:
    """Answers out of what was told of them; whatever a stranger's data may bring about, it is theirs that is wrong."""
    if seen is None:
        gone = Run("killed", detail="its process was ended from outside")
        return Answers((gone,), whole=False)
    try:
        return Answers(
            tuple(_run(one, question) for one in seen.get("runs", [])),
            _stopped(seen.get("own")),
            tuple(filter(None, map(_stopped, seen.get("others", [])))),
            tuple(
                (bool(own), clean(text, 3000)) for own, text in seen.get("notes", [])
            ),
            tuple(clean(r, 200) for r in seen.get("refused", [])[:20]),
            seen.get("whole") is True,
        )
    except Exception as error:
        told = clean(str(error), 200)
        return Answers((Run("unreadable", detail=told),), whole=False)


def _run(one: Mapping[str, Any], question: Question) -> Run:
    end = _end(one.get("end"))
    stage, _, number = str(one.get("stage", "")).partition(" ")
    there = stage == "case" and number.isdecimal() and len(number) < 9
    case = int(number) if there else -1
    run = Run(
        end,
        case if case < len(question.cases) else -1,
        detail=clean(one.get("detail"), 200),
        seconds=float(one.get("seconds", 0.0)),
    )
    if end != "replied":
        return run
    try:
        room = REPLY_HEADER * (1 + len(question.cases))
        told = wire.unpack(one["reply"].tobytes(), header=room)
        return replace(run, reply=checked_reply(told, question.most, question.results))
    except Exception as error:
        return replace(run, end="unreadable", detail=clean(str(error), 200))


def _end(told: Any) -> End:
    return next((e for e in ENDS if e == told), "unreadable")


def _stopped(told: Any) -> tuple[End, str] | None:
    if not told:
        return None
    return _end(told[0]), clean(told[1], 200)


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
