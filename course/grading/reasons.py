"""The reason of a row: one line of a message, written for the table of marks and read again for the grader's page."""

from __future__ import annotations

from course.exercises.message import Message

REASON_LIMIT = 500
SEPARATOR = " | "
#: Labels of parts that describe one run and no cause.
OF_ONE_RUN = ("case: ", "expected: ", "got: ")


def reason_of(message: Message, *more: str) -> str:
    """Why an answer has no points, in one line, with ``more`` causes; empty where there is nothing to say."""
    words = [f"{p.label}: {p.text}" for p in message.parts if p.about == "run"]
    words += [p.text for p in message.parts if p.about == "cause"]
    words += more
    line = SEPARATOR.join(" ".join(word.split()) for word in words)
    if len(line) <= REASON_LIMIT:
        return line
    return line[: REASON_LIMIT - 1] + "\N{HORIZONTAL ELLIPSIS}"


def causes_in(reason: str) -> set[str]:
    """The causes that a reason names, without what describes one run."""
    parts = reason.split(SEPARATOR)
    return {part for part in parts if part and not part.startswith(OF_ONE_RUN)}
