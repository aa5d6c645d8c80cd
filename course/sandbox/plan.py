"""From a notebook to what is run for each of its exercises.

In the box, before any run.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from course.exercises.notebook_file import ExerciseCell, NotebookFile
from course.exercises.source import (
    is_blank,
    is_left_blank,
    needed_cells,
    python_only,
)

State = Literal["blank", "fault", "run"]


@dataclass(frozen=True)
class Planned:
    """An exercise: blank, faulty (``cell`` says why), or the cells to run in order.

    The last one is the exercise's own. A cell is its source, and whether to continue
    after a statement that fails.
    """

    cell: ExerciseCell
    state: State
    cells: tuple[tuple[str, bool], ...] = ()


def plan_of(notebook: NotebookFile) -> tuple[Planned, ...]:
    """What is run for each exercise, in the lesson's order."""
    plain = [python_only(cell.source) for cell in notebook.cells]
    return tuple(_planned(notebook, plain, i) for i in range(len(notebook.cells)))


def _planned(notebook: NotebookFile, plain: Sequence[str], index: int) -> Planned:
    cell, source = notebook.cells[index], plain[index]
    if is_blank(source, cell.name) or (cell.fault and is_left_blank(source)):
        return Planned(cell, "blank")
    if cell.fault and not cell.nearest:
        return Planned(cell, "fault")
    earlier = _earlier(notebook, plain[:index], source)
    return Planned(cell, "run", (*earlier, (source, False)))


def _earlier(
    notebook: NotebookFile, before: Sequence[str], source: str
) -> tuple[tuple[str, bool], ...]:
    """The earlier cells that the answer needs, from the preamble and previous
    exercises.
    """
    cells = [(python_only(s), True) for s in notebook.preamble]
    for text in before:
        if text and text != source and (text, True) not in cells:
            cells.append((text, False))
    kept = needed_cells([text for text, _ in cells], source)
    return tuple(cells[i] for i in kept)
