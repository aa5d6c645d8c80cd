"""Read what a student's process sent back. It is data from a stranger: everything is checked, nothing is run."""

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
    """What came back, checked: the outcomes, or why there are none; ``checked`` where the notebook itself asked,
    ``unlike`` what the answer may lean on that its author's kernel had and this process had not."""

    outcomes: tuple[Outcome, ...] = ()
    missing: bool = False
    blank: bool = False
    fault: str = ""
    held: tuple[str, ...] = ()
    checked: bool = False
    unlike: str = ""


def checked_reply(told: Any, most: Sequence[int], results: int) -> Reply:
    """The reply as a ``Reply``; raises ``Unreadable`` where a part is not what it should be."""
    if not isinstance(told, dict):
        raise wire.Unreadable("no table of results")
    held = tuple(word for word in LIMIT_WORDS if word in _list(told.get("held", [])))
    more: dict[str, Any] = {"held": held, "checked": told.get("checked") is True,
                            "unlike": clean(told.get("unlike", ""), 200)}  # fmt: skip
    if told.get("missing") is True:
        return Reply(missing=True, **more)
    if told.get("blank") is True:
        return Reply(blank=True, **more)
    if "fault" in told:
        fault = clean(told["fault"], TEXT_LIMIT * 3) or "it stopped"
        return Reply(fault=fault, **more)
    listed = _list(told.get("outcomes"))
    if len(listed) != len(most):
        raise wire.Unreadable(f"{len(listed)} results for {len(most)} cases")
    outcomes = tuple(map(_outcome, listed, most, [results] * len(most)))
    return Reply(outcomes, **more)


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
    """A stranger's text, cut, and without characters that terminals, tables or encoders stumble over."""
    if not isinstance(text, str):
        return ""
    plain = text[:limit].encode("utf-8", "replace").decode("utf-8")
    return "".join(
        c if c.isprintable() or c in "\n\t" else "\N{REPLACEMENT CHARACTER}"
        for c in plain
    )
