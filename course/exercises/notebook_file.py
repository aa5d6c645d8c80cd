"""Read a submitted notebook: which lesson it is, its import cell, and the cell of each exercise.

Nothing of the notebook is run here; its code is only parsed to see which names a cell defines.
"""

from __future__ import annotations

import ast
import difflib
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nbformat

from course.exercises.definition import Lesson, all_lessons

MAXIMUM_BYTES = 50_000_000


class UnusableNotebook(ValueError):
    """The file cannot be marked at all; the message says why."""


@dataclass(frozen=True)
class ExerciseCell:
    """Where an exercise's answer is: its source, or in ``fault`` why there is none.

    ``needs_person`` marks what a grader should look at (a renamed function, a deleted cell), ``nearest`` the name
    found in its place.
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


def read_notebook(path: Path) -> NotebookFile:
    """Read a notebook for marking; raises ``UnusableNotebook`` with the reason where that is not possible."""
    notebook = _load(path)
    sources = [(cell.get("metadata", {}), cell.source) for cell in notebook.cells if cell.cell_type == "code"]
    lesson = _lesson_of(notebook, path, [source for _, source in sources])
    names = [e.name for e in lesson.exercises]
    defined = {i: defined_names(source) for i, (_, source) in enumerate(sources)}
    cells = tuple(_find(name, names, sources, defined) for name in names)
    return NotebookFile(path, lesson, _preamble(sources, names, defined), cells)


def defined_names(source: str) -> tuple[str, ...]:
    """The names of functions and variables that a cell defines at its top level; none if it does not parse."""
    tree = _parse(source)
    if tree is None:
        return ()
    names: list[str] = []
    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            names.append(node.name)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names += [t.id for t in targets if isinstance(t, ast.Name)]
    return tuple(names)


def _load(path: Path) -> Any:
    if not path.is_file():
        raise UnusableNotebook("no such file" if not path.exists() else "not a file")
    size = path.stat().st_size
    if size == 0:
        raise UnusableNotebook("the file is empty")
    if size > MAXIMUM_BYTES:
        raise UnusableNotebook(f"{size / 1e6:.0f} MB is too large for a notebook (limit {MAXIMUM_BYTES / 1e6:.0f} MB)")
    try:
        text = path.read_text(encoding="utf-8")
        notebook = nbformat.reads(text, as_version=4)
        nbformat.validate(notebook)
    except UnicodeDecodeError:
        raise UnusableNotebook("not a notebook: not text in UTF-8") from None
    except RecursionError:
        raise UnusableNotebook("not a notebook: nested too deeply") from None
    except OSError as error:
        raise UnusableNotebook(f"cannot be read: {error.strerror or error}") from None
    except Exception as error:  # nbformat raises several kinds for what is not a notebook
        raise UnusableNotebook(f"not a notebook: {str(error).splitlines()[0][:120]}") from None
    if not any(cell.cell_type == "code" for cell in notebook.cells):
        raise UnusableNotebook("a notebook without a code cell")
    return notebook


def _lesson_of(notebook: Any, path: Path, sources: Sequence[str]) -> Lesson:
    """The lesson by the notebook's own word, else by its file name, else by the exercises it defines."""
    lessons = {lesson.number: lesson for lesson in all_lessons()}
    told = notebook.metadata.get("course", {})
    number = str(told.get("lesson", "")) if isinstance(told, dict) else ""
    if number in lessons:
        return lessons[number]
    match = re.search(r"(?<!\d)(\d\d)-[a-z]", path.name)
    if match and match.group(1) in lessons:
        return lessons[match.group(1)]
    names = {name for source in sources for name in defined_names(source)}
    best = max(lessons.values(), key=lambda le: len(names & {e.name for e in le.exercises}), default=None)
    if best is None or not names & {e.name for e in best.exercises}:
        raise UnusableNotebook("none of the lessons: it names no lesson and defines no exercise")
    return best


def _find(name: str, names: Sequence[str], sources: list[Any], defined: dict[int, tuple[str, ...]]) -> ExerciseCell:
    holders = [i for i, found in defined.items() if name in found]
    if holders:  # the last definition counts, as it does when the notebook is run from top to bottom
        return ExerciseCell(name, sources[holders[-1]][1])
    own = [source for metadata, source in sources if _exercise_of(metadata) == name]
    if own and _parse(own[0]) is None:
        return ExerciseCell(name, own[0], fault="the cell is not valid Python: " + _syntax_error(own[0]))
    others = [n for found in defined.values() for n in found if n not in names]
    local = [n for n in (defined_names(own[0]) if own else ()) if n not in names]
    near = local or difflib.get_close_matches(name, others, n=1, cutoff=0.7)
    if near:
        fault = f"no {name} in the notebook; the nearest name is {near[0]}"
        return ExerciseCell(name, own[0] if own else "", fault, needs_person=True, nearest=near[0])
    if own:
        return ExerciseCell(name, own[0], f"the exercise's cell defines no {name}", needs_person=True)
    return ExerciseCell(name, fault=f"no cell defines {name}: was it deleted?", needs_person=True)


def _preamble(sources: list[Any], names: Sequence[str], defined: dict[int, tuple[str, ...]]) -> tuple[str, ...]:
    """The import cell, then the definitions in cells that students added (helpers their answers call)."""
    code = []
    for i, (metadata, source) in enumerate(sources):
        told = metadata.get("course", {})
        role = told.get("role", "") if isinstance(told, dict) else ""
        if role == "imports":
            code.append(source)
        elif not told and not set(defined[i]) & set(names):
            helpers = _definitions_only(source)
            if helpers:
                code.append(helpers)
    return tuple(code)


def _definitions_only(source: str) -> str:
    tree = _parse(source)
    if tree is None:
        return ""
    kept = [n for n in tree.body if isinstance(n, (ast.FunctionDef, ast.ClassDef, ast.Import, ast.ImportFrom))]
    return "\n\n".join(ast.unparse(node) for node in kept)


def _exercise_of(metadata: Any) -> str:
    told = metadata.get("course", {})
    return str(told.get("exercise", "")) if isinstance(told, dict) else ""


def _parse(source: str) -> ast.Module | None:
    """The cell's syntax tree, IPython's own lines (%magic, !shell, ?help) left out; None if it does not parse."""
    kept = ["pass" if re.match(r"[%!?]", line) else line for line in source.splitlines()]
    try:
        return ast.parse("\n".join(kept))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def _syntax_error(source: str) -> str:
    try:
        ast.parse(source)
    except SyntaxError as error:
        return f"{error.msg} (line {error.lineno})"
    except (ValueError, RecursionError, MemoryError) as error:
        return str(error)
    return "it does not parse"
