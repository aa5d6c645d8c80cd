"""The syllabus: each topic of the lecture with its lesson section, code, exercise,
test.

The data is ``syllabus.toml`` beside this file. ``problems`` says what is missing for a
topic whose lesson is built; other topics are not checked.
"""

from __future__ import annotations

import ast
import importlib
import json
import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from course.exercises.definition import all_lessons

ROOT = Path(__file__).resolve().parents[2]
DATA = Path(__file__).with_name("syllabus.toml")
NEEDED = ("section", "code", "exercise", "test")


@dataclass(frozen=True)
class Topic:
    """One topic: in words, its lesson (file name without ending), and where it is
    found.

    "" where not built yet.
    """

    what: str
    lesson: str
    section: str = ""
    code: str = ""
    exercise: str = ""
    test: str = ""


@dataclass(frozen=True)
class Row:
    """A row of the syllabus and its slide.

    Row 0 is the loop that uses all the others.
    """

    number: int
    slide: int
    topics: tuple[Topic, ...]


def read_syllabus(data: Path = DATA) -> tuple[Row, ...]:
    """The rows in order. Raises ``ValueError`` naming the row of a missing or unknown
    key.
    """
    rows = []
    for entry in tomllib.loads(data.read_text(encoding="utf-8"))["row"]:
        try:
            topics = tuple(Topic(**topic) for topic in entry["topics"])
            rows.append(Row(entry["number"], entry["slide"], topics))
        except (KeyError, TypeError) as error:
            number = entry.get("number", "without a number")
            raise ValueError(
                f"row {number}: expected number, slide and topics as in syllabus.toml; {error}"
            ) from error
    return tuple(rows)


def syllabus_table(root: Path = ROOT, data: Path = DATA) -> str:
    """The syllabus as text, a topic a line below its row, with what is missing."""
    lines = []
    for row in read_syllabus(data):
        lines.append(
            f"row {row.number}, slide {row.slide}" if row.number else "all rows"
        )
        for topic in row.topics:
            lines.append(f"    {topic.what}")
            lines.append(
                f"        {topic.lesson}: {_places(topic) if is_built(topic, root) else 'not built yet'}"
            )
            if is_built(topic, root):
                lines += [f"        ! {fault}" for fault in faults(row, topic, root)]
    return "\n".join(lines)


def problems(root: Path = ROOT, data: Path = DATA) -> list[str]:
    """What is missing, a line each, for the topics whose lesson is built."""
    return [
        f"row {row.number}, {topic.what}: {fault}"
        for row in read_syllabus(data)
        for topic in row.topics
        if is_built(topic, root)
        for fault in faults(row, topic, root)
    ]


def is_built(topic: Topic, root: Path = ROOT) -> bool:
    """Whether the topic's lesson exists in solutions/."""
    return _solution(topic, root).exists()


def faults(row: Row, topic: Topic, root: Path = ROOT) -> Iterator[str]:
    """What is missing for a built topic."""
    yield from (f"no {key} is named" for key in NEEDED if not getattr(topic, key))
    if topic.section and topic.section.casefold() not in headings(
        _solution(topic, root)
    ):
        yield f"solutions/{topic.lesson}.ipynb has no heading {topic.section!r}"
    if topic.code and not code_exists(topic.code):
        yield f"{topic.code} cannot be imported"
    if topic.exercise:
        yield from _exercise_faults(row, topic)
    if topic.test and not has_test(topic.test, root):
        yield f"there is no test {topic.test}"


def headings(notebook: Path) -> set[str]:
    """The headings of a notebook's text cells, without marks of emphasis, in lower
    case.
    """
    found = set()
    for cell in json.loads(notebook.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] != "markdown":
            continue
        text = "".join(cell["source"])
        for heading in re.findall(
            r"^#{1,6}\s+(.+?)\s*#*\s*$", text, flags=re.MULTILINE
        ):
            found.add(re.sub(r"[*`_]", "", heading).casefold())
    return found


def code_exists(name: str) -> bool:
    """Whether a dotted name leads to an object that can be imported."""
    module, _, attribute = name.rpartition(".")
    try:
        return hasattr(importlib.import_module(module), attribute)
    except (ImportError, ValueError):
        return False


def has_test(name: str, root: Path = ROOT) -> bool:
    """Whether "file::function" (or "file::Class::method") exists in the tests."""
    file, *path = name.split("::")
    try:
        scope: Any = ast.parse((root / file).read_text(encoding="utf-8"))
    except (OSError, SyntaxError):
        return False
    for part in path:
        inside = {
            node.name: node
            for node in scope.body
            if isinstance(node, (ast.FunctionDef, ast.ClassDef))
        }
        if part not in inside:
            return False
        scope = inside[part]
    return bool(path)


def _exercise_faults(row: Row, topic: Topic) -> Iterator[str]:
    found = {
        exercise.name: (lesson, exercise)
        for lesson in all_lessons()
        for exercise in lesson.exercises
    }
    if topic.exercise not in found:
        yield f"no exercise {topic.exercise!r} is registered"
        return
    lesson, exercise = found[topic.exercise]
    if lesson.stem != topic.lesson:
        yield f"exercise {topic.exercise!r} belongs to lesson {lesson.number}"
    if row.number and row.number not in exercise.rows:
        yield f"exercise {topic.exercise!r} names the rows {exercise.rows}, not this one"


def _solution(topic: Topic, root: Path) -> Path:
    return root / "solutions" / f"{topic.lesson}.ipynb"


def _places(topic: Topic) -> str:
    return " -> ".join(getattr(topic, key) or f"no {key}" for key in NEEDED)
