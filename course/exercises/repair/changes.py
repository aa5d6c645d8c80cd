"""The changes of a source by number, made where the source is run: who searches among them sees no code."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from dataclasses import dataclass

from course.exercises.repair.edits import STAGES, Code, Edit, edits_of, patched

__all__ = ["STAGES", "UNCHANGED", "Candidate", "ChangedSource", "Step"]
#: The number of no change.
UNCHANGED = -1


@dataclass(frozen=True)
class Candidate:
    """A change as a search needs it: its kind in words, where in the order it is tried, how much text it changes."""

    kind: str
    stage: int
    length: int


@dataclass(frozen=True)
class Step:
    """A change that was found: its kind in words, the line it is in, and the piece of it before and after."""

    kind: str
    line: str
    old: str
    new: str


class ChangedSource:
    """A source with its changes, and those of what each of them makes of it."""

    def __init__(self, code: Code) -> None:
        self._codes = {UNCHANGED: code}
        self._edits: dict[int, Sequence[Edit]] = {}

    def changes(self, after: int = UNCHANGED) -> list[Candidate]:
        """Every change of the source, of which ``after`` is made first; a number is a place in this list."""
        return [
            Candidate(e.kind, e.stage, sum(b - a + len(t) for a, b, t in e.patches))
            for e in self._edits_of(after)
        ]

    def source(self, number: int, after: int = UNCHANGED) -> str:
        """The source with a change made."""
        return self._edits_of(after)[number].applied(self._code(after).source)

    def step(self, number: int, after: int = UNCHANGED) -> Step:
        """A change in words and code."""
        edit, code = self._edits_of(after)[number], self._code(after)
        start, end = min(p[0] for p in edit.patches), max(p[1] for p in edit.patches)
        moved = tuple((a - start, b - start, t) for a, b, t in edit.patches)
        old = code.source[start:end]
        new = patched(old, moved)
        return Step(edit.kind, code.line(edit.line), _tidy(old), _tidy(new))

    def _code(self, after: int) -> Code:
        if after not in self._codes:
            self._codes[after] = Code(self.source(after), self._codes[UNCHANGED].axes)
        return self._codes[after]

    def _edits_of(self, after: int) -> Sequence[Edit]:
        if after not in self._edits:
            self._edits[after] = edits_of(self._code(after))
        return self._edits[after]


def _tidy(text: str) -> str:
    """An expression without needless brackets; anything else as it is."""
    try:
        return ast.unparse(ast.parse(text.strip()))
    except (SyntaxError, ValueError):
        return text
