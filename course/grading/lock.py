"""A lock beside a table: two graders writing to one table would lose each other's rows.

Where the system has locks (``fcntl``, ``msvcrt``), it releases the lock when its holder
dies, however that happens. Where a file system has none, the file itself is the lock,
and one whose process is gone is taken over.
"""

from __future__ import annotations

import errno
import os
import socket
import sys
import time
from pathlib import Path
from types import TracebackType

FIRST_LINE = "lock of course grade"
#: Windows locks bytes, not files: one far behind the text, so that others can read who
#: holds the lock.
FAR_BYTE = 1 << 20
NEW_SECONDS = 0.2
HELD, TAKEN, UNKNOWN = "held by another", "taken", "no locks here"


class Locked(ValueError):
    """Another grader holds the lock; the text names it."""


class Lock:
    """``with Lock(path):`` lets one grader in at a time; raises ``Locked`` for a
    second.
    """

    def __init__(self, path: Path, what: str) -> None:
        self.path, self.what = Path(path), what
        self._number = -1

    def __enter__(self) -> Lock:
        for _ in range(20):
            number, made = self._open()
            try:
                if self._is_ours(number, made=made):
                    self._number = number
                    return self
            except BaseException:
                os.close(number)
                raise
            os.close(number)
            time.sleep(0.02)
        raise Locked(f"{self.path} changes all the time: is another grader starting?")

    def _open(self) -> tuple[int, bool]:
        """The lock file, and whether this call made it: only one can."""
        try:
            return os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o644), True
        except FileExistsError:
            return os.open(self.path, os.O_RDWR | os.O_CREAT, 0o644), False

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        # POSIX can remove an open file; on Windows it must be closed first.
        if sys.platform == "win32":
            os.close(self._number)
        try:
            self.path.unlink(missing_ok=True)
        except OSError:
            pass  # an old lock file does no harm: nobody holds it
        if sys.platform != "win32":
            os.close(self._number)

    def _is_ours(self, number: int, *, made: bool) -> bool:
        """Whether the lock was taken; False where its file was removed meanwhile: try
        again.
        """
        state = _take(number)
        lines = _read(number).decode("utf-8", "replace").splitlines()
        if state == HELD or (lines and _may_live(lines, locked=state == TAKEN)):
            raise Locked(self._held_by(lines))
        if state == UNKNOWN and not made:
            # An empty one may be another grader's, just being made.
            if lines or time.time() - os.fstat(number).st_mtime > NEW_SECONDS:
                self.path.unlink(missing_ok=True)
            return False
        if not self._is_there(number):
            return False
        lines = [FIRST_LINE, str(os.getpid()), socket.gethostname(), time.ctime()]
        try:
            os.ftruncate(number, 0)
            os.lseek(number, 0, os.SEEK_SET)
            os.write(number, "\n".join(lines).encode() + b"\n")
        except OSError:
            self.path.unlink(missing_ok=True)
            raise
        return self._is_there(number)

    def _is_there(self, number: int) -> bool:
        try:
            return os.path.samestat(os.stat(self.path), os.fstat(number))
        except FileNotFoundError:
            return False

    def _held_by(self, lines: list[str]) -> str:
        who = (
            f"process {lines[1]} on {lines[2]}, since {lines[3]}"
            if len(lines) > 3
            else "another process"
        )
        return (
            f"{self.what} is being written by another grader ({who}). Wait until it is done, or choose another "
            f"--out. If that grader is no longer there, delete {self.path}"
        )


def _read(number: int) -> bytes:
    os.lseek(number, 0, os.SEEK_SET)
    return os.read(number, 500)


def _may_live(lines: list[str], *, locked: bool) -> bool:
    """Whether the holder that a lock file names may still be running.

    The system's lock is the surer sign, but some do not reach other machines.
    """
    if len(lines) < 3 or lines[0] != FIRST_LINE:
        return False
    if lines[2] != socket.gethostname():
        return True
    return not locked and (not lines[1].isdigit() or _alive(int(lines[1])))


def _alive(pid: int) -> bool:
    if sys.platform == "win32":
        # os.kill would end it there; but there the system's own lock always exists
        return True
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        pass
    return True


if sys.platform == "win32":
    import msvcrt

    def _take(number: int) -> str:
        os.lseek(number, FAR_BYTE, os.SEEK_SET)
        try:
            msvcrt.locking(number, msvcrt.LK_NBLCK, 1)
        except OSError:
            return HELD
        return TAKEN

else:
    import fcntl

    def _take(number: int) -> str:
        try:
            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            held = error.errno in (errno.EWOULDBLOCK, errno.EACCES)
            return HELD if held else UNKNOWN
        return TAKEN
