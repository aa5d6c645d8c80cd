"""Find the one change, or the two, with which a wrong answer passes every case, and those of two other seeds."""

from __future__ import annotations

import ast
import re
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from course.exercises.answer import Outcome
from course.exercises.definition import Case, Exercise
from course.exercises.repair.edits import (
    STAGES,
    Code,
    Edit,
    edits_of,
    patched,
    without_twin,
)
from course.exercises.verdict import answers_of, passes

#: Runs sources on the cases of these numbers: for each source the outcomes, in order; with the arguments as they were
#: left where the flag says so (they are many numbers).
Attempt = Callable[[Sequence[str], Sequence[int], bool], list[list[Outcome]]]
#: The seeds besides that of every notebook.
OTHER_SEEDS = (1, 2)
TOGETHER = 40
ENOUGH = 8
#: First steps that are followed by a second.
FIRST_STEPS = 3
SIGNS = ("a sign", "the sign of a term", "a difference turned round")
#: Of two kinds of change that both make it right, the one whose words come first is told.
_ORDER = (
    "a second name", "a term too many", "a factor too many", "a divisor too many", "a power too many",
    "too many", "in place", "argument", "wrong place", "order of", "without axis", "axis",
    "axes", "keepdims", "brackets", "condition", "a number$", "belongs", "sign of a term",
    "turned round", "names of another", "exchanged", "twin", "upside", "a sign",
    "an index", "another name", "another product", "number", "missing",
)  # fmt: skip


@dataclass(frozen=True)
class Step:
    """A change that was found: its kind, the line it is in (or lines), and the piece of it before and after."""

    kind: str
    line: str
    old: str
    new: str


@dataclass(frozen=True)
class Repair:
    """What makes an answer right: its steps in turn (one or two), the answer with them made, and other lines where the
    first would do as well.
    """

    steps: tuple[Step, ...]
    changed: str
    elsewhere: tuple[str, ...] = ()


def drawn_cases(exercise: Exercise) -> tuple[tuple[Case, ...], int]:
    """The cases of every notebook and of two other seeds, and how many the first are."""
    own = exercise.draw()
    more = [case for seed in OTHER_SEEDS for case in exercise.draw(seed)]
    return (*own, *more), len(own)


class Search:
    """A search for repairs of one answer; ``attempt`` runs, this judges. Ends when ``seconds`` are over."""

    def __init__(
        self,
        exercise: Exercise,
        cases: Sequence[Case],
        own: int,
        attempt: Attempt,
        seconds: float,
    ) -> None:
        self._exercise, self._cases, self._own = exercise, cases, own
        self._attempt = attempt
        self._end = time.monotonic() + seconds
        self._expected = answers_of(
            exercise.sample or exercise.reference, exercise, cases
        )
        self._opposite: list[Edit] = []
        self.tried = 0

    def find(self, code: Code, outcomes: Sequence[Outcome]) -> Repair | None:
        """The repair of an answer that gave these outcomes on the notebook's own cases; None where there is none."""
        right = [self._right(i, o) for i, o in enumerate(outcomes)]
        if all(right):
            return None
        edits = self._edits(code)
        for stage in STAGES:
            found = self._passing(code, [e for e in edits if e.stage == stage], right)
            if found:
                return _told(code, found)
        return self._and_a_sign(code, right) or self._in_two(code, edits, right)

    def _edits(self, code: Code) -> list[Edit]:
        """The changes of a source; of an expression's those of its own lines, not of what returns it."""
        hidden = f"return {self._exercise.name}"
        whole = self._exercise.kind == "expression"
        return [e for e in edits_of(code) if not whole or code.line(e.line) != hidden]

    def _right(self, index: int, outcome: Outcome) -> bool:
        return passes(
            self._exercise, self._cases[index], outcome, self._expected[index]
        )

    def _opposite_is_right(self, index: int, outcome: Outcome) -> bool:
        """Whether a single result of numbers has only the wrong sign."""
        if len(outcome.values) != 1 or outcome.values[0].dtype.kind != "f":
            return False
        turned = replace(outcome, values=(-outcome.values[0],))
        return self._right(index, turned)

    def _over(self) -> bool:
        return time.monotonic() > self._end

    def _passing(
        self, code: Code, edits: Sequence[Edit], right: Sequence[bool]
    ) -> list[Edit]:
        """The edits with which every case passes; ``right`` is which of the notebook's do without."""
        failing = [i for i, r in enumerate(right) if not r]
        probe = min(
            failing, key=lambda i: (self._cases[i].kind == "batch", self._size(i))
        )
        # Those that failed first: most candidates fail them again.
        passed = [i for i in range(len(self._cases)) if i not in failing]
        everything = [*failing, *passed]
        found: list[Edit] = []
        for start in range(0, len(edits), TOGETHER):
            if self._over() or len(found) >= ENOUGH:
                break
            some = edits[start : start + TOGETHER]
            for edit, (outcome,) in zip(
                some, self._run(code, some, [probe]), strict=True
            ):
                if self._opposite_is_right(probe, outcome):
                    self._opposite.append(edit)
                if self._right(probe, outcome):
                    (outcomes,) = self._run(code, [edit], everything, left=True)
                    if all(map(self._right, everything, outcomes)):
                        found.append(edit)
        return found

    def _size(self, index: int) -> int:
        return sum(
            int(np.size(v))
            for v in self._cases[index].arguments.values()
            if not isinstance(v, tuple)
        )

    def _run(
        self,
        code: Code,
        edits: Sequence[Edit],
        indices: Sequence[int],
        *,
        left: bool = False,
    ) -> list[list[Outcome]]:
        self.tried += len(edits)
        return self._attempt([e.applied(code.source) for e in edits], indices, left)

    def _and_a_sign(self, code: Code, right: Sequence[bool]) -> Repair | None:
        """A first step that leaves the opposite of what is right, and then a sign."""
        own, whole = list(range(self._own)), list[Edit]()
        for start in range(0, len(self._opposite), TOGETHER):
            some = self._opposite[start : start + TOGETHER]
            if self._over():
                break
            for edit, run in zip(some, self._run(code, some, own), strict=True):
                if all(self._opposite_is_right(i, o) for i, o in enumerate(run)):
                    whole.append(edit)
        for first in sorted(whole, key=_rank)[:FIRST_STEPS]:
            changed = Code(first.applied(code.source), code.axes)
            signs = [e for e in self._edits(changed) if e.kind in SIGNS]
            found = self._passing(changed, signs, right)
            if found:
                return _in_turn(code, first, _told(changed, found))
        return None

    def _in_two(
        self, code: Code, edits: Sequence[Edit], right: Sequence[bool]
    ) -> Repair | None:
        """A first step that makes more cases pass and none fail, and a second one that makes all pass."""
        own = list(range(self._own))
        better: list[tuple[int, Edit, list[bool]]] = []
        short = [e for e in edits if e.stage < 3]
        for start in range(0, len(short), TOGETHER):
            some = short[start : start + TOGETHER]
            if self._over():
                break
            for edit, outcomes in zip(some, self._run(code, some, own), strict=True):
                now = [self._right(i, o) for i, o in enumerate(outcomes)]
                if sum(right) < sum(now) < own[-1] + 1 and all(
                    n or not r for n, r in zip(now, right, strict=True)
                ):
                    better.append((sum(now), edit, now))
        better.sort(key=lambda b: -b[0])
        for _, first, now in better[:FIRST_STEPS]:
            changed = Code(first.applied(code.source), code.axes)
            seconds = self._edits(changed)
            for stage in (1, 2):
                found = self._passing(
                    changed, [e for e in seconds if e.stage == stage], now
                )
                if found:
                    return _in_turn(code, first, _told(changed, found))
        return None


def _rank(edit: Edit) -> tuple[int, int]:
    order = (i for i, words in enumerate(_ORDER) if re.search(words, edit.kind))
    place = next(order, len(_ORDER))
    if (
        edit.kind == "a sign"
    ):  # one too many first; else that of the whole, not of a part
        grown = sum(len(t) - (b - a) for a, b, t in edit.patches)
        if grown <= 2:
            return _ORDER.index("too many"), grown
        return place, 10_000 - _size(edit)
    if edit.kind == "a limit at 0 missing":  # of what is set, not of a part of it
        return place, 10_000 - _size(edit)
    return place, _size(edit)


def _size(edit: Edit) -> int:
    return sum(abs(b - a) + len(t) for a, b, t in edit.patches)


def _told(code: Code, found: Sequence[Edit]) -> Repair:
    """The best of several edits that all make it right, and in which lines others of its kind do."""
    best = min(found, key=lambda e: (_unlike_its_twins(code, e), *_rank(e)))
    line = "\n".join(_lines(code, best))
    alike = dict.fromkeys(
        "\n".join(_lines(code, e)) for e in found if e.kind == best.kind
    )
    others = tuple(other for other in alike if other != line)
    return Repair((_step(code, best),), best.applied(code.source), others)


def _unlike_its_twins(code: Code, edit: Edit) -> bool:
    """Whether arguments change places that stand in the same order elsewhere: another cause is likelier."""
    if "order of the arguments" not in edit.kind or len(edit.patches) > 1:
        return False
    start, end, _ = edit.patches[0]
    mine = without_twin(code.source[start:end])
    calls = [p.node for p in code.places() if isinstance(p.node, ast.Call)]
    return sum(without_twin(code.text(c)) == mine for c in calls) > 1


def _in_turn(code: Code, first: Edit, then: Repair) -> Repair:
    """A step and what follows it, the second's line as it stands in the unchanged source where that can be told."""
    (second,) = then.steps
    before, after = code.source.splitlines(), first.applied(code.source).splitlines()
    if len(before) == len(after):
        at = [
            b.strip()
            for b, a in zip(before, after, strict=True)
            if a.strip() == second.line
        ]
        second = replace(second, line=at[0]) if at else second
    return Repair((_step(code, first), second), then.changed)


def _step(code: Code, edit: Edit) -> Step:
    start, end = min(p[0] for p in edit.patches), max(p[1] for p in edit.patches)
    moved = tuple((a - start, b - start, t) for a, b, t in edit.patches)
    old, new = code.source[start:end], patched(code.source[start:end], moved)
    return Step(edit.kind, "\n".join(_lines(code, edit)), _tidy(old), _tidy(new))


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
