"""Banded and sparse Cholesky factors against dense ones, on patterns of every kind."""

import numpy as np
import pytest
from scipy.sparse import block_diag, csr_array, diags_array, eye_array, kron

from course.contact.engine.banded_cholesky import BandedCholesky
from course.contact.engine.mass_weighting import mass_weighted_jacobian
from course.contact.engine.regularization import _cheapest
from course.contact.engine.sparse_cholesky import SparseCholesky
from course.scenes import pile, wall

pytestmark = pytest.mark.slow  # with its like, left out of --quick

KINDS = (BandedCholesky, SparseCholesky)


def chain(count):
    return csr_array(
        diags_array(
            [np.ones(count), np.ones(count - 1), np.ones(count - 1)], offsets=[0, 1, -1]
        )
    )


def grid(side):
    line = chain(side)
    return csr_array(kron(line, eye_array(side)) + kron(eye_array(side), line))


def drawn(count, density, seed):
    rng = np.random.default_rng(seed)
    ones = np.eye(count, dtype=bool) | (rng.uniform(size=(count, count)) < density)
    return csr_array((ones | ones.T).astype(float))


def arrow(count):
    """All touch the first: eliminated first it would fill everything."""
    ones = np.eye(count)
    ones[0] = ones[:, 0] = 1.0
    return csr_array(ones)


PATTERNS = {
    "one": csr_array(np.ones((1, 1))), "separate": csr_array(np.eye(40)), "chain": chain(70),
    "full": csr_array(np.ones((30, 30))), "arrow": arrow(50), "grid": grid(13),
    "bodies": csr_array(kron(grid(9), np.ones((6, 6)))),
    "two parts": csr_array(block_diag([chain(20), grid(6), np.ones((4, 4))])),
    **{f"drawn {d}, {s}": drawn(90, d, s) for d in (0.01, 0.05, 0.3) for s in (1, 2)},
}  # fmt: skip


def matrix_on(pattern, rng):
    """Symmetric with these entries, its eigenvalues from 0 up, so that one more makes it definite."""
    dense = np.where(pattern.toarray() != 0, rng.normal(size=pattern.shape), 0.0)
    dense = np.tril(dense) + np.tril(dense, -1).T
    return dense - min(np.linalg.eigvalsh(dense)[0], 0.0) * np.eye(dense.shape[0])


def factored(cholesky, dense):
    """With the entries of this matrix below its diagonal."""
    ordered = dense[np.ix_(cholesky.order, cholesky.order)]
    row, column = np.nonzero(np.tril(ordered))
    cholesky.factor(cholesky.place(row, column), ordered[row, column])


def solved(cholesky, q):
    x = np.empty_like(q)
    x[cholesky.order] = cholesky.solve(q[cholesky.order])
    return x


@pytest.mark.parametrize("kind", KINDS, ids=lambda k: k.__name__)
@pytest.mark.parametrize("name", PATTERNS)
def test_solutions_are_those_of_the_dense_matrix(kind, name):
    pattern = PATTERNS[name]
    cholesky, rng = kind(pattern), np.random.default_rng(3)
    assert np.array_equal(np.sort(cholesky.order), np.arange(pattern.shape[0]))
    assert np.array_equal(cholesky.rank[cholesky.order], np.arange(pattern.shape[0]))
    for _ in range(
        3
    ):  # the same pattern, other numbers: nothing of the last ones is left
        dense, q = matrix_on(pattern, rng), rng.normal(size=pattern.shape[0])
        factored(cholesky, dense)
        expected = np.linalg.solve(dense + np.eye(q.size), q)
        before = q.copy()
        np.testing.assert_allclose(
            solved(cholesky, q), expected, rtol=0, atol=1e-11 * np.abs(expected).max()
        )
        assert np.array_equal(q, before)


@pytest.mark.parametrize("kind", KINDS, ids=lambda k: k.__name__)
def test_a_matrix_that_is_not_positive_definite_raises_and_does_no_lasting_harm(kind):
    pattern = PATTERNS["grid"]
    cholesky, rng = kind(pattern), np.random.default_rng(5)
    dense = matrix_on(pattern, rng)
    with pytest.raises(np.linalg.LinAlgError, match="pivot"):
        factored(cholesky, dense - 5.0 * np.eye(pattern.shape[0]))
    factored(cholesky, dense)
    q = rng.normal(size=pattern.shape[0])
    np.testing.assert_allclose(
        (dense + np.eye(q.size)) @ solved(cholesky, q), q, atol=1e-10
    )


def test_the_panels_hold_no_more_than_it_pays_to():
    """An arrow needs 2 n - 1 numbers, a tridiagonal matrix as many; merging may store some zeros, not n^2."""
    for name in ("arrow", "chain"):
        count = PATTERNS[name].shape[0]
        assert (
            2 * count - 1 <= SparseCholesky(PATTERNS[name]).size <= count * (count + 1)
        )
    heap = pattern_of(pile(700, np.random.default_rng(2)))
    assert SparseCholesky(heap).size < 0.7 * BandedCholesky(heap).size


def pattern_of(scene):
    rows = csr_array(mass_weighted_jacobian(scene.system()))
    rows = rows[:, np.unique(rows.indices)]
    ones = csr_array((np.ones(rows.nnz), rows.indices, rows.indptr), shape=rows.shape)
    return csr_array(ones.T @ ones)


def test_walls_are_factored_banded_and_large_piles_sparse():
    assert isinstance(_cheapest(pattern_of(wall(12, 12))), BandedCholesky)
    assert isinstance(_cheapest(pattern_of(wall(24, 24))), BandedCholesky)
    assert isinstance(
        _cheapest(pattern_of(pile(1000, np.random.default_rng(1)))), SparseCholesky
    )


def test_the_band_begins_at_an_end():
    """A long grid with its rows shuffled: as narrow as it is wide, or nearly."""
    for seed in range(5):
        long = csr_array(kron(chain(40), eye_array(5)) + kron(eye_array(40), chain(5)))
        order = np.random.default_rng(seed).permutation(long.shape[0])
        assert BandedCholesky(long[order][:, order]).width <= 9
