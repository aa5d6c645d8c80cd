"""The changes of a source by number, made where the source is run: who searches among them sees no code."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from dataclasses import dataclass

from course.exercises.repair.edits import (
    STAGES,
    Code,
    Edit,
    edits_of,
    patched,
    without_twin,
)

__all__ = ["STAGES", "UNCHANGED", "Candidate", "ChangedSource", "Step"]
#: The number of no change.
UNCHANGED = -1


@dataclass(frozen=True)
class Candidate:
    """A change as a search needs it.

    Args:
        kind: in words.
        stage: where in the order it is tried.
        length, grown: characters of text that it changes, and by how many the text is longer after it.
        unlike_twins: whether arguments change places in it that stand in the same order elsewhere: another cause is
            likelier.
        converts: whether it calls NumPy with something else than before: a Python number may have become NumPy's.
    """

    kind: str
    stage: int
    length: int
    grown: int = 0
    unlike_twins: bool = False
    converts: bool = False


@dataclass(frozen=True)
class Step:
    """A change that was found: its kind in words, the line it is in (or lines), the piece of it before and after, and
    the whole source after it.
    """

    kind: str
    line: str
    old: str
    new: str
    changed: str = ""


class ChangedSource:
    """A source with its changes, and those of what each of them makes of it."""

    def __init__(self, code: Code, hidden: str = "") -> None:
        """``hidden`` is a line that no student wrote, and that is left as it is."""
        self._codes, self._hidden = {UNCHANGED: code}, hidden
        self._edits: dict[int, Sequence[Edit]] = {}

    def changes(self, after: int = UNCHANGED) -> list[Candidate]:
        """Every change of the source, of which ``after`` is made first; a number is a place in this list."""
        code = self._code(after)
        return [
            Candidate(
                e.kind,
                e.stage,
                _length(e),
                _grown(e),
                _unlike_its_twins(code, e),
                _converts(code, e),
            )
            for e in self._edits_of(after)
        ]

    def source(self, number: int, after: int = UNCHANGED) -> str:
        """The source with a change made."""
        return self._edits_of(after)[number].applied(self._code(after).source)

    def step(self, number: int, after: int = UNCHANGED) -> Step:
        """A change in words and code; a second one's line as it stands in the unchanged source, where it does."""
        edit, code = self._edits_of(after)[number], self._code(after)
        start, end = min(p[0] for p in edit.patches), max(p[1] for p in edit.patches)
        moved = tuple((a - start, b - start, t) for a, b, t in edit.patches)
        old = code.source[start:end]
        new = patched(old, moved)
        line = "\n".join(_lines(code, edit))
        if after != UNCHANGED:
            line = self._unchanged_line(line, code)
        changed = edit.applied(code.source)
        return Step(edit.kind, line, _tidy(old), _tidy(new), changed)

    def _unchanged_line(self, line: str, code: Code) -> str:
        before = self._codes[UNCHANGED].source.splitlines()
        now = code.source.splitlines()
        if len(before) != len(now):
            return line
        pairs = zip(before, now, strict=True)
        return next((b.strip() for b, a in pairs if a.strip() == line), line)

    def _code(self, after: int) -> Code:
        if after not in self._codes:
            self._codes[after] = Code(self.source(after), self._codes[UNCHANGED].axes)
        return self._codes[after]

    def _edits_of(self, after: int) -> Sequence[Edit]:
        if after not in self._edits:
            code = self._code(after)
            self._edits[after] = [
                e
                for e in edits_of(code)
                if not self._hidden or code.line(e.line) != self._hidden
            ]
        return self._edits[after]


def _length(edit: Edit) -> int:
    return sum(abs(b - a) + len(t) for a, b, t in edit.patches)


def _grown(edit: Edit) -> int:
    return sum(len(t) - (b - a) for a, b, t in edit.patches)


def _converts(code: Code, edit: Edit) -> bool:
    return any(
        _numpy_calls(new) - _numpy_calls(code.source[start:end])
        for start, end, new in edit.patches
        if "np." in new
    )


def _numpy_calls(text: str) -> set[str]:
    """The calls of NumPy's functions in a piece of source; the piece itself where it is no whole statement."""
    try:
        tree = ast.parse(text.strip())
    except SyntaxError:
        return {text}
    calls = (ast.unparse(n) for n in ast.walk(tree) if isinstance(n, ast.Call))
    return {call for call in calls if call.startswith("np.")}


def _unlike_its_twins(code: Code, edit: Edit) -> bool:
    if "order of the arguments" not in edit.kind or len(edit.patches) > 1:
        return False
    start, end, _ = edit.patches[0]
    mine = without_twin(code.source[start:end])
    calls = [p.node for p in code.places() if isinstance(p.node, ast.Call)]
    return sum(without_twin(code.text(c)) == mine for c in calls) > 1


def _lines(code: Code, edit: Edit) -> list[str]:
    """The lines of an edit: of a line that moves the one, of the same change in many places all of them."""
    if any(text == "pass" or start == end for start, end, text in edit.patches):
        return [code.line(edit.line)]
    numbers = [code.source.count("\n", 0, p[0]) + 1 for p in sorted(edit.patches)]
    return [code.line(n) for n in dict.fromkeys(numbers)]


def _tidy(text: str) -> str:
    """An expression without needless brackets; anything else as it is."""
    try:
        return ast.unparse(ast.parse(text.strip()))
    except (SyntaxError, ValueError):
        return text
