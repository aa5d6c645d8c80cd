"""Contact forces by the quadratic programme (QP) of the lecture's last slide, in CVXPY."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from course.arrays import Array, ArrayLike
from course.contact.solvers.arguments import square_system


def solve_qp(
    matrix: Any,
    bias: ArrayLike,
    *,
    tolerance: float = 1e-10,
    max_iterations: int | None = None,
) -> tuple[Array | None, int]:
    """The quadratic programme: minimise f'A f/2 + b.f subject to f >= 0, by Clarabel through CVXPY.

    The slide's x'Q x/2 + c.x with A x <= b means Q = A_contact, c =
    b_contact, and the constraint -f <= 0 (syllabus row 25, misprint 13). Its
    optimality conditions are A f + b - y = 0 with multipliers y >= 0 and
    y.f = 0: so y = d_ddot, and d_ddot >= 0 and f.d_ddot = 0 come out.

    Args:
        matrix: A, (c, c), sparse or dense, positive semidefinite.
        bias: b, (c,).
        tolerance: the solver's own, for the gap and for feasibility.
        max_iterations: the solver's own, 200 if not given.
    Returns:
        f, (c,), negative by no more than the tolerance, and the solver's
        iterations; None for f where it finds the objective unbounded (no
        force exists) or fails.
    Raises:
        ValueError: shapes that do not belong together, NaN or infinity.
    """
    import cvxpy as cp

    a, b = square_system(matrix, bias)
    f = cp.Variable(b.size)
    objective = cp.Minimize(0.5 * cp.quad_form(f, cp.psd_wrap(a)) + b @ f)
    problem = cp.Problem(objective, [-f <= 0])
    options = dict.fromkeys(("tol_gap_abs", "tol_gap_rel", "tol_feas"), tolerance)
    limit = 200 if max_iterations is None else max_iterations
    try:
        with warnings.catch_warnings():
            warnings.simplefilter(
                "ignore", UserWarning
            )  # "may be inaccurate": the residual says how much
            problem.solve(solver=cp.CLARABEL, max_iter=limit, max_threads=1, **options)
    except cp.error.SolverError:
        return None, limit
    stats = problem.solver_stats
    count = (
        int(stats.num_iters)
        if stats is not None and stats.num_iters is not None
        else limit
    )
    return (None if f.value is None else np.asarray(f.value, dtype=float)), count
