"""Watch the run of an exercise: its clock, files and memory; record what it reports."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field

from course.sandbox.ending import End, end_of
from course.sandbox.limits import Limits
from course.sandbox.messages import FAULT, REPLY, STAGE, TRIED, Garbled, Incoming

# Seconds for a run to begin: a slow disk is not the student's fault.
START_SECONDS = 60.0
LOOK_SECONDS = 0.25
MOST_FILES = 2_000


class Abandoned(Exception):
    """The grader is gone."""


@dataclass
class Seen:
    """What is known of a run: how far it got, what it attempted, and how it ended."""

    stage: str = ""
    refused: list[str] = field(default_factory=list)
    reply: bytes = b""
    end: End = "ended"
    detail: str = ""
    seconds: float = 0.0

    def take(self, letter: bytes, payload: bytes) -> bool:
        """Record a message; True once the reply is there."""
        if letter == STAGE:
            self.stage = payload[:32].decode("ascii", "replace")
        elif letter == TRIED and len(self.refused) < 20:
            self.refused.append(payload[:400].decode("utf-8", "replace"))
        elif letter == REPLY:
            self.reply, self.end = payload, "replied"
            return True
        elif letter == FAULT:
            self.end, self.detail = (
                "unreadable",
                payload[:400].decode("utf-8", "replace"),
            )
            return True
        return False


def watch(
    process: int, pipe: int, grader: int, work: str, limits: Limits, *, boxed: bool
) -> Seen:
    """Wait for the run's reply or its end, and end it; nothing of it runs afterwards.

    ``pipe`` is read from the run, ``grader`` from the process that asked for it: when
    that one closes, ``Abandoned`` is raised.
    """
    seen, started = Seen(), time.monotonic()
    try:
        _follow(seen, pipe, grader, _Limits(process, work, limits, boxed))
    finally:
        code = _take_down(process, seen, boxed)
    if seen.end == "ended" and not seen.detail:
        seen.end, seen.detail = end_of(code)
    seen.seconds = time.monotonic() - started
    return seen


def _follow(seen: Seen, pipe: int, grader: int, limits: _Limits) -> None:
    incoming = Incoming()
    while True:
        ready, _, _ = select.select([pipe, grader], [], [], limits.patience())
        if grader in ready:
            raise Abandoned
        if pipe in ready:
            data = os.read(pipe, 1 << 16)
            if not data:
                return
            try:
                if any([seen.take(*message) for message in incoming.feed(data)]):
                    return
            except Garbled as error:
                seen.end, seen.detail = "unreadable", str(error)
                return
        limits.begun = limits.begun or (time.monotonic() if seen.stage else 0.0)
        passed = limits.passed()
        if passed is not None:
            seen.end, seen.detail = passed, "limit"
            return


class _Limits:
    """The limits watched from outside: the clock, files, and memory if nothing else
    limits it.
    """

    def __init__(self, process: int, work: str, limits: Limits, boxed: bool) -> None:
        self._process, self._work, self._limits, self._boxed = (
            process,
            work,
            limits,
            boxed,
        )
        self._asked = self._looked = time.monotonic()
        self.begun = 0.0

    def patience(self) -> float:
        """How long to wait for the next message [s]."""
        if not self.begun:
            return LOOK_SECONDS
        return max(
            0.0, min(LOOK_SECONDS, self.begun + self._limits.seconds - time.monotonic())
        )

    def passed(self) -> End | None:
        """The limit that was exceeded, if any."""
        now = time.monotonic()
        if now > (
            self.begun + self._limits.seconds
            if self.begun
            else self._asked + START_SECONDS
        ):
            return "time"
        if now - self._looked > LOOK_SECONDS:
            self._looked = now
            if self._too_much_written():
                return "files"
            if (
                watches_memory()
                and _resident_mb(self._process) > self._limits.memory_mb
            ):
                return "memory"
        return None

    def _too_much_written(self) -> bool:
        if (
            self._boxed
        ):  # a file system of its own: its size is limited, its number of files is not
            told = os.statvfs(self._work)
            return told.f_files - told.f_ffree > MOST_FILES
        total = count = 0
        for place, _, names in os.walk(self._work):
            count += len(names) + 1
            for name in names[:MOST_FILES]:
                try:
                    total += os.lstat(os.path.join(place, name)).st_size
                except OSError:
                    continue
            if total > self._limits.file_mb * 1_000_000 or count > MOST_FILES:
                return True
        return False


def watches_memory() -> bool:
    """Whether memory is watched, for lack of a limit on it (macOS)."""
    return sys.platform == "darwin"


def _resident_mb(process: int) -> float:
    """Memory of a process according to ps; 0 where ps reports nothing."""
    command = ["ps", "-o", "rss=", "-p", str(process)]
    told = subprocess.run(command, capture_output=True, text=True, check=False)
    return int(told.stdout) / 1000 if told.stdout.strip().isdigit() else 0.0


def _take_down(process: int, seen: Seen, boxed: bool) -> int:
    """End the run and everything it started; returns the exit code it already had, if
    any.
    """
    code = None
    if (
        seen.end == "ended"
    ):  # its pipe is closed: it is about to end, or has closed the pipe and goes on
        code = _code_of(process, patience=0.5)
    for target in [-1] if boxed else [-process, process]:
        try:
            os.kill(target, signal.SIGKILL)
        except (ProcessLookupError, PermissionError):
            pass  # nobody left
    if code is None:
        seen.detail = seen.detail or (
            "it closed the way for its reply" if seen.end == "ended" else ""
        )
        code = _code_of(process, patience=None)
    if boxed:
        _reap_others()
    return 0 if code is None else code


def _code_of(process: int, *, patience: float | None) -> int | None:
    """The exit code, waited for this long [s] (None: without limit); None if there is
    none yet.
    """
    deadline = None if patience is None else time.monotonic() + patience
    while True:
        done, status = os.waitpid(process, 0 if deadline is None else os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        if deadline is not None and time.monotonic() > deadline:
            return None
        time.sleep(0.005)


def _reap_others() -> None:
    """Descendants further down, where this process inherits them."""
    try:
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    except ChildProcessError:
        pass
