"""The references of lesson 16 against the contact package and against what they are to find."""

import numpy as np
import pytest

from course.contact.solvers import complementarity_residual
from course.contact.solvers.pivot import solve_pivot
from course.contact.solvers.projected_gauss_seidel import solve_projected_gauss_seidel
from course.contact.solvers.qp import solve_qp
from course.exercises.definition import find_exercise
from course.exercises.verdict import answers_of, judge
from course.study.resting_scenes import random_scene, stack


def exercise(name):
    return find_exercise(name)[1]


def test_residual_is_that_of_the_contact_package():
    rng = np.random.default_rng(1)
    root = rng.normal(size=(20, 5, 3))
    a, f, b = (
        root @ np.swapaxes(root, 1, 2),
        rng.uniform(0, 3, (20, 5)),
        rng.normal(size=(20, 5)),
    )
    found = exercise("complementarity_residual").reference(a, f, b)
    np.testing.assert_allclose(found, complementarity_residual(a, f, b), rtol=1e-13)


def test_sweeps_are_those_of_the_contact_package():
    """A chain in colours is swept as odd, then even contacts: the same limit, not the same path."""
    system = stack(6, corners=1).system()
    a = system.A.toarray()
    found = exercise("projected_gauss_seidel").reference(a, system.b, np.zeros(6), 400)
    expected = solve_projected_gauss_seidel(a, system.b, tolerance=1e-13).force
    np.testing.assert_allclose(found, expected, rtol=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_pivoting_is_that_of_the_contact_package(seed):
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(9, 12))
    a, b = root @ root.T, 5 * rng.normal(size=9)
    np.testing.assert_allclose(
        exercise("pivot").reference(a, b), solve_pivot(a, b).force, atol=1e-9
    )


@pytest.mark.slow
@pytest.mark.parametrize("seed", [None, 1, 2, 3])
def test_the_slides_programme_passes_by_its_three_conditions(seed):
    """An answer of Clarabel at its usual tolerance, also where the forces are not unique."""
    qp = exercise("solve_contact_qp")
    cases = qp.draw(seed)
    for tolerance in (1e-8, 1e-10):
        answers = answers_of(
            lambda a, b, t=tolerance: solve_qp(a, b, tolerance=t)[0], qp, cases
        )
        assert judge(qp, cases, answers).passed
    other = answers_of(
        lambda a, b: solve_pivot(a, b).force, qp, cases
    )  # one of two contacts carries all
    assert judge(qp, cases, other).passed


def test_clipped_increments_are_told_by_their_answer():
    """TRUTHS: (1, .5) on A = [[1, .5], [.5, 1]], b = (-1, -1), where (2/3, 2/3) is right."""
    sweeps = exercise("projected_gauss_seidel")
    a, b = np.array([[1, 0.5], [0.5, 1]]), -np.ones(2)
    (clipped,) = (m.function for m in sweeps.mistakes if m.name == "clips the change")
    np.testing.assert_allclose(clipped(a, b, np.zeros(2), 50), [1, 0.5])
    np.testing.assert_allclose(sweeps.reference(a, b, np.zeros(2), 50), 2 / 3)


@pytest.mark.slow
def test_sweeps_solve_a_scene():
    system = random_scene(12, contacts=12).system()
    f = exercise("projected_gauss_seidel").reference(
        system.A.toarray(), system.b, np.zeros(len(system)), 5000
    )
    assert complementarity_residual(system.A, f, system.b) < 1e-6
