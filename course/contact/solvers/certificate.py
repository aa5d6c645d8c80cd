"""The proof that a contact system has no solution."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, BoolArray

#: |A y| may be this times |A| y: rounding of a sum that is 0.
ZERO = 1e-13
#: b.y must be below this times -|b|.y to be below 0 for certain.
BELOW = 1e-10
#: Supports up to this size are polished by dense linear algebra.
POLISHED = 1500


def certificate(matrix: Any, bias: Array, guess: Array | None = None, *, search: bool = True) -> Array | None:
    """y >= 0 with A y = 0 and b.y < 0, if there is one: then no f >= 0 has A f + b >= 0.

    By Farkas' lemma one of the two exists, but not both (J. Farkas, 1902).
    Forces of a solver that ran away point along y: they are tried first, then
    HiGHS looks for a vertex of y >= 0, A y = 0, b.y = -1. Either is projected
    onto the null space of A on its support and checked.

    Args:
        matrix: A, (c, c), sparse or dense, positive semidefinite.
        bias: b, (c,).
        guess: f >= 0, (c,), of a solver that did not converge.
        search: whether HiGHS may look where the guess proves nothing.
    Returns:
        y, (c,), its largest entry 1, or None.
    """
    diagonal = matrix.diagonal()
    if np.any(bare := (diagonal == 0) & (bias < 0)):
        return np.where(bare, 1.0, 0.0)
    root = np.sqrt(diagonal)
    scale = np.divide(1.0, root, out=np.zeros_like(root), where=root > 0)
    if hasattr(matrix, "tocsr"):
        from scipy.sparse import diags_array

        a = (diags_array(scale) @ matrix @ diags_array(scale)).tocsr()
    else:
        a = matrix * (scale[:, None] * scale)
    b = scale * bias
    if guess is not None and np.any(guess > 0):
        unit = np.asarray(guess) * root
        for least in (1e-9, 1e-4, 1e-2):
            found = _projected(a, b, unit, unit > least * unit.max())
            if found is not None:
                return _largest_one(found * scale)
    found = _vertex(a, b) if search else None
    return None if found is None else _largest_one(found * scale)


def _projected(a: Any, b: Array, y: Array, support: BoolArray) -> Array | None:
    """The nearest null vector of A on the support, if it is a certificate."""
    index = np.flatnonzero(support)
    if not index.size or index.size > POLISHED:
        return None
    part = a[index][:, index]
    part = part.toarray() if hasattr(part, "toarray") else part
    values, axes = np.linalg.eigh(part)
    null = axes[:, values <= 1e-12 * max(float(values[-1]), 0.0) + 1e-300]
    candidate = np.zeros(b.size)
    candidate[index] = null @ (null.T @ y[index])
    candidate[np.abs(candidate) <= 1e-12 * np.abs(candidate).max(initial=0.0)] = 0.0
    return candidate if _proves(a, b, candidate) else None


def _proves(a: Any, b: Array, y: Array) -> bool:
    if not np.all(y >= 0) or not np.any(y):
        return False
    still = np.all(np.abs(a @ y) <= ZERO * len(b) ** 0.5 * (abs(a) @ y) + ZERO * y.max())
    return bool(still and b @ y < -BELOW * (np.abs(b) @ y))


def _vertex(a: Any, b: Array) -> Array | None:
    from scipy.optimize import linprog
    from scipy.sparse import csr_array, vstack

    size = float(np.abs(b).max(initial=0.0))
    if size == 0 or np.all(b >= 0):
        return None
    rows = vstack([csr_array(a), csr_array(b[None] / size)])
    target = np.append(np.zeros(b.size), -1.0)
    options = {"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10}
    found = linprog(np.ones(b.size), A_eq=rows, b_eq=target, method="highs", options=options)
    if found.x is None:
        return None
    y = np.maximum(found.x, 0.0)
    return _projected(a, b, y, y > 1e-9 * y.max(initial=1.0))


def _largest_one(y: Array) -> Array:
    return y / y.max()
