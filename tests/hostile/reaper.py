"""Run a program so that whatever it leaves running is found: orphans become children of this process.

A script: its argument is a file that says what to run, and where to write what came of it.
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

PR_SET_CHILD_SUBREAPER = 36


def main(told: dict) -> None:
    if sys.platform.startswith("linux"):
        ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    started = time.monotonic()
    with open(told["said"], "wb") as said:
        process = subprocess.Popen(
            told["command"], env=told["environment"], cwd=told["cwd"], stdout=said,
            stderr=said, stdin=subprocess.DEVNULL, start_new_session=True,
        )  # fmt: skip
        try:
            code = process.wait(told["seconds"])
        except subprocess.TimeoutExpired:
            code = "it did not end"
            process.kill()
            process.wait()
    seconds = time.monotonic() - started
    left = remaining(told["patience"])
    answer = {"code": code, "seconds": seconds, "left": left}
    Path(told["answer"]).write_text(json.dumps(answer))


def remaining(patience: float) -> list[str]:
    """What still runs below this process after a while, by its command line; it is ended."""
    deadline = time.monotonic() + patience
    while (alive := descendants(os.getpid())) and time.monotonic() < deadline:
        time.sleep(0.05)
    told = []
    for pid in alive:
        with contextlib.suppress(OSError):
            words = Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ")
            told.append(f"{pid}: {words.decode('utf-8', 'replace')[-200:]}")
    while alive:
        for pid in alive:
            with contextlib.suppress(OSError):
                os.kill(pid, signal.SIGKILL)
        time.sleep(0.05)
        alive = descendants(os.getpid())
    return told


def end_all(word: str) -> None:
    """End every process whose command line names this folder, which is nobody else's."""
    for entry in os.listdir("/proc") if os.path.isdir("/proc/self") else ():
        with contextlib.suppress(OSError):
            if (
                entry.isdigit()
                and word.encode() in Path(f"/proc/{entry}/cmdline").read_bytes()
            ):
                os.kill(int(entry), signal.SIGKILL)


def descendants(top: int) -> list[int]:
    """Every process that runs below one; those that have ended are taken away first."""
    with contextlib.suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    parents = {}
    for entry in os.listdir("/proc") if os.path.isdir("/proc/self") else ():
        if entry.isdigit():
            with contextlib.suppress(OSError):
                words = Path(f"/proc/{entry}/stat").read_text().rsplit(")", 1)[1]
                if words.split()[0] != "Z":
                    parents[int(entry)] = int(words.split()[1])
    found: list[int] = []
    fresh = {top}
    while fresh:
        fresh = {pid for pid, parent in parents.items() if parent in fresh}
        found += sorted(fresh)
    return found


if __name__ == "__main__":
    main(json.loads(Path(sys.argv[1]).read_text()))
