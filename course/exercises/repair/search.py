"""Find the one change, or the two, with which a wrong answer passes every case, and those of two other seeds.

The source is changed and run elsewhere (``Changes``); what comes of it is judged here.
"""

from __future__ import annotations

import re
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from course.exercises.answer import Outcome
from course.exercises.inputs import Inputs
from course.exercises.repair.changes import STAGES, UNCHANGED, Candidate, Step
from course.exercises.verdict import passes

TOGETHER = 40
ENOUGH = 8
#: First steps that are followed by a second.
FIRST_STEPS = 3
SIGNS = ("a sign", "the sign of a term", "a difference turned round")
#: Of two kinds of change that both make it right, the one whose words come first is told.
_ORDER = (
    "a second name", "a term too many", "a factor too many", "a divisor too many", "a power too many",
    "too many", "in place", "letters", "argument", "wrong place", "order of", "without axis", "axis",
    "axes", "keepdims", "brackets", "condition", "a number$", "belongs", "sign of a term",
    "turned round", "names of another", "exchanged", "twin", "upside", "a sign",
    "an index", "another name", "another expression", "number", "missing",
)  # fmt: skip


@dataclass(frozen=True)
class Repair:
    """What makes an answer right: its steps in turn (one or two), and other lines where the first would do as well.

    ``halved`` where the search had half its time.
    """

    steps: tuple[Step, ...]
    elsewhere: tuple[str, ...] = ()
    halved: bool = False

    @property
    def changed(self) -> str:
        """The answer's source with all steps made."""
        return self.steps[-1].changed


class Changes(Protocol):
    """An answer whose source can be changed and run; changes go by their numbers.

    ``after`` is a change that is made first.
    """

    def changes(self, after: int = UNCHANGED) -> Sequence[Candidate]:
        """Every change of the source."""

    def step(self, number: int, after: int = UNCHANGED) -> Step:
        """A change in words and code."""

    def outcomes(
        self,
        numbers: Sequence[int],
        cases: Sequence[int],
        *,
        after: int = UNCHANGED,
        left: bool = False,
    ) -> list[list[Outcome]]:
        """What changed sources give on the cases of these numbers; ``left``: and how they leave their arguments (many
        numbers)."""


class Search:
    """A search for repairs of one answer. Ends when ``seconds`` are over."""

    def __init__(self, inputs: Inputs, answer: Changes, seconds: float) -> None:
        draws = (inputs, *inputs.others)
        self._exercise = inputs.exercise
        self._cases = [case for drawn in draws for case in drawn.cases]
        self._expected = [outcome for drawn in draws for outcome in drawn.expected]
        self._own = len(inputs.cases)
        self._answer = answer
        self._end = time.monotonic() + seconds
        self._opposite: list[int] = []
        self._divides_by_0 = False

    def find(self, outcomes: Sequence[Outcome]) -> Repair | None:
        """The repair of an answer that gave these outcomes on its own cases; None where there is none."""
        right = [self._right(i, o) for i, o in enumerate(outcomes)]
        if all(right):
            return None
        self._divides_by_0 = any(map(_divided_by_0, outcomes))
        changes = self._answer.changes()
        for stage in STAGES:
            numbers = self._of_stages(changes, stage)
            found = self._passing(numbers, right)
            if found:
                return self._best(changes, found)
        return self._and_a_sign(changes, right) or self._in_two(changes, right)

    def _right(self, index: int, outcome: Outcome) -> bool:
        case, expected = self._cases[index], self._expected[index]
        return passes(self._exercise, case, outcome, expected)

    def _opposite_is_right(self, index: int, outcome: Outcome) -> bool:
        """Whether a single result of numbers has only the wrong sign."""
        if len(outcome.values) != 1 or outcome.values[0].dtype.kind != "f":
            return False
        turned = replace(outcome, values=(-outcome.values[0],))
        return self._right(index, turned)

    def _of_stages(self, changes: Sequence[Candidate], *stages: int) -> list[int]:
        """The changes of these stages. NumPy's numbers divide by 0 without an error, Python's do not: after a
        ``ZeroDivisionError`` a change that converts would hide the division, and is left out."""
        return [
            i
            for i, c in enumerate(changes)
            if c.stage in stages and not (self._divides_by_0 and c.converts)
        ]

    def _over(self) -> bool:
        return time.monotonic() > self._end

    def _passing(
        self, numbers: Sequence[int], right: Sequence[bool], after: int = UNCHANGED
    ) -> list[int]:
        """The changes with which every case passes; ``right`` is which of the answer's own do without."""
        failing = [i for i, r in enumerate(right) if not r]
        probe = min(
            failing, key=lambda i: (self._cases[i].kind == "batch", self._size(i))
        )
        # Those that failed first: most candidates fail them again.
        passed = [i for i in range(len(self._cases)) if i not in failing]
        everything = [*failing, *passed]
        run = self._answer.outcomes
        found: list[int] = []
        for start in range(0, len(numbers), TOGETHER):
            if self._over() or len(found) >= ENOUGH:
                break
            some = numbers[start : start + TOGETHER]
            probed = run(some, [probe], after=after)
            for number, (outcome,) in zip(some, probed, strict=True):
                if after == UNCHANGED and self._opposite_is_right(probe, outcome):
                    self._opposite.append(number)
                if self._right(probe, outcome):
                    (whole,) = run([number], everything, after=after, left=True)
                    if all(map(self._right, everything, whole)):
                        found.append(number)
        return found

    def _size(self, index: int) -> int:
        return sum(
            int(np.size(v))
            for v in self._cases[index].arguments.values()
            if not isinstance(v, tuple)
        )

    def _and_a_sign(
        self, changes: Sequence[Candidate], right: Sequence[bool]
    ) -> Repair | None:
        """A first step that leaves the opposite of what is right, and then a sign."""
        own, whole = list(range(self._own)), list[int]()
        for start in range(0, len(self._opposite), TOGETHER):
            some = self._opposite[start : start + TOGETHER]
            if self._over():
                break
            for number, run in zip(some, self._answer.outcomes(some, own), strict=True):
                if all(self._opposite_is_right(i, o) for i, o in enumerate(run)):
                    whole.append(number)
        for first in sorted(whole, key=lambda i: _rank(changes[i]))[:FIRST_STEPS]:
            seconds = self._answer.changes(first)
            some = self._of_stages(seconds, *STAGES)
            signs = [i for i in some if seconds[i].kind in SIGNS]
            found = self._passing(signs, right, first)
            if found:
                return self._in_turn(first, seconds, found)
        return None

    def _in_turn(
        self, first: int, seconds: Sequence[Candidate], found: Sequence[int]
    ) -> Repair:
        """A step, and the best of those that follow it."""
        best = min(found, key=lambda i: _rank(seconds[i]))
        return Repair((self._answer.step(first), self._answer.step(best, first)))

    def _in_two(
        self, changes: Sequence[Candidate], right: Sequence[bool]
    ) -> Repair | None:
        """A first step that makes more cases pass and none fail, and a second one that makes all pass."""
        for first, now in self._improving(changes, right)[:FIRST_STEPS]:
            seconds = self._answer.changes(first)
            for stage in (1, 2):
                numbers = self._of_stages(seconds, stage)
                found = self._passing(numbers, now, first)
                if found:
                    return self._in_turn(first, seconds, found)
        return None

    def _improving(
        self, changes: Sequence[Candidate], right: Sequence[bool]
    ) -> list[tuple[int, list[bool]]]:
        """The changes that make more of the answer's own cases pass and none fail, the best first, with those that
        pass."""
        own = list(range(self._own))
        better: list[tuple[int, list[bool]]] = []
        short = self._of_stages(changes, 1, 2)
        for start in range(0, len(short), TOGETHER):
            some = short[start : start + TOGETHER]
            if self._over():
                break
            for number, outcomes in zip(
                some, self._answer.outcomes(some, own), strict=True
            ):
                now = [self._right(i, o) for i, o in enumerate(outcomes)]
                none_lost = all(n or not r for n, r in zip(now, right, strict=True))
                if sum(right) < sum(now) < len(own) and none_lost:
                    better.append((number, now))
        return sorted(better, key=lambda one: -sum(one[1]))

    def _best(self, changes: Sequence[Candidate], found: Sequence[int]) -> Repair:
        """The best of several changes that all make it right, and in which lines others of its kind do."""
        best = min(found, key=lambda i: _rank(changes[i]))
        step = self._answer.step(best)
        alike = [i for i in found if changes[i].kind == changes[best].kind]
        lines = dict.fromkeys(self._answer.step(i).line for i in alike)
        return Repair((step,), tuple(line for line in lines if line != step.line))


def _divided_by_0(outcome: Outcome) -> bool:
    return outcome.kind == "raised" and outcome.text.startswith("ZeroDivisionError")


def _rank(change: Candidate) -> tuple[bool, int, int]:
    """Of several changes that make it right the least is the likeliest cause."""
    order = (i for i, words in enumerate(_ORDER) if re.search(words, change.kind))
    place = next(order, len(_ORDER))
    unlike, size = change.unlike_twins, change.length
    if change.kind == "a sign":
        # One too many first; else that of the whole, not of a part.
        if change.grown <= 2:
            return unlike, _ORDER.index("too many"), change.grown
        return unlike, place, 10_000 - size
    if change.kind == "a limit at 0 missing":  # of what is set, not of a part of it
        return unlike, place, 10_000 - size
    return unlike, place, size
