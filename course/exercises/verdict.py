"""From outcomes to a verdict: state, first counterexample, a likely cause."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

import numpy as np

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
    mistake, whole = diagnose(exercise, cases, outcomes, failed)
    reason = () if mistake else general_advice(exercise, cases, outcomes, wrongs)
    if mistake and not whole:
        reason = (
            "This does not explain every case that fails: fix it, then look for a second slip.",
        )
    reason += violated(exercise, cases[first], outcomes[first])
    return Verdict(
        exercise.name,
        state,
        0,
        len(cases),
        cases[first],
        outcomes[first],
        wrongs[first],
        mistake,
        reason,
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
    failed: Sequence[int],
) -> tuple[Mistake | None, bool]:
    """The planted mistake that explains the answer, and whether it explains every
    failed case.

    One that gives the same on every case; else the one that gives the same on most of
    the failed ones: on all of them, or by value on more than half and at least two (a
    second slip, a forgotten guard say, changes the others; two answers that merely
    raise the same kind of error need not have a slip in common).
    """
    best: tuple[tuple[int, int], Mistake | None] = ((0, 0), None)
    for mistake in exercise.mistakes:
        theirs = answers_of(mistake.function, exercise, cases)
        alike = [_alike(exercise, o, t) for o, t in zip(outcomes, theirs, strict=True)]
        if all(alike):
            return mistake, True
        explained = sum(alike[i] for i in failed)
        by_value = sum(alike[i] and outcomes[i].kind == "value" for i in failed)
        enough = explained == len(failed) or (
            by_value >= 2 and 2 * by_value > len(failed)
        )
        if enough and (explained, sum(alike)) > best[0]:
            best = (explained, sum(alike)), mistake
    return best[1], best[0][0] == len(failed)


def general_advice(
    exercise: Exercise,
    cases: Sequence[Case],
    outcomes: Sequence[Outcome],
    wrongs: Sequence[Difference | None],
) -> tuple[str, ...]:
    """Slips that need no planting: only in batches, constant, only at edges."""
    wrong_kinds = {c.kind for c, w in zip(cases, wrongs, strict=True) if w is not None}
    advice = []
    if (
        all(o.kind == "value" for o in outcomes)
        and len(outcomes) > 1
        and _constant(outcomes)
    ):
        return ("It gives the same for every input: does it use its arguments?",)
    if any("object is not subscriptable" in o.text for o in outcomes):
        advice.append(
            "A plain number has no axes to index: np.asarray(s)[..., None] serves numbers and arrays alike."
        )
    elif any("truth value of an array" in o.text for o in outcomes):
        advice.append(
            "`if` asks one question, a batch has many answers: use np.where(condition, this, that), which answers "
            "each element for itself."
        )
    elif any(
        "'...' ellipsis" in o.text for o in outcomes
    ):  # einsum, of letters fewer than axes
        advice.append(
            'In np.einsum put ... before the letters, for the axes of the batch: "...ij,...j->...i" is matrix times '
            "vector for one and for many."
        )
    elif wrong_kinds == {"batch"} and exercise.kind == "function":
        advice.append(
            "Right for one, wrong for many at once: take sums over the last axis, np.sum(a * b, axis=-1), and give a "
            "number one more axis before it multiplies vectors, s[..., None] * n."
        )
    elif wrong_kinds == {"edge"}:
        advice.append(
            "Right in the ordinary cases, wrong at an edge: read what the task says of this case."
        )
    if any(v.dtype in (np.float16, np.float32) for o in outcomes for v in o.values):
        advice.append(
            "Your numbers are of single or half precision, right to 7 or 3 digits: leave them as float64."
        )
    return tuple(advice)


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
    return one.kind != "raised" or one.text.split(":")[0] == other.text.split(":")[0]


def _constant(outcomes: Sequence[Outcome]) -> bool:
    values = [o.values[0] for o in outcomes]
    return (
        all(v.size > 0 for v in values)
        and len({v.dtype.kind for v in values}) == 1
        and all(bool((v == values[0].flat[0]).all()) for v in values)
    )
