"""Read the reply of a student's process: untrusted data, all checked, none executed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.exercises.answer import PRINTED_LIMIT, TEXT_LIMIT, Outcome
from course.sandbox import wire

LIMIT_WORDS = (
    "processor time",
    "memory",
    "file size",
    "open files",
    "one process",
    "system calls",
)
KINDS = ("value", "none", "raised", "unreadable", "unattempted")


@dataclass(frozen=True)
class Reply:
    """The checked reply: the outcomes, or why there are none.

    ``notes`` are pairs (cell, the exception it raised).
    """

    outcomes: tuple[Outcome, ...] = ()
    missing: bool = False
    blank: bool = False
    fault: str = ""
    notes: tuple[tuple[int, str], ...] = ()
    held: tuple[str, ...] = ()


def checked_reply(told: Any, cells: int, most: Sequence[int], results: int) -> Reply:
    """The reply as a ``Reply``; raises ``Unreadable`` where a part is not as it should
    be.
    """
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
    listed = _list(told.get("outcomes"))
    if len(listed) != len(most):
        raise wire.Unreadable(f"{len(listed)} results for {len(most)} cases")
    outcomes = tuple(map(_outcome, listed, most, [results] * len(most)))
    return Reply(outcomes, notes=notes, held=held)


def _outcome(told: Any, most: int, results: int) -> Outcome:
    if not isinstance(told, dict) or told.get("kind") not in KINDS:
        raise wire.Unreadable("a result of unknown kind")
    text, printed = (
        clean(told.get("text", ""), TEXT_LIMIT * 3),
        clean(told.get("printed", ""), PRINTED_LIMIT),
    )
    given = told.get("given", {})
    if not isinstance(given, dict):
        raise wire.Unreadable("arguments that are no table")
    if told["kind"] != "value":
        return Outcome(told["kind"], text=text, printed=printed, given=given)
    values = _list(told.get("values"))
    if len(values) != results or not all(
        isinstance(value, np.ndarray) for value in values
    ):
        raise wire.Unreadable("a result that is not made of arrays")
    if (count := sum(value.size for value in values)) > most:
        raise wire.Unreadable(f"{count} numbers where at most {most} were expected")
    return Outcome("value", tuple(values), text, printed, given)


def _list(value: Any) -> Sequence[Any]:
    if not isinstance(value, list):
        raise wire.Unreadable("no list where one belongs")
    return value


def clean(text: Any, limit: int) -> str:
    """Untrusted text, cut to ``limit``, without characters that break terminals or
    tables.
    """
    if not isinstance(text, str):
        return ""
    plain = text[:limit].encode("utf-8", "replace").decode("utf-8")
    return "".join(
        c if c.isprintable() or c in "\n\t" else "\N{REPLACEMENT CHARACTER}"
        for c in plain
    )
