"""Refuse what an answer has no business with: other processes, signals, the network, files outside its folder.

An audit hook (PEP 578) cannot be taken out again, costs little and works on every platform. It stops accidents and
plain tricks, and code that sets out to break it can: that is a sandbox of the operating system's task
(``sandbox.command``). No mark hangs on it, because verdicts are not made in this process.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import Any

REFUSED = frozenset(
    "os.fork os.forkpty os.exec os.posix_spawn os.spawn os.system os.startfile os.startfile/2 subprocess.Popen "
    "pty.spawn os.kill os.killpg signal.pthread_kill resource.setrlimit resource.prlimit socket.connect socket.bind "
    "socket.getaddrinfo socket.gethostbyname socket.sendto ctypes.dlopen ctypes.dlsym ctypes.dlsym/handle "
    "ctypes.call_function webbrowser.open _winapi.CreateProcess".split()
)
CHANGES = frozenset(
    "os.remove os.rename os.rmdir os.mkdir os.link os.symlink os.truncate os.chmod os.chown os.lchown os.utime "
    "os.setxattr os.removexattr os.chflags shutil.rmtree".split()
)
TWO_PATHS = frozenset({"os.rename", "os.link", "os.symlink"})
WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND


def install_guard(own: str, closed: Sequence[str]) -> None:
    """From now on writing works in the folder ``own`` alone, and the folders ``closed`` cannot be read."""
    own = os.path.realpath(own)
    shut = [os.path.realpath(folder) for folder in closed]

    def hook(event: str, details: tuple[Any, ...]) -> None:
        if event in REFUSED:
            raise PermissionError(f"{event} is not allowed while an answer is marked")
        if event == "open":
            path, _, flags = details
            if not isinstance(path, (str, bytes, os.PathLike)):
                return  # an open file's number
            if isinstance(flags, int) and flags & WRITING:
                _require_inside(path, own)
            elif shut:
                _require_outside(path, shut)
        elif event in CHANGES:
            for path in details[: 2 if event in TWO_PATHS else 1]:
                if isinstance(path, (str, bytes, os.PathLike)):
                    _require_inside(path, own)

    sys.addaudithook(hook)
    _refuse_fork_exec()


def _refuse_fork_exec() -> None:
    """Close the way that multiprocessing takes to new processes, which no audit event tells of."""
    try:
        import _posixsubprocess
    except ImportError:  # Windows, where an event does
        return

    def fork_exec(*_: Any, **__: Any) -> Any:
        raise PermissionError("a new process is not allowed while an answer is marked")

    _posixsubprocess.fork_exec = fork_exec  # type: ignore[assignment]


def _require_inside(path: Any, folder: str) -> None:
    place = os.path.realpath(os.fsdecode(path))
    if (
        place != os.devnull
        and place != folder
        and not place.startswith(folder + os.sep)
    ):
        raise PermissionError(
            f"writing outside the working folder is not allowed while an answer is marked: {place}"
        )


def _require_outside(path: Any, folders: Sequence[str]) -> None:
    place = os.path.realpath(os.fsdecode(path))
    if any(place == folder or place.startswith(folder + os.sep) for folder in folders):
        raise PermissionError(
            "the course's own files cannot be read while an answer is marked"
        )
