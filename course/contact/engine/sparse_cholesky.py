"""Cholesky factors of sparse matrices with one pattern and changing numbers, in dense panels.

A minimum degree ordering (J. W.-H. Liu, ACM Transactions on Mathematical
Software 11(2), 1985) keeps L sparse; SuperLU finds it. Columns of L with
nearly the same rows are kept together, a few zeros being stored for it
(C. Ashcraft and R. Grimes, ACM TOMS 15(4), 1989), so that LAPACK works on
dense panels: the columns of such a supernode, on their own rows and on those
below. A factored panel subtracts its products from the later ones at once
(E. Ng and B. Peyton, SIAM Journal on Scientific Computing 14(5), 1993). Where
they go depends on the pattern alone and is found once, which SciPy's own
sparse factors would do for every new set of numbers.

Why by hand: eliminations that go row by row leave BLAS out. QDLDL, and a compiled
up-looking L D L' (T. A. Davis, "Algorithm 849", ACM TOMS 31(4), 2005), take the same
Newton steps, but ``solve`` then takes 1.2 to 1.4 times as long on piles of 840
contacts, where it is as fast as Clarabel, and twice as long on piles of 4,300.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from course.arrays import Array, IntArray

#: About how long a supernode takes in any case, how long a multiplication, and handing a number to a later panel [s].
A_NODE, PANEL_PRODUCT, A_NUMBER = 2e-5, 1e-10, 3e-9


class SparseCholesky:
    """L L' = a symmetric positive definite matrix, one on the diagonal added to it.

    Args:
        pattern: (n, n) sparse and symmetric with its diagonal; only where its entries are counts.
    """

    def __init__(self, pattern: Any) -> None:
        nodes = _supernodes(pattern)
        self.seconds = sum(
            _seconds(node.columns.size, node.rows.size) for node in nodes
        )
        self.order: IntArray = np.concatenate([node.columns for node in nodes])
        self.rank = np.empty_like(self.order)
        self.rank[self.order] = np.arange(self.order.size)
        self._width = np.array([node.columns.size for node in nodes])
        self._first = np.cumsum(self._width) - self._width
        self._node = np.repeat(np.arange(len(nodes)), self._width)
        self._rows = [
            np.concatenate(
                [first + np.arange(node.columns.size), np.sort(self.rank[node.rows])]
            )
            for first, node in zip(self._first, nodes, strict=True)
        ]
        self._height = height = np.array([rows.size for rows in self._rows])
        self._top = np.cumsum(height) - height
        self._start = np.cumsum(height * self._width) - height * self._width
        self._storage = np.zeros(int(np.sum(height * self._width)))
        self._panels: list[_Panel] | None = None

    @property
    def size(self) -> int:
        """How many numbers the storage holds."""
        return self._storage.size

    def place(self, row: Any, column: Any) -> Any:
        """Where an entry on or below the diagonal stands in the storage."""
        count = self.order.size
        keys = np.concatenate([rows + k * count for k, rows in enumerate(self._rows)])
        node = self._node[column]
        down = np.searchsorted(keys, node * count + row) - self._top[node]
        return self._in_panel(node, down, column)

    def _in_panel(self, node: Any, down: Any, column: Any) -> Any:
        """Where an entry of this column, so many rows down its panel, stands: first the square, then what is below."""
        width, across = self._width[node], column - self._first[node]
        square = across * width + down
        below = width * width + across * (self._height[node] - width) + down - width
        return self._start[node] + np.where(down < width, square, below)

    def factor(self, place: Any, values: Array) -> None:
        """Factor the matrix with these values in these places; LinAlgError if it is not positive definite."""
        from scipy.linalg.blas import dsyrk, dtrsm
        from scipy.linalg.lapack import dpotrf

        if self._panels is None:
            self._panels = [self._panel(k) for k in range(self._width.size)]
            self._diagonal = self.place(
                np.arange(self.order.size), np.arange(self.order.size)
            )
        numbers = self._storage
        numbers[:] = 0
        numbers[place] = values
        numbers[self._diagonal] += 1.0
        for panel in self._panels:
            info = dpotrf(panel.square, lower=1, clean=0, overwrite_a=1)[1]
            if info:
                raise np.linalg.LinAlgError(
                    f"not positive definite to rounding at pivot {panel.first + info}"
                )
            if panel.rows.size:
                # From the right: from the left takes twice as long.
                dtrsm(
                    1.0,
                    panel.square,
                    panel.below,
                    side=1,
                    lower=1,
                    trans_a=1,
                    overwrite_b=1,
                )
                products = dsyrk(1.0, panel.below, lower=1)
                numbers[panel.target] -= products.T.ravel()[panel.source]

    def solve(self, q: Array) -> Array:
        """L L' x = q, in this order."""
        from scipy.linalg.blas import dtrsv

        assert self._panels is not None, "factor comes first"
        x = q.copy()
        for panel in self._panels:
            own = x[panel.first : panel.end] = dtrsv(
                panel.square, x[panel.first : panel.end], lower=1
            )
            if panel.rows.size:
                x[panel.rows] -= panel.below @ own
        for panel in reversed(self._panels):
            own = x[panel.first : panel.end]
            if panel.rows.size:
                own = own - x[panel.rows] @ panel.below
            x[panel.first : panel.end] = dtrsv(panel.square, own, lower=1, trans=1)
        return x

    def _panel(self, k: int) -> _Panel:
        first, width, height, start = (
            self._first[k],
            self._width[k],
            self._height[k],
            self._start[k],
        )
        middle, end = start + width * width, start + height * width
        rows, target, source = self._rows[k][width:], [], []
        node, number = self._node[rows], np.arange(rows.size)
        edges = np.append(np.flatnonzero(np.diff(node, prepend=-1)), rows.size)
        # The products with the rows that are columns of one later panel, on and below its diagonal.
        for i, j in pairwise(edges):
            down = np.searchsorted(self._rows[node[i]], rows[i:])[:, None]
            lower = number[i:, None] >= number[i:j]
            target.append(self._in_panel(node[i], down, rows[i:j])[lower])
            source.append((number[i:j] * rows.size + number[i:, None])[lower])
        empty = np.zeros(0, dtype=np.intp)
        return _Panel(
            int(first), int(first + width), rows,
            self._storage[start:middle].reshape(width, width).T,
            self._storage[middle:end].reshape(width, rows.size).T,
            np.concatenate([empty, *target]), np.concatenate([empty, *source]),
        )  # fmt: skip


@dataclass(frozen=True)
class _Panel:
    """Columns ``first`` to ``end`` of L and where its products go; both parts column by column, as LAPACK has them.

    square: (k, k), its lower triangle; below: (m, k); rows: (m,) those of below; source and target: which of the
    (m, m) products are subtracted, and where in the storage.
    """

    first: int
    end: int
    rows: IntArray
    square: Array
    below: Array
    target: IntArray
    source: IntArray


@dataclass(frozen=True)
class _Supernode:
    """Columns kept together, and the rows below them, as the matrix numbers both."""

    columns: IntArray
    rows: IntArray


def _supernodes(pattern: Any) -> list[_Supernode]:
    """In an order in which they can be eliminated."""
    members = _alike(pattern)
    first = np.array([m[0] for m in members])
    order, lower = _eliminated(pattern[first][:, first])
    members = [members[i] for i in order]
    size = np.array([m.size for m in members])
    ahead = np.concatenate([[0], np.cumsum(size[lower.indices])])[lower.indptr]
    some = np.diff(lower.indptr) > 0
    parent = np.full(size.size, -1)
    parent[some] = lower.indices[lower.indptr[:-1][some]]
    kept, parts = _put_together(size.tolist(), np.diff(ahead).tolist(), parent.tolist())
    empty = np.zeros(0, dtype=np.intp)

    def columns(which: Any) -> IntArray:
        return np.concatenate([empty, *(members[i] for i in which)])

    def below(i: int) -> IntArray:
        return columns(lower.indices[lower.indptr[i] : lower.indptr[i + 1]].tolist())

    return [_Supernode(columns(parts[i]), below(i)) for i in kept]


def _alike(pattern: Any) -> list[IntArray]:
    """Groups of columns with the same rows; mostly those of one body."""
    ones = pattern.astype(bool).astype(float)
    ones.sort_indices()
    # Sums of the same numbers in the same order: equal to the last bit where the rows are the same.
    label = ones @ np.random.default_rng(0).random(pattern.shape[0])
    group = np.unique(label, return_inverse=True)[1]
    order = np.argsort(group, kind="stable")
    edges = [0, *(np.flatnonzero(np.diff(group[order])) + 1).tolist(), order.size]
    return [order[i:j] for i, j in pairwise(edges)]


def _eliminated(pattern: Any) -> tuple[IntArray, Any]:
    """A minimum degree order, and in that order the pattern of L below its diagonal, columns sorted."""
    from scipy.sparse import csc_array, diags_array, tril
    from scipy.sparse.linalg import splu

    # Where the diagonal outweighs the rest, all of it negative, nothing cancels and nothing is exchanged.
    matrix = csc_array(pattern, dtype=float)
    matrix.data[:] = -1.0
    matrix = (matrix + diags_array(2.0 + np.diff(matrix.indptr))).tocsc()
    found = splu(
        matrix,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    lower = tril(found.L, -1, format="csc")
    lower.sort_indices()
    return np.argsort(found.perm_c), lower


def _put_together(
    width: list[int], below: list[int], parent: list[int]
) -> tuple[list[int], list[list[int]]]:
    """Columns merged into their parents in the elimination tree wherever one panel is faster than two.

    Which columns stand for a supernode, and for every column those put together with it, itself the last.
    """
    parts, children = [[i] for i in range(len(width))], [list[int]() for _ in width]
    width, kept, seconds = width.copy(), list[int](), [0.0] * len(width)
    for i, above in enumerate(parent):
        seconds[i] = _seconds(width[i], below[i])
        for child in sorted(children[i], key=below.__getitem__, reverse=True):
            together = _seconds(width[child] + width[i], below[i])
            if together <= seconds[child] + seconds[i]:
                width[i] += width[child]
                parts[i] = parts[child] + parts[i]
                seconds[i] = together
            else:
                kept.append(child)
        if above < 0:
            kept.append(i)
        else:
            children[above].append(i)
    return sorted(kept), parts


def _seconds(width: int, below: int) -> float:
    """About how long a panel takes."""
    products = width * (width * width / 3 + below * (width + below))
    return A_NODE + PANEL_PRODUCT * products + A_NUMBER * 0.5 * below * below
