"""From outcomes to a verdict: state, first counterexample, a likely cause."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any, Literal

import numpy as np

from course.exercises.advice import general_advice
from course.exercises.answer import Outcome, call_all, evaluator
from course.exercises.comparison import Difference, compare, same
from course.exercises.definition import Case, Exercise, Mistake

State = Literal["passed", "wrong", "not attempted", "error", "needs a person"]


@dataclass(frozen=True)
class Verdict:
    """The judgement of one answer.

    ``case`` is the counterexample (the first that is no batch, if any), ``outcome`` the
    answer's result there and ``difference`` how it is wrong; ``mistake`` is the planted
    mistake it matches, ``reason`` anything else worth saying, one line each.
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
    #: All that came back, of an answer that failed.
    outcomes: tuple[Outcome, ...] = field(default=(), repr=False, compare=False)

    @property
    def passed(self) -> bool:
        """Whether the answer is right."""
        return self.state == "passed"


def judge(
    exercise: Exercise, cases: Sequence[Case], outcomes: Sequence[Outcome]
) -> Verdict:
    """Judge an answer's outcomes; only the reference and the mistakes are run here.

    Raises ``ValueError`` where the two sequences differ in length: every case is
    judged.
    """
    if len(cases) != len(outcomes) or not cases:
        raise ValueError(
            f"outcomes: expected one for each of {len(cases)} cases, at least one; got {len(outcomes)}"
        )
    outcomes = [_or_wrote(c.arguments, o) for c, o in zip(cases, outcomes, strict=True)]
    if any(o.kind == "unattempted" for o in outcomes):
        return Verdict(exercise.name, "not attempted")
    expected = answers_of(exercise.sample or exercise.reference, exercise, cases)
    wrongs = [
        _wrong(exercise, c, o, e)
        for c, o, e in zip(cases, outcomes, expected, strict=True)
    ]
    failed = [i for i, w in enumerate(wrongs) if w is not None]
    if not failed:
        return Verdict(exercise.name, "passed", exercise.points, len(cases))
    first = min(
        failed, key=lambda i: cases[i].kind == "batch"
    )  # one call is easier to follow than a batch of them
    state: State = (
        "error" if outcomes[first].kind in ("raised", "unreadable", "none") else "wrong"
    )
    mistake = diagnose(exercise, cases, outcomes)
    reason = (
        () if mistake else general_advice(exercise, cases, outcomes, wrongs, expected)
    )
    difference = wrongs[first]
    fault = difference.fault if difference else ""
    if not mistake and not fault.startswith("shape"):  # else that says more
        reason += violated(exercise, cases[first], outcomes[first])
    return Verdict(
        exercise.name,
        state,
        0,
        len(cases),
        cases[first],
        outcomes[first],
        difference,
        mistake,
        reason,
        tuple(outcomes),
    )


def passes(exercise: Exercise, case: Case, outcome: Outcome, expected: Outcome) -> bool:
    """Whether what an answer gave in one case is right."""
    outcome = _or_wrote(case.arguments, outcome)
    return _wrong(exercise, case, outcome, expected) is None


def alike(
    exercise: Exercise,
    cases: Sequence[Case],
    some: Sequence[Outcome],
    others: Sequence[Outcome],
) -> bool:
    """Whether two runs of answers gave the same on every case: values within the tolerances, errors by their words."""
    pairs = zip(cases, some, others, strict=True)
    return all(
        _alike(exercise, _or_wrote(c.arguments, a), _or_wrote(c.arguments, b))
        for c, a, b in pairs
    )


def answers_of(
    function: Any, exercise: Exercise, cases: Sequence[Case]
) -> list[Outcome]:
    """What a trusted function (reference or planted mistake) returns for the cases."""
    if exercise.kind == "expression":
        function = _evaluated(function, tuple(a.name for a in exercise.arguments))
    arguments = [c.arguments for c in cases]
    outcomes = call_all(function, arguments, len(exercise.results))
    return [_or_wrote(a, o) for a, o in zip(arguments, outcomes, strict=True)]


def _or_wrote(arguments: Mapping[str, Any], outcome: Outcome) -> Outcome:
    """The outcome, or that the answer modified its inputs.

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


def diagnose(
    exercise: Exercise,
    cases: Sequence[Case],
    outcomes: Sequence[Outcome],
) -> Mistake | None:
    """The planted mistake that gives the same as the answer on every case, passed and failed alike.

    One that agrees on a part of them names nothing: the answer may have another cause
    there, and what the mistake's message says would then be false.
    """
    for mistake in exercise.mistakes:
        theirs = answers_of(mistake.function, exercise, cases)
        if all(_alike(exercise, o, t) for o, t in zip(outcomes, theirs, strict=True)):
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
    if expected.kind != "value":
        raise RuntimeError(
            f"the reference of {exercise.name} gives no value for {case.label!r}: {expected.text}"
        )
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
