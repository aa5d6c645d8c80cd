"""The links at a lesson's beginning and end: to the one before, to the one after, to the
page of all.

They are plain relative links, so that they lead on in JupyterLab, on GitHub and in
exported pages alike. ``course build`` makes their cells, from the lessons there are; each
is marked, so that the next build or edition can replace it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from course.exercises.definition import DEEPER
from course.workbook.overview import PAGE

ROLE = "links"
MORE = f"{DEEPER}.ipynb"


def link_line(titles: Mapping[str, str], name: str) -> str:
    """The line of links of the lesson ``name``; ``titles`` are those of all lessons, in
    their order, by file name.
    """
    names = [each for each in titles if not _is_deeper(each)]
    core, deeper = name.replace(f"{DEEPER}.", "."), name.replace(".ipynb", MORE)
    at = names.index(core)
    before = core if _is_deeper(name) else names[at - 1] if at else None
    parts = [f"[all lessons]({PAGE})"]
    if before:
        parts.insert(0, _link(before, f"← {titles[before]}"))
    if deeper in titles:
        parts.append(_link(deeper, "deeper into this"))
    if at + 1 < len(names):
        parts.append(_link(names[at + 1], f"{titles[names[at + 1]]} →"))
    return " \N{MIDDLE DOT} ".join(parts)


def _is_deeper(name: str) -> bool:
    return name.endswith(MORE)


def with_links(cells: Sequence[Any], line: str) -> list[Any]:
    """A lesson's cells between two cells of links; older ones are left out."""
    from nbformat.v4 import new_markdown_cell

    first, last = (
        new_markdown_cell(line, id=f"links-{end}", metadata={"course": {"role": ROLE}})
        for end in ("first", "last")
    )
    return [first, *(cell for cell in cells if not is_link(cell)), last]


def is_link(cell: Any) -> bool:
    """Whether a cell holds the links that a build made."""
    notes = cell.metadata.get("course", {})
    return isinstance(notes, dict) and notes.get("role") == ROLE


def title_of(cells: Sequence[Any], otherwise: str) -> str:
    """A lesson's title: its first heading."""
    for cell in cells:
        found = re.search(r"^# +(.+?) *$", cell.source, re.MULTILINE)
        if cell.cell_type == "markdown" and found:
            return str(found.group(1))
    return otherwise


def _link(name: str, text: str) -> str:
    escaped = re.sub(r"([\\\[\]])", r"\\\1", text)
    return f"[{escaped}]({name})"
