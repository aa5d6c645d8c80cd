"""Wrong answers that a reader of lesson 06 gave: each fails with every seed, and what is said of it is true."""

import numpy as np
import pytest

from course.exercises.definition import find_exercise
from course.exercises.explanation import verdict_message
from course.exercises.inputs import answers_of
from course.exercises.verdict import judge

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


def told(name, function, seed=None):
    """What is said of an answer; "passed" where it passes."""
    exercise = find_exercise(name)[1]
    cases = exercise.draw(seed)
    with np.errstate(all="ignore"):
        verdict = judge(exercise, cases, answers_of(function, exercise, cases))
    said = str(verdict_message(exercise, verdict)).replace("\n", " ")
    return "passed" if verdict.passed else " ".join(said.split())


# miss_probability


def misses(seen=lambda t, r: t + 2 * r, way=lambda v, h: v * h, form=None):
    form = form or (lambda share: np.clip(1 - share, 0, 1))
    return lambda t, r, v, h: form(seen(t, r) / way(v, h))


# swept_spheres_time


def spheres(hits, root=lambda inside: np.sqrt(np.maximum(inside, 0))):
    """By the first root, as (-b - root)/a, and a question of one's own."""

    def time(x, r, v, y, s, w, horizon):
        m, v, r = x - y, v - w, r + s
        a, b = np.sum(v * v, -1), np.sum(m * v, -1)
        c = np.sum(m * m, -1) - r**2
        inside = b * b - a * c
        t = (-b - root(inside)) / np.where(a > 0, a, 1.0)
        t = np.where(c < 0, 0.0, np.where(hits(a, b, inside, t), t, np.inf))
        return np.where(t <= horizon, t, np.inf)

    return time


def approaching(a, b, inside, t):
    return (b < 0) & (inside >= 0)


def not_below_0(a, b, inside, t):
    return (t >= 0) & (inside >= 0) & (a > 0)


def any_time(a, b, inside, t):
    return inside >= 0


def above_0(a, b, inside, t):
    return (t > 0) & (inside >= 0)


def bars(a, b, inside, t):
    return b < 0


# swept_boxes_time


def at_once(first, last):
    return (first <= last) & (last > 0)


def boxes(
    combined=lambda enter, leave: (enter.max(-1), leave.min(-1)),
    meets=at_once,
    between=lambda v, w: v - w,
    ends=lambda one, other: (np.minimum(one, other), np.maximum(one, other)),
    slide=lambda rubs, enter, inside: rubs & np.all(inside, axis=-1),
):
    """By the lines that are given, and a combination of one's own."""

    def time(lower_a, upper_a, v, lower_b, upper_b, w, horizon):
        v = between(v, w)
        before, after = lower_b - upper_a, upper_b - lower_a
        still, inside = v == 0, (before <= 0) & (after >= 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            one, other = before / v, after / v
        one = np.where(still, np.where(inside, -np.inf, np.inf), one)
        other = np.where(still, np.inf, other)
        rubs = np.any(still & ((before == 0) | (after == 0)), axis=-1)
        enter, leave = ends(one, other)
        slides = slide(rubs, enter, inside)
        first, last = combined(enter, leave)
        meet = meets(first, last) & (first <= horizon) & ~slides
        return np.where(meet, np.maximum(first, 0), np.inf)

    return time


def never(rubs, enter, inside):
    return np.zeros_like(rubs)


def before_the_start(rubs, enter, inside):
    return rubs & np.all(enter < 0, axis=-1)


def tiny(v, w):
    return np.where(v == w, 1e-12, v - w)


ANSWERS = {
    "cut off at 0": ("miss_probability", misses(), "Right but at rest"),
    "one radius": ("miss_probability", misses(lambda t, r: t + r), "a whole diameter"),
    "thinner": ("miss_probability", misses(lambda t, r: t - 2 * r), "easier to see"),
    "to be seen": (
        "miss_probability", misses(form=lambda share: np.minimum(share, 1)), "that a look"),
    "step over speed": (
        "miss_probability", misses(way=lambda v, h: v / h), "speed times step"),
    "abs under the root": (
        "swept_spheres_time", spheres(bars, lambda i: np.sqrt(np.abs(i))), "Below 0 under the root"),
    "t >= 0": ("swept_spheres_time", spheres(not_below_0), "ask b < 0"),
    "whatever the time": ("swept_spheres_time", spheres(any_time), "ask whether they approach"),
    "t > 0": ("swept_spheres_time", spheres(above_0), "which t > 0 leaves out"),
    "(a) not sorted": (
        "swept_boxes_time", boxes(ends=lambda one, other: (one, other)), "take them as they come"),
    "(b) first and last exchanged": (
        "swept_boxes_time", boxes(lambda e, f: (e.min(-1), f.max(-1))), "changed places"),
    "(c) v turned round": (
        "swept_boxes_time", boxes(between=lambda v, w: w - v), "The sign of v is turned round"),
    "(d) last > 0 left out": (
        "swept_boxes_time", boxes(meets=lambda first, last: first <= last), "the end lies in the past"),
    "(e) a tiny speed for 0": (
        "swept_boxes_time", boxes(between=tiny), "something move slowly"),
    "(f) max of all": (
        "swept_boxes_time", boxes(lambda e, f: (e.max(), f.min(-1))), "without axis=-1"),
    "(g) neither parting nor sliding": (
        "swept_boxes_time", boxes(meets=lambda first, last: first <= last, slide=never), "they are parting"),
    "(h) the last entry alone": (
        "swept_boxes_time", boxes(meets=lambda first, last: first < np.inf), "ask nothing of the ends"),
    "(i) the last entry alone, and no slide": (
        "swept_boxes_time", boxes(meets=lambda first, last: first < np.inf, slide=never), "ask nothing of the ends"),
    "(j) the last entry and an end after the start": (
        "swept_boxes_time", boxes(meets=lambda first, last: last > 0, slide=never), "pass each other"),
    "(k) sliding before the start alone": (
        "swept_boxes_time", boxes(slide=before_the_start), "just at the start"),
    "(f) at both ends": (
        "swept_boxes_time", boxes(lambda e, f: (e.max(), f.min())), "without axis=-1"),
}  # fmt: skip


@pytest.mark.parametrize("seed", [None, 1, 2, 3, 4, 5])
@pytest.mark.parametrize("answer", ANSWERS)
def test_it_fails_and_is_told_why(answer, seed):
    name, function, why = ANSWERS[answer]
    said = told(name, function, seed)
    assert why in said, said
    assert "abs() missing" not in said


def test_right_answers_written_otherwise_pass():
    def miss(t, r, v, h):
        seen = t + 2 * r
        return np.maximum(1 - seen / np.maximum(v * h, seen), 0)

    for seed in (None, 1, 2, 3):
        assert told("miss_probability", miss, seed) == "passed"
        assert told("swept_spheres_time", spheres(approaching), seed) == "passed"
        assert told("swept_boxes_time", boxes(), seed) == "passed"


@pytest.mark.parametrize("seed", [None, 1, 2, 3])
def test_the_later_root_without_any_question_is_told_both(seed):
    def later(x, r, v, y, s, w, horizon):
        m, v, r = x - y, v - w, r + s
        a, b = np.sum(v * v, -1), np.sum(m * v, -1)
        c = np.sum(m * m, -1) - r**2
        t = (-b + np.sqrt(b * b - a * c)) / a
        return np.where(t <= horizon, t, np.inf)

    said = told("swept_spheres_time", later, seed)
    assert "You return the later root" in said and "ask neither" in said
