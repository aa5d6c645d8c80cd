"""Certificates: Farkas' proof that a contact system has no solution."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray
from course.contact.solvers.arguments import dense, proof_by_the_unmoved

#: |R y| may be this times |R| y, R = J M^-1/2 or A, as it is computed: rounding of a sum that is 0.
ZERO = 1e-13
#: |A y| may be this times |A| y, with no rounding of the product: A's own, one unit in the last place.
OWN = np.finfo(float).eps
#: The same as it is computed, where there are too many contacts to do without rounding.
OWN_COMPUTED = 8 * OWN
#: Up to how many contacts A y is formed without rounding.
UNROUNDED = 150
#: Singular values below this times the largest are rounding, or too near to it to tell.
NULL = 1e-12
#: b.y must be below this times -|b|.y to be below 0 for certain.
BELOW = 1e-10
#: Supports up to this size are projected by dense linear algebra.
SVD_UP_TO = 300
#: Up to how many contacts HiGHS may look through A alone, or J M^-1/2: it can take minutes beyond.
SEARCHED, SEARCHED_WITH_ROWS = 500, 3000
#: How often a y with entries below 0 is projected once more without them.
DROPS = 4


def certificate(
    matrix: Any,
    bias: Array,
    guess: Array | None = None,
    *,
    search: bool = True,
    rows: Any = None,
) -> Array | None:
    """y >= 0 with A y = 0 and b.y < 0, if there is one: then no f >= 0 has A f + b >= 0.

    By Farkas' lemma one of the two exists, but not both (J. Farkas, 1902).
    Zero means to A's own rounding: |A y| <= eps |A| y, for a y as near as can
    be. Then entries that differ from A's by a unit in the last place prove
    that there is no force (W. Oettli and W. Prager, Numerische Mathematik 6,
    1964), and one for A as it is stored would be about b / eps.
    Forces of a solver that ran away point along y: they are tried first, then
    HiGHS looks for a vertex of y >= 0, A y = 0, b.y = -1. Either is projected
    onto the null space of A on its support and checked.

    Args:
        matrix: A, (c, c), sparse or dense, positive semidefinite.
        bias: b, (c,).
        guess: f >= 0, (c,), of a solver that did not converge.
        search: whether HiGHS may look where the guess proves nothing.
        rows: None, or G', sparse (c, m) with A = G'G, such as J M^-1/2. It has the null
            space of A, but its singular values are the roots of A's: what is small
            yet not null stands out where it drowns in A's rounding; and HiGHS is many
            times faster.
    Returns:
        y, (c,), its largest entry 1, or None.
    """
    from scipy.sparse import csr_array

    diagonal = matrix.diagonal()
    unmoved = proof_by_the_unmoved(diagonal, bias)
    if unmoved is not None:
        return unmoved
    root = np.sqrt(diagonal)
    scale = np.divide(1.0, root, out=np.zeros_like(root), where=root > 0)
    if rows is not None:
        r = csr_array(_scaled(csr_array(rows), scale).T)
        r = r[np.flatnonzero(np.diff(r.indptr))]
    else:
        r = _scaled(csr_array(matrix), scale)
        r.data *= scale[r.indices]
    b = scale * bias
    if guess is not None and np.any(guess > 0):
        unit = np.asarray(guess) * root
        for least in (1e-9, 1e-4, 1e-2):
            found = _projected(r, b, unit, unit > least * unit.max())
            if found is not None and rows is None:
                found = _of_stored(matrix, found * scale)
            if found is not None:
                return _largest_one(found * (scale if rows is not None else 1.0))
    most = SEARCHED if rows is None else SEARCHED_WITH_ROWS
    found = _vertex(r, b) if search and b.size <= most else None
    if found is not None:
        found = found * scale
        found = found if rows is not None else _of_stored(matrix, found)
    return None if found is None else _largest_one(found)


def _scaled(rows: Any, scale: Array) -> Any:
    """A copy with its rows multiplied."""
    scaled = rows.copy()
    scaled.data = rows.data * np.repeat(scale, np.diff(rows.indptr))
    return scaled


def _projected(rows: Any, b: Array, y: Array, support: BoolArray) -> Array | None:
    """The nearest null vector of R on the support, or on a smaller one, if it is a certificate."""
    for _ in range(DROPS):
        index = np.flatnonzero(support)
        if not index.size:
            return None
        part = rows[:, index]
        part = part[np.flatnonzero(np.diff(part.indptr))]
        candidate = np.zeros(b.size)
        candidate[index] = _null_part(part, y[index] / y[index].max())
        candidate[np.abs(candidate) <= 1e-12 * np.abs(candidate).max(initial=0.0)] = 0.0
        if _proves(rows, b, candidate):
            return candidate
        if np.all(candidate >= 0):
            return None
        support = candidate > 0
    return None


def _null_part(rows: Any, y: Array) -> Array:
    """The null vector of R nearest to y."""
    from scipy.linalg import svd
    from scipy.sparse.linalg import lsmr

    if y.size > SVD_UP_TO:
        for _ in range(2):
            change = lsmr(
                rows, rows @ y, atol=1e-15, btol=1e-15, conlim=0, maxiter=4000
            )[0]
            y = y - change
        return y
    if not rows.nnz:
        return y
    _, values, axes = svd(rows.toarray())
    null = axes[np.count_nonzero(values > NULL * values[0]) :]
    return null.T @ (null @ y)


def _proves(rows: Any, b: Array, y: Array) -> bool:
    if not np.all(y >= 0) or not np.any(y):
        return False
    still = np.all(
        np.abs(rows @ y) <= ZERO * len(b) ** 0.5 * (abs(rows) @ y) + ZERO * y.max()
    )
    return bool(still and b @ y < -BELOW * (np.abs(b) @ y))


def _of_stored(matrix: Any, y: Array) -> Array | None:
    """The y nearest to this one for which A y is least, if it is 0 to A's own rounding.

    The product is formed without rounding, and what y's own rounding adds to
    it is taken off by one step of least squares, y - A^+ (A y).
    """
    index = np.flatnonzero(y)
    # Powers of two that bring the diagonal near 1 change no rounding.
    power = np.frexp(matrix.diagonal())[1] // 2
    a = matrix[:, index]
    a = np.ldexp(dense(a), -power[:, None] - power[index])
    unit = np.ldexp(y, power)[index]
    if y.size > UNROUNDED:
        product, size = a @ unit, abs(a) @ unit
        small = np.abs(product) <= OWN_COMPUTED * (size + unit.max())
        return y if np.all(small) else None
    columns = [[Fraction(x) for x in row] for row in a.tolist()]
    nearest = [Fraction(x) for x in unit.tolist()]
    left, values, right = np.linalg.svd(a, full_matrices=False)
    seen = values > NULL * values[0]
    missing = np.array([float(one) for one in _times(columns, nearest)])
    step = right[seen].T @ ((left[:, seen].T @ missing) / values[seen])
    nearest = [x - Fraction(d) for x, d in zip(nearest, step.tolist(), strict=True)]
    size = [[abs(x) for x in row] for row in columns]
    terms = zip(_times(columns, nearest), _times(size, nearest), strict=True)
    if min(nearest) < 0 or any(abs(one) > OWN * most for one, most in terms):
        return None
    sharp = np.zeros(y.size)
    sharp[index] = [float(x) for x in nearest]
    return np.ldexp(sharp, -power)


def _times(rows: list[list[Fraction]], x: list[Fraction]) -> list[Fraction]:
    return [
        sum((a * b for a, b in zip(row, x, strict=True) if a), Fraction(0))
        for row in rows
    ]


def _vertex(rows: Any, b: Array) -> Array | None:
    from scipy.optimize import linprog
    from scipy.sparse import csr_array, vstack

    size = float(np.abs(b).max(initial=0.0))
    if size == 0 or np.all(b >= 0):
        return None
    every = vstack([rows, csr_array(b[None] / size)])
    target = np.append(np.zeros(rows.shape[0]), -1.0)
    options = {
        "primal_feasibility_tolerance": 1e-10,
        "dual_feasibility_tolerance": 1e-10,
    }
    found = linprog(
        np.ones(b.size), A_eq=every, b_eq=target, method="highs", options=options
    )
    if found.x is None:
        return None
    y = np.maximum(found.x, 0.0)
    return _projected(rows, b, y, y > 1e-9 * y.max(initial=1.0))


def _largest_one(y: Array) -> Array:
    return y / y.max()
