"""Cholesky factors of sparse matrices with one pattern and changing numbers, in LAPACK's band storage.

Orders that go through the graph level by level, reverse Cuthill-McKee among
them (A. George and J. W.-H. Liu, Computer Solution of Large Sparse Positive
Definite Systems, 1981, chapter 4), bring the numbers close to the diagonal.
Best for what is long: stacks, walls, chains.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, IntArray

#: About how long a multiplication takes [s]; narrow bands run at a fraction of that speed, as if wider by so much.
BAND_PRODUCT, WIDER = 4e-11, 30.0


class BandedCholesky:
    """L L' = a symmetric positive definite matrix, one on the diagonal added to it.

    Args:
        pattern: (n, n) sparse and symmetric with its diagonal; only where its entries are counts.
    """

    def __init__(self, pattern: Any) -> None:
        row, column = pattern.nonzero()
        ranked = [(order, np.argsort(order)) for order in _orders(pattern)]
        widths = [
            int(np.max(np.abs(rank[row] - rank[column]), initial=0))
            for _, rank in ranked
        ]
        self.width = min(widths)
        self.order, self.rank = ranked[widths.index(self.width)]
        self.seconds = BAND_PRODUCT * self.order.size * (self.width + WIDER) ** 2
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
            raise np.linalg.LinAlgError(
                f"not positive definite to rounding at pivot {info}"
            )

    def solve(self, q: Array) -> Array:
        """L L' x = q, in this order."""
        from scipy.linalg.lapack import dpbtrs

        return dpbtrs(self._cholesky, q, lower=1)[0]


def _orders(pattern: Any) -> list[IntArray]:
    """Orders to choose from: level by level from either end of the graph, and reverse Cuthill-McKee after that.

    An end is the row reached last from anywhere, or from the other end. SciPy's reverse Cuthill-McKee begins
    anywhere, so that it depends on how the rows come.
    """
    from scipy.sparse.csgraph import breadth_first_order, reverse_cuthill_mckee

    orders, at = [], 0
    for _ in range(3):
        orders.append(breadth_first_order(pattern, at, return_predecessors=False))
        at = orders[-1][-1]
    if orders[0].size < pattern.shape[0]:  # of several pieces
        return [reverse_cuthill_mckee(pattern, symmetric_mode=True).astype(np.intp)]
    levels = orders[-1]
    there = pattern[levels][:, levels]
    orders[0] = levels[reverse_cuthill_mckee(there, symmetric_mode=True)]
    return [order.astype(np.intp) for order in orders]
