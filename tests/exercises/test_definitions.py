"""Every exercise of every lesson: the reference passes, each planted mistake fails with its own message."""

import dataclasses
import keyword
import re

import numpy as np
import pytest
from campaigns import drawn_of

from course.exercises.comparison import same
from course.exercises.definition import (
    Case,
    Exercise,
    Mistake,
    Property,
    Value,
    all_lessons,
)
from course.exercises.explanation import verdict_message
from course.exercises.formula_source import source_of
from course.exercises.inputs import answers_of
from course.exercises.letters import with_letters
from course.exercises.verdict import judge, violated

EXERCISES = [e for lesson in all_lessons() for e in lesson.exercises]
#: The notebook's own inputs, one other draw every day, and one more in the long tests, or two.
SEEDS = (
    None,
    pytest.param(20_261, marks=pytest.mark.slow),
    *(
        pytest.param(seed, marks=pytest.mark.long)
        for seed in (1, 987_654_321)[: drawn_of(2, 1)]
    ),
)
by_name = pytest.mark.parametrize("exercise", EXERCISES, ids=lambda e: e.name)


def verdict_of(exercise: Exercise, function, seed=None):
    cases = exercise.draw(seed)
    return judge(exercise, cases, answers_of(function, exercise, cases))


def blind_pairs(exercise: Exercise, seed=None) -> list[tuple[str, str]]:
    """Pairs of planted mistakes, or of a mistake and the reference, that the inputs do not tell apart."""
    cases = exercise.draw(seed)
    versions = {"the reference": exercise.reference} | {
        m.name: m.function for m in exercise.mistakes
    }
    answers = {
        name: answers_of(function, exercise, cases)
        for name, function in versions.items()
    }
    names = list(answers)
    return [
        (a, b)
        for i, a in enumerate(names)
        for b in names[i + 1 :]
        if all(
            _alike(exercise, x, y) for x, y in zip(answers[a], answers[b], strict=True)
        )
    ]


def _alike(exercise, one, other):
    if one.kind != other.kind:
        return False
    if one.kind == "value":
        return same(exercise.results, one.values, other.values)
    return (
        one.kind != "raised" or one.text.split(":")[0] == other.text.split(":")[0]
    )  # the type of the error


@by_name
@pytest.mark.parametrize("seed", SEEDS)
def test_reference_passes(exercise, seed):
    verdict = verdict_of(exercise, exercise.reference, seed)
    assert verdict.passed, str(verdict_message(exercise, verdict))


@pytest.mark.slow
@by_name
@pytest.mark.parametrize("seed", SEEDS)
def test_each_mistake_fails_with_its_own_message(exercise, seed):
    for mistake in exercise.mistakes:
        verdict = verdict_of(exercise, mistake.function, seed)
        assert not verdict.passed, f"{mistake.name} passes"
        assert verdict.mistake is mistake, (
            f"{mistake.name} is taken for {verdict.mistake and verdict.mistake.name}"
        )
        assert with_letters(mistake.message).split("\n")[0][:40] in str(
            verdict_message(exercise, verdict)
        ).replace("\n", " ")


@by_name
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.slow
def test_inputs_tell_all_versions_apart(exercise, seed):
    assert blind_pairs(exercise, seed) == []


@by_name
@pytest.mark.slow
def test_properties_hold_for_the_reference(exercise):
    for case in exercise.draw(7):
        (outcome,) = answers_of(exercise.reference, exercise, [case])
        assert violated(exercise, case, outcome) == ()


@by_name
def test_cases_begin_with_a_single_one_and_draw_anew(exercise):
    first, again, other = exercise.draw(1), exercise.draw(1), exercise.draw(2)
    assert first[0].kind == "single"
    assert (
        [c.label for c in first] == [c.label for c in again] == [c.label for c in other]
    )
    assert all(_equal(a, b) for a, b in zip(first, again, strict=True))
    assert not all(_equal(a, b) for a, b in zip(first, other, strict=True))


@by_name
def test_declared_names_and_messages(exercise):
    for case in exercise.draw():
        assert list(case.arguments) == [a.name for a in exercise.arguments]
    messages = [m.message for m in exercise.mistakes]
    assert len(set(messages)) == len(messages)
    assert all(len(m) > 30 for m in messages)
    assert exercise.points > 0 and exercise.minutes > 0 and exercise.rows
    assert "____" in exercise.hints[2], "the third hint is a line with a hole in it"


@by_name
def test_the_third_hint_has_the_names_of_the_formula(exercise):
    """Who fills in the holes and then sees the formula reads the same lines twice."""
    code = re.sub(r"\"[^\"]*\"|#.*", "", exercise.hints[2])
    names = set(re.findall(r"\b[A-Za-z]\w*", code)) - set(keyword.kwlist)
    known = set(re.findall(r"\w+", source_of(exercise.reference))) | {exercise.name}
    assert not names - known, f"not in the formula: {sorted(names - known)}"


@pytest.mark.parametrize("lesson", all_lessons(), ids=lambda le: le.number)
@pytest.mark.slow
def test_predictions_can_be_computed_and_are_not_shown_before(lesson):
    for prediction in lesson.predictions:
        outcome = prediction.outcome()
        if prediction.choices:
            assert outcome in prediction.choices
            assert set(prediction.wrong) <= set(prediction.choices) - {outcome}
        else:
            assert np.isfinite(float(outcome))
            assert all(
                abs(w - outcome) > prediction.tolerance * abs(outcome)
                for w in prediction.wrong
            )


# The tests above must be able to fail: an exercise whose inputs hide a mistake, and one whose message is another's.


def _square(**changes) -> Exercise:
    value = Value("x", "(...)", "m")
    options = dict(
        name="square", rows=(1,), points=1, minutes=1, task="Return x squared.", arguments=(value,),
        results=(value,), reference=lambda x: x**2,
        cases=lambda rng: [Case("one", {"x": 3.0}), Case("drawn", {"x": rng.uniform(2, 3)})],
        mistakes=(Mistake("cube", lambda x: x**3, "You cube where you should square the number."),),
        hints=("a", "b", "____"),
    )  # fmt: skip
    return Exercise(**(options | changes))


def test_a_blind_generator_is_found_out():
    ones = _square(
        cases=lambda rng: [Case("one", {"x": 1.0}), Case("zero", {"x": 0.0})]
    )
    assert blind_pairs(ones) == [("the reference", "cube")]
    assert blind_pairs(_square()) == []
    twice = Mistake(
        "cube again", lambda x: x * x * x, "Another message for the same wrong answer."
    )
    assert blind_pairs(_square(mistakes=(*_square().mistakes, twice))) == [
        ("cube", "cube again")
    ]


def test_a_property_judges_where_answers_are_not_unique():
    root = _square(
        name="root",
        reference=lambda x: np.sqrt(x),
        judged_by="properties",
        sample=lambda x: 0 * x,
        properties=(
            Property(
                "squares", lambda given, y: y**2 - given["x"], "Its square is not x."
            ),
        ),
        mistakes=(
            Mistake(
                "half", lambda x: x / 2, "Half of x is not its root, except for 4."
            ),
        ),
    )
    assert verdict_of(root, lambda x: -np.sqrt(x)).passed
    wrong = verdict_of(root, lambda x: x)
    assert wrong.state == "wrong" and "Its square is not x." in str(
        verdict_message(root, wrong)
    )


def test_an_exercise_without_mistakes_or_hints_is_refused():
    with pytest.raises(ValueError, match="mistakes: expected at least one"):
        _square(mistakes=())
    with pytest.raises(ValueError, match="hints: expected three"):
        _square(hints=("a",))
    with pytest.raises(ValueError, match="properties: expected at least one"):
        _square(judged_by="properties", sample=lambda x: 0 * x)
    with pytest.raises(ValueError, match="sample: expected one"):
        _square(sample=lambda x: 0 * x)


def test_every_case_is_judged():
    square = _square()
    cases = square.draw()
    with pytest.raises(ValueError, match="outcomes: expected one for each"):
        judge(square, cases, answers_of(square.reference, square, cases[:1]))
    with pytest.raises(ValueError, match="outcomes"):
        judge(square, [], [])


def _equal(a: Case, b: Case) -> bool:
    return all(_equal_values(a.arguments[k], b.arguments[k]) for k in a.arguments)


def _equal_values(a, b) -> bool:
    if isinstance(a, tuple):  # its parts may differ in shape
        return len(a) == len(b) and all(
            _equal_values(x, y) for x, y in zip(a, b, strict=True)
        )
    return np.array_equal(a, b)


def test_cases_cannot_be_written_to():
    case = _square(cases=lambda rng: [Case("one", {"x": np.ones(3)})]).draw()[0]
    with pytest.raises(ValueError):
        case.arguments["x"][0] = 2.0
    with pytest.raises(TypeError):
        case.arguments["x"] = 2.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        case.label = "two"
