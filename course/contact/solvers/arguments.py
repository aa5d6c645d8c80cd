"""What the solvers are given: A and b, sparse or dense, and the contacts among them that no force moves."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, ArrayLike, failure, scalar, scalars, shaped, written


def square_system(matrix: Any, bias: ArrayLike) -> tuple[Any, Array]:
    """A, (c, c), sparse as it is or dense, and b, (c,), for a solver that is called by itself.

    ``ContactSystem`` asks more: symmetry, and no diagonal below 0.

    Raises:
        ValueError: shapes that do not belong together, NaN or infinity.
    """
    b = scalars("bias", bias)
    if hasattr(matrix, "tocsr"):
        scalars("matrix", matrix.data)
    else:
        matrix = scalars("matrix", matrix)
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1]:
        raise failure("matrix", "shape (c, c)", f"shape {matrix.shape}")
    shaped("bias", b, matrix.shape[:1])
    return matrix, b


def relaxation_of(value: ArrayLike) -> float:
    """The relaxation of Gauss-Seidel sweeps; ValueError unless it is above 0 and below 2."""
    relaxation = scalar("relaxation", value)
    if not 0 < relaxation < 2:
        raise failure("relaxation", "a number above 0 and below 2", written(relaxation))
    return relaxation


def dense(matrix: Any) -> Array:
    """A matrix as an array, whatever it is stored as."""
    array: Array = matrix.toarray() if hasattr(matrix, "toarray") else matrix
    return array


def proof_by_the_unmoved(diagonal: Array, bias: Array) -> Array | None:
    """y = 1 where a contact that no force moves (a_ii = 0) has b_i < 0, (c,); None where there is none.

    A row of a positive semidefinite A with 0 on its diagonal is 0: A y = 0 and
    b.y < 0, the plainest proof that there are no forces. So it is between two
    fixed bodies.
    """
    unmoved = (diagonal <= 0) & (bias < 0)
    return np.where(unmoved, 1.0, 0.0) if np.any(unmoved) else None
