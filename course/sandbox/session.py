"""A submission's process as the grader sees it: have the notebook read, ask for exercises, end it."""

from __future__ import annotations

import contextlib
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from course.exercises.notebook_file import Outline, UnusableNotebook
from course.exercises.question import Question
from course.exercises.untrusted_text import clean
from course.sandbox import messages, wire
from course.sandbox.box import Start
from course.sandbox.ending import end_of
from course.sandbox.findings import Answers, Reading, checked_answers, checked_reading
from course.sandbox.limits import Limits
from course.sandbox.watching import START_SECONDS

#: For a notebook to be read, once its process has started; a lesson of fifty cells takes a hundredth of that.
READ_SECONDS = 10.0
#: Beyond the limits of a run, for its process to report it.
GRACE_SECONDS = 15.0
#: For a process that serves to end by itself.
END_SECONDS = 1.0
#: Messages that wait to be looked at; a process that sends more waits itself.
MOST_WAITING = 4
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


class Session:
    """A running process that serves one submission."""

    def __init__(
        self,
        start: Start,
        limits: Limits,
        *,
        boxed: bool = False,
        cancel: threading.Event | None = None,
    ) -> None:
        self._limits, self._boxed, self._cancel = limits, boxed, cancel
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
        self._begun, self._over = threading.Event(), threading.Event()
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
                   "lessons": outlines, "limits": list(asdict(self._limits).values())}  # fmt: skip
        self._send(request)
        message = self._next(READ_SECONDS)
        if message is None:
            raise self._unread()
        letter, payload = message
        if letter == messages.UNUSABLE:
            raise UnusableNotebook(clean(payload.decode("utf-8", "replace"), 300))
        reading = checked_reading(wire.unpack(payload), lessons)
        if reading is None:
            raise SandboxFailure("what came of reading is not of this lesson")
        self.reading = reading

    def _unread(self) -> Exception:
        """Why there is no answer to a notebook: its own fault, or somebody's who ended the process."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(END_SECONDS)
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
        self._send({"questions": [question.as_plain() for question in questions]})
        # A notebook is begun at most a few times, and each time has its limit.
        once = self._limits.seconds * (len(questions) + 2)
        patience = 4 * (START_SECONDS + once) + GRACE_SECONDS
        for question in questions:
            report = self._report(patience) if FORKS else self._watched()
            patience = GRACE_SECONDS if report is not None else 0.0
            yield checked_answers(report, question)

    def ask_for_repair(self, request: Mapping[str, Any], seconds: float) -> Any:
        """What the process replies to a request of ``course.sandbox.repairing``, once all questions are answered;
        raises ``messages.NoReply``, ``wire.Unreadable``."""
        self._send({"repair": dict(request)})
        message = self._next(seconds)
        if message is None or message[0] != messages.REPLY:
            raise messages.NoReply
        return wire.unpack(message[1], header=messages.REPAIR_HEADER)

    def close(self) -> None:
        """End the process and all that it started."""
        with contextlib.suppress(OSError):
            if self._process.stdin:
                self._process.stdin.close()
        self._wait_for_its_end()
        if not self._boxed and sys.platform != "win32":
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

    def _wait_for_its_end(self) -> None:
        """Wait until the process has ended by itself, or may be killed.

        One that serves sees that nobody asks it any more. A box that is half built must be let be: killed now, it
        would leave a process behind that waits for its maker for ever. Once the child in it runs, ready or not, the
        box is whole.
        """
        if self._ready:
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(END_SECONDS)
            return
        deadline = time.monotonic() + (START_SECONDS if self._boxed else 0.0)
        while self._process.poll() is None and time.monotonic() < deadline:
            if self._begun.wait(0.02):
                return

    def _report(self, patience: float) -> dict[str, Any] | None:
        """What the process reports of the next exercise; None where it is gone."""
        while (message := self._next(patience)) is not None:
            if message[0] == messages.END:
                try:
                    return dict(wire.unpack(message[1]))
                except (wire.Unreadable, ValueError, TypeError):
                    return None
        return None

    def _watched(self) -> dict[str, Any]:
        """The same without forks: the notebook runs in the process itself, and is watched from here."""
        seconds = self._limits.seconds
        run: dict[str, Any] = {"end": "ended", "detail": "", "stage": "", "seconds": 0.0}  # fmt: skip
        refused: list[str] = []
        deadline, reply = time.monotonic() + START_SECONDS + seconds, b""
        while not reply:
            message = self._next(deadline - time.monotonic())
            if message is None:
                over = self._process.poll() is None
                code = self._process.returncode
                run["end"], run["detail"] = ("time", "") if over else end_of(code)
                break
            letter, payload = message
            if letter == messages.STAGE:
                run["stage"] = payload[:32].decode("ascii", "replace")
                deadline = time.monotonic() + seconds
            elif letter == messages.TRIED and len(refused) < 20:
                refused.append(payload[:400].decode("utf-8", "replace"))
            elif letter == messages.REPLY:
                reply, run["end"] = payload[4:], "replied"
        run["reply"] = np.frombuffer(reply, np.uint8)
        return {"runs": [run], "refused": refused, "whole": True}

    def _next(self, patience: float) -> tuple[bytes, bytes] | None:
        """The next message; None where none comes in time or the process is gone."""
        deadline = time.monotonic() + patience
        while (left := deadline - time.monotonic()) > 0:
            if self._cancel is not None and self._cancel.is_set():
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
                if message[0] == messages.BEGUN:
                    self._begun.set()
                    continue
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
