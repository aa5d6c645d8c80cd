"""Wrong answers that readers of lesson 02 gave: each fails with every seed, and what is said of it is true."""

import numpy as np
import pytest
import sympy as sp

from course.exercises.definition import find_exercise
from course.exercises.explanation import verdict_message
from course.exercises.inputs import answers_of
from course.exercises.verdict import judge
from course.formulas import support

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


def told(name, function, seed=None):
    """What is said of an answer; "passed" where it passes."""
    exercise = find_exercise(name)[1]
    cases = exercise.draw(seed)
    verdict = judge(exercise, cases, answers_of(function, exercise, cases))
    said = str(verdict_message(exercise, verdict)).replace("\n", " ")
    return "passed" if verdict.passed else " ".join(said.split())


# support


def places(points, direction):
    return np.sum(points * direction[..., None, :], axis=-1)


def farthest(score):
    def answer(points, direction):
        best = np.argmax(score(points, direction), axis=-1)[..., None, None]
        return np.take_along_axis(points, best, axis=-2)[..., 0, :]

    return answer


def tied(points, direction):
    p = places(points, direction)
    return (p == p.max(-1, keepdims=True))[..., None]


def sum_of_ties(points, direction):
    return np.sum(points * tied(points, direction), axis=-2)


def mean_of_ties(points, direction):
    m = tied(points, direction)
    return np.sum(points * m, axis=-2) / np.sum(m, axis=-2)


def from_the_tip(points, direction):
    return np.linalg.norm(points - direction[..., None, :], axis=-1)


# k_dop


def ends(least, largest, axis):
    def answer(points, directions):
        along = points @ directions.T
        return least(along, axis=axis), largest(along, axis=axis)

    return answer


def stacked(points, directions):
    return np.stack(ends(np.min, np.max, -2)(points, directions))


def both_ways(points, directions):
    most = np.max(np.abs(points @ directions.T), axis=-2)
    return -most, most


# compound_support


def placed(points, rotation, translation):
    turned = points @ np.swapaxes(rotation, -1, -2)
    return turned + translation[..., None, :]


def corner_of_all(points, rotation, translation, direction):
    return np.max(placed(points, rotation, translation), axis=(-3, -2))


def of_each_part(points, rotation, translation, direction):
    inward = np.sum(rotation * direction[..., None, :, None], axis=-2)
    own = farthest(places)(points, inward)
    return np.sum(rotation * own[..., None, :], axis=-1) + translation


def inward_twice(points, rotation, translation, direction):
    inward = np.sum(rotation * direction[..., None, :, None], axis=-2)
    world = of_each_part(points, rotation, translation, direction)
    return farthest(places)(world, inward)


# bounding_sphere and principal_box


def ritter(move):
    """Ritter's sphere whose centre moves by ``move(way, distance, old radius, new one)``."""

    def answer(points):
        low, high = points[np.argmin(points, axis=0)], points[np.argmax(points, axis=0)]
        widest = np.argmax(np.linalg.norm(high - low, axis=-1))
        center = 0.5 * (low[widest] + high[widest])
        radius = 0.5 * np.linalg.norm(high[widest] - low[widest])
        for point in points:
            distance = np.linalg.norm(point - center)
            if distance > radius:
                grown = 0.5 * (radius + distance)
                center = center + move(point - center, distance, radius, grown)
                radius = grown
        return center, radius

    return answer


def by_eigenvalues(points):
    spread, axes = np.linalg.eigh(np.cov(points.T))
    axes = axes * np.sign(np.linalg.det(axes))
    along = (points - points.mean(axis=0)) @ axes
    middle = 0.5 * (along.max(axis=0) + along.min(axis=0))
    return points.mean(axis=0) + axes @ middle, axes, np.sqrt(spread)


# box_growth


def growth(first, second):
    def answer(e_1, e_2, theta):
        c, s = abs(sp.cos(theta)), abs(sp.sin(theta))
        return first(e_1, e_2, c, s) * second(e_1, e_2, c, s) / (e_1 * e_2)

    return answer


def along_x(e_1, e_2, c, s):
    return e_1 * c + e_2 * s


def along_y(e_1, e_2, c, s):
    return e_1 * s + e_2 * c


def less(e_1, e_2, c, s):
    return e_1 * c - e_2 * s


def in_degrees(e_1, e_2, theta):
    return growth(along_x, along_y)(e_1, e_2, theta * sp.pi / 180)


ANSWERS = {
    "sum of ties": ("support", sum_of_ties, "If several are equally far, you add them"),
    "mean of ties": ("support", mean_of_ties, "you take their mean"),
    "one direction for all": (
        "support", farthest(lambda x, d: np.sum(x * d, axis=-1)), "direction[..., None, :]"),
    "a matrix product": ("support", farthest(lambda x, d: x @ d), "takes the directions for the columns"),
    "a column": (
        "support", farthest(lambda x, d: np.sum(x * d[..., None], axis=-1)), "stands the direction up as a column"),
    "far from the tip": ("support", farthest(from_the_tip), "as if d were a place"),
    "near the tip": (
        "support", farthest(lambda x, d: -from_the_tip(x, d)), "nearest to the tip of d"),
    "place times direction": (
        "support", lambda x, d: np.max(places(x, d), axis=-1)[..., None] * d, "largest place by the direction"),
    "the number": ("support", lambda x, d: np.argmax(places(x, d), axis=-1), "the number of the farthest point"),
    "the place": ("support", lambda x, d: np.max(places(x, d), axis=-1), "the place of the farthest point, a number"),
    "an axis too many": ("support", lambda x, d: support(x, d)[..., None, :], "still as a table of one row"),
    "largest coordinates": ("support", lambda x, d: np.max(x, axis=-2), "a corner of the AABB"),
    "numbers of points": ("k_dop", ends(np.argmin, np.argmax, -2), "which point is at the end"),
    "over the directions": ("k_dop", ends(np.min, np.max, -1), "axis=-2 of (..., n, h)"),
    "one array": ("k_dop", stacked, "return lower, upper"),
    "one end": ("k_dop", lambda x, n: np.max(x @ n.T, axis=-2), "Asked are two results"),
    "all at once": ("k_dop", ends(np.min, np.max, None), "of all places at once"),
    "rows": (
        "k_dop", lambda x, n: (np.min(x @ n, axis=-2), np.max(x @ n, axis=-2)), "turn rows into columns"),
    "both ways": ("k_dop", both_ways, "the largest size of a place for both ends"),
    "corner of the compound": ("compound_support", corner_of_all, "a corner of the AABB"),
    "a point for each part": ("compound_support", of_each_part, "You return a point for each part"),
    "the part's direction twice": ("compound_support", inward_twice, "one direction of the world"),
    "half of the way": (
        "bounding_sphere", ritter(lambda way, d, r, grown: way / 2), "it moves by (d - r)/2, and not by d/2"),
    "not of length 1": (
        "bounding_sphere", ritter(lambda way, d, r, grown: (d - r) / 2 * way), "which is d long and not 1"),
    "the old radius": (
        "bounding_sphere", ritter(lambda way, d, r, grown: (1 - r / d) * way), "before it grew"),
    "eigenvalues": ("principal_box", by_eigenvalues, "the roots of the eigenvalues"),
    "degrees": ("box_growth", in_degrees, "it is in radians already"),
    "minus": ("box_growth", growth(less, along_y), "there is no minus"),
    "squared": ("box_growth", growth(along_x, along_x), "the reach along x for both sides"),
}  # fmt: skip


@pytest.mark.parametrize("seed", [None, 1, 2, 3])
@pytest.mark.parametrize("answer", ANSWERS)
def test_it_fails_and_is_told_why(answer, seed):
    name, function, why = ANSWERS[answer]
    said = told(name, function, seed)
    assert why in said, said
    assert "dtype int" not in said and "Right for one, wrong for many" not in said


def test_of_points_that_are_as_far_any_one_will_do():
    def last(points, direction):
        return support(points[..., ::-1, :], direction)

    for seed in (None, 1, 2, 3):
        assert told("support", last, seed) == "passed"
