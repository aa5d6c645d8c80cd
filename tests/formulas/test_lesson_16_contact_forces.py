"""Lesson 16 against all 2^c ways in which c contacts can push or rest, and against
differences."""

import itertools

import numpy as np
import pytest
from formulas.clouds import rate

from course import formulas
from course.exercises.definition import find_exercise
from course.exercises.inputs import answers_of
from course.exercises.verdict import judge
from course.scenes import random_scene

SEEDS = pytest.mark.parametrize("seed", range(6))


def drawn(seed, count=6):
    """A positive definite A, not far from singular, and b of both signs."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(count, count + 1))
    return root @ root.T + 0.05 * np.eye(count), 3 * rng.normal(size=count)


def by_trying_all(a, b):
    """The one set of contacts that can push, d_ddot = 0, while the others part."""
    for size in range(len(b) + 1):
        for pushing in map(list, itertools.combinations(range(len(b)), size)):
            f = np.zeros(len(b))
            f[pushing] = np.linalg.solve(a[np.ix_(pushing, pushing)], -b[pushing])
            w = a @ f + b
            w[pushing] = 0.0
            if f.min(initial=0.0) >= 0 and w.min(initial=0.0) >= 0:
                return f
    raise AssertionError("a positive definite A has a solution for every b")


@SEEDS
def test_all_ways_find_the_forces(seed):
    a, b = drawn(seed)
    f = by_trying_all(a, b)
    np.testing.assert_allclose(formulas.pivot(a, b), f, atol=1e-11)
    swept = formulas.projected_gauss_seidel(a, b, np.zeros(6), 3000)
    np.testing.assert_allclose(swept, f, atol=1e-9)
    np.testing.assert_allclose(formulas.solve_contact_qp(a, b), f, atol=1e-5)
    assert formulas.complementarity_residual(a, f, b) < 1e-14


@SEEDS
def test_no_forces_nearby_lower_the_objective(seed):
    a, b = drawn(seed)
    q = lambda f: 0.5 * f @ a @ f + b @ f  # noqa: E731
    f, rng = formulas.pivot(a, b), np.random.default_rng(seed)
    for step in 10.0 ** rng.uniform(-6, 0, 50):
        assert q(np.maximum(f + step * rng.normal(size=6), 0)) >= q(f) - 1e-12


@SEEDS
def test_residual_is_zero_for_a_solution_alone_and_has_no_unit(seed):
    """Off by a little in any force it is not 0, and in grams and millimetres it is the
    same."""
    a, b = drawn(seed)
    f = by_trying_all(a, b)
    for i in range(6):
        other = f.copy()
        other[i] += 1e-3
        assert formulas.complementarity_residual(a, other, b) > 1e-6
    wrong = np.abs(np.random.default_rng(seed).normal(size=6))
    residual = formulas.complementarity_residual(a, wrong, b)
    scaled = formulas.complementarity_residual(1e-3 * a, 1e6 * wrong, 1e3 * b)
    assert scaled == pytest.approx(residual, rel=1e-13)


def test_residual_by_hand():
    """One contact of 2 kg: f = 1, w = 1/2 - 3: |min(1/2, -5/2)| / (1/2 + 3)."""
    found = formulas.complementarity_residual(
        np.array([[0.5]]), np.array([1.0]), np.array([-3.0])
    )
    assert found == pytest.approx(5 / 7, rel=1e-15)


def test_slope_is_the_rate_of_the_objective():
    a_11, a_12, a_22, f_1, f_2, b_1, b_2 = 2.0, 0.5, 1.5, 3.0, 4.0, -9.0, 1.0

    def q(t):
        f = np.array([f_1 + t, f_2])
        a = np.array([[a_11, a_12], [a_12, a_22]])
        return 0.5 * f @ a @ f + np.array([b_1, b_2]) @ f

    found = formulas.slope_1(a_11, a_12, f_1, f_2, b_1)
    assert found == pytest.approx(rate(q), rel=1e-8)


def test_pivot_says_where_there_is_no_end():
    """No contact matrix: a_11 < 0, a push there draws the bodies together, and two
    contacts take turns for ever."""
    a = np.array([[2.0, -3, 0, 0], [-3, -6, -2, 1], [0, -2, 6, 2], [0, 1, 2, 2]])
    with pytest.raises(RuntimeError, match="contact 2: no end after 100 stops"):
        formulas.pivot(a, np.array([-2.0, -2.0, -3.0, -1.0]))


def test_clipped_increments_are_told_by_their_answer():
    """(1, .5) on A = [[1, .5], [.5, 1]], b = (-1, -1), where (2/3, 2/3) is right."""
    sweeps = find_exercise("projected_gauss_seidel")[1]
    a, b = np.array([[1, 0.5], [0.5, 1]]), -np.ones(2)
    (clipped,) = (m.function for m in sweeps.mistakes if m.name == "clips the change")
    np.testing.assert_allclose(clipped(a, b, np.zeros(2), 50), [1, 0.5])
    right = formulas.projected_gauss_seidel(a, b, np.zeros(2), 50)
    np.testing.assert_allclose(right, 2 / 3)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [None, 1, 2, 3])
def test_the_slides_programme_passes_by_its_three_conditions(seed):
    """The formula, also where the forces are not unique; and where one of two contacts
    carries all."""
    exercise = find_exercise("solve_contact_qp")[1]
    cases = exercise.draw(seed)

    def one_of_two(a, b):
        """The later of two contacts that are one is a little stiffer, and so the first
        carries all."""
        stiffer = 1e-12 * np.trace(a) * np.diag(np.arange(len(b)))
        return formulas.pivot(a + stiffer, b)

    for answer in (formulas.solve_contact_qp, one_of_two):
        assert judge(exercise, cases, answers_of(answer, exercise, cases)).passed


@pytest.mark.slow
def test_sweeps_solve_a_scene():
    system = random_scene(12, contacts=12).system()
    a = system.A.toarray()
    f = formulas.projected_gauss_seidel(a, system.b, np.zeros(len(system)), 5000)
    assert formulas.complementarity_residual(a, f, system.b) < 1e-6
