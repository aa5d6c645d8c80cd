"""Regularization: (A + diag(1/theta)) x = q solved again and again for changing theta, by the cheapest elimination.

Both Newton's method on the contact conditions and the solution on a guessed
set of pushing contacts need it: theta_i is large where contact i pushes and
0 where it does not (x_i is 0 then). With T = diag(sqrt(theta)):

by forces         x = T (1 + T A T)^-1 T q, Cholesky of a c x c matrix;
by accelerations  A = G'G, x = theta (q - G'y), (1 + G theta G') y = G theta q,
                  Cholesky of a matrix as large as the bodies' degrees of
                  freedom: Gauss' view, and the better one where many contacts
                  share few bodies.

A is brought to a diagonal of ones first, so that heavy and light bodies count
alike. The matrix is factored dense, banded or, where the band is wide, sparse.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, Protocol

import numpy as np

from course.arrays import Array, IntArray
from course.contact.engine.banded_cholesky import BandedCholesky
from course.contact.engine.sparse_cholesky import SparseCholesky
from course.contact.solvers.arguments import dense

#: Below this many contacts a dense matrix is always the cheapest.
ALWAYS_DENSE = 96
#: About how long a multiplication takes in a dense factor [s].
DENSE_PRODUCT = 4e-11
#: A factor that takes less than this is not worth the search for a better one [s].
QUICK = 3e-3
#: Up to so many entries a row of A the elimination by forces is tried first: the bodies have few contacts each.
FEW_ENTRIES = 12


class RegularizedSystem(Protocol):
    """What the solvers ask of a matrix A with a diagonal of ones."""

    def times(self, x: Array) -> Array:
        """A x."""
        ...

    def factor(self, theta: Array) -> None:
        """Prepare ``solve`` for this theta >= 0; LinAlgError where rounding makes that impossible."""
        ...

    def solve(self, q: Array) -> Array:
        """x with (A + diag(1/theta)) x = q, x_i = 0 where theta_i = 0."""
        ...


class Cholesky(Protocol):
    """What they ask of the factors of a sparse matrix with one pattern, one on the diagonal added to it."""

    #: How the rows are ordered, and for each the place it gets; about how long a factor takes [s].
    order: IntArray
    rank: IntArray
    seconds: float

    @property
    def size(self) -> int:
        """How many numbers the storage holds."""
        ...

    def place(self, row: Any, column: Any) -> Any:
        """Where an entry on or below the diagonal stands in the storage, row and column as ordered."""
        ...

    def factor(self, place: Any, values: Array) -> None:
        """Factor the matrix with these values in these places; LinAlgError if it is not positive definite."""
        ...

    def solve(self, q: Array) -> Array:
        """x for the right-hand side q, both as ordered."""
        ...


def regularized(
    matrix: Any, rows: Callable[[], Any] | None = None
) -> RegularizedSystem:
    """The cheapest way for this A, (c, c) sparse or dense with a diagonal of ones; the first that is quick enough.

    Args:
        matrix: A.
        rows: None, or what gives G', (c, m) sparse, with A = G'G, if it is needed.
    """
    from scipy.sparse import csr_array, issparse

    count = matrix.shape[0]
    whole = partial(_dense, matrix)
    if count <= ALWAYS_DENSE:
        return whole()
    ways: list[Callable[[], tuple[float, Callable[[], RegularizedSystem]]]] = []
    if issparse(matrix):
        ways.append(partial(_by_forces, csr_array(matrix), known=rows is not None))
    if rows is not None:
        few = issparse(matrix) and matrix.nnz <= FEW_ENTRIES * count
        ways.insert(len(ways) if few else 0, partial(_by_accelerations, rows))
    best: tuple[float, Callable[[], RegularizedSystem]] = (
        DENSE_PRODUCT * count**3 / 3,
        whole,
    )
    for way in ways:
        best = min(best, way(), key=lambda one: one[0])
        if best[0] < QUICK:
            break
    return best[1]()


def _dense(matrix: Any) -> RegularizedSystem:
    return RegularizedDense(dense(matrix))


def _by_forces(
    matrix: Any, *, known: bool
) -> tuple[float, Callable[[], RegularizedSystem]]:
    # The graph of contacts is denser than that of bodies: no search for a sparse factor where the other is known.
    contacts = BandedCholesky(matrix) if known else _cheapest(matrix)
    return contacts.seconds, partial(RegularizedByForces, matrix, contacts)


def _by_accelerations(
    given: Callable[[], Any],
) -> tuple[float, Callable[[], RegularizedSystem]]:
    from scipy.sparse import csr_array

    rows = _without_empty_columns(csr_array(given()))
    ones = csr_array((np.ones(rows.nnz), rows.indices, rows.indptr), shape=rows.shape)
    bodies = _cheapest((ones.T @ ones).tocsr())
    return bodies.seconds, partial(RegularizedByAccelerations, rows, bodies)


def _cheapest(pattern: Any) -> Cholesky:
    banded = BandedCholesky(pattern)
    if banded.seconds < QUICK:
        return banded
    sparse = SparseCholesky(pattern)
    return sparse if sparse.seconds < banded.seconds else banded


def _without_empty_columns(rows: Any) -> Any:
    from scipy.sparse import csr_array

    used = np.zeros(rows.shape[1], dtype=bool)
    used[rows.indices] = True
    number = np.cumsum(used) - 1
    return csr_array(
        (rows.data, number[rows.indices], rows.indptr),
        shape=(rows.shape[0], int(used.sum())),
    )


class RegularizedDense:
    """By forces, A dense."""

    def __init__(self, matrix: Array) -> None:
        self._matrix = matrix

    def times(self, x: Array) -> Array:
        return self._matrix @ x

    def factor(self, theta: Array) -> None:
        from scipy.linalg.lapack import dpotrf

        self._used = np.flatnonzero(theta)
        self._root = np.sqrt(theta[self._used])
        small = self._matrix[np.ix_(self._used, self._used)] * (
            self._root[:, None] * self._root
        )
        small[np.diag_indices_from(small)] += 1.0
        self._cholesky, info = dpotrf(small.T, lower=1, overwrite_a=1, clean=0)
        _check(info)

    def solve(self, q: Array) -> Array:
        from scipy.linalg.lapack import dpotrs

        x = np.zeros(q.size)
        if self._used.size:
            x[self._used] = (
                self._root
                * dpotrs(self._cholesky, self._root * q[self._used], lower=1)[0]
            )
        return x


class RegularizedByForces:
    """By forces, A sparse."""

    def __init__(self, matrix: Any, cholesky: Cholesky) -> None:
        from scipy.sparse import csr_array

        self._matrix, self._cholesky = csr_array(matrix), cholesky
        entries = self._matrix.tocoo()
        row, column = cholesky.rank[entries.row], cholesky.rank[entries.col]
        lower = row >= column
        self._row, self._column, self._value = (
            row[lower],
            column[lower],
            entries.data[lower],
        )
        self._place = cholesky.place(self._row, self._column)

    def times(self, x: Array) -> Array:
        return self._matrix @ x

    def factor(self, theta: Array) -> None:
        self._root = np.sqrt(theta[self._cholesky.order])
        values = self._value * self._root[self._row] * self._root[self._column]
        self._cholesky.factor(self._place, values)

    def solve(self, q: Array) -> Array:
        x = np.empty(q.size)
        x[self._cholesky.order] = self._root * self._cholesky.solve(
            self._root * q[self._cholesky.order]
        )
        return x


class RegularizedByAccelerations:
    """By accelerations, G' (c, m) sparse."""

    def __init__(self, rows: Any, cholesky: Cholesky) -> None:
        from scipy.sparse import csr_array

        self._rows = csr_array(
            (rows.data.copy(), cholesky.rank[rows.indices], rows.indptr.copy()),
            shape=rows.shape,
        )
        self._rows.sort_indices()
        self._columns = csr_array(self._rows.T)
        self._cholesky = cholesky
        # Every contact adds theta_i g_i g_i'. All those products, and where
        # they go, are the same for every theta: one sparse matrix times theta.
        begin = self._rows.indptr[:-1]
        contact = np.repeat(np.arange(begin.size), np.diff(self._rows.indptr))
        pairs = (
            np.arange(1, contact.size + 1) - begin[contact]
        )  # an entry with those before it in its row, and itself
        first = np.repeat(np.arange(contact.size), pairs)
        second = (
            np.arange(first.size)
            - np.repeat(np.cumsum(pairs) - pairs, pairs)
            + begin[contact[first]]
        )
        place = cholesky.place(self._rows.indices[first], self._rows.indices[second])
        products = self._rows.data[first] * self._rows.data[second]
        used = np.zeros(cholesky.size, dtype=bool)
        used[place] = True
        self._place = np.flatnonzero(used)
        number = np.empty(cholesky.size, dtype=np.intp)
        number[self._place] = np.arange(self._place.size)
        shape = (self._place.size, begin.size)
        self._products = csr_array(
            (products, (number[place], contact[first])), shape=shape
        )

    def times(self, x: Array) -> Array:
        return self._rows @ (self._columns @ x)

    def factor(self, theta: Array) -> None:
        self._theta = theta
        self._cholesky.factor(self._place, self._products @ theta)

    def solve(self, q: Array) -> Array:
        pushed = self._theta * q
        return pushed - self._theta * (
            self._rows @ self._cholesky.solve(self._columns @ pushed)
        )


def _check(info: int) -> None:
    if info:
        raise np.linalg.LinAlgError(
            f"not positive definite to rounding at pivot {info}"
        )
