"""What bodies do when contacts are pushed, against A and b; counts and exact entries."""

import numpy as np
import pytest
from contact.entry_by_entry import matrix_by_entries

from course.scenes import (
    ladder,
    random_scene,
    spinning_between_pins,
    stack,
    table,
    tilted_foot,
    wall,
    without_forces,
)
from course.study import (
    exact_matrix,
    matrix_cost,
    matrix_growth,
    measured_accelerations,
)


@pytest.mark.parametrize(
    "scene",
    [table(), ladder(1.0, rate=-0.5), stack(2), tilted_foot(table(), 1, 0.3)],
    ids=lambda s: s.name,
)
def test_motion_obeys_b_plus_a_f(scene):
    f = np.random.default_rng(5).uniform(0, 4, len(scene.contacts))
    system = scene.system()
    np.testing.assert_allclose(
        measured_accelerations(scene, f), system.A @ f + system.b, atol=2e-8
    )


def test_without_external_forces_a_f_remains():
    scene = without_forces(table())
    np.testing.assert_allclose(
        measured_accelerations(scene, [1.0, 0, 0, 0]),
        scene.system().A.toarray()[:, 0],
        atol=2e-9,
    )


def test_faces_of_a_are_refused():
    with pytest.raises(ValueError, match="scene: expected contacts of faces of B"):
        measured_accelerations(spinning_between_pins(), [1.0, 1.0])


def test_a_tilted_foot_makes_the_fourth_force_zero():
    """Four normals of which one is tilted: A is not singular, and only this foot can push sideways, so it does not."""
    system = tilted_foot(table(), 3, 0.1).system()
    f = np.linalg.solve(system.A.toarray(), -system.b)
    # All answers are (.341667, .241667, .158333, .258333) + t (1, -1, 1, -1) of the weight; here the last is 0.
    expected = 9.81 * np.array([0.6, -1 / 60, 5 / 12, 0])
    np.testing.assert_allclose(f, expected, atol=1e-10)


@pytest.mark.parametrize(
    "scene", [table(5), wall(2, 2), random_scene(3, contacts=12)], ids=lambda s: s.name
)
def test_exact_entries(scene):
    a = matrix_by_entries(scene.bodies, scene.contacts)
    np.testing.assert_allclose(
        exact_matrix(scene.bodies, scene.contacts), a, atol=1e-14 * np.abs(a).max()
    )


def test_costs_of_a_table_and_of_a_wall():
    one = matrix_cost(table().bodies, table().contacts)
    assert (one.contacts, one.bodies, one.stored_dense, one.stored_sparse) == (
        4,
        2,
        16,
        16,
    )
    assert (
        one.entries == 30 * 2 * 16
    )  # the table and the floor are in common to all pairs
    assert (
        one.stored_factors == 4 * 3 + 6
    )  # N_z, two lever components a row; 1/m three times, I^-1 diagonal
    assert (
        one.sparse == 4 * 3 + 3 * 16
    )  # M^-1 J' diagonal times J', then three columns of four by rows of four
    scene = wall(4, 4)
    cost, system = matrix_cost(scene.bodies, scene.contacts), scene.system()
    assert cost.stored_sparse == system.A.nnz and cost.sparse < cost.dense / 10


def test_growth_of_the_counts_is_fitted_at_their_end():
    c = {"full": [2.0, 10.0, 100.0, 1000.0]}
    counts = {"full": [7.0, 1e3, 1e6, 1e9]}  # c^3 in the last three
    found = matrix_growth(c, {"full": [1.0, 2.0, 3.0, 4.0]}, counts)
    assert found.exponent["full"] == pytest.approx(3.0)
    assert found.seconds["full"].tolist() == [1.0, 2.0, 3.0, 4.0]
    with pytest.raises(ValueError, match="full: expected at least three"):
        matrix_growth({"full": [1.0, 2.0]}, {"full": [1.0, 2.0]}, {"full": [1.0, 2.0]})
    with pytest.raises(ValueError, match="full"):
        matrix_growth(c, {"full": [1.0]}, counts)
