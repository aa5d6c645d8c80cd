"""What a wrong answer's outcomes alone tell: only in batches, in another order, of whole numbers."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations

import numpy as np

from course.exercises.answer import Outcome
from course.exercises.comparison import Difference, compare
from course.exercises.definition import Case, Exercise

#: What NumPy says where one True or False is wanted of many.
AMBIGUOUS = "truth value of an array"

#: So many cases are named, no more.
FEW = 3


#: What Python says where a number is indexed, and where numbers are combined as if they
#: were conditions.
INDEXED_NUMBER = (
    "float' object is not subscriptable",
    "int' object is not subscriptable",
    "invalid index to scalar",
)
COMBINED_NUMBERS = (
    "operand type(s) for &",
    "operand type(s) for |",
    "'bitwise_and' not supported",
    "'bitwise_or' not supported",
)

CONSTANT = "It gives the same in every case: does it use its arguments?"
#: A verdict may be the same in a dozen cases and another in the next: no more is said than was seen.
ONE_VERDICT = "It says {} in all the cases that were tried."
INDEXES_A_NUMBER = (
    "What has [...] behind it there is a plain number. Where an axis is wanted, np.asarray(s)[..., None] "
    "serves numbers and arrays alike."
)
COMBINES_NUMBERS = (
    "& and | were given numbers, not conditions. They bind more tightly than <, so each comparison needs "
    "brackets: (a < 0) & (b < 0)."
)
#: What Python says where np.max or np.min takes a second array for an axis.
TAKEN_FOR_AXIS = (
    "object cannot be interpreted as an integer",
    "only integer scalar arrays can be converted",
)
MAX_OF_TWO = (
    "np.max and np.min take one array; what stands behind it is taken for the number of an axis. np.maximum(a, b) "
    "and np.minimum(a, b) compare two arrays place by place."
)
NO_DEFAULT = (
    "Where no condition holds np.select puts the number 0, and numbers do not go with words. It wants a word for what "
    "is left: default=..."
)
#: What Python says where a pair of numbers is compared, or given a minus, as if it were one.
WHOLE_TUPLES = ("and 'tuple'", "'tuple' and", "unary -: 'tuple'")
TAKES_A_TUPLE = (
    "A tuple, several numbers in brackets, stands there in the place of one number. Take it apart first: "
    "first, second = pair."
)
ONE_QUESTION = (
    "`if`, `and`, `or`, `not`, a < b < c, min(), max() and np.arange() ask one question, a batch has "
    "many answers: np.where(condition, this, that), &, |, ~, np.minimum and np.maximum answer each element for "
    "itself."
)
ONE_TRUTH = (
    "`if`, `and`, `or`, `not`, min(), max() and .remove() need one True or False. In a case that is no batch a "
    "whole array is compared: does a vector stand there in the place of a number?"
)
EINSUM_DOTS = (
    'In np.einsum put ... before the letters, for the axes of the batch: "...ij,...j->...i" is matrix times '
    "vector for one and for many."
)
#: What Python says where a call hands over too little, and NumPy where np.maximum gets three.
TOO_LITTLE = "required positional argument"
NO_STAR = (
    "That call hands over fewer values than the function has names for. If one of them is a pair, as of a function "
    "that returns two, a star hands over its members: f(*pair)."
)
NO_PLACE = "return arrays must be of ArrayType"
MAXIMUM_OF_THREE = (
    "np.maximum and np.minimum compare two arrays; what stands third is taken for the place to write to. For three, "
    "put one call into the other."
)
SHAPES_DIFFER = "could not be broadcast together"
FROM_THE_RIGHT = (
    "NumPy lays shapes side by side from the right: each two lengths must be the same, or one of them 1. Which of the "
    "two shapes has a length too many? A sum over one axis, such as axis=-1, takes that one away."
)
ONLY_BATCHES = (
    "Right for one, wrong for many at once. A batch has its axes in front of the one's own: look for a line "
    "that takes them for the vector's, or mixes the members."
)
SOME_OF_A_BATCH = (
    "Right for one, and in a batch for most. Either the batch is mixed up, or some of its members are of a kind that "
    "the single cases lack: give the one at the index above to your function alone."
)
ONLY_EDGES = (
    "Right in the ordinary cases, wrong at an edge: what is special in this one?"
)
CUT_OFF = "Your numbers are whole: an array of dtype int cuts off the decimals of all that is put into it."
SINGLE_PRECISION = "Your numbers are of single or half precision, right to 7 or 3 digits: leave them as float64."


def general_advice(
    exercise: Exercise,
    cases: Sequence[Case],
    outcomes: Sequence[Outcome],
    wrongs: Sequence[Difference | None],
    expected: Sequence[Outcome],
) -> tuple[str, ...]:
    """Slips that need no planting: only in batches, constant, only at edges; a line each."""
    values = all(o.kind == "value" for o in outcomes)
    if values and len(outcomes) > 1 and _constant(outcomes):
        said = outcomes[0].values[0]
        is_bool = said.dtype.kind == "b"
        return (ONE_VERDICT.format(bool(said.flat[0])) if is_bool else CONSTANT,)
    advice = [*_other_order(exercise, outcomes, expected)]
    kinds = {c.kind for c, w in zip(cases, wrongs, strict=True) if w is not None}
    stopped = _why_it_stops(cases, outcomes, also_wrong=bool(kinds - {"batch"}))
    if stopped:
        advice.append(stopped)
    elif kinds == {"batch"} and exercise.kind == "function":
        few = _few_members(exercise, outcomes, expected)
        advice.append(SOME_OF_A_BATCH if few else ONLY_BATCHES)
    elif kinds == {"edge"}:
        advice.append(ONLY_EDGES)
    elif exercise.kind == "function" and not advice and _all_compared(outcomes, wrongs):
        advice += _where_it_holds(cases, wrongs)
    if _cut_off(exercise, outcomes, wrongs):
        advice.append(CUT_OFF)
    if any(v.dtype in (np.float16, np.float32) for o in outcomes for v in o.values):
        advice.append(SINGLE_PRECISION)
    return tuple(advice)


def _few_members(
    exercise: Exercise, outcomes: Sequence[Outcome], expected: Sequence[Outcome]
) -> bool:
    """Whether a verdict, a single True or False, is wrong for at most a quarter of all members."""
    if [r.dtype for r in exercise.results] != ["bool"]:
        return False
    pairs = [(o.values, e.values) for o, e in zip(outcomes, expected, strict=True)]
    if any(not o or o[0].shape != e[0].shape for o, e in pairs):
        return False
    wrong = [np.ravel(o[0] != e[0]) for o, e in pairs]
    return bool(np.concatenate(wrong).mean() <= 0.25)


def _why_it_stops(
    cases: Sequence[Case], outcomes: Sequence[Outcome], *, also_wrong: bool
) -> str:
    """What an error says of numbers and batches that were taken for one another, or ""."""
    if any(_says(o, *INDEXED_NUMBER) for o in outcomes):
        return INDEXES_A_NUMBER
    if any(_says(o, *COMBINED_NUMBERS) for o in outcomes):
        return COMBINES_NUMBERS
    if any(_says(o, *TAKEN_FOR_AXIS) and _max_in_line(o) for o in outcomes):
        return MAX_OF_TWO
    if any(_says(o, "Choicelist and default value") for o in outcomes):
        return NO_DEFAULT
    if any(_says(o, *WHOLE_TUPLES) for o in outcomes):
        return TAKES_A_TUPLE
    if asks_one_question(cases, outcomes):
        return ("Besides, it stops at batches: " if also_wrong else "") + ONE_QUESTION
    if any(_says(o, AMBIGUOUS) for o in outcomes):
        return ONE_TRUTH
    if any("'...' ellipsis" in o.text for o in outcomes):  # of letters fewer than axes
        return EINSUM_DOTS
    return _why_a_call_stops(cases, outcomes)


def _why_a_call_stops(cases: Sequence[Case], outcomes: Sequence[Outcome]) -> str:
    """What an error says of a call's arguments or of their shapes, or ""."""
    if any(_says(o, TOO_LITTLE) for o in outcomes):
        return NO_STAR
    if any(_says(o, NO_PLACE) for o in outcomes):
        return MAXIMUM_OF_THREE
    single = (o for c, o in zip(cases, outcomes, strict=True) if c.kind == "single")
    return FROM_THE_RIGHT if any(_says(o, SHAPES_DIFFER) for o in single) else ""


def _all_compared(
    outcomes: Sequence[Outcome], wrongs: Sequence[Difference | None]
) -> bool:
    """Whether numbers of the right shape came in every case: else that is what has to be said."""
    values = all(o.kind == "value" for o in outcomes)
    return values and not any(w is not None and w.fault for w in wrongs)


def _where_it_holds(
    cases: Sequence[Case], wrongs: Sequence[Difference | None]
) -> list[str]:
    """Of an answer that is right in a few single cases, or wrong in a few of all, which they are."""
    judged = list(zip(cases, wrongs, strict=True))
    right = [c.label for c, w in judged if w is None and c.kind != "batch"]
    wrong = [c.label for c, w in judged if w is not None]
    if 0 < len(right) <= min(FEW, len(wrong)):
        return [f"Right in: {'; '.join(right)}. What is special there?"]
    if right and len(wrong) <= FEW:
        return [f"Wrong only in: {'; '.join(wrong)}. What is special there?"]
    return []


def _other_order(
    exercise: Exercise, outcomes: Sequence[Outcome], expected: Sequence[Outcome]
) -> list[str]:
    """Whether the results, wherever there are any, are the right ones in another order."""
    pairs = zip(outcomes, expected, strict=True)
    came = [(o, e) for o, e in pairs if o.kind == "value"]
    if len(exercise.results) < 2 or len(came) < 3:
        return []
    for order in list(permutations(range(len(exercise.results))))[1:]:
        turned = [(tuple(o.values[i] for i in order), e.values) for o, e in came]
        if not any(compare(exercise.results, e, t).wrong for t, e in turned):
            names = ", ".join(r.name for r in exercise.results)
            return [f"The results are right, but for their order: return {names}."]
    return []


def _cut_off(
    exercise: Exercise,
    outcomes: Sequence[Outcome],
    wrongs: Sequence[Difference | None],
) -> bool:
    """Whether an array of whole numbers came where decimals are right."""
    return any(
        w is not None and not w.fault and r.dtype == "float"
        and r.name == w.result and v.dtype.kind in "iu" and v.ndim > 0
        and not np.array_equal(w.expected, np.round(w.expected))
        for o, w in zip(outcomes, wrongs, strict=True)
        for r, v in zip(exercise.results, o.values, strict=False)
    )  # fmt: skip


def asks_one_question(cases: Sequence[Case], outcomes: Sequence[Outcome]) -> bool:
    """Whether an answer stops at an `if` or the like, and with batches only."""
    kinds = {
        c.kind for c, o in zip(cases, outcomes, strict=True) if _says(o, AMBIGUOUS)
    }
    return kinds == {"batch"}


def _says(outcome: Outcome, *words: str) -> bool:
    """Whether the answer raised an error with one of these words in it."""
    return outcome.kind == "raised" and any(w in outcome.text for w in words)


def _max_in_line(outcome: Outcome) -> bool:
    """Whether np.max or np.min stands in the line that stopped."""
    return any(call in outcome.text for call in ("np.max(", "np.min("))


def _constant(outcomes: Sequence[Outcome]) -> bool:
    values = [o.values[0] for o in outcomes]
    return (
        all(v.size > 0 for v in values)
        and len({v.dtype.kind for v in values}) == 1
        and all(bool((v == values[0].flat[0]).all()) for v in values)
    )
