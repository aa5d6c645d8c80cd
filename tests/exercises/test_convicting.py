"""Wrong answers that are no slip of one place: each must fail with every seed, and not by luck."""

from collections.abc import Callable
from functools import cache
from itertools import combinations, permutations, product

import numpy as np
import pytest
from exercises.mutant_worker import passes, trial_of

from course import formulas
from course.exercises.definition import Exercise, all_lessons, find_exercise
from course.exercises.slips import slip

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

SEEDS = (None, *range(12))
EXERCISES = [e for lesson in all_lessons() for e in lesson.exercises]


@cache
def trial(name: str, seed):
    """The cases of a seed, judged without asking why an answer is wrong."""
    return trial_of(find_exercise(name)[1], seed)


def right(name: str, function: Callable, seed) -> bool:
    return passes(function, trial(name, seed))


# Which contacts push? Tried one set after the other, with a condition forgotten.


def sets_of(order: str, count: int):
    """Sets of contacts in an order that a student may try them in."""
    flags = list(product([False, True], repeat=count))
    if order == "first contact last":
        return [np.flatnonzero(f[::-1]) for f in flags]
    if order == "all first":
        return [np.flatnonzero(f) for f in flags[::-1]]
    if order == "small ones first":
        sizes = range(count + 1)
        return [np.array(s, int) for n in sizes for s in combinations(range(count), n)]
    return [np.flatnonzero(f) for f in flags]


ORDERS = (
    "as counted",
    "first contact last",
    "all first",
    "small ones first",
)


def tried(order: str, *, w: bool, f: bool) -> Callable:
    def forces(a, b):
        for some in sets_of(order, len(b)):
            force = np.zeros(len(b))
            block = a[np.ix_(some, some)]
            force[some] = np.linalg.lstsq(block, -b[some], rcond=None)[0]
            size = max(1.0, np.abs(b).max())
            enough = not w or (a @ force + b).min() >= -1e-9 * size
            if enough and (not f or force.min(initial=0.0) >= -1e-9):
                return force
        return None

    return forces


def as_impulses(forces: Callable) -> Callable:
    return lambda matrix, u, e: forces(matrix, (1 + e) * np.asarray(u))


NAMES = ("pivot", "simultaneous_impulses", "solve_contact_qp")


def answer_for(name: str, forces: Callable) -> Callable:
    return as_impulses(forces) if name == "simultaneous_impulses" else forces


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("order", ORDERS)
def test_trying_sets_with_one_condition_fails_and_with_both_passes(name, order):
    for seed in SEEDS[:4]:
        only_w = answer_for(name, tried(order, w=True, f=False))
        assert not right(name, only_w, seed)
        only_f = answer_for(name, tried(order, w=False, f=True))
        assert not right(name, only_f, seed)
        both = answer_for(name, tried(order, w=True, f=True))
        assert right(name, both, seed)


def test_the_two_cases_made_for_them_convict_every_order():
    for name in NAMES:
        for order, seed in product(ORDERS, SEEDS[:5]):
            function = answer_for(name, tried(order, w=True, f=False))
            pulled = [t for t in trial(name, seed) if "pulling" in t[1].label]
            assert len(pulled) == 2 and not passes(function, pulled)


# Loops that do not settle.


def all_at_once(share: float) -> Callable:
    """Jacobi's sweeps: every impulse from those of the sweep before."""

    def impulses(matrix, u, e):
        p = np.zeros(len(u))
        for _ in range(501):
            w = matrix @ p + (1 + e) * np.asarray(u)
            p = np.maximum(0.0, p - share * w / np.diagonal(matrix))
        return p

    return impulses


def flipped(a, b):
    """All that sink are added and all that pull taken out at once, until nothing changes."""
    pushing = b < 0
    for _ in range(100):
        f, some = np.zeros(len(b)), np.flatnonzero(pushing)
        f[some] = np.linalg.lstsq(a[np.ix_(some, some)], -b[some], rcond=None)[0]
        new = np.where(pushing, f > 0, a @ f + b < -1e-12)
        if (new == pushing).all():
            break
        pushing = new
    return f


@pytest.mark.parametrize("seed", SEEDS)
def test_jacobi_flips_for_ever(seed):
    assert not right("simultaneous_impulses", all_at_once(1.0), seed)


@pytest.mark.parametrize("name", ["pivot", "simultaneous_impulses"])
@pytest.mark.parametrize("seed", SEEDS)
def test_adding_and_taking_out_all_at_once_goes_round(name, seed):
    assert not right(name, answer_for(name, flipped), seed)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("rounds", [20])
def test_too_few_rounds_do_not_pass_for_a_row(seed, rounds):
    few = slip(formulas.simultaneous_impulses, "range(500)", f"range({rounds})")
    assert not right("simultaneous_impulses", few, seed)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("flights", [49, 100, 1000, 10_000])
def test_a_sum_of_flights_that_is_cut_off_is_no_time_to_rest(flights, seed):
    """The sum itself, in closed form: 2 (e + ... + e^n) = 2 e (1 - e^n)/(1 - e)."""
    edits = "2 * e / (1 - e)", f"2 * e * (1 - e**{flights}) / (1 - e)"
    assert not right("rest_time", slip(formulas.rest_time, *edits), seed)


@pytest.mark.parametrize("most", [10, 30])
def test_times_of_so_many_impacts_at_most_are_not_those_asked_for(most):
    few = slip(
        formulas.bounce_times, "np.arange(count)", f"np.arange(min(count, {most}))"
    )
    assert not right("bounce_times", few, None)


# Pivoting.


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    "edits",
    [
        ("for i in range(k) if i", "for i in range(len(b)) if i"),
        (" and (k in pushing or f[k] == 0)", ""),
        (
            " and (k in pushing or f[k] == 0)",
            "",
            "min(stops)",
            "min(stops, key=lambda stop: stop[0])",
        ),
    ],
)
def test_stops_of_contacts_not_dealt_with_and_two_at_once(edits, seed):
    wrong = slip(formulas.pivot, *edits)
    assert not right("pivot", wrong, seed)


def test_pivoting_holds_where_two_stops_coincide():
    """Worked: f_2 = 2 N brings w_2 and f_1 to 0 in one step; then contact 3 needs w_2 kept at 0."""
    a = np.array([[1, 0.5, -0.2], [0.5, 1, 0.25], [-0.2, 0.25, 1]])
    b = np.array([-1.0, -2.0, -3.0])
    for order in permutations(range(3)):
        order = list(order)
        f = formulas.pivot(a[np.ix_(order, order)], b[order])
        w = a[np.ix_(order, order)] @ f + b[order]
        assert f.min() >= 0 and w.min() > -1e-12 and np.abs(f * w).max() < 1e-12


@pytest.mark.parametrize(
    "seeds",
    [(None, *range(20)), pytest.param(tuple(range(20, 100)), marks=pytest.mark.slow)],
    ids=["some", "many"],
)
def test_no_contact_needs_more_than_the_four_stops_the_lesson_promises(seeds):
    four = slip(formulas.pivot, "range(100)", "range(5)")
    for seed in seeds:
        assert right("pivot", four, seed)


# What is given and not read: another index, a number written in.


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    "index",
    [
        lambda i, j, c: (i, 0),
        lambda i, j, c: (i, 1),
        lambda i, j, c: (i, c - 1),
        lambda i, j, c: (i, 1 - i),
        lambda i, j, c: (i, c - 1 - i),
        lambda i, j, c: (i, (i + 1) % c),
        lambda i, j, c: (0, j),
        lambda i, j, c: (1, j),
        lambda i, j, c: (i, i),
        lambda i, j, c: (i, j - 1),
        lambda i, j, c: (min(i, j), max(i, j) - min(i, j)),
    ],
)
def test_an_index_that_is_not_read(index, seed):
    def entry(i, j, contacts, bodies):
        i, j = index(int(i), int(j), len(contacts[0]))
        return formulas.contact_matrix_entry(i, j, contacts, bodies)

    assert not right("contact_matrix_entry", entry, seed)


#: The length of a rod or ladder drops out: arm squared over inertia holds it once each.
CANCELLED = {("rod_impulse", "ell"), ("ladder_entry", "ell")}


def _numbers(exercise: Exercise, cases, name: str) -> list:
    """The values an argument has in the single cases, and the numbers one writes without looking."""
    given = [c.arguments[name] for c in cases]
    single = [v for v in given if not isinstance(v, tuple) and np.ndim(v) == 0]
    if any(isinstance(v, str) for v in single):
        return sorted(set(single))
    usual = [9.81, 10.0, 0.0, 0.5, 1.0, 2.0] if single else []
    return sorted({*map(float, single), *usual})


#: Without a tolerance the steps of conservative advancement have no end.
ENDLESS = ("conservative_advancement", "tolerance", 0.0)


@pytest.mark.slow
@pytest.mark.parametrize("exercise", EXERCISES, ids=lambda e: e.name)
def test_no_argument_can_be_written_in(exercise):
    for seed in (None, 3):
        cases = exercise.draw(seed)
        for argument in exercise.arguments:
            if (exercise.name, argument.name) in CANCELLED:
                continue
            for value in _numbers(exercise, cases, argument.name):
                if (exercise.name, argument.name, value) == ENDLESS:
                    continue
                wrong = _written_in(exercise, argument.name, value)
                try:
                    passed = right(exercise.name, wrong, seed)
                except (ZeroDivisionError, ValueError):  # an expression without a value
                    passed = False
                assert not passed, f"{argument.name} = {value} written in, seed {seed}"


def _written_in(exercise: Exercise, name: str, value) -> Callable:
    place = [a.name for a in exercise.arguments].index(name)
    whole = exercise.arguments[place].dtype == "int"

    def function(*given):
        before = given[place]
        if isinstance(value, str):
            now = value
        elif exercise.kind == "expression":
            now = value
        else:
            now = int(value) if whole else np.full(np.shape(before), value)[()]
        return exercise.reference(*given[:place], now, *given[place + 1 :])

    return function
