"""From outcomes to a verdict: the state, the first counterexample, and why the answer may be wrong."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from course.exercises.answer import Outcome, call_all
from course.exercises.comparison import Difference, compare, same
from course.exercises.definition import Case, Exercise, Mistake

State = Literal["passed", "wrong", "not attempted", "error", "needs a person"]


@dataclass(frozen=True)
class Verdict:
    """The judgement of one answer.

    ``case`` is the first counterexample, ``outcome`` what the answer gave there and ``difference`` how it is wrong;
    ``mistake`` is the planted mistake it matches, ``reason`` anything else worth saying, one line each.
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

    @property
    def passed(self) -> bool:
        """Whether the answer is right."""
        return self.state == "passed"


def judge(exercise: Exercise, cases: Sequence[Case], outcomes: Sequence[Outcome]) -> Verdict:
    """Judge what an answer gave on the cases; only the reference and the mistakes are run here.

    Raises ``ValueError`` where the two sequences differ in length: no case goes unjudged.
    """
    if len(cases) != len(outcomes) or not cases:
        raise ValueError(f"outcomes: expected one for each of {len(cases)} cases, at least one; got {len(outcomes)}")
    if any(o.kind == "unattempted" for o in outcomes):
        return Verdict(exercise.name, "not attempted")
    expected = answers_of(exercise.reference, exercise, cases)
    wrongs = [_wrong(exercise, c, o, e) for c, o, e in zip(cases, outcomes, expected, strict=True)]
    first = next((i for i, w in enumerate(wrongs) if w is not None), None)
    if first is None:
        return Verdict(exercise.name, "passed", exercise.points, len(cases))
    state: State = "error" if outcomes[first].kind in ("raised", "unreadable", "none") else "wrong"
    mistake = diagnose(exercise, cases, outcomes, [w is not None for w in wrongs])
    reason = () if mistake else general_advice(cases, outcomes, wrongs)
    reason += violated(exercise, cases[first], outcomes[first])
    return Verdict(
        exercise.name, state, 0, len(cases), cases[first], outcomes[first], wrongs[first], mistake, reason
    )


def answers_of(function: Any, exercise: Exercise, cases: Sequence[Case]) -> list[Outcome]:
    """What a trusted function (the reference, a planted mistake) gives on the cases."""
    return call_all(function, [c.arguments for c in cases], len(exercise.results))


def diagnose(
    exercise: Exercise, cases: Sequence[Case], outcomes: Sequence[Outcome], wrong: Sequence[bool]
) -> Mistake | None:
    """The planted mistake that explains the answer.

    One that gives the same on every case, else one that gives the same wherever the answer is wrong (a second slip
    may hide a part of it); of several, the one that agrees with the answer on most cases.
    """
    best: tuple[int, Mistake | None] = (0, None)
    for mistake in exercise.mistakes:
        theirs = answers_of(mistake.function, exercise, cases)
        alike = [_alike(exercise, o, t) for o, t in zip(outcomes, theirs, strict=True)]
        if all(alike):
            return mistake
        if all(a for a, w in zip(alike, wrong, strict=True) if w) and sum(alike) > best[0]:
            best = (sum(alike), mistake)
    return best[1]


def general_advice(
    cases: Sequence[Case], outcomes: Sequence[Outcome], wrongs: Sequence[Difference | None]
) -> tuple[str, ...]:
    """Slips that no exercise needs to plant: wrong only in a batch, one answer for all, wrong only at edges."""
    wrong_kinds = {c.kind for c, w in zip(cases, wrongs, strict=True) if w is not None}
    advice = []
    if any("truth value of an array" in o.text for o in outcomes):
        advice.append(
            "`if` asks one question, a batch has many answers: use np.where(condition, this, that), which answers "
            "each element for itself."
        )
    elif wrong_kinds == {"batch"}:
        advice.append(
            "Right for one, wrong for many at once: take sums over the last axis, np.sum(a * b, axis=-1), and give a "
            "number one more axis before it multiplies vectors, s[..., None] * n."
        )
    elif wrong_kinds == {"edge"}:
        advice.append("Right in the ordinary cases, wrong at an edge: read what the task says of this case.")
    if all(o.kind == "value" for o in outcomes) and len(outcomes) > 1 and _constant(outcomes):
        advice.append("It gives the same for every input: does it use its arguments?")
    return tuple(advice)


def violated(exercise: Exercise, case: Case, outcome: Outcome) -> tuple[str, ...]:
    """The messages of the properties that the answer to this case lacks."""
    if outcome.kind != "value":
        return ()
    answer = outcome.values[0] if len(exercise.results) == 1 else outcome.values
    lacking = []
    for rule in exercise.properties:
        try:
            with np.errstate(all="ignore"):
                residual = np.max(np.abs(np.asarray(rule.residual(case.arguments, answer), dtype=float)), initial=0.0)
        except (ValueError, TypeError, IndexError):
            if exercise.judged_by == "reference":
                continue  # an answer of another shape: the comparison has said so already
            residual = np.inf  # nothing else judges it: an answer the rule cannot be asked of is no right one
        if not residual <= rule.tolerance:
            lacking.append(rule.message)
    return tuple(lacking)


def _wrong(exercise: Exercise, case: Case, outcome: Outcome, expected: Outcome) -> Difference | None:
    if expected.kind != "value":
        raise RuntimeError(f"the reference of {exercise.name} gives no value for {case.label!r}: {expected.text}")
    if outcome.kind != "value":
        return Difference(exercise.results[0].name, expected=expected.values[0], fault=outcome.kind)
    difference = compare(exercise.results, expected.values, outcome.values)
    if exercise.judged_by == "reference" or difference.fault:
        return difference if difference.wrong else None
    lacking = violated(exercise, case, outcome)
    return Difference(exercise.results[0].name, got=outcome.values[0], fault=lacking[0]) if lacking else None


def _alike(exercise: Exercise, one: Outcome, other: Outcome) -> bool:
    if one.kind != other.kind:
        return False
    if one.kind == "value":
        return same(exercise.results, other.values, one.values)
    return one.kind != "raised" or one.text.split(":")[0] == other.text.split(":")[0]


def _constant(outcomes: Sequence[Outcome]) -> bool:
    first = outcomes[0].values[0].ravel()[:1]
    return all(o.values[0].size and (o.values[0] == first).all() for o in outcomes)
