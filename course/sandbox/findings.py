"""What came of a submission, read from what its process sent: data from a stranger, checked part by part."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from course.exercises.notebook_file import Outline
from course.exercises.question import Question
from course.exercises.untrusted_text import clean
from course.sandbox import wire
from course.sandbox.ending import ENDS, End
from course.sandbox.reply import Reply, checked_reply

#: Numbers and text of a reply but its arrays [bytes]: for each case and each cell.
REPLY_HEADER = 20_000
MOST_REFUSED = 20


@dataclass(frozen=True)
class Found:
    """What reading found of an exercise: "blank", "fault" (with why), or "run"."""

    state: str
    fault: str = ""
    nearest: str = ""
    needs_person: bool = False


@dataclass(frozen=True)
class Reading:
    """What a notebook is: its lesson's number, and what was found of each exercise, in the lesson's order."""

    lesson: str
    exercises: tuple[Found, ...]


@dataclass(frozen=True)
class Run:
    """How one answer to an exercise ended, the case it stood at then (-1: none), and the reply if one came."""

    end: End
    case: int = -1
    reply: Reply | None = None
    detail: str = ""
    seconds: float = 0.0


@dataclass(frozen=True)
class Answers:
    """What a notebook gave for an exercise: a run for every time it was checked, or one at the notebook's end.

    ``own`` is how the exercise's own cell was stopped, ``others`` whether other cells were (end, detail); ``notes``
    are what cells raised, each with whether it is the exercise's own; ``refused`` what was tried and refused.
    """

    runs: tuple[Run, ...] = ()
    own: tuple[End, str] | None = None
    others: tuple[tuple[End, str], ...] = ()
    notes: tuple[tuple[bool, str], ...] = ()
    refused: tuple[str, ...] = ()
    whole: bool = True


#: Where the process is gone before it said anything of an exercise.
GONE = Answers((Run("killed", detail="its process was ended from outside"),), whole=False)  # fmt: skip


def checked_reading(sent: Any, lessons: Sequence[Outline]) -> Reading | None:
    """What the process found of a notebook it had only parsed; None where that is of no lesson."""
    lesson = next((o for o in lessons if o.number == sent["lesson"]), None)
    if lesson is None or len(sent["exercises"]) != len(lesson.exercises):
        return None
    found = tuple(
        Found(one["state"], clean(one["fault"], 300), clean(one["nearest"], 100),
              bool(one["person"]))
        for one in sent["exercises"]
    )  # fmt: skip
    return Reading(lesson.number, found)


def checked_answers(sent: Mapping[str, Any] | None, question: Question) -> Answers:
    """The answers to a question; whatever a stranger's data may bring about, it is theirs that is wrong."""
    if sent is None:
        return GONE
    try:
        return Answers(
            tuple(checked_run(one, question) for one in sent.get("runs", [])),
            _stopped(sent.get("own")),
            tuple(filter(None, map(_stopped, sent.get("others", [])))),
            tuple(
                (bool(own), clean(text, 3000)) for own, text in sent.get("notes", [])
            ),
            tuple(clean(r, 200) for r in sent.get("refused", [])[:MOST_REFUSED]),
            sent.get("whole") is True,
        )
    except Exception as error:
        detail = clean(str(error), 200)
        return Answers((Run("unreadable", detail=detail),), whole=False)


def checked_run(sent: Mapping[str, Any], question: Question) -> Run:
    """One run of an answer, its reply too where one came."""
    end = _end(sent.get("end"))
    stage, _, number = str(sent.get("stage", "")).partition(" ")
    there = stage == "case" and number.isdecimal() and len(number) < 9
    case = int(number) if there else -1
    run = Run(
        end,
        case if case < len(question.cases) else -1,
        detail=clean(sent.get("detail"), 200),
        seconds=float(sent.get("seconds", 0.0)),
    )
    if end != "replied":
        return run
    try:
        room = REPLY_HEADER * (1 + len(question.cases))
        reply = wire.unpack(sent["reply"].tobytes(), header=room)
        return replace(run, reply=checked_reply(reply, question))
    except Exception as error:
        return replace(run, end="unreadable", detail=clean(str(error), 200))


def _end(sent: Any) -> End:
    return next((e for e in ENDS if e == sent), "unreadable")


def _stopped(sent: Any) -> tuple[End, str] | None:
    if not sent:
        return None
    return _end(sent[0]), clean(sent[1], 200)
