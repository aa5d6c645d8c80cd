"""How a run can end, and what an exit code says of it."""

from __future__ import annotations

import signal
from typing import Literal, get_args

#: "replied": results came. "time", "files", "memory", "threads": a limit was passed. The
#: rest came without a reply: "ended" by the program itself, "crashed", "killed" from
#: outside, "unreadable".
End = Literal[
    "replied",
    "time",
    "files",
    "memory",
    "threads",
    "ended",
    "crashed",
    "killed",
    "unreadable",
]
ENDS: tuple[End, ...] = get_args(End)
#: Ends that say nothing of the answer: another run may end otherwise, and a person has to look.
WITHOUT_REPLY = ("ended", "crashed", "killed", "unreadable")


def end_of(code: int) -> tuple[End, str]:
    """The end that an exit code (negative: a signal) stands for, and what happened in words."""
    if code >= 0:
        return "ended", f"exit code {code}"
    number = -code
    if number == getattr(signal, "SIGXCPU", None):
        return "time", ""
    try:
        name = signal.Signals(number).name
    except ValueError:
        name = f"signal {number}"
    return ("killed" if name in ("SIGKILL", "SIGTERM", "SIGHUP") else "crashed"), name
