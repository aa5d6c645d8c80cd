"""A stack under forces: Newton's law box by box agrees with A f + b, and with what stands above."""

import numpy as np
import pytest

from course import formulas
from course.scenes import GRAVITY, stack
from course.study.asking import UnusableResult
from course.study.carried_stacks import by_solver, by_sweeps, carried_stack

TIMES = np.linspace(0.0, 0.3, 7)


@pytest.mark.parametrize(("count", "top"), [(2, 1.0), (4, 10.0), (6, 0.1)])
def test_right_forces_carry_all_that_stands_above(count, top):
    right = carried_stack(count, top, TIMES)
    above = [(count - 1 - k) + top for k in range(count)]
    assert right.force == pytest.approx(GRAVITY * np.array(above), rel=1e-12)
    assert right.acceleration == pytest.approx(np.zeros(count), abs=1e-9)
    assert right.height[0] == pytest.approx(0.5 + np.arange(count))


@pytest.mark.parametrize("seed", range(3))
def test_accelerations_are_those_of_A_and_b(seed):
    force = np.random.default_rng(seed).uniform(0.0, 60.0, 5)
    found = carried_stack(5, 3.0, TIMES, lambda a, b: force)
    system = stack(5, mass=np.array([1, 1, 1, 1, 3.0]), corners=1).system()
    assert found.acceleration == pytest.approx(system.A @ force + system.b, abs=1e-9)
    assert found.gap[-1] == pytest.approx(0.5 * 0.3**2 * found.acceleration, abs=1e-9)
    risen = np.diff(found.height - found.height[0], prepend=0.0, axis=1)
    assert risen == pytest.approx(found.gap, abs=1e-12)


@pytest.mark.parametrize(("count", "top"), [(2, 10.0), (6, 10.0), (6, 0.1)])
def test_the_formulas_carry_it(count, top):
    right = carried_stack(count, top, TIMES).force
    for solver in (
        by_solver(formulas.solve_contact_qp),
        by_solver(formulas.pivot),
        by_sweeps(formulas.projected_gauss_seidel),
    ):
        assert carried_stack(count, top, TIMES, solver).force == pytest.approx(
            right, rel=1e-5
        )


def test_what_is_no_force_for_each_contact_is_told():
    with pytest.raises(UnusableResult, match="shape"):
        carried_stack(3, 1.0, TIMES, by_solver(lambda a, b: np.zeros(2)))
