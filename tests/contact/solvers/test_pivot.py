"""Baraff's pivoting: by hand, redundant contacts, the ray where no force exists, and against the definition."""

import numpy as np
import pytest

from course.contact.solvers import complementarity_residual
from course.contact.solvers.pivot import solve_pivot
from course.scenes import random_scene, spinning_between_pins, table


def test_two_contacts_by_hand():
    found = solve_pivot([[1, 0.5], [0.5, 1]], [-1.0, -1.0])
    np.testing.assert_allclose(found.force, 2 / 3, rtol=1e-12)
    assert found.finished and found.pivots == 2 and found.ray is None
    lifted = solve_pivot(
        [[1, 0.5], [0.5, 1]], [-1.0, 0.0]
    )  # the second alone would pull
    np.testing.assert_allclose(lifted.force, [1, 0])


def test_a_redundant_contact_never_joins():
    """Three contacts of rank 1: the first carries all, the others' w is 0 already."""
    found = solve_pivot(np.ones((3, 3)), [-2.0, -2.0, -2.0])
    assert (
        found.finished and found.pivots == 1 and found.force.sum() == pytest.approx(2)
    )
    worse = solve_pivot(np.ones((3, 3)), [-1.0, -3.0, -2.0])
    np.testing.assert_allclose(worse.force, [0, 3, 0])


@pytest.mark.parametrize("seed", range(25))
@pytest.mark.slow
def test_any_scene(seed):
    system = random_scene([31, seed], contacts=40).system()
    if len(system):
        found = solve_pivot(system.A.toarray(), system.b)
        assert found.finished and np.all(found.force >= 0)
        assert complementarity_residual(system.A, found.force, system.b) <= 1e-10


def test_no_solution_is_proved():
    pins = spinning_between_pins(2.0).system()
    for a, b in (
        ([[1.0, -1], [-1, 1]], [-1.0, -1]),
        (pins.A.toarray(), pins.b),
        ([[0.0, 0], [0, 1]], [-1.0, 1]),
    ):
        found = solve_pivot(a, b)
        y = found.ray
        assert not found.finished and np.all(y >= 0)
        np.testing.assert_allclose(np.array(a) @ y, 0, atol=1e-13)
        assert np.array(b) @ y < 0


def test_stops_at_its_limit_and_refuses_wrong_shapes():
    system = table().system()
    found = solve_pivot(system.A.toarray(), system.b, max_pivots=1)
    assert found.pivots == 1 and not found.finished
    assert solve_pivot(np.zeros((0, 0)), []).finished
    with pytest.raises(ValueError, match="matrix"):
        solve_pivot(np.zeros((2, 3)), [1.0, 1])
    with pytest.raises(ValueError, match="bias"):
        solve_pivot(np.eye(2), [1.0])
