"""Cholesky factors of sparse matrices with one pattern and changing numbers, in LAPACK's band storage.

Reverse Cuthill-McKee (A. George and J. W.-H. Liu, Computer Solution of Large
Sparse Positive Definite Systems, 1981) brings the numbers close to the
diagonal. Best for what is long: stacks, walls, chains.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, IntArray

#: About how long a multiplication takes [s]; narrow bands run at a fraction of that speed, as if wider by so much.
A_PRODUCT, WIDER = 4e-11, 30.0


class BandedCholesky:
    """L L' = a symmetric positive definite matrix, one on the diagonal added to it.

    Args:
        pattern: (n, n) sparse and symmetric with its diagonal; only where its entries are counts.
    """

    def __init__(self, pattern: Any) -> None:
        self.order: IntArray = _order(pattern)
        self.rank = np.argsort(self.order)
        row, column = pattern.nonzero()
        self.width = int(np.max(np.abs(self.rank[row] - self.rank[column]), initial=0))
        self.seconds = A_PRODUCT * self.order.size * (self.width + WIDER) ** 2
        self._storage: Array | None = None

    @property
    def size(self) -> int:
        """How many numbers the storage holds."""
        return self.order.size * (self.width + 1)

    def place(self, row: Any, column: Any) -> Any:
        """Where an entry on or below the diagonal stands in the storage."""
        return column.astype(np.int64) * (self.width + 1) + (row - column)

    def factor(self, place: Any, values: Array) -> None:
        """Factor the matrix with these values in these places; LinAlgError if it is not positive definite."""
        from scipy.linalg.lapack import dpbtrf

        if self._storage is None:
            self._storage = np.zeros((self.order.size, self.width + 1))
        storage = self._storage
        storage[:] = 0
        storage.ravel()[place] = values
        storage[:, 0] += 1.0
        self._cholesky, info = dpbtrf(storage.T, lower=1, overwrite_ab=1)
        if info:
            raise np.linalg.LinAlgError(f"not positive definite to rounding at pivot {info}")

    def solve(self, q: Array) -> Array:
        """L L' x = q, in this order."""
        from scipy.linalg.lapack import dpbtrs

        return dpbtrs(self._cholesky, q, lower=1)[0]


def _order(pattern: Any) -> IntArray:
    """Reverse Cuthill-McKee, begun at an end of the graph if it is of one piece; SciPy begins it anywhere."""
    from scipy.sparse.csgraph import breadth_first_order, reverse_cuthill_mckee

    reached = breadth_first_order(pattern, 0, return_predecessors=False)
    if reached.size < pattern.shape[0]:
        return reverse_cuthill_mckee(pattern, symmetric_mode=True).astype(np.intp)
    # The row reached last is at an end, and what is farthest from it at another.
    reached = breadth_first_order(pattern, reached[-1], return_predecessors=False)
    there = pattern[reached][:, reached]
    return reached[reverse_cuthill_mckee(there, symmetric_mode=True)].astype(np.intp)
