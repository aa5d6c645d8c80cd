"""From a notebook to what is run of it. It happens in the box, before anything is run."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import Literal

from course.exercises.notebook_file import CodeCell, ExerciseCell, NotebookFile
from course.exercises.source import (
    DYNAMIC,
    closure,
    facts_of,
    is_blank,
    is_left_blank,
    mentions,
    python_only,
)

State = Literal["blank", "fault", "run"]
#: What a kernel keeps of cells and their results, by number.
NUMBERED = re.compile(r"_{1,3}|_i{1,3}|_i?\d+|_[iod]h|In|Out")
RECALLS = re.compile(r"^\s*%(rerun|recall|rep|macro|save|history|hist|edit)\b", re.M)


@dataclass(frozen=True)
class Planned:
    """An exercise: blank, at fault as far as its source tells (``cell`` says why), or to be run; and its own cells."""

    cell: ExerciseCell
    state: State
    own: tuple[int, ...] = ()


@dataclass(frozen=True)
class Step:
    """A code cell to run: its place, source, whether to go on after a statement that fails, and its number in a kernel
    that runs the notebook once."""

    index: int
    source: str
    tolerant: bool = False
    number: int = 0


def plan_of(notebook: NotebookFile) -> tuple[Planned, ...]:
    """What reading tells of each exercise, in the lesson's order."""
    return tuple(_planned(notebook, cell) for cell in notebook.cells)


def steps_of(notebook: NotebookFile) -> tuple[Step, ...]:
    """The cells to run, in the notebook's order: all but the lesson's own that are unchanged and not needed.

    An import that fails stops no other: what is missing may not be needed.
    """
    theirs = [facts_of(cell.source) for cell in notebook.code if not cell.handed_out]
    given = [cell for cell in notebook.code if cell.handed_out]
    used = frozenset[str]().union(*(facts.uses for facts in theirs))
    told = (cell.source for cell in notebook.code)
    if (
        used & DYNAMIC
        or any(map(NUMBERED.fullmatch, used))
        or any(map(RECALLS.search, told))
        or not all(facts.parsed for facts in theirs)
    ):
        needed = set(map(id, given))
    else:
        needed = {id(given[i]) for i in closure([c.source for c in given], used)}
    numbers = accumulate(bool(cell.source.strip()) for cell in notebook.code)
    return tuple(
        Step(index, cell.source, cell.role == "imports", number)
        for index, (cell, number) in enumerate(zip(notebook.code, numbers, strict=True))
        if not cell.handed_out or id(cell) in needed
    )


def _planned(notebook: NotebookFile, cell: ExerciseCell) -> Planned:
    source = python_only(cell.source)
    own = tuple(i for i, c in enumerate(notebook.code) if _is_of(c, cell))
    if is_blank(source, cell.name) or (cell.fault and is_left_blank(source)):
        elsewhere = any(mentions(s, cell.name) for s in _theirs(notebook, but=cell))
        return Planned(cell, "run" if elsewhere else "blank", own)
    if cell.nearest and any(mentions(s, cell.name) for s in _theirs(notebook)):
        return Planned(replace(cell, nearest=""), "run", own)
    return Planned(cell, "fault" if cell.fault else "run", own)


def _theirs(notebook: NotebookFile, but: ExerciseCell | None = None) -> Iterator[str]:
    """The cells that students wrote or changed, where an answer may be that no cell shows: what is there is asked."""
    for code in notebook.code:
        if not code.handed_out and (but is None or code.source != but.source):
            yield code.source


def _is_of(code: CodeCell, cell: ExerciseCell) -> bool:
    name = cell.nearest or cell.name
    return code.exercise == cell.name or name in facts_of(code.source).defines
