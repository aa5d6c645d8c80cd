"""Solvers of the contact conditions w = A f + b >= 0, f >= 0, f.w = 0, on plain arrays."""

from course.contact.solvers.nnls import (
    NonNegativeSolution,
    nonnegative_least_squares,
    solve_nnls,
)
from course.contact.solvers.residual import complementarity_residual

__all__ = [
    "NonNegativeSolution",
    "complementarity_residual",
    "nonnegative_least_squares",
    "solve_nnls",
]
