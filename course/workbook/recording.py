"""What a student has done: events appended to one file in work/.course/, and their
summary.

Events are only ever appended, one JSON line each, so two notebooks open at once cannot
lose each other's. They are recorded only by a notebook that lies in work/; tests and
graders run elsewhere and write nothing. In one session (a notebook's kernel) the events
are also kept in memory, so that a lesson opened elsewhere still knows what passed.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from course.exercises.definition import Exercise, Lesson, all_lessons
from course.workbook.course_folder import append_line, kept_text
from course.workbook.overview import Table, table, write_page

FILE_NAME = "progress.jsonl"
UNRECOGNISED = "unrecognised.jsonl"
_session: list[dict[str, Any]] = []


@dataclass(frozen=True)
class State:
    """The summary of the events: exercises passed, hints taken, predictions made."""

    passed: frozenset[str] = frozenset()
    hints: dict[str, int] = field(default_factory=dict)
    predicted: frozenset[str] = frozenset()
    reference_opened: frozenset[str] = frozenset()


def recording_folder(start: Path | None = None) -> Path | None:
    """The work/ folder that contains ``start`` (default: the current one), or None."""
    here = (start or Path.cwd()).resolve()
    for folder in (here, *here.parents):
        if folder.name == "work" and (folder.parent / "lessons").is_dir():
            return folder
    return None


def record(kind: str, name: str, **details: Any) -> None:
    """Append one event.

    A folder that cannot be written is no reason to stop a student.
    """
    event = {
        "time": time.strftime("%Y-%m-%dT%H:%M:%S"),
        "kind": kind,
        "name": name,
        **details,
    }
    _session.append(event)
    folder = recording_folder()
    if folder is not None:
        append_line(folder, FILE_NAME, json.dumps(event))
        write_page(folder, state(folder).passed)


def record_unrecognised(name: str, source: str, message: str) -> None:
    """Keep a wrong answer that matches no planted mistake, so that one can be planted
    later.

    It stays on this machine.
    """
    folder = recording_folder()
    line = json.dumps({"exercise": name, "source": source, "message": message})
    if folder is not None and line not in kept_text(folder, UNRECOGNISED).splitlines():
        append_line(folder, UNRECOGNISED, line)  # once: a cell is run more than once


def state(folder: Path | None = None) -> State:
    """Fold the recorded events, and this session's, into a state."""
    folder = folder or recording_folder()
    events = [*(_events(folder) if folder else ()), *_session]
    hints: dict[str, int] = {}
    for event in events:
        tier = event.get("tier")
        if event["kind"] == "hint" and isinstance(tier, int):
            hints[event["name"]] = max(hints.get(event["name"], 0), tier)
    return State(
        passed=frozenset(
            e["name"]
            for e in events
            if e["kind"] == "check" and e.get("state") == "passed"
        ),
        hints=hints,
        predicted=frozenset(e["name"] for e in events if e["kind"] == "predict"),
        reference_opened=frozenset(n for n, tier in hints.items() if tier > 3),
    )


def predicted(name: str, folder: Path | None = None) -> Any:
    """The last answer given to a prediction, here or in this session.

    None if none was.
    """
    folder = folder or recording_folder()
    events = [*(_events(folder) if folder else ()), *_session]
    return next(
        (
            e.get("answer")
            for e in reversed(events)
            if e["kind"] == "predict" and e["name"] == name
        ),
        None,
    )


def hinted_in_this_session(name: str) -> bool:
    """Whether this kernel has shown a hint for the exercise."""
    return any(e["kind"] == "hint" and e["name"] == name for e in _session)


def next_exercise(
    lesson: Lesson, after: str, passed: frozenset[str]
) -> Exercise | None:
    """The first exercise not passed yet, searched from the one after ``after`` and
    around.
    """
    names = [e.name for e in lesson.exercises]
    start = names.index(after) + 1 if after in names else 0
    order = [*lesson.exercises[start:], *lesson.exercises[:start]]
    counted = lesson.counted
    return next((e for e in order if e.name not in passed and e in counted), None)


def first_unfinished(folder: Path | None = None) -> Lesson | None:
    """The first lesson with a core exercise that has not passed.

    None when all is done.
    """
    passed = state(folder).passed
    return next(
        (le for le in all_lessons() if any(e.name not in passed for e in le.core)), None
    )


def progress(folder: Path | None = None) -> Table:
    """How far you are: core exercises done by lesson, minutes left, and what comes
    next.
    """
    return table(state(folder).passed)


def _events(folder: Path) -> Iterator[dict[str, Any]]:
    """The events kept in a folder; a line cut off by a crash is skipped, the others
    count.
    """
    for line in kept_text(folder, FILE_NAME).splitlines():
        try:
            event = json.loads(line)
        except (ValueError, RecursionError):
            continue
        if (
            isinstance(event, dict)
            and isinstance(event.get("name"), str)
            and "kind" in event
        ):
            yield event
