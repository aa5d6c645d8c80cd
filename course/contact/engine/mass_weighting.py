"""Mass weighting: from J and M^-1 to J M^-1/2, the rows whose products are the entries of A."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import failure

#: Entries below this times the largest of their row are rounding.
NEGLIGIBLE = 1e-15


def mass_weighted_jacobian(system: Any) -> Any:
    """J M^-1/2, sparse (c, 6n), G' with A = G'G, from the system's jacobian and inverse mass; None where it has none.

    Args:
        system: a ``ContactSystem``; its inverse mass consists of 6 x 6
            blocks, each positive definite or, for a fixed body, zero.
    Raises:
        ValueError: another inverse mass.
    """
    from scipy.sparse import csr_array

    if system.jacobian is None:
        return None
    entries = csr_array(system.inverse_mass).tocoo()
    n = system.inverse_mass.shape[0] // 6
    if np.any(entries.row // 6 != entries.col // 6):
        raise failure(
            "system.inverse_mass",
            "blocks of 6 x 6, body by body",
            "entries between two bodies",
        )
    blocks = np.zeros((n, 6, 6))
    np.add.at(
        blocks, (entries.row // 6, entries.row % 6, entries.col % 6), entries.data
    )
    root, free = np.zeros_like(blocks), np.einsum("nii->ni", blocks).any(axis=1)
    try:
        root[free] = np.linalg.cholesky(blocks[free])
    except np.linalg.LinAlgError:
        raise failure(
            "system.inverse_mass",
            "positive definite blocks, or zero for a fixed body",
            "another",
        ) from None
    body, row, column = np.nonzero(root)
    sparse_root = csr_array(
        (root[body, row, column], (6 * body + row, 6 * body + column)),
        shape=(6 * n, 6 * n),
    )
    return _without_rounding(csr_array(csr_array(system.jacobian) @ sparse_root))


def _without_rounding(rows: Any) -> Any:
    """A sparse matrix without the entries that are rounding beside the largest of their row."""
    if rows.nnz:
        sizes = np.append(np.abs(rows.data), 0.0)
        largest = np.maximum.reduceat(sizes, rows.indptr[:-1])
        row_by_row = np.repeat(largest, np.diff(rows.indptr))
        rows.data[np.abs(rows.data) <= NEGLIGIBLE * row_by_row] = 0.0
        rows.eliminate_zeros()
    return rows
