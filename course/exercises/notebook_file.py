"""Read a submitted notebook: its lesson, its import cell, and the cell of each
exercise.

Nothing of the notebook is run here; its code is only parsed to see which names a cell
defines. When marking, this happens inside the box: parsing untrusted text takes as much
time and memory as its author likes.
"""

from __future__ import annotations

import difflib
import hashlib
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from course.exercises.source import (
    cell_tree,
    defined_names,
    definitions_only,
    is_blank,
    python_only,
    syntax_error,
)

MAXIMUM_BYTES = 50_000_000
#: Code cells; a lesson has about fifty.
MAXIMUM_CELLS = 20_000
#: Names among which the nearest to a missing one is sought.
MAXIMUM_NAMES = 2_000


class UnusableNotebook(ValueError):
    """The file cannot be marked at all; the message says why."""


@dataclass(frozen=True)
class ExerciseCell:
    """Where an exercise's answer is: its source, or in ``fault`` why there is none.

    ``needs_person`` marks what a grader should look at (a renamed function, a deleted
    cell), ``nearest`` the name found instead, in ``source``.
    """

    name: str
    source: str = ""
    fault: str = ""
    needs_person: bool = False
    nearest: str = ""


@dataclass(frozen=True)
class Outline:
    """What reading needs to know of a lesson: its number, the names of its exercises, and digests (``digest_of``) of
    the lesson's own cells as they are handed out."""

    number: str
    exercises: tuple[str, ...]
    handed_out: frozenset[str] = frozenset()


@dataclass(frozen=True)
class NotebookFile:
    """A submission: its lesson, the code that runs first, the exercise cells in the lesson's order, and all code cells
    in the notebook's order."""

    lesson: str
    preamble: tuple[str, ...]
    cells: tuple[ExerciseCell, ...]
    code: tuple[CodeCell, ...] = ()


@dataclass(frozen=True)
class CodeCell:
    """A code cell: its source, the exercise it is for, its role, and whether it is the lesson's own, unchanged."""

    source: str
    exercise: str = ""
    role: str = ""
    handed_out: bool = False


def digest_of(source: str) -> str:
    """A digest of a cell."""
    return hashlib.sha256(source.encode("utf-8", "replace")).hexdigest()


@dataclass(frozen=True)
class _Cell:
    """A code cell: its source and the lesson author's notes on it."""

    source: str
    metadata: Mapping[str, Any]
    defines: tuple[str, ...]

    @property
    def notes(self) -> Mapping[str, Any]:
        """The notes of this course; empty for cells that students added."""
        notes = self.metadata.get("course", {})
        return notes if isinstance(notes, dict) else {}

    @property
    def exercise(self) -> str:
        return str(self.notes.get("exercise", ""))


def parse_notebook(
    content: bytes, file_name: str, lessons: Sequence[Outline]
) -> NotebookFile:
    """A notebook taken apart for marking; raises ``UnusableNotebook`` with the reason.

    ``lessons`` are the ones it may be of.
    """
    notebook = _load(content)
    cells = _code_cells(notebook)
    lesson = _lesson_of(notebook, file_name, cells, lessons)
    names = lesson.exercises
    found = tuple(_find(name, names, cells) for name in names)
    code = tuple(
        CodeCell(
            cell.source,
            cell.exercise if cell.exercise in names else "",
            str(cell.notes.get("role", "")),
            digest_of(cell.source) in lesson.handed_out,
        )
        for cell in cells
    )
    return NotebookFile(lesson.number, _preamble(cells, names), found, code)


def _load(content: bytes) -> Mapping[str, Any]:
    if not content:
        raise UnusableNotebook("the file is empty")
    if len(content) > MAXIMUM_BYTES:
        raise UnusableNotebook(too_large(len(content)))
    try:
        notebook = json.loads(content.decode("utf-8-sig"))
    except UnicodeDecodeError:
        raise UnusableNotebook("not a notebook: not text in UTF-8") from None
    except RecursionError:
        raise UnusableNotebook("not a notebook: nested too deeply") from None
    except ValueError as error:
        why = str(error)[:120]
        raise UnusableNotebook(f"not a notebook: not JSON ({why})") from None
    if not isinstance(notebook, dict) or not isinstance(notebook.get("nbformat"), int):
        raise UnusableNotebook(
            "not a notebook: JSON, but without a notebook's format number"
        )
    return notebook if notebook["nbformat"] >= 4 else _upgraded(notebook)


def too_large(size: int) -> str:
    """Why a file of this many bytes is not read."""
    limit = MAXIMUM_BYTES / 1e6
    return f"{size / 1e6:.0f} MB is too large for a notebook (limit {limit:.0f} MB)"


def _upgraded(notebook: Mapping[str, Any]) -> Mapping[str, Any]:
    """A notebook of the formats 1 to 3 in format 4."""
    import nbformat  # takes seconds to import, and hardly any notebook needs it

    try:
        upgraded: Mapping[str, Any] = nbformat.reads(json.dumps(notebook), as_version=4)
    except (
        Exception
    ) as error:  # nbformat raises several kinds for what is not a notebook
        raise UnusableNotebook(
            f"not a notebook: {str(error).splitlines()[0][:120]}"
        ) from None
    return upgraded


def _code_cells(notebook: Mapping[str, Any]) -> list[_Cell]:
    """The code cells. Only what marking needs is checked: Jupyter opens more than its
    schema.
    """
    cells = notebook.get("cells")
    if not isinstance(cells, list):
        raise UnusableNotebook("not a notebook: it has no list of cells")
    code = []
    for cell in cells:
        if not isinstance(cell, dict) or cell.get("cell_type") != "code":
            continue
        source, metadata = cell.get("source", ""), cell.get("metadata", {})
        if isinstance(source, list):
            source = "".join(line for line in source if isinstance(line, str))
        if isinstance(source, str):
            code.append(
                _Cell(
                    source,
                    metadata if isinstance(metadata, dict) else {},
                    defined_names(source),
                )
            )
    if not code:
        raise UnusableNotebook("a notebook without a code cell")
    if len(code) > MAXIMUM_CELLS:
        raise UnusableNotebook(
            f"{len(code):,} code cells are too many (limit {MAXIMUM_CELLS:,})"
        )
    return code


def _lesson_of(
    notebook: Mapping[str, Any],
    file_name: str,
    cells: Sequence[_Cell],
    known: Sequence[Outline],
) -> Outline:
    """The lesson that the notebook names, else its file name, else its exercises."""
    lessons = {lesson.number: lesson for lesson in known}
    metadata = notebook.get("metadata", {})
    notes = metadata.get("course", {}) if isinstance(metadata, dict) else {}
    number = str(notes.get("lesson", "")) if isinstance(notes, dict) else ""
    if number in lessons:
        return lessons[number]
    match = re.search(r"(?<!\d)(\d\d)-[a-z]+(.*-more(?![a-z]))?", file_name)
    for number in (f"{match[1]}-more",) * bool(match[2]) + (match[1],) if match else ():
        if number in lessons:
            return lessons[number]
    names = {name for cell in cells for name in cell.defines}
    best = max(known, key=lambda le: len(names & set(le.exercises)), default=None)
    if best is None or not names & set(best.exercises):
        raise UnusableNotebook(
            "none of the lessons: it names no lesson and defines no exercise"
        )
    return best


def _find(name: str, names: Sequence[str], cells: Sequence[_Cell]) -> ExerciseCell:
    holder = _holder(name, cells)
    if holder is not None:
        return ExerciseCell(name, holder.source)
    own = next((cell for cell in cells if cell.exercise == name), None)
    if own is not None and cell_tree(own.source) is None:
        return ExerciseCell(
            name,
            own.source,
            fault="the cell is not valid Python: " + syntax_error(own.source),
        )
    others = [n for cell in cells for n in cell.defines if n not in names]
    others = others[:MAXIMUM_NAMES]
    local = [n for n in (own.defines if own else ())[:MAXIMUM_NAMES] if n not in names]
    near = difflib.get_close_matches(name, local, n=1, cutoff=0.5) or (
        local if len(local) == 1 else []
    )
    near = near or difflib.get_close_matches(name, others, n=1, cutoff=0.7)
    source = own.source if own else ""
    if near:
        source = next(
            (c.source for c in (own, *cells) if c is not None and near[0] in c.defines),
            source,
        )
        fault = f"no {name} in the notebook; the nearest name is {near[0]}"
        return ExerciseCell(name, source, fault, needs_person=True, nearest=near[0])
    if own is not None:
        return ExerciseCell(
            name, source, f"the exercise's cell defines no {name}", needs_person=True
        )
    return ExerciseCell(
        name, fault=f"no cell defines {name}: was it deleted?", needs_person=True
    )


def _holder(name: str, cells: Sequence[_Cell]) -> _Cell | None:
    """The cell that holds the answer.

    A lesson's other cells may use the same name for a number, and a student may try
    things further down: so the exercise's own cell comes before cells that students
    added, and those before the lesson's. A blank comes last, and of equals the last
    counts, as it does when the notebook is run from top to bottom.
    """
    holders = [(i, cell) for i, cell in enumerate(cells) if name in cell.defines]
    theirs = [
        (i, cell) for i, cell in holders if cell.exercise == name or not cell.notes
    ]
    ranked = [
        ((not is_blank(python_only(cell.source), name), cell.exercise == name, i), cell)
        for i, cell in theirs or holders
    ]
    return max(ranked, key=lambda pair: pair[0])[1] if ranked else None


def _preamble(cells: Sequence[_Cell], names: Sequence[str]) -> tuple[str, ...]:
    """The import cell, then the definitions in cells that students added."""
    code = []
    for cell in cells:
        if cell.notes.get("role", "") == "imports":
            code.append(cell.source)
        elif not cell.notes and not set(cell.defines) & set(names):
            helpers = definitions_only(cell.source)
            if helpers:
                code.append(helpers)
    return tuple(code)
