"""From an answer to a verdict: state, first counterexample, a likely cause."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from course.exercises.advice import asks_one_question, general_advice
from course.exercises.answer import Answer, Outcome
from course.exercises.comparison import Difference, compare, same
from course.exercises.definition import Case, Exercise, Mistake
from course.exercises.inputs import Inputs, observed

State = Literal["passed", "wrong", "not attempted", "error", "needs a person"]


@dataclass(frozen=True)
class Verdict:
    """The judgement of one answer.

    ``case`` is the counterexample (the first that is no batch, if any), ``outcome`` the
    answer's result there and ``difference`` how it is wrong; ``mistake`` is the planted
    mistake it matches, ``reason`` anything else worth saying, ``violated`` the messages
    of the properties that it lacks, one line each.
    """

    exercise: str
    state: State
    points: int = 0
    tried: int = 0
    case: Case | None = None
    outcome: Outcome | None = None
    difference: Difference | None = None
    mistake: Mistake | None = None
    reason: tuple[str, ...] = ()
    violated: tuple[str, ...] = ()
    #: Whether the outcomes say themselves what is wrong.
    plain: bool = False
    #: All outcomes of an answer that failed.
    outcomes: tuple[Outcome, ...] = field(default=(), repr=False, compare=False)

    @property
    def passed(self) -> bool:
        """Whether the answer is right."""
        return self.state == "passed"

    @property
    def failed(self) -> bool:
        """Whether there is an answer, and it is not right."""
        return self.state in ("wrong", "error")

    @property
    def unexplained(self) -> bool:
        """Whether a search for a repair may say more: no planted mistake matches, and the outcomes do not say
        themselves what is wrong.

        Those that do: inputs written to, an ``if`` on a batch. What makes these right is a copy or a rewriting; a
        smaller change that happens to do so is not the cause.
        """
        return (
            self.failed
            and self.mistake is None
            and bool(self.outcomes)
            and not self.plain
        )


def judge_answer(inputs: Inputs, answer: Answer) -> Verdict:
    """Judge what came of an answer; only the reference and the mistakes are run here.

    Raises ``ValueError`` where there is not one outcome for each case: every case is
    judged.
    """
    exercise, cases = inputs.exercise, inputs.cases
    if answer.blank:
        return Verdict(exercise.name, "not attempted")
    if answer.fault:
        return Verdict(exercise.name, "error", reason=(answer.fault,))
    if len(cases) != len(answer.outcomes) or not cases:
        raise ValueError(
            f"outcomes: expected one for each of {len(cases)} cases, at least one; got {len(answer.outcomes)}"
        )
    pairs = zip(cases, answer.outcomes, strict=True)
    outcomes = tuple(observed(case.arguments, outcome) for case, outcome in pairs)
    triples = zip(cases, outcomes, inputs.expected, strict=True)
    wrongs = [_wrong(exercise, c, o, e) for c, o, e in triples]
    failed = [i for i, w in enumerate(wrongs) if w is not None]
    if not failed:
        return Verdict(exercise.name, "passed", exercise.points, len(cases))
    # One call is easier to follow than a batch of them.
    first = min(failed, key=lambda i: cases[i].kind == "batch")
    raised = outcomes[first].kind in ("raised", "unreadable", "none")
    mistake = diagnose(inputs, outcomes)
    difference = wrongs[first]
    # Of an answer of another shape no property can be judged, and a known slip says more.
    quiet = mistake or (difference and difference.fault.startswith("shape"))
    advice = general_advice(exercise, cases, outcomes, wrongs, inputs.expected)
    wrote = any(o.kind == "wrote" for o in outcomes)
    return Verdict(
        exercise.name,
        "error" if raised else "wrong",
        0,
        len(cases),
        cases[first],
        outcomes[first],
        difference,
        mistake,
        () if mistake else advice,
        () if quiet else violated(exercise, cases[first], outcomes[first]),
        wrote or asks_one_question(cases, outcomes),
        outcomes,
    )


def judge(
    exercise: Exercise, cases: Sequence[Case], outcomes: Sequence[Outcome]
) -> Verdict:
    """The same for outcomes on cases that were drawn elsewhere."""
    return judge_answer(Inputs(exercise, tuple(cases)), Answer(tuple(outcomes)))


def passes(exercise: Exercise, case: Case, outcome: Outcome, expected: Outcome) -> bool:
    """Whether what an answer gave in one case (``observed``) is right."""
    return _wrong(exercise, case, outcome, expected) is None


def alike(
    exercise: Exercise, some: Sequence[Outcome], others: Sequence[Outcome]
) -> bool:
    """Whether two runs of answers gave the same on every case: values within the tolerances, errors by their words."""
    pairs = zip(some, others, strict=True)
    return all(_alike(exercise, one, other) for one, other in pairs)


def diagnose(inputs: Inputs, outcomes: Sequence[Outcome]) -> Mistake | None:
    """The planted mistake that gives the same as the answer on every case, passed and failed alike.

    One that agrees on a part of them names nothing: the answer may have another cause
    there, and what the mistake's message says would then be false.
    """
    for mistake in inputs.exercise.mistakes:
        if alike(inputs.exercise, outcomes, inputs.with_mistake(mistake)):
            return mistake
    return None


def violated(exercise: Exercise, case: Case, outcome: Outcome) -> tuple[str, ...]:
    """The messages of the properties that the answer to this case violates."""
    if outcome.kind != "value":
        return ()
    numbers = all(
        v.dtype.kind in "biuf" and np.isfinite(v).all() for v in outcome.values
    )
    if exercise.judged_by == "reference" and not numbers:
        return ()  # NaN, text, complex numbers: the comparison has said so already
    answer = outcome.values[0] if len(exercise.results) == 1 else outcome.values
    lacking = []
    for rule in exercise.properties:
        try:
            with np.errstate(all="ignore"):
                residual = np.max(
                    np.abs(
                        np.asarray(rule.residual(case.arguments, answer), dtype=float)
                    ),
                    initial=0.0,
                )
        except (ValueError, TypeError, IndexError):
            if exercise.judged_by == "reference":
                # an answer of another shape: the comparison has said so already
                continue
            # nothing else judges it: an answer on which the rule cannot be evaluated is
            # not right
            residual = np.inf
        if not residual <= rule.tolerance:
            lacking.append(rule.message)
    return tuple(lacking)


def _wrong(
    exercise: Exercise, case: Case, outcome: Outcome, expected: Outcome
) -> Difference | None:
    if outcome.kind != "value":
        return Difference(
            exercise.results[0].name, expected=expected.values[0], fault=outcome.kind
        )
    difference = compare(exercise.results, expected.values, outcome.values)
    if exercise.judged_by == "reference" or difference.fault:
        return difference if difference.wrong else None
    lacking = violated(exercise, case, outcome)
    return (
        Difference(exercise.results[0].name, got=outcome.values[0], fault=lacking[0])
        if lacking
        else None
    )


def _alike(exercise: Exercise, one: Outcome, other: Outcome) -> bool:
    if one.kind != other.kind:
        return False
    if one.kind == "value":
        return same(exercise.results, other.values, one.values)
    return one.kind != "raised" or _error(one) == _error(other)


def _error(outcome: Outcome) -> str:
    """The whole error but its numbers, not its type alone: a TypeError may have any number of causes."""
    return re.sub(r"\d+", "", outcome.text.split("\n  in the line:")[0])
