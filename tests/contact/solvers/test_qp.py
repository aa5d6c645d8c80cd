"""The lecture's quadratic programme, in CVXPY."""

import subprocess
import sys

import numpy as np

from course.contact.solvers import complementarity_residual
from course.contact.solvers.qp import solve_qp
from course.scenes import stack, table


def test_the_optimality_conditions_come_out():
    system = table().system()
    f, count = solve_qp(system.A, system.b, tolerance=1e-11)
    assert count > 0
    assert complementarity_residual(system.A, np.maximum(f, 0), system.b) < 1e-9


def test_dense_and_sparse_are_the_same_programme():
    system = stack(4).system()
    sparse, _ = solve_qp(system.A, system.b)
    dense, _ = solve_qp(system.A.toarray(), system.b)
    np.testing.assert_allclose(system.A @ sparse, system.A @ dense, atol=1e-7)


def test_an_unbounded_programme_has_no_force():
    f, _ = solve_qp(np.array([[1.0, -1], [-1, 1]]), np.array([-1.0, -1]))
    assert f is None


def test_cvxpy_is_loaded_when_called_only():
    code = "import sys, course.contact; assert 'cvxpy' not in sys.modules and 'scipy' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
