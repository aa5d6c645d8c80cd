"""The limits a process sets on itself before it runs what a student wrote.

POSIX has resource limits; Windows has job objects. ``apply_limits`` returns the limits
that took effect on this machine, in words, for the report.
"""

from __future__ import annotations

import contextlib
import math
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class Limits:
    """What one run of an answer may use: wall and processor seconds, memory, files
    written.
    """

    seconds: float = 10.0
    memory_mb: int = 2000
    file_mb: int = 100

    def __post_init__(self) -> None:
        if not 0 < self.seconds < math.inf:
            raise ValueError(
                f"time_limit: expected seconds above 0; got {self.seconds!r}"
            )
        # Python with NumPy alone maps about half of that.
        if not self.memory_mb >= 256:
            raise ValueError(
                f"memory_mb: expected at least 256; got {self.memory_mb!r}"
            )
        if not self.file_mb > 0:
            raise ValueError(
                f"file_mb: expected a number above 0; got {self.file_mb!r}"
            )


def apply_limits(limits: Limits) -> list[str]:
    """Limit the calling process for good; returns the limits that took effect."""
    if sys.platform == "win32":
        return _by_job_object(limits)
    else:
        return _by_resource(limits)


@contextlib.contextmanager
def memory_limited(limits: Limits) -> Iterator[None]:
    """Limit the memory of the calling process for a while, where that is possible."""
    if sys.platform == "win32":
        yield
        return
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    _set("RLIMIT_AS", limits.memory_mb * 1_000_000, lasting=False)
    try:
        yield
    finally:
        with contextlib.suppress(ValueError, OSError):
            resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


def resident_mb(process: int) -> float:
    """Resident memory of a process by ps, for systems that set no limit on it; 0 where there is no such process."""
    command = ["ps", "-o", "rss=", "-p", str(process)]
    listed = subprocess.run(command, capture_output=True, text=True, check=False)
    return int(listed.stdout) / 1000 if listed.stdout.strip().isdigit() else 0.0


if sys.platform == "win32":
    # Written from the documentation of the job object API (learn.microsoft.com, "Job
    # Objects").
    import ctypes
    from ctypes import wintypes

    class _Basic(ctypes.Structure):
        _fields_ = [
            ("PerProcessUserTimeLimit", ctypes.c_int64),
            ("PerJobUserTimeLimit", ctypes.c_int64),
            ("LimitFlags", wintypes.DWORD),
            ("MinimumWorkingSetSize", ctypes.c_size_t),
            ("MaximumWorkingSetSize", ctypes.c_size_t),
            ("ActiveProcessLimit", wintypes.DWORD),
            ("Affinity", ctypes.c_size_t),
            ("PriorityClass", wintypes.DWORD),
            ("SchedulingClass", wintypes.DWORD),
        ]

    class _Extended(ctypes.Structure):
        _fields_ = [
            ("BasicLimitInformation", _Basic),
            ("IoInfo", ctypes.c_uint64 * 6),
            ("ProcessMemoryLimit", ctypes.c_size_t),
            ("JobMemoryLimit", ctypes.c_size_t),
            ("PeakProcessMemoryUsed", ctypes.c_size_t),
            ("PeakJobMemoryUsed", ctypes.c_size_t),
        ]

    _EXTENDED_LIMITS = 9
    _TIME, _PROCESSES, _MEMORY, _KILL_ON_CLOSE = 0x2, 0x8, 0x100, 0x2000

    def _by_job_object(limits: Limits) -> list[str]:
        """Join a job of one process. The handle stays open: when this process ends, so
        does the job.
        """
        try:
            kernel = ctypes.WinDLL("kernel32", use_last_error=True)
            kernel.CreateJobObjectW.restype = wintypes.HANDLE
            kernel.CreateJobObjectW.argtypes = [ctypes.c_void_p, wintypes.LPCWSTR]
            kernel.SetInformationJobObject.argtypes = [
                wintypes.HANDLE, ctypes.c_int, ctypes.c_void_p, wintypes.DWORD
            ]  # fmt: skip
            kernel.GetCurrentProcess.restype = wintypes.HANDLE
            kernel.AssignProcessToJobObject.argtypes = [
                wintypes.HANDLE,
                wintypes.HANDLE,
            ]
            job = kernel.CreateJobObjectW(None, None)
            wanted = _Extended()
            wanted.BasicLimitInformation.LimitFlags = (
                _TIME | _PROCESSES | _MEMORY | _KILL_ON_CLOSE
            )
            wanted.BasicLimitInformation.PerProcessUserTimeLimit = int(
                (limits.seconds + 2) * 1e7
            )
            wanted.BasicLimitInformation.ActiveProcessLimit = 1
            wanted.ProcessMemoryLimit = limits.memory_mb * 1_000_000
            size = ctypes.sizeof(wanted)
            done = kernel.SetInformationJobObject(
                job, _EXTENDED_LIMITS, ctypes.byref(wanted), size
            )
            if done and kernel.AssignProcessToJobObject(
                job, kernel.GetCurrentProcess()
            ):
                return ["processor time", "memory", "one process"]
        except (OSError, AttributeError):
            pass  # a limit that did not take effect is not claimed
        return []

else:
    import resource

    def _by_resource(limits: Limits) -> list[str]:
        # Python's start-up and the loading of an answer's packages are on this clock
        # too.
        seconds = math.ceil(limits.seconds + time.process_time()) + 2
        wanted = [
            # Not 0: where dumps go to a program, Linux starts that one all the same.
            ("", "RLIMIT_CORE", 1),
            ("processor time", "RLIMIT_CPU", seconds),
            ("memory", "RLIMIT_AS", limits.memory_mb * 1_000_000),
            ("file size", "RLIMIT_FSIZE", limits.file_mb * 1_000_000),
            ("open files", "RLIMIT_NOFILE", 64),
            ("", "RLIMIT_MSGQUEUE", 0),
        ]
        # RLIMIT_NPROC is not set: it counts threads, of which solvers need some, and
        # does not bind root.
        return [words for words, name, value in wanted if _set(name, value) and words]

    def _set(name: str, value: int, *, lasting: bool = True) -> bool:
        kind = getattr(resource, name, None)
        if kind is None:
            return False
        _, hardest = resource.getrlimit(kind)
        value = value if hardest == resource.RLIM_INFINITY else min(value, hardest)
        # The soft processor limit shows why the process ends (SIGXCPU), the hard one
        # just ends it.
        hard = (
            value + 2
            if name == "RLIMIT_CPU" and hardest == resource.RLIM_INFINITY
            else value
        )
        try:
            resource.setrlimit(kind, (value, hard if lasting else hardest))
        except (ValueError, OSError):  # macOS refuses RLIMIT_AS
            return False
        return True
