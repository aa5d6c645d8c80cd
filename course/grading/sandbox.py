"""Run one answer in a process of its own, within limits, and read back what it sends as data from a stranger."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Literal

from course.grading import wire
from course.grading.limits import Limits
from course.grading.reply import MESSAGE_LIMIT, Reply, checked_reply, clean, read_bytes

PACKAGE = Path(__file__).resolve().parents[1]
CHILD = Path(__file__).with_name("child.py")
KEPT_ENVIRONMENT = (
    "PATH LD_LIBRARY_PATH DYLD_LIBRARY_PATH DYLD_FALLBACK_LIBRARY_PATH "
    "SYSTEMROOT SYSTEMDRIVE WINDIR"
).split()
START_SECONDS = 60.0  # for Python and NumPy to load, on the slowest disk
POLL_SECONDS = 0.01
MOST_FILES = 2_000

End = Literal["replied", "time", "files", "memory", "ended", "crashed", "unreadable"]


class SandboxFailure(RuntimeError):
    """The process did not even start on the answer: a fault of this machine, not of a submission."""


class Cancelled(Exception):
    """The batch was stopped while this answer ran."""


@dataclass(frozen=True)
class Job:
    """What the process is told: the cells in order (source, and whether to go on after a statement that fails), the
    answer's name and kind, the declared arguments, how many results, and the inputs of every case."""

    cells: tuple[tuple[str, bool], ...]
    name: str
    kind: str
    arguments: tuple[str, ...]
    results: int
    cases: tuple[Mapping[str, Any], ...]


@dataclass(frozen=True)
class Run:
    """How a run ended, where it stood then (``stage`` "cell" or "case", and its index), and the reply if one came."""

    end: End
    stage: str = ""
    index: int = 0
    reply: Reply | None = None
    detail: str = ""
    seconds: float = 0.0


def command(folder: Path) -> list[str]:
    """The command line that runs the job in ``folder``.

    The one place that knows how the process is shut in: a wrapper of the operating system (bubblewrap on Linux)
    goes in front here, with ``folder`` writable and the interpreter readable.
    """
    return [sys.executable, "-I", "-S", "-B", "-X", "utf8", str(CHILD), str(folder)]


def isolation(limits: Limits) -> tuple[str, ...]:
    """What shuts a run in on this machine, found out by one run; raises ``SandboxFailure`` if none is possible."""
    job = Job((("def probe(): return 1.0", False),), "probe", "function", (), 1, ({},))
    run = run_job(job, limits)
    if run.reply is None or [o.kind for o in run.reply.outcomes] != ["value"]:
        raise SandboxFailure(
            f"a plain answer could not be run: {run.end} {run.detail}".strip()
        )
    watched = ("memory by watching",) if _watches_memory() else ()
    return ("separate process", "clock", *run.reply.held, *watched, "audit hook")


def run_job(job: Job, limits: Limits, *, cancel: threading.Event | None = None) -> Run:
    """Run the job to its end or its limits; nothing of it is left afterwards, neither process nor file.

    Raises ``SandboxFailure`` where the process cannot start, ``Cancelled`` when ``cancel`` is set meanwhile.
    """
    started = time.monotonic()
    try:
        temporary = tempfile.TemporaryDirectory(
            prefix="course-", ignore_cleanup_errors=True
        )
        try:
            run = _run_in(Path(temporary.name).resolve(), job, limits, cancel)
        finally:
            _remove(temporary)
    except OSError as error:
        raise SandboxFailure(f"no process for an answer: {error}") from error
    return replace(run, seconds=time.monotonic() - started)


def _run_in(
    folder: Path, job: Job, limits: Limits, cancel: threading.Event | None
) -> Run:
    _write_job(job, limits, folder)
    with (folder / "stderr").open("wb") as errors:
        process = subprocess.Popen(
            command(folder), cwd=folder / "work", env=_environment(folder / "work"), stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL, stderr=errors, close_fds=True, **_own_group(),
        )  # fmt: skip
    try:
        end = _wait(process, folder, limits, cancel)
    finally:
        _kill(process)
    return _read(job, folder, end, process.returncode)


def _remove(temporary: tempfile.TemporaryDirectory[str]) -> None:
    try:
        temporary.cleanup()
    except RecursionError:
        pass  # folders in folders, deeper than Python can follow


def _write_job(job: Job, limits: Limits, folder: Path) -> None:
    (folder / "work").mkdir()
    (folder / "stage").touch()
    told = {
        "cells": [list(cell) for cell in job.cells], "name": job.name, "kind": job.kind,
        "arguments": list(job.arguments), "results": job.results, "cases": [dict(case) for case in job.cases],
        "limits": list(asdict(limits).values()),
    }  # fmt: skip
    (folder / "job").write_bytes(wire.pack(told))
    root = PACKAGE.parent
    path = [
        entry
        for entry in sys.path
        if entry and Path(entry).resolve() not in (root, PACKAGE)
    ]
    if "site-packages" in root.parts:
        path.append(str(root))
    closed = [str(PACKAGE), str(root / "solutions")]
    (folder / "path.json").write_text(
        json.dumps({"root": str(root), "path": path, "closed": closed}), "utf-8"
    )


def _environment(work: Path) -> dict[str, str]:
    """Nothing of the parent's environment but where libraries are."""
    kept = {name: os.environ[name] for name in KEPT_ENVIRONMENT if name in os.environ}
    places = dict.fromkeys(
        ("HOME", "USERPROFILE", "TMPDIR", "TMP", "TEMP", "MPLCONFIGDIR"), str(work)
    )
    threads = dict.fromkeys(
        ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1"
    )
    return {
        **kept,
        **places,
        **threads,
        "MPLBACKEND": "Agg",
        "LANG": "C.UTF-8",
        "LC_ALL": "C.UTF-8",
    }


def _own_group() -> dict[str, Any]:
    if sys.platform == "win32":
        return {
            "creationflags": subprocess.CREATE_NEW_PROCESS_GROUP
            | subprocess.CREATE_NO_WINDOW
        }
    return {"start_new_session": True}


def _wait(
    process: subprocess.Popen[bytes],
    folder: Path,
    limits: Limits,
    cancel: threading.Event | None,
) -> End | None:
    """Wait for the end; gives the limit that was passed, or None where the process ended by itself.

    The clock runs from when the process says that it is ready: a slow disk is not the student's.
    """
    deadline, ready, looked = time.monotonic() + START_SECONDS, False, time.monotonic()
    while True:
        try:
            process.wait(POLL_SECONDS)
            return None
        except subprocess.TimeoutExpired:
            pass
        if cancel is not None and cancel.is_set():
            raise Cancelled
        now = time.monotonic()
        if not ready and (folder / "stage").stat().st_size:
            ready, deadline = True, now + limits.seconds
        if now > deadline:
            return "time"
        if ready and now - looked > 0.25:
            looked = now
            if _too_much_written(folder, limits.file_mb * 1_000_000):
                return "files"
            if _watches_memory() and _resident_mb(process.pid) > limits.memory_mb:
                return "memory"


def _too_much_written(folder: Path, limit: int) -> bool:
    total = count = 0
    for place, _, names in os.walk(folder):
        count += len(names) + 1
        for name in names[:MOST_FILES]:
            try:
                total += os.lstat(os.path.join(place, name)).st_size
            except OSError:
                continue
        if total > limit or count > MOST_FILES:
            return True
    return False


def _watches_memory() -> bool:
    return sys.platform == "darwin"  # which knows no limit on a process's memory


def _resident_mb(pid: int) -> float:
    """Memory of a process as ps tells it; 0 where it tells nothing."""
    told = subprocess.run(
        ["ps", "-o", "rss=", "-p", str(pid)],
        capture_output=True,
        text=True,
        check=False,
    )
    return int(told.stdout) / 1000 if told.stdout.strip().isdigit() else 0.0


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End the process and all that it started and did not move out of its group."""
    if sys.platform != "win32":
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except (ProcessLookupError, PermissionError):
            pass  # nobody left, or only what is being taken away
    process.kill()
    process.wait()


def _read(job: Job, folder: Path, end: End | None, code: int) -> Run:
    stage, index = _stage(folder, len(job.cells), len(job.cases))
    if not stage:
        errors = (
            read_bytes(folder / "stderr", 10_000)[-2000:]
            .decode("utf-8", "replace")
            .strip()
        )
        raise SandboxFailure(
            f"the process for an answer did not start (exit code {code}): {errors}"
        )
    if end is not None:
        return Run(end, stage, index)
    if code:
        return _ended(code, stage, index)
    try:
        message = (
            read_bytes(folder / "reply", MESSAGE_LIMIT + 1)
            if (folder / "reply").exists()
            else b""
        )
        if not message:
            return Run("ended", stage, index, detail="exit code 0")
        reply = checked_reply(
            wire.unpack(message), len(job.cells), len(job.cases), job.results
        )
        return Run("replied", stage, index, reply)
    except Exception as error:  # whatever a stranger's data may bring about, it is their reply that is wrong
        return Run("unreadable", stage, index, detail=clean(str(error), 200))


def _ended(code: int, stage: str, index: int) -> Run:
    if code > 0:
        return Run("ended", stage, index, detail=f"exit code {code}")
    number = -code
    if number == getattr(signal, "SIGXCPU", None):
        return Run("time", stage, index)
    try:
        name = signal.Signals(number).name
    except ValueError:
        name = f"signal {number}"
    return Run("crashed", stage, index, detail=name)


def _stage(folder: Path, cells: int, cases: int) -> tuple[str, int]:
    """Where the run stood; the file is the student's to write to, so nothing in it is taken unseen."""
    try:
        words = read_bytes(folder / "stage", 64).decode("ascii", "replace").split()
    except OSError:
        words = []
    if (
        len(words) == 2
        and words[0] in ("cell", "case")
        and words[1].isdigit()
        and len(words[1]) < 9
    ):
        index = int(words[1])
        if index < (cells if words[0] == "cell" else cases):
            return words[0], index
    return ("ready", 0) if words else ("", 0)
