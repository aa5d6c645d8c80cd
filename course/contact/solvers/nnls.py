"""Non-negative least squares, whose optimality conditions are those of contact.

minimise |G f - t|^2 over f >= 0 asks for w = G'(G f - t) >= 0, f >= 0, f.w = 0: the
contact conditions with A = G'G and b = -G't. ``engine.least_distance`` brings it any A
and b (``solve_nnls``): it finds G and t, or the proof that there is no force.

SciPy's ``nnls`` does the work; what it returns is checked here, because some
releases were known to stop early or to report a zero residual for a point
that is not the minimum (scipy issues 20302, 21140, 25389).
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike, failure, scalars, shaped

#: Optimality residual above which SciPy's answer is not taken.
ACCEPTED = 1e-10


def nonnegative_least_squares(columns: ArrayLike, target: ArrayLike) -> Array:
    """The x >= 0 that brings G x closest to t.

    minimise |G x - t|^2 with x >= 0 (C. L. Lawson and R. J. Hanson, Solving
    Least Squares Problems, 1995, chapter 23). Its optimality conditions are
    those of contact with A = G'G and b = -G't (syllabus rows 20 and 25).

    Args:
        columns: G, (m, c).
        target: t, (m,).
    Returns:
        x, (c,).
    Raises:
        ValueError: shapes that do not belong together, NaN or infinity.
    """
    from scipy.optimize import nnls

    g, t = scalars("columns", columns), scalars("target", target)
    if g.ndim != 2:
        raise failure("columns", "shape (m, c)", f"shape {g.shape}")
    shaped("target", t, g.shape[:1])
    length = np.sqrt(np.sum(g * g, axis=0))
    used = length > 0
    x = np.zeros(g.shape[1])
    if not np.any(used) or not np.any(t):
        return x
    # Columns of unit length: Lawson and Hanson's choice of the next column,
    # and every tolerance inside, then do not depend on masses.
    unit, size = g[:, used] / length[used], np.sqrt(np.sum(t * t))
    try:
        found = nnls(unit, t / size, maxiter=30 * unit.shape[1])[0]
    except RuntimeError:
        found = None
    if found is None or not _off_optimum(unit, t / size, found) <= ACCEPTED:
        found = _bounded(unit, t / size, found)
    x[used] = found * size / length[used]
    return x


def _off_optimum(columns: Array, target: Array, x: Array) -> float:
    """Residual of the optimality conditions x >= 0, w = G'(G x - t) >= 0, x.w = 0."""
    gradient = columns.T @ (columns @ x - target)
    return float(np.max(np.abs(np.minimum(x, gradient)) / (1.0 + np.max(x))))


def _bounded(columns: Array, target: Array, first: Array | None) -> Array:
    """SciPy's other solver for the same problem, where its nnls has failed; the better of the two."""
    from scipy.optimize import lsq_linear

    other = np.maximum(
        lsq_linear(columns, target, bounds=(0, np.inf), method="bvls", tol=1e-15).x, 0.0
    )
    if first is None or _off_optimum(columns, target, other) < _off_optimum(
        columns, target, first
    ):
        return other
    return first
