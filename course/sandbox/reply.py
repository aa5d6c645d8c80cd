"""Read what a student's process sent back. It is data from a stranger: everything is checked, nothing is run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from course.exercises.answer import PRINTED_LIMIT, TEXT_LIMIT, Answer, Outcome
from course.exercises.question import Question
from course.exercises.untrusted_text import clean
from course.sandbox import wire

LIMIT_WORDS = (
    "processor time",
    "memory",
    "file size",
    "open files",
    "one process",
    "system calls",
)
KINDS = ("value", "none", "raised", "unreadable")


@dataclass(frozen=True)
class Reply:
    """What came back, checked: the answer, or that there is no such name (``missing``).

    ``held`` are the limits that took effect; ``checked`` where the notebook itself asked; ``unlike`` what the answer
    may lean on that its author's kernel had and this process had not.
    """

    answer: Answer = field(default_factory=Answer)
    missing: bool = False
    held: tuple[str, ...] = ()
    checked: bool = False
    unlike: str = ""


def checked_reply(sent: Any, question: Question) -> Reply:
    """The reply as a ``Reply``; raises ``Unreadable`` where a part is not what it should be."""
    if not isinstance(sent, dict):
        raise wire.Unreadable("no table of results")
    held = tuple(word for word in LIMIT_WORDS if word in _list(sent.get("held", [])))
    more: dict[str, Any] = {"held": held, "checked": sent.get("checked") is True,
                            "unlike": clean(sent.get("unlike", ""), 200)}  # fmt: skip
    if sent.get("missing") is True:
        return Reply(missing=True, **more)
    return Reply(_answer(sent, question), **more)


def _answer(sent: dict[str, Any], question: Question) -> Answer:
    if sent.get("blank") is True:
        return Answer(blank=True)
    if "fault" in sent:
        return Answer(fault=clean(sent["fault"], TEXT_LIMIT * 3) or "it stopped")
    listed = _list(sent.get("outcomes"))
    if len(listed) != len(question.most):
        raise wire.Unreadable(f"{len(listed)} results for {len(question.most)} cases")
    pairs = zip(listed, question.most, strict=True)
    return Answer(
        tuple(checked_outcome(one, most, question.results) for one, most in pairs)
    )


def checked_outcome(sent: Any, most: int, results: int) -> Outcome:
    """What an answer gave in one case: ``results`` arrays of at most so many numbers together, or why there are
    none; raises ``Unreadable``."""
    if not isinstance(sent, dict) or sent.get("kind") not in KINDS:
        raise wire.Unreadable("a result of unknown kind")
    text, printed = (
        clean(sent.get("text", ""), TEXT_LIMIT * 3),
        clean(sent.get("printed", ""), PRINTED_LIMIT),
    )
    given = sent.get("given", {})
    if not isinstance(given, dict):
        raise wire.Unreadable("arguments that are no table")
    if sent["kind"] != "value":
        return Outcome(sent["kind"], text=text, printed=printed, given=given)
    values = _list(sent.get("values"))
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
