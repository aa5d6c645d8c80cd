"""What an exercise is tried on: its cases for one seed, with what is right there, worked out once.

Only trusted functions run here: the reference, or a planted mistake.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np

from course.exercises.answer import Outcome, call_all
from course.exercises.definition import Case, Exercise, Mistake
from course.exercises.expressions import evaluator
from course.exercises.question import Question

#: An answer may give so many numbers where few are expected: a wrong shape is explained as that.
FEW = 10_000


@dataclass(frozen=True)
class Inputs:
    """The cases of an exercise. What they ask and what is expected is worked out when first needed, and kept."""

    exercise: Exercise
    cases: tuple[Case, ...]
    seed: int | None = None

    @cached_property
    def question(self) -> Question:
        """What is asked, without anything that shows the right answer."""
        exercise = self.exercise
        return Question(
            exercise.name,
            exercise.kind,
            tuple(argument.name for argument in exercise.arguments),
            len(exercise.results),
            tuple(case.arguments for case in self.cases),
        )

    @cached_property
    def expected(self) -> tuple[Outcome, ...]:
        """What a right answer gives; where answers are not unique, something of the right shape."""
        right = self.exercise.sample or self.exercise.reference
        outcomes = tuple(answers_of(right, self.exercise, self.cases))
        for case, outcome in zip(self.cases, outcomes, strict=True):
            if outcome.kind != "value":
                raise RuntimeError(
                    f"the reference of {self.exercise.name} gives no value for {case.label!r}: {outcome.text}"
                )
        return outcomes

    @cached_property
    def others(self) -> tuple[Inputs, Inputs]:
        """The inputs for two other seeds."""
        first, second = [seed for seed in (1, 2, 3) if seed != self.seed][:2]
        return inputs_of(self.exercise, first), inputs_of(self.exercise, second)

    @property
    def most(self) -> tuple[int, ...]:
        """How many numbers an answer may give, case by case."""
        sizes = (sum(v.size for v in outcome.values) for outcome in self.expected)
        return tuple(max(FEW, 4 * size) for size in sizes)

    def with_mistake(self, mistake: Mistake) -> list[Outcome]:
        """What a planted mistake gives."""
        if mistake.name not in self._mistaken:
            found = answers_of(mistake.function, self.exercise, self.cases)
            self._mistaken[mistake.name] = found
        return self._mistaken[mistake.name]

    @cached_property
    def _mistaken(self) -> dict[str, list[Outcome]]:
        return {}


def inputs_of(exercise: Exercise, seed: int | None = None) -> Inputs:
    """The inputs for a seed; without one, for the seed that every notebook's check uses."""
    return Inputs(exercise, exercise.draw(seed), seed)


def answers_of(
    function: Any, exercise: Exercise, cases: Sequence[Case]
) -> list[Outcome]:
    """What a trusted function (reference or planted mistake) returns for the cases."""
    if exercise.kind == "expression":
        function = _evaluated(function, tuple(a.name for a in exercise.arguments))
    arguments = [c.arguments for c in cases]
    outcomes = call_all(function, arguments, len(exercise.results))
    return [observed(a, o) for a, o in zip(arguments, outcomes, strict=True)]


def observed(arguments: Mapping[str, Any], outcome: Outcome) -> Outcome:
    """The outcome, or that the answer modified its inputs: asked once, where an outcome comes in.

    Determined here, not where the answer ran: it could have patched the comparison.
    """
    given = outcome.given
    changed = [
        n for n, v in arguments.items() if n in given and not _unchanged(v, given[n])
    ]
    if not changed:
        return outcome
    return Outcome("wrote", text=", ".join(changed), printed=outcome.printed)


def _unchanged(before: Any, after: Any) -> bool:
    if isinstance(before, tuple):
        return (
            isinstance(after, tuple)
            and len(before) == len(after)
            and all(map(_unchanged, before, after))
        )
    if not isinstance(before, np.ndarray):
        return True
    return (
        isinstance(after, np.ndarray)
        and before.shape == after.shape
        and np.array_equal(before, after, equal_nan=before.dtype.kind == "f")
    )


@cache
def _evaluated(
    formula: Callable[..., Any], names: tuple[str, ...]
) -> Callable[..., Any]:
    """A formula of symbols as a function of arrays, made once."""
    import sympy

    return evaluator(formula(*map(sympy.Symbol, names)), names)
