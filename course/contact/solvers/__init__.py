"""The lecture's ways to contact forces, one a file: w = A f + b >= 0, f >= 0, f.w = 0, on plain arrays.

A method stands here as its source states it, on what its source takes. Where that is A
and b, the file has all of it: ``pivot``, ``projected_gauss_seidel``, ``qp``. Where it is
something else, ``course.contact.engine`` makes that of A and b: G and t for ``nnls``
(``engine.least_distance.solve_nnls``), and for ``gauss`` an elimination, the moment to
stop and the finish (``engine.interior_point.solve_gauss``). None of them decides whether
its answer is to be believed: ``engine.acceptance`` does. ``arguments`` checks what
they are given, ``residual`` defines how far a force is from solving the conditions.
"""

from course.contact.solvers.nnls import nonnegative_least_squares
from course.contact.solvers.residual import complementarity_residual

__all__ = ["complementarity_residual", "nonnegative_least_squares"]
