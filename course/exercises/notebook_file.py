"""Read a submitted notebook: which lesson it is, its import cell, and the cell of each exercise.

Nothing of the notebook is run here; its code is only parsed to see which names a cell defines.
"""

from __future__ import annotations

import ast
import difflib
import json
import re
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from course.exercises.answer import is_blank
from course.exercises.definition import Lesson, all_lessons

MAXIMUM_BYTES = 50_000_000
MAXIMUM_CELL = (
    200_000  # characters; longer ones are no answers and cost seconds to parse
)


class UnusableNotebook(ValueError):
    """The file cannot be marked at all; the message says why."""


@dataclass(frozen=True)
class ExerciseCell:
    """Where an exercise's answer is: its source, or in ``fault`` why there is none.

    ``needs_person`` marks what a grader should look at (a renamed function, a deleted cell), ``nearest`` the name
    found in its place, in ``source``.
    """

    name: str
    source: str = ""
    fault: str = ""
    needs_person: bool = False
    nearest: str = ""


@dataclass(frozen=True)
class NotebookFile:
    """A submission: its lesson, the code that runs first, and the exercise cells in the lesson's order."""

    path: Path
    lesson: Lesson
    preamble: tuple[str, ...]
    cells: tuple[ExerciseCell, ...]


@dataclass(frozen=True)
class _Cell:
    """A code cell: its source and what the lesson's author noted beside it."""

    source: str
    metadata: Mapping[str, Any]
    defines: tuple[str, ...]

    @property
    def told(self) -> Mapping[str, Any]:
        """The notes of this course; empty for cells that students added."""
        told = self.metadata.get("course", {})
        return told if isinstance(told, dict) else {}

    @property
    def exercise(self) -> str:
        return str(self.told.get("exercise", ""))


def read_notebook(path: Path, lessons: Sequence[Lesson] | None = None) -> NotebookFile:
    """Read a notebook for marking; raises ``UnusableNotebook`` with the reason where that is not possible.

    ``lessons`` are the ones it may be of (default: all there are).
    """
    notebook = _load(path)
    cells = _code_cells(notebook)
    lesson = _lesson_of(
        notebook, path, cells, all_lessons() if lessons is None else lessons
    )
    names = [e.name for e in lesson.exercises]
    found = tuple(_find(name, names, cells) for name in names)
    return NotebookFile(path, lesson, _preamble(cells, names), found)


def defined_names(source: str) -> tuple[str, ...]:
    """The names of functions and variables that a cell defines at its top level; none if it does not parse.

    ``f = use(f)`` defines nothing: it is how a lesson's own cells call what a student wrote.
    """
    tree = _parse(source)
    if tree is None:
        return ()
    names: list[str] = []
    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            names.append(node.name)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)) and not _is_use(node.value):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            parts = [
                p
                for t in targets
                for p in (t.elts if isinstance(t, (ast.Tuple, ast.List)) else [t])
            ]
            names += [p.id for p in parts if isinstance(p, ast.Name)]
    return tuple(names)


def python_only(source: str) -> str:
    """The cell with IPython's own lines (%magic, !shell, name?) turned into ``pass``; line numbers stay.

    A cell that is Python as it stands is left alone: a line may begin with % inside an expression or a text.
    """
    if _tree(source) is not None:
        return source
    lines = []
    for line in source.splitlines():
        foreign = re.match(r"(\s*)(?:[%!?]|[\w.]+\?{1,2}\s*$|[\w, ]+=\s*[%!])", line)
        lines.append(f"{foreign.group(1)}pass" if foreign else line)
    return "\n".join(lines)


def _load(path: Path) -> Mapping[str, Any]:
    if not path.is_file():
        raise UnusableNotebook("no such file" if not path.exists() else "not a file")
    size = path.stat().st_size
    if size == 0:
        raise UnusableNotebook("the file is empty")
    if size > MAXIMUM_BYTES:
        raise UnusableNotebook(
            f"{size / 1e6:.0f} MB is too large for a notebook (limit {MAXIMUM_BYTES / 1e6:.0f} MB)"
        )
    try:
        notebook = json.loads(path.read_text(encoding="utf-8-sig"))
    except UnicodeDecodeError:
        raise UnusableNotebook("not a notebook: not text in UTF-8") from None
    except RecursionError:
        raise UnusableNotebook("not a notebook: nested too deeply") from None
    except OSError as error:
        raise UnusableNotebook(f"cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        raise UnusableNotebook(
            f"not a notebook: not JSON ({str(error)[:120]})"
        ) from None
    if not isinstance(notebook, dict) or not isinstance(notebook.get("nbformat"), int):
        raise UnusableNotebook(
            "not a notebook: JSON, but without a notebook's format number"
        )
    return notebook if notebook["nbformat"] >= 4 else _upgraded(notebook)


def _upgraded(notebook: Mapping[str, Any]) -> Mapping[str, Any]:
    """A notebook of the formats 1 to 3 in format 4."""
    import nbformat  # takes seconds to import, and hardly a notebook needs it

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
    """The code cells. Only what marking needs is asked of them: Jupyter opens more than its own schema allows."""
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
    return code


def _lesson_of(
    notebook: Mapping[str, Any],
    path: Path,
    cells: Sequence[_Cell],
    known: Sequence[Lesson],
) -> Lesson:
    """The lesson by the notebook's own word, else by its file name, else by the exercises it defines."""
    lessons = {lesson.number: lesson for lesson in known}
    metadata = notebook.get("metadata", {})
    told = metadata.get("course", {}) if isinstance(metadata, dict) else {}
    number = str(told.get("lesson", "")) if isinstance(told, dict) else ""
    if number in lessons:
        return lessons[number]
    match = re.search(r"(?<!\d)(\d\d)-[a-z]", path.name)
    if match and match.group(1) in lessons:
        return lessons[match.group(1)]
    names = {name for cell in cells for name in cell.defines}
    best = max(
        lessons.values(),
        key=lambda le: len(names & {e.name for e in le.exercises}),
        default=None,
    )
    if best is None or not names & {e.name for e in best.exercises}:
        raise UnusableNotebook(
            "none of the lessons: it names no lesson and defines no exercise"
        )
    return best


def _find(name: str, names: Sequence[str], cells: Sequence[_Cell]) -> ExerciseCell:
    holder = _holder(name, cells)
    if holder is not None:
        return ExerciseCell(name, holder.source)
    own = next((cell for cell in cells if cell.exercise == name), None)
    if own is not None and _parse(own.source) is None:
        return ExerciseCell(
            name,
            own.source,
            fault="the cell is not valid Python: " + _syntax_error(own.source),
        )
    others = [n for cell in cells for n in cell.defines if n not in names]
    local = [n for n in (own.defines if own else ()) if n not in names]
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

    A lesson's other cells may use the same name for a number, and a student may try things below: so the exercise's
    own cell comes before cells that students added, and those before the lesson's. A blank comes last, and of equals
    the last counts, as it does when the notebook is run from top to bottom.
    """
    holders = [(i, cell) for i, cell in enumerate(cells) if name in cell.defines]
    theirs = [
        (i, cell) for i, cell in holders if cell.exercise == name or not cell.told
    ]
    ranked = [
        ((not is_blank(python_only(cell.source), name), cell.exercise == name, i), cell)
        for i, cell in theirs or holders
    ]
    return max(ranked, key=lambda pair: pair[0])[1] if ranked else None


def _preamble(cells: Sequence[_Cell], names: Sequence[str]) -> tuple[str, ...]:
    """The import cell, then the definitions in cells that students added (helpers and numbers their answers use)."""
    code = []
    for cell in cells:
        if cell.told.get("role", "") == "imports":
            code.append(cell.source)
        elif not cell.told and not set(cell.defines) & set(names):
            helpers = _definitions_only(cell.source)
            if helpers:
                code.append(helpers)
    return tuple(code)


def _definitions_only(source: str) -> str:
    tree = _parse(source)
    if tree is None:
        return ""
    wanted = (
        ast.FunctionDef,
        ast.ClassDef,
        ast.Import,
        ast.ImportFrom,
        ast.Assign,
        ast.AnnAssign,
    )
    try:
        return "\n\n".join(
            ast.unparse(node) for node in tree.body if isinstance(node, wanted)
        )
    except RecursionError:
        return ""


def _is_use(value: ast.expr | None) -> bool:
    return (
        isinstance(value, ast.Call)
        and isinstance(value.func, ast.Name)
        and value.func.id == "use"
    )


def _parse(source: str) -> ast.Module | None:
    """The cell's syntax tree, IPython's own lines left out; None if it does not parse."""
    return _tree(python_only(source))


def _tree(source: str) -> ast.Module | None:
    if len(source) > MAXIMUM_CELL:
        return None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # "\d" in a text is the student's affair
            return ast.parse(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _syntax_error(source: str) -> str:
    if len(source) > MAXIMUM_CELL:
        return f"{len(source)} characters are too many (limit {MAXIMUM_CELL})"
    try:
        ast.parse(python_only(source))
    except SyntaxError as error:
        return f"{error.msg} (line {error.lineno})"
    except (ValueError, RecursionError, MemoryError) as error:
        return str(error)
    return "it does not parse"
