"""Read what a student's process sent back. It is data from a stranger: everything is checked, nothing is run."""

from __future__ import annotations

import os
import stat
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from course.exercises.answer import PRINTED_LIMIT, TEXT_LIMIT, Outcome
from course.grading import wire

LIMIT_WORDS = ("processor time", "memory", "file size", "open files", "one process")
KINDS = ("value", "none", "raised", "unreadable", "unattempted", "wrote")
MESSAGE_LIMIT = wire.HEADER_LIMIT + wire.BODY_LIMIT


@dataclass(frozen=True)
class Reply:
    """What came back, checked: the outcomes, or why there are none; ``notes`` are (cell, what it raised)."""

    outcomes: tuple[Outcome, ...] = ()
    missing: bool = False
    blank: bool = False
    fault: str = ""
    notes: tuple[tuple[int, str], ...] = ()
    held: tuple[str, ...] = ()


def read_bytes(path: Path, limit: int) -> bytes:
    """The first bytes of a plain file; nothing of a link, a pipe or a device that stands in its place."""
    flags = (
        os.O_RDONLY
        | getattr(os, "O_NOFOLLOW", 0)
        | getattr(os, "O_NONBLOCK", 0)
        | getattr(os, "O_BINARY", 0)
    )
    with os.fdopen(os.open(path, flags), "rb") as file:
        return (
            file.read(limit) if stat.S_ISREG(os.fstat(file.fileno()).st_mode) else b""
        )


def checked_reply(told: Any, cells: int, cases: int, results: int) -> Reply:
    """The reply as a ``Reply``; raises ``Unreadable`` where a part is not what it should be."""
    if not isinstance(told, dict):
        raise wire.Unreadable("no table of results")
    notes = tuple(
        (note[0], clean(note[1], TEXT_LIMIT * 3))
        for note in _list(told.get("notes", []))[:cells]
        if isinstance(note, list)
        and len(note) == 2
        and type(note[0]) is int
        and 0 <= note[0] < cells
    )
    held = tuple(word for word in LIMIT_WORDS if word in _list(told.get("held", [])))
    if told.get("missing") is True:
        return Reply(missing=True, notes=notes, held=held)
    if told.get("blank") is True:
        return Reply(blank=True, notes=notes, held=held)
    if "fault" in told:
        return Reply(
            fault=clean(told["fault"], TEXT_LIMIT * 3) or "it stopped",
            notes=notes,
            held=held,
        )
    outcomes = tuple(_outcome(one, results) for one in _list(told.get("outcomes")))
    if len(outcomes) != cases:
        raise wire.Unreadable(f"{len(outcomes)} results for {cases} cases")
    return Reply(outcomes, notes=notes, held=held)


def _outcome(told: Any, results: int) -> Outcome:
    if not isinstance(told, dict) or told.get("kind") not in KINDS:
        raise wire.Unreadable("a result of unknown kind")
    text, printed = (
        clean(told.get("text", ""), TEXT_LIMIT * 3),
        clean(told.get("printed", ""), PRINTED_LIMIT),
    )
    if told["kind"] != "value":
        return Outcome(told["kind"], text=text, printed=printed)
    values = _list(told.get("values"))
    if len(values) != results or not all(
        isinstance(value, np.ndarray) for value in values
    ):
        raise wire.Unreadable("a result that is not made of arrays")
    return Outcome("value", tuple(values), text, printed)


def _list(value: Any) -> Sequence[Any]:
    if not isinstance(value, list):
        raise wire.Unreadable("no list where one belongs")
    return value


def clean(text: Any, limit: int) -> str:
    """A stranger's text, cut, and without characters that terminals, tables or encoders stumble over."""
    if not isinstance(text, str):
        return ""
    plain = text[:limit].encode("utf-8", "replace").decode("utf-8")
    return "".join(
        c if c.isprintable() or c in "\n\t" else "\N{REPLACEMENT CHARACTER}"
        for c in plain
    )
