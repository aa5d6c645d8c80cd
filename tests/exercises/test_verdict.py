"""Which slip an answer is told of: whole or in part, and no slip that it did not make."""

import warnings

import numpy as np
import pytest

from course.exercises.definition import find_exercise
from course.exercises.verdict import answers_of, judge


def verdict_of(name, function, seed=None):
    exercise = find_exercise(name)[1]
    cases = exercise.draw(seed)
    return judge(exercise, cases, answers_of(function, exercise, cases))


def closing(v, w, n):
    return np.sum((w - v) * n, axis=-1)


def mu(a, b):
    return 1 / (1 / a + 1 / b)


@pytest.mark.parametrize("seed", (None, 3, 4, 5))
@pytest.mark.parametrize(
    ("factor", "name"),
    [
        (lambda e: e, "only e"),
        (lambda e: 1.0, "no e"),
        (lambda e: 1 - e, "as printed"),
        (lambda e: -(1 + e), "sign"),
    ],
)
def test_a_slip_is_told_although_the_guard_is_forgotten_too(factor, name, seed):
    verdict = verdict_of(
        "impulse_central",
        lambda a, b, v, w, n, e: factor(e) * closing(v, w, n) * mu(a, b),
        seed,
    )
    assert verdict.mistake.name == name
    assert "look for a second slip" in verdict.reason[0]


def test_a_slip_that_explains_all_says_nothing_of_a_second():
    verdict = verdict_of(
        "impulse_central",
        lambda a, b, v, w, n, e: (1 + e) * closing(v, w, n) * mu(a, b),
    )
    assert verdict.mistake.name == "no guard"
    assert not any("second slip" in r for r in verdict.reason)


def test_errors_of_one_kind_are_not_taken_for_one_slip():
    """np.dot and the missing axis both raise ValueError in a batch; they are not the same mistake."""

    def wall_bounce(v, n, e):
        along = np.dot(v, n)
        return np.where(along < 0, v - (1 + e) * along * n, v)

    verdict = verdict_of("wall_bounce", wall_bounce)
    assert verdict.mistake is None and "over the last axis" in verdict.reason[0]


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (
            lambda p, q, i, n: (p + i[..., None] * n, q - i[..., None] * n),
            "np.asarray(s)[..., None] serves",
        ),
        (
            lambda p, q, i, n: (p, q) if i > 0 else (q, p),
            "np.where(condition, this, that)",
        ),
    ],
)
def test_a_plain_number_that_is_indexed_and_an_if_on_a_batch_are_told(wrong, message):
    assert any(message in r for r in verdict_of("momentum_after", wrong).reason)


@pytest.mark.parametrize("letters", ("ij,j->i", "ij,j", "ij,...j->...i"))
def test_einsum_without_its_dots_is_told(letters):
    def spin(inverse, momentum, omega, torque):
        return np.einsum(letters, inverse, torque + np.cross(momentum, omega))

    (reason,) = verdict_of("angular_acceleration_free", spin).reason
    assert "put ... before the letters" in reason and "np.sum" not in reason


def test_einsum_that_fails_for_another_reason_is_not_told_of_dots():
    def spin(inverse, momentum, omega, torque):
        return np.einsum("...ij,...k->...i", inverse, torque[..., :2])[..., :1, 9]

    assert not any(
        "before the letters" in r
        for r in verdict_of("angular_acceleration_free", spin).reason
    )


def test_single_precision_is_told():
    def nearly(v, w, n, e):
        u = -closing(v, w, n)
        return np.float32(np.where(u < 0, -e * u, u))

    assert any("single" in r for r in verdict_of("separation_speed", nearly).reason)


@pytest.mark.parametrize("value", (np.nan, np.inf, 1j))
def test_no_property_is_said_to_be_lacking_where_there_is_no_number(value):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        verdict = verdict_of(
            "impulse_central", lambda a, b, v, w, n, e: value * np.ones(np.shape(a))
        )
    assert not any("pulls the bodies" in r for r in verdict.reason)


@pytest.mark.parametrize(
    "answer",
    [
        lambda s: np.zeros(0),
        lambda s: np.zeros((0,) if s else ()),
        lambda s: "a" if s else 1.0,
    ],
)
def test_answers_of_odd_sizes_are_judged(answer):
    verdict = verdict_of(
        "impulse_central", lambda a, b, v, w, n, e: answer(np.shape(a))
    )
    assert verdict.state == "wrong"
