"""Contact forces of one case: the solver's, the scene's, and the plane that they lie in."""

import numpy as np
import pytest

from course.contact import solve
from course.scenes import loaded_plank, table
from course.study import (
    plank_forces,
    pushed_table,
    two_forces,
)


@pytest.mark.parametrize("load_at", [0.3, 1.05])
def test_two_forces_are_those_of_the_solver_and_of_the_plank(load_at):
    system, truth = loaded_plank(load_at).system(), loaded_plank(load_at).truth
    found = plank_forces(load_at)
    forces = found.forces
    np.testing.assert_allclose(forces.force, truth, atol=1e-9)
    np.testing.assert_allclose(
        forces.acceleration, solve(system).acceleration, atol=1e-9
    )
    np.testing.assert_allclose(forces.matrix @ forces.forced, -forces.bias, atol=1e-12)
    assert found.centre == pytest.approx(20 * load_at / 30)
    assert found.feet.tolist() == [-0.5, 0.5]


def test_many_sweeps_come_to_the_solution():
    found = two_forces([[2.0, -1.0], [-1.0, 3.0]], [-1.0, -2.0], sweeps=40)
    assert found.sweeps.shape == (81, 2)
    np.testing.assert_allclose(found.sweeps[-1], found.force, atol=1e-12)
    np.testing.assert_allclose(found.force, [1.0, 1.0], atol=1e-12)


def test_a_table_pushed_at_a_foot_shows_its_column_of_a():
    column = table().system().A.toarray()[:, 2]
    found = pushed_table(-0.5, -0.3)
    np.testing.assert_allclose(found.response, column, atol=1e-14)
    # The response is linear in the place of a foot, and 0 on the still line.
    plane = np.column_stack([found.feet[:, :2], np.ones(4)])
    slope = np.linalg.lstsq(plane, found.response, rcond=None)[0]
    np.testing.assert_allclose(
        np.column_stack([found.still, [1, 1]]) @ slope, 0, atol=1e-12
    )
    assert pushed_table(0.1, 0.05).still is None


def test_level_sets_are_those_of_the_quadratic_form():
    """q = f'A f/2 + b.f is half the square of the distance, plus a constant."""
    a, b = np.array([[2.0, -1.0], [-1.0, 3.0]]), np.array([-1.0, 2.0])
    found = two_forces(a, b)
    f = np.random.default_rng(3).normal(size=(4, 5, 2))
    q = 0.5 * np.einsum("...i,ij,...j->...", f, a, f) + f @ b
    rest = q - 0.5 * found.distance(f) ** 2
    assert rest.shape == (4, 5) and np.ptp(rest) < 1e-13
    assert found.distance(found.forced) == 0
