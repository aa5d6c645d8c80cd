"""What a message prints is true: the pasted call gives what it says was expected and got."""

from dataclasses import replace

import numpy as np
import pytest

from course.exercises.comparison import compare_one
from course.exercises.definition import Case, Exercise, Mistake, Value, all_lessons
from course.exercises.explanation import pasteable, verdict_message
from course.exercises.inputs import answers_of
from course.exercises.message import Message
from course.exercises.numbers_as_text import code, short
from course.exercises.verdict import judge

EXERCISES = [
    e for lesson in all_lessons() for e in lesson.exercises if e.kind == "function"
]


def parts_of(exercise, verdict):
    return {part.label: part.text for part in verdict_message(exercise, verdict).parts}


def pair_exercise(mistake, shape="(..., 3)"):
    """Twice a vector, over a single case and batches whose lengths look like vectors and quaternions."""
    value = Value("x", shape, "m")
    return Exercise(
        name="double", rows=(1,), points=1, minutes=1, task="Double it.", arguments=(value, Value("s", "(...)")),
        results=(value,), reference=lambda x, s: 2 * x,
        cases=lambda rng: [
            Case("one", {"x": rng.normal(size=3), "s": 1.0}),
            Case("three", {"x": rng.normal(size=(3, 3)), "s": rng.normal(size=3)}, "batch"),
            Case("four", {"x": rng.normal(size=(4, 3)), "s": rng.normal(size=4)}, "batch"),
        ],
        mistakes=(Mistake("the mistake", mistake, "Some words about the mistake."),), hints=("a", "b", "____"),
    )  # fmt: skip


def test_an_answer_judged_by_properties_is_shown_beside_the_one_it_breaks():
    exercise = next(e for e in EXERCISES if e.name == "solve_contact_qp")
    cases = exercise.draw()
    answers = answers_of(lambda a, b: np.full(len(b), 0.125), exercise, cases)
    parts = verdict_message(exercise, judge(exercise, cases, answers)).parts
    assert parts_of(exercise, judge(exercise, cases, answers))["got"].startswith(
        "f = [0.125"
    )
    assert len({part.text for part in parts}) == len(parts), "nothing is said twice"


@pytest.mark.slow
@pytest.mark.parametrize("exercise", EXERCISES, ids=lambda e: e.name)
@pytest.mark.parametrize("seed", (None, pytest.param(20_261, marks=pytest.mark.long)))
def test_every_counterexample_can_be_pasted_and_gives_what_it_says(exercise, seed):
    cases = exercise.draw(seed)
    for mistake in exercise.mistakes:
        verdict = judge(exercise, cases, answers_of(mistake.function, exercise, cases))
        call = pasteable(exercise, verdict)
        if verdict.difference.fault:
            with (
                pytest.raises(Exception)
                if verdict.outcome.kind == "raised"
                else np.errstate(all="ignore")
            ):
                eval(call, {"np": np, exercise.name: mistake.function})
            continue
        which = [r.name for r in exercise.results].index(verdict.difference.result)
        for function, told in (
            (mistake.function, verdict.difference.got),
            (exercise.reference, verdict.difference.expected),
        ):
            value = eval(call, {"np": np, exercise.name: function})
            value = np.asarray(value if len(exercise.results) == 1 else value[which])[
                verdict.difference.index
            ]
            np.testing.assert_array_equal(
                value, told, err_msg=f"{mistake.name}\n{call}"
            )


def test_a_batch_that_is_mixed_up_is_shown_whole():
    exercise = pair_exercise(
        lambda x, s: 2 * x if x.ndim == 1 else 2 * np.cumsum(x, axis=0)[::-1]
    )
    cases = exercise.draw(1)
    verdict = judge(
        exercise, cases, answers_of(exercise.mistakes[0].function, exercise, cases)
    )
    again = eval(
        pasteable(exercise, verdict),
        {"np": np, "double": exercise.mistakes[0].function},
    )
    np.testing.assert_array_equal(
        again[verdict.difference.index], verdict.difference.got
    )
    assert "at index [0] of the batch" in parts_of(exercise, verdict)["expected"]


def test_one_call_is_shown_before_a_batch():
    exercise = pair_exercise(lambda x, s: 3 * x)
    cases = exercise.draw(1)[::-1]
    verdict = judge(
        exercise, cases, answers_of(exercise.mistakes[0].function, exercise, cases)
    )
    assert verdict.case.label == "one"


@pytest.mark.parametrize(
    "value",
    [
        1.0, 0.1 + 0.2, np.inf, -np.inf, np.float64(2.5), 3, True, "word", np.array(4.0), np.array(np.inf), (1.0, 2),
        np.array([1.0, np.inf, -np.inf, np.nan]), np.array([[1, 2], [3, 4]]), np.array([True, False]),
        np.zeros((0, 3)), np.zeros(0, dtype=int), np.linspace(0, 1, 3000), (np.array([1.0, np.inf]), 2), (np.ones(2),),
        np.array(["a", "b"]),
    ],
)  # fmt: skip
def test_code_makes_the_value_again(value):
    again = eval(code(value), {"np": np})
    for one, other in zip(
        *((v,) if not isinstance(v, tuple) else v for v in (value, again)), strict=True
    ):
        np.testing.assert_array_equal(one, other)
        assert (
            np.shape(one) == np.shape(other)
            and np.asarray(one).dtype == np.asarray(other).dtype
        )


def test_nan_is_told_with_its_place_in_the_batch():
    vector = Value("v", "(..., 3)")
    expected = np.ones((4, 3))
    got = expected.copy()
    got[2, 1] = np.nan
    difference = compare_one(vector, expected, got)
    assert (
        "NaN" in difference.fault
        and difference.index == (2,)
        and difference.entry == (1,)
    )


@pytest.mark.parametrize(
    ("shape", "own"), [("scalar", 0), ("(...)", 0), ("(..., 3)", 1), ("(..., count)", 1), ("(..., 3, 3)", 2),
                       ("(n, 3)", 2), ("(c,)", 1)],
)  # fmt: skip
def test_own_axes_are_those_after_the_batch(shape, own):
    assert Value("x", shape).own_axes == own


def test_an_element_is_compared_as_a_whole():
    """A rounding error in a small entry of a large matrix is judged by the matrix; the batch stays apart."""
    matrix = Value("R", "(..., 3, 3)")
    expected = np.stack([np.eye(3) * 1e6, np.eye(3)])
    off = np.zeros((2, 3, 3))
    off[:, 0, 1] = 1e-8
    assert not compare_one(matrix, expected, expected + off * [[[1]], [[0]]]).wrong
    difference = compare_one(matrix, expected, expected + off)
    assert difference.wrong and difference.index == (1,) and difference.entry == (0, 1)
    assert difference.got.shape == (3, 3)


def test_a_long_answer_shows_the_wrong_entry():
    exercise = pair_exercise(lambda x, s: x, shape="(n, 3)")
    many = [Case("many", {"x": np.arange(30.0).reshape(10, 3) + 1, "s": 1.0})]
    wrong = 2 * many[0].arguments["x"]
    wrong[7, 2] = -5.0
    parts = parts_of(
        exercise, judge(exercise, many, answers_of(lambda x, s: wrong, exercise, many))
    )
    assert parts["expected"] == "48 m, at index [7, 2]" and parts["got"] == "-5 m"


def test_expected_and_got_never_read_the_same():
    value = Value("x", "(..., 3)", "m", relative=1e-13)
    exercise = replace(pair_exercise(lambda x, s: x), results=(value,))
    cases = [Case("one", {"x": np.ones(3), "s": 1.0})]
    verdict = judge(
        exercise, cases, answers_of(lambda x, s: 2 * x * (1 + 1e-11), exercise, cases)
    )
    assert short(verdict.difference.expected) == short(verdict.difference.got)
    parts = parts_of(exercise, verdict)
    assert parts["expected"] != parts["got"]


def test_a_batch_is_laid_out_in_columns_and_html_is_escaped():
    exercise = pair_exercise(lambda x, s: 2 * x if x.ndim == 1 else 2 * x[::-1])
    cases = exercise.draw(1)
    verdict = judge(
        exercise, cases, answers_of(exercise.mistakes[0].function, exercise, cases)
    )
    rows = [line for line in pasteable(exercise, verdict).splitlines() if "[" in line]
    assert rows[0].index("[[") + 1 == rows[1].index("[") == rows[2].index("[")
    assert (
        "&lt;b&gt;" in Message("wrong", "<b>").html()
        and "<b>" not in Message("wrong", "<b>").html()
    )
