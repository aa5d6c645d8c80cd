"""A plank carried by given forces, against A f + b and the law of the lever."""

from __future__ import annotations

import numpy as np
import pytest

from course import formulas
from course.scenes import GRAVITY, loaded_plank
from course.study.asking import UnusableResult
from course.study.carried_planks import (
    by_entries,
    by_matrix,
    by_response,
    by_solver,
    by_sweeps,
    carried_plank,
    forced,
    printed_entry,
)

TIMES = np.linspace(0.0, 0.3, 31)


@pytest.mark.parametrize("load_at", [-1.5, -0.4, 0.0, 0.75, 1.2])
def test_its_accelerations_are_a_f_plus_b_whatever_the_forces(load_at):
    force = np.random.default_rng(3).uniform(-100, 300, 2)
    plank = carried_plank(load_at, lambda scene: force, TIMES)
    system = loaded_plank(load_at).system()
    np.testing.assert_allclose(
        plank.acceleration, system.A.toarray() @ force + system.b, atol=1e-10
    )
    early = plank.gap[1] / (0.5 * TIMES[1] ** 2)
    np.testing.assert_allclose(early, plank.acceleration, rtol=1e-3, atol=1e-3)


@pytest.mark.parametrize(
    "forces",
    [
        by_solver(formulas.pivot), by_solver(formulas.solve_contact_qp), by_sweeps(formulas.projected_gauss_seidel),
        by_matrix(formulas.contact_matrix), by_entries(formulas.contact_matrix_entry),
        by_response(formulas.point_response),
    ],
)  # fmt: skip
@pytest.mark.parametrize("load_at", [-1.2, 0.3, 1.4])
def test_the_right_forces_let_nothing_sink_in(forces, load_at):
    plank = carried_plank(load_at, forces, TIMES)
    np.testing.assert_allclose(plank.force, loaded_plank(load_at).truth, atol=1e-4)
    assert plank.gap.min() > -1e-6 and plank.force.min() > -1e-5


def test_no_force_is_free_fall_and_the_forced_ones_pull():
    fall = carried_plank(1.2, lambda scene: np.zeros(2), TIMES)
    np.testing.assert_allclose(
        fall.gap, np.tile(-0.5 * GRAVITY * TIMES[:, None] ** 2, 2), atol=1e-12
    )
    pulled = carried_plank(1.2, by_solver(forced), TIMES)
    assert pulled.force.min() < -80 and np.abs(pulled.gap).max() < 1e-9


def test_with_the_printed_bracket_it_sinks_in():
    assert carried_plank(0.3, by_entries(printed_entry), TIMES).gap.min() < -0.1


def test_a_matrix_without_forces_is_said():
    with pytest.raises(UnusableResult, match="a push along N does not part"):
        carried_plank(0.3, by_matrix(lambda c, b: np.zeros((2, 2))), TIMES)
    wild = np.array([[1.0, -5.0], [-5.0, 1.0]])
    with pytest.raises(UnusableResult, match="no forces are found"):
        carried_plank(0.3, by_matrix(lambda c, b: wild), TIMES)
