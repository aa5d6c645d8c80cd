"""Watch over a notebook's process: the clock of each cell and answer, files, memory; and take down what it says."""

from __future__ import annotations

import os
import select
import signal
import sys
import time
from dataclasses import dataclass, field

from course.sandbox.ending import End, end_of
from course.sandbox.forks import Forks
from course.sandbox.limits import Limits, resident_mb
from course.sandbox.messages import (
    DONE,
    FAULT,
    LONGEST,
    NOTE,
    REPLY,
    STAGE,
    TRIED,
    Garbled,
    Incoming,
)

START_SECONDS = 60.0  # for a run to begin: a slow disk is not the student's
LOOK_SECONDS = 0.25
#: What an interrupted cell, or a notebook whose answer was ended, gets to go on.
GRACE_SECONDS = 1.0
MOST_FILES = 2_000
MOST_TOLD = 20
MOST_ANSWERS = 200
#: Started in one run, whether they still live or not.
MOST_THREADS = 4_000
#: Numbers of processes start anew there, on most machines.
NUMBERS = 1 << 15


class Abandoned(Exception):
    """The grader is gone."""


@dataclass
class Answered:
    """One answer: how it ended, the case it stood at, and its reply."""

    end: End = "ended"
    detail: str = ""
    stage: str = ""
    reply: bytes = b""
    seconds: float = 0.0


@dataclass
class Seen:
    """What is known of a notebook's run."""

    answers: dict[int, list[Answered]] = field(default_factory=dict)
    notes: dict[int, bytes] = field(default_factory=dict)
    refused: list[str] = field(default_factory=list)
    #: Cells that passed their time, and were interrupted or took the process with them.
    stopped: dict[int, tuple[End, str]] = field(default_factory=dict)
    #: How the process was lost, where it was not at a cell or an answer.
    lost: tuple[End, str] = ("ended", "")
    whole: bool = False


class Watch:
    """Follows a notebook's process to its end, and ends it; nothing of it runs afterwards.

    ``pipe`` is read from it, ``grader`` from whom the work came: when it closes, ``Abandoned`` is raised.
    """

    def __init__(
        self, process: int, pipe: int, grader: int, forks: Forks | None, work: str, limits: Limits, *, boxed: bool,
        seconds: float,
    ) -> None:  # fmt: skip
        self.seen = Seen()
        self._process, self._pipe, self._grader, self._forks = (
            process,
            pipe,
            grader,
            forks,
        )
        self._work, self._limits, self._boxed = work, limits, boxed
        self._cell, self._answer, self._fork = -1, -1, 0
        self._begun = self._looked = time.monotonic()
        self._deadline = self._begun + START_SECONDS
        self._interrupted = False
        self._until = self._begun + START_SECONDS + seconds  # for the whole notebook

    def follow(self) -> Seen:
        """To the end of the notebook, or of its process."""
        try:
            self._read()
        finally:
            code = self._take_down()
        if not self.seen.whole:
            self._lost(*end_of(code))
        return self.seen

    def _read(self) -> None:
        incoming = Incoming(4 * LONGEST)
        watched = [self._pipe, self._grader]
        watched += [self._forks.listener] if self._forks else []
        while not self.seen.whole:
            patience = max(0.0, min(LOOK_SECONDS, self._deadline - time.monotonic()))
            ready, _, _ = select.select(watched, [], [], patience)
            if self._grader in ready:
                raise Abandoned
            if self._forks and self._forks.listener in ready:
                self._forks.decide()
            if self._pipe in ready:
                data = os.read(self._pipe, 1 << 16)
                if not data:
                    return
                try:
                    for message in incoming.feed(data):
                        self._take(*message)
                except Garbled as error:
                    self._lost("unreadable", str(error))
                    return
            if not self.seen.whole and not self._goes_on():
                return

    def _take(self, letter: bytes, payload: bytes) -> None:
        if letter == STAGE:
            what, _, number = payload[:32].decode("ascii", "replace").partition(" ")
            if number.isdecimal() and len(number) < 9:
                self._stage(what, int(number))
        elif letter == NOTE and self._cell >= 0:
            self.seen.notes[self._cell] = payload[:8000]
        elif letter == TRIED and len(self.seen.refused) < MOST_TOLD:
            self.seen.refused.append(payload[:400].decode("utf-8", "replace"))
        elif letter == REPLY and self._answer >= 0:
            current = self._current()
            if current and not current.reply:
                current.reply, current.end = payload[4:], "replied"
        elif letter == DONE:
            self._done(payload[:40].decode("ascii", "replace"))
        elif letter == FAULT:
            self._lost("unreadable", payload[:400].decode("utf-8", "replace"))

    def _stage(self, what: str, number: int) -> None:
        now = time.monotonic()
        if what in ("cell", "end"):
            self._cell, self._interrupted = (number if what == "cell" else -1), False
        elif what == "answer":
            made = self.seen.answers.setdefault(number, [])
            if sum(map(len, self.seen.answers.values())) >= MOST_ANSWERS:
                self._deadline = now  # a loop of checks: its time is over
                return
            made.append(Answered())
            self._answer, self._fork = number, 0
        elif what == "by":
            self._fork = number
            return
        elif what == "case":
            current = self._current()
            if current:
                current.stage = f"case {number}"
            return
        else:
            return
        self._begun, self._deadline = now, now + self._limits.seconds

    def _done(self, told: str) -> None:
        number, _, code = told.partition(" ")
        if number == "-1":
            self.seen.whole = True
            return
        current = self._current()
        if current and current.end == "ended" and not current.detail:
            try:
                current.end, current.detail = end_of(int(code))
            except ValueError:
                current.end = "unreadable"
        if current:
            current.seconds = time.monotonic() - self._begun
        self._answer = -1
        self._deadline = time.monotonic() + self._limits.seconds  # the cell goes on

    def _current(self) -> Answered | None:
        made = self.seen.answers.get(self._answer)
        return made[-1] if made else None

    def _goes_on(self) -> bool:
        """Whether no limit was passed; an answer or a cell that takes too long is stopped alone, if possible."""
        passed = self._passed()
        if passed is None:
            return True
        current = self._current()
        if (
            passed == "time"
            and current
            and current.end == "ended"
            and not current.detail
        ):
            current.end, current.detail = "time", "limit"
            current.seconds = time.monotonic() - self._begun
            self._deadline = time.monotonic() + GRACE_SECONDS
            return self._is_ours(self._fork) and self._stop(self._fork, signal.SIGKILL)
        if (
            passed == "time"
            and self._cell >= 0
            and not self._interrupted
            and self._answer < 0
        ):
            self._interrupted = True
            self.seen.stopped[self._cell] = ("time", "")
            self._deadline = time.monotonic() + GRACE_SECONDS
            return self._stop(self._process, signal.SIGINT)
        self._lost(passed, "limit")
        return False

    def _is_ours(self, process: int) -> bool:
        """Whether a number that the notebook told is that of a process of its own."""
        try:
            return process > 1 and os.getpgid(process) == self._process
        except ProcessLookupError:
            return False

    def _stop(self, process: int, number: signal.Signals) -> bool:
        if process <= 1 or process == os.getpid():
            return False
        try:
            os.kill(process, number)
        except (ProcessLookupError, PermissionError):
            return False
        return True

    def _lost(self, end: End, detail: str) -> None:
        """The process is gone, or has to go: what it stood at is told so."""
        self.seen.lost = (end, detail)
        current = self._current()
        if current is not None and self._answer >= 0:
            if current.end == "ended" and not current.detail:
                current.end, current.detail = end, detail
        elif self._cell >= 0:
            self.seen.stopped.setdefault(self._cell, (end, detail))

    def _passed(self) -> End | None:
        """The limit that was passed, if one was."""
        now = time.monotonic()
        if now > min(self._deadline, self._until):
            return "time"
        if now - self._looked > LOOK_SECONDS:
            self._looked = now
            if self._too_much_written():
                return "files"
            if watches_memory() and resident_mb(self._process) > self._limits.memory_mb:
                return "memory"
            if self._boxed and self._too_many_threads():
                return "threads"
        return None

    def _too_many_threads(self) -> bool:
        """Whether thousands were started: they would use up the machine's numbers.

        In a box, processes and threads are numbered one after the other, so a process
        made now tells how many there have been. No limit of the system's holds for root.
        """
        try:
            latest = os.fork()
        except OSError:
            return True
        if latest == 0:
            os._exit(0)
        os.waitpid(latest, 0)
        return (latest - self._process) % NUMBERS > MOST_THREADS

    def _too_much_written(self) -> bool:
        if (
            self._boxed
        ):  # a file system of its own: its size is set, its number of files is not
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

    def _take_down(self) -> int:
        """End the process and all that it started; the exit code it had, if it had one already."""
        code = None if self.seen.whole else _code_of(self._process, patience=0.5)
        for target in [-1] if self._boxed else [-self._process, self._process]:
            try:
                os.kill(target, signal.SIGKILL)
            except (ProcessLookupError, PermissionError):
                pass  # nobody left
        if code is None:
            code = _code_of(self._process, patience=None)
        if self._boxed:
            _reap_others()
        return 0 if code is None else code


def watches_memory() -> bool:
    """Whether memory is watched, for want of a limit on it (macOS)."""
    return sys.platform == "darwin"


def _code_of(process: int, *, patience: float | None) -> int | None:
    """The exit code, waited for this long [s] (None: to the end); None where there is none yet."""
    deadline = None if patience is None else time.monotonic() + patience
    while True:
        done, status = os.waitpid(process, 0 if deadline is None else os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        if deadline is not None and time.monotonic() > deadline:
            return None
        time.sleep(0.005)


def _reap_others() -> None:
    """Children of children, where this process inherits them."""
    try:
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    except ChildProcessError:
        pass
