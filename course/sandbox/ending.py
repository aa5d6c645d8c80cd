"""How a run can end, and what its exit code says about that."""

from __future__ import annotations

import signal
from typing import Literal

#: "replied": results came. "time", "files", "memory": a limit was exceeded. "blocked":
#: a cell it needs ended an earlier run. The rest ended without a reply: "ended" by the
#: program itself, "crashed", "killed" from outside, "unreadable".
End = Literal[
    "replied",
    "time",
    "files",
    "memory",
    "blocked",
    "ended",
    "crashed",
    "killed",
    "unreadable",
]
ENDS: tuple[End, ...] = (
    "replied",
    "time",
    "files",
    "memory",
    "blocked",
    "ended",
    "crashed",
    "killed",
    "unreadable",
)
#: Ends that say nothing about the answer: another run may end differently, and a person
#: has to look.
WITHOUT_REPLY = ("ended", "crashed", "killed", "unreadable")


def end_of(code: int) -> tuple[End, str]:
    """The end that an exit code (negative: a signal) implies, and what happened in
    words.
    """
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
