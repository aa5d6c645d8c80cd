"""The lecture's ways to contact forces, one a file: w = A f + b >= 0, f >= 0, f.w = 0, on plain arrays."""

from course.contact.solvers.nnls import nonnegative_least_squares
from course.contact.solvers.residual import complementarity_residual

__all__ = ["complementarity_residual", "nonnegative_least_squares"]
