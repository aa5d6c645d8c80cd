"""What a solver that is called by itself asks of A and b, and the contacts that no force moves."""

import numpy as np
import pytest
from scipy.sparse import csr_array

from course.contact.engine.certificates import certificate
from course.contact.engine.least_distance import solve_nnls
from course.contact.solvers.arguments import (
    dense,
    proof_by_the_unmoved,
    relaxation_of,
    square_system,
)
from course.contact.solvers.pivot import solve_pivot
from course.contact.solvers.projected_gauss_seidel import solve_projected_gauss_seidel
from course.contact.solvers.qp import solve_qp

SOLVERS = (solve_pivot, solve_nnls, solve_projected_gauss_seidel, solve_qp)
each = pytest.mark.parametrize("solver", SOLVERS, ids=lambda s: s.__name__)


@each
@pytest.mark.parametrize(
    "matrix, bias, message",
    [
        (np.ones((2, 3)), [-1.0, 1.0], r"matrix: expected shape \(c, c\)"),
        (np.ones(2), [-1.0, 1.0], r"matrix: expected shape \(c, c\)"),
        (np.eye(2), [-1.0], r"bias: expected shape \(2,\)"),
        (np.eye(2), [-1.0, np.nan], "bias: expected finite"),
        (np.full((2, 2), np.inf), [-1.0, 1.0], "matrix: expected finite"),
    ],
)
def test_every_solver_refuses_in_the_same_words(solver, matrix, bias, message):
    with pytest.raises(ValueError, match=message):
        solver(matrix, bias)


@each
def test_sparse_and_dense_are_solved_alike(solver):
    a, b = np.array([[1.0, 0.5], [0.5, 1.0]]), np.array([-1.0, -1.0])
    dense_one, sparse_one = (solver(m, b) for m in (a, csr_array(a)))
    forces = [
        f[0] if isinstance(f, tuple) else f.force for f in (dense_one, sparse_one)
    ]
    np.testing.assert_allclose(forces, np.full((2, 2), 2 / 3), rtol=1e-7)


def test_sparse_matrices_stay_as_they_are():
    sparse = csr_array(np.array([[2.0, 1.0], [1.0, 2.0]]))
    matrix, bias = square_system(sparse, [1, 2])
    assert matrix is sparse and bias.dtype == np.float64
    np.testing.assert_array_equal(dense(sparse), [[2.0, 1.0], [1.0, 2.0]])
    with pytest.raises(ValueError, match="matrix: expected finite"):
        square_system(csr_array(np.array([[np.nan]])), [1.0])


@pytest.mark.parametrize("value", [0.0, 2.0, -1.0, 2.5])
def test_relaxation_is_between_0_and_2(value):
    with pytest.raises(ValueError, match="above 0 and below 2"):
        relaxation_of(value)
    assert relaxation_of(1.9) == 1.9


def test_what_no_force_moves_is_the_proof_of_every_method():
    a, b = np.diag([1.0, 0.0, 0.0, 2.0]), np.array([-1.0, -3.0, 2.0, 1.0])
    y = proof_by_the_unmoved(a.diagonal(), b)
    np.testing.assert_array_equal(y, [0.0, 1.0, 0.0, 0.0])
    assert not np.any(a @ y) and b @ y == -3.0
    for found in (
        certificate(a, b),
        solve_pivot(a, b).ray,
        solve_nnls(a, b).certificate,
    ):
        np.testing.assert_array_equal(found, y)
    assert proof_by_the_unmoved(a.diagonal(), np.abs(b)) is None
    assert proof_by_the_unmoved(a.diagonal(), np.array([-1.0, 0, 0, -1.0])) is None
