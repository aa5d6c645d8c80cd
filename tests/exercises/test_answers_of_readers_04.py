"""Wrong answers that a reader of lesson 04 gave: each fails with every seed, and what is said of it is true."""

import numpy as np
import pytest
import sympy as sp

from course.exercises.definition import find_exercise
from course.exercises.explanation import verdict_message
from course.exercises.inputs import answers_of
from course.exercises.verdict import judge
from course.formulas import closest_point_on_segment as nearest_on

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


def told(name, function, seed=None):
    """What is said of an answer; "passed" where it passes."""
    exercise = find_exercise(name)[1]
    cases = exercise.draw(seed)
    verdict = judge(exercise, cases, answers_of(function, exercise, cases))
    said = str(verdict_message(exercise, verdict)).replace("\n", " ")
    return "passed" if verdict.passed else " ".join(said.split())


def dot(a, b):
    return np.sum(a * b, axis=-1, keepdims=True)


def divided_by(divisor):
    """A nearest point that replaces a square of 0 in another way."""

    def nearest(p, a, b):
        way = b - a
        return a + np.clip(dot(p - a, way) / divisor(dot(way, way)), 0, 1) * way

    return nearest


def share(p, a, b):
    way = b - a
    square = dot(way, way)
    return np.clip(dot(p - a, way) / np.where(square == 0, 1, square), 0, 1)


def spheres(verdict):
    """Of the squared distance and the square of the reach."""
    return lambda a, r, b, s: verdict(np.sum((a - b) ** 2, -1), (r + s) ** 2)


def capsule(nearest):
    def gap(c, r, a, b, s):
        return np.linalg.norm(c - nearest(c, a, b), axis=-1) - r - s

    return gap


def on_line(p, a, b):
    return a + dot(p - a, b - a) / dot(b - a, b - a) * (b - a)


def nearer_end(p, a, b):
    first = dot(p - a, p - a) < dot(p - b, p - b)
    return np.where(first, a, b)


def of_squares(c, r, a, b, s):
    return np.sum((c - nearest_on(c, a, b)) ** 2, -1) - (r + s) ** 2


def square_and(added):
    return divided_by(lambda q: q + added)


def end_of_b(la, ua, lb, ub):
    """Whether an end of B's interval lies in A's, on each axis."""
    return (la <= lb) & (lb <= ua) | (la <= ub) & (ub <= ua)


def corner_of_either(la, ua, lb, ub):
    return np.all(end_of_b(la, ua, lb, ub), -1) | np.all(end_of_b(lb, ub, la, ua), -1)


def lowest_corner(la, ua, lb, ub):
    return np.all((la <= lb) & (lb <= ua), -1) | np.all((lb <= la) & (la <= ub), -1)


def centre_in_the_other(a, r, b, s):
    square = np.sum((a - b) ** 2, -1)
    return (square <= r**2) | (square <= s**2)


ANSWERS = {
    "squares below 1e-6": (
        "closest_point_on_segment", divided_by(lambda q: np.maximum(q, 1e-6)), "A segment of 0.1 mm is no point"),
    "squares below 1": (
        "closest_point_on_segment", divided_by(lambda q: np.where(q < 1, 1, q)), "Where the squared length is below 1"),
    "the share": (
        "closest_point_on_segment", lambda p, a, b: share(p, a, b)[..., 0], "You return the share"),
    "the share, an axis more": ("closest_point_on_segment", share, "You return the share"),
    "isclose": (
        "spheres_overlap", spheres(lambda d, q: (d < q) | np.isclose(d, q)), "that are 9 mm apart"),
    ">=": ("spheres_overlap", spheres(lambda d, q: d >= q), "The comparison is turned"),
    "square of the sum": (
        "spheres_overlap", lambda a, r, b, s: np.sum(a - b, -1) ** 2 <= (r + s) ** 2, "square their sum"),
    "centres added": (
        "spheres_overlap", lambda a, r, b, s: np.sum((a + b) ** 2, -1) <= (r + s) ** 2, "You add the two centres"),
    "B below A": (
        "boxes_overlap", lambda la, ua, lb, ub: np.all(lb <= ua, -1), "where B lies wholly below A"),
    "and": (
        "boxes_overlap", lambda la, ua, lb, ub: np.all((la <= ub) and (lb <= ua), -1), "& joins two arrays"),
    "both >=": (
        "boxes_overlap", lambda la, ua, lb, ub: np.all((la >= ub) & (lb >= ua), -1), "Both comparisons are turned"),
    "an end of B in A": (
        "boxes_overlap", lambda *corners: np.all(end_of_b(*corners), -1), "whether a corner of B lies in A"),
    "a corner of either": ("boxes_overlap", corner_of_either, "a corner of one lies in the other"),
    "the lowest corner": ("boxes_overlap", lowest_corner, "On x A may begin first and on y B"),
    "a centre": ("spheres_overlap", centre_in_the_other, "whether the centre of one lies in the other"),
    "and a hair": ("closest_point_on_segment", square_and(1e-12), "You add 1e-12 m² to the square"),
    "from the origin": (
        "closest_point_on_segment",
        lambda p, a, b: a + np.clip(dot(p, b) / np.maximum(dot(b - a, b - a), 1e-300), 0, 1) * (b - a),
        "two places as seen from the origin"),
    "the point from the origin, not guarded": (
        "closest_point_on_segment",
        lambda p, a, b: a + np.clip(dot(p, b - a) / dot(b - a, b - a), 0, 1) * (b - a),
        "of the point as seen from the origin"),
    "no limit, not guarded": ("closest_point_on_segment", on_line, "only a point you divide 0 by 0"),
    "the length, not guarded": (
        "closest_point_on_segment",
        lambda p, a, b: a + np.clip(dot(p - a, b - a) / dot(b - a, b - a) ** 0.5, 0, 1) * (b - a),
        "divided by the square of the length. And where"),
    "as derived": (
        "closest_point_on_segment",
        lambda p, a, b: np.clip(dot(p, b) / dot(b, b), 0, 1) * b, "share of the derivation as it stands"),
    "as derived, along the way": (
        "closest_point_on_segment",
        lambda p, a, b: a + np.clip(dot(p, b) / dot(b, b), 0, 1) * (b - a), "share of the derivation as it stands"),
    "coordinates": ("closest_point_on_segment", np.clip, "You limit x, y and z one by one"),
    "coordinates in order": (
        "closest_point_on_segment",
        lambda p, a, b: np.clip(p, np.minimum(a, b), np.maximum(a, b)),
        "the nearest place of the upright box"),
    "a size": (
        "sphere_capsule_gap",
        lambda *given: np.abs(capsule(nearest_on)(*given)), "leave its sign as it comes"),
    "no np.all": (
        "boxes_overlap", lambda la, ua, lb, ub: (la <= ub) & (lb <= ua), "You give three verdicts a pair"),
    "squares": ("sphere_capsule_gap", of_squares, "difference of two squares"),
    "the line": ("sphere_capsule_gap", capsule(on_line), "you divide 0 by 0"),
    "the nearer end": ("sphere_capsule_gap", capsule(nearer_end), "You measure to the nearer end"),
}  # fmt: skip


@pytest.mark.parametrize("seed", [None, 1, 2, 3, 4, 5])
@pytest.mark.parametrize("answer", ANSWERS)
def test_it_fails_and_is_told_why(answer, seed):
    name, function, why = ANSWERS[answer]
    assert why in told(name, function, seed)


@pytest.mark.parametrize("seed", [None, 1, 2, 3, 4, 5])
def test_with_the_root_it_is_right_as_well(seed):
    def with_root(a, r, b, s):
        return np.linalg.norm(a - b, axis=-1) <= r + s

    assert told("spheres_overlap", with_root, seed) == "passed"


def lengths(p_1, p_2, p_3, b_1, b_2, b_3):
    return (p_1**2 + p_2**2 + p_3**2) ** 0.5 / (b_1**2 + b_2**2 + b_3**2) ** 0.5


@pytest.mark.parametrize("seed", [None, 1, 2])
def test_how_long_p_is_counts_only_along_b(seed):
    assert "how long p is, in lengths of b" in told("foot_share", lengths, seed)


BRACKETS = {
    "none": (
        lambda p, q, r, a, b, c: p * a + q * b + r * c / a**2 + b**2 + c**2, "Put the numerator in brackets, and"),
    "above": (
        lambda p, q, r, a, b, c: (p * a + q * b + r * c) / a**2 + b**2 + c**2, "you divide by the first square only"),
    "below": (
        lambda p, q, r, a, b, c: p * a + q * b + r * c / (a**2 + b**2 + c**2), "only the last product is divided"),
}  # fmt: skip


@pytest.mark.parametrize("seed", [None, 1, 2])
@pytest.mark.parametrize("where", BRACKETS)
def test_brackets_that_are_missing_are_named(where, seed):
    function, why = BRACKETS[where]
    assert why in told("foot_share", function, seed)


def test_a_vector_is_no_share():
    from course.exercises.expressions import evaluator

    b = sp.Matrix(sp.symbols("b_1:4"))
    with pytest.raises(TypeError, match="got a vector or a matrix"):
        evaluator(b / 3, ["b_1", "b_2", "b_3"])


def test_a_choice_that_is_a_number_needs_no_quotes():
    from course.exercises.definition import find_prediction
    from course.workbook.predicting import _given

    prediction = find_prediction("first_wrong")[1]
    assert _given(prediction, 65) == prediction.outcome() == "65"
    with pytest.raises(ValueError, match="got 66"):
        _given(prediction, 66)
