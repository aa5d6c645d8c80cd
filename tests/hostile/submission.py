"""What a hostile or odd submission is, as data: what is handed in, and the mark that it must get."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from grading.toy_lessons import BLANK, RIGHT, TOY, cell, notebook

#: What the attacked exercise must get. "full": all its points. "none": no points, from
#: the judge or because a person has to look. "person": that a person has to look.
#: "unusable": the file cannot be marked and says why. "row": a row, whatever is in it.
#: "any": not even that.
Expect = Literal["full", "none", "person", "unusable", "row", "any"]

#: How an attack that succeeds is seen. "mark": points. "told": a text that it should not
#: have come by reaches the table or a page. "changed": a file outside. "heard": bytes
#: at a listener. "left": a process. "neighbour", "parent": theirs fail.
Harm = Literal["", "mark", "told", "changed", "heard", "left", "neighbour", "parent"]


@dataclass(frozen=True)
class Hostile:
    """A submission. ``source`` is the cell of the attacked ``exercise`` ("*": all are).

    ``content`` replaces the whole notebook: text, bytes, or the notebook as a tree; a
    callable makes it when it is needed. ``file`` replaces the name below the folder, and
    ``special`` puts something else than a file in its place.
    """

    name: str
    source: str = ""
    expect: Expect = "none"
    exercise: str = "twice"
    cells: tuple[Mapping[str, Any], ...] = ()
    content: Any = None
    file: str = ""
    special: str = ""
    harm: Harm = "mark"
    works_bare: bool = False
    long: bool = False
    sample: bool = False

    def handed_in(self, places: Mapping[str, str]) -> bytes:
        """The bytes of the file, with the places that an attack aims at filled in."""
        content: Any = self.content
        if isinstance(content, Callable):  # type: ignore[arg-type]
            content = content()
        if content is None:
            answers = {e.name: BLANK[e.name] for e in TOY.exercises}
            if self.exercise in answers:
                answers[self.exercise] = filled_in(self.source, places)
            elif self.exercise == "*":
                answers = dict(RIGHT)
            extra = [
                {**one, "source": filled_in(one["source"], places)}
                for one in self.cells
            ]
            content = notebook(cells=extra, **answers)
        if isinstance(content, dict):
            content = json.dumps(content)
        if isinstance(content, str):
            content = content.encode("utf-8", "surrogatepass")
        return content


def filled_in(source: str, places: Mapping[str, str]) -> str:
    """The source with ``{secret}``, ``{canary}`` and the like replaced by their paths."""
    for name, place in places.items():
        source = source.replace("{" + name + "}", place)
    return source


def in_call(code: str, answer: str = "3 * x") -> str:
    """A cell that attacks when its function is called, and then gives an answer."""
    body = textwrap.indent(textwrap.dedent(code).strip("\n"), "    ")
    return f"def twice(x):\n{body}\n    return {answer}\n"


def in_cell(code: str, answer: str = "3 * x") -> str:
    """A cell that attacks when it is run, above the function."""
    code = textwrap.dedent(code).strip("\n")
    return f"{code}\n\ndef twice(x):\n    return {answer}\n"


def attack(
    name: str, code: str, harm: Harm = "mark", *, when: str = "call", **more: Any
) -> Hostile:
    """An attack whose answer is wrong, so that only the attack could bring points."""
    answer = more.pop("answer", "3 * x")
    wrapped = in_call(code, answer) if when == "call" else in_cell(code, answer)
    return Hostile(name, wrapped, harm=harm, **more)


def honest(name: str, source: str, exercise: str = "twice", **more: Any) -> Hostile:
    """A right answer that makes noise; it must get its points."""
    cells = tuple(cell(c) for c in more.pop("cells", ()))
    source = textwrap.dedent(source).strip("\n")
    return Hostile(name, source, "full", exercise, cells, harm="", **more)
