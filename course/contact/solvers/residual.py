"""The residual of the contact conditions (complementarity): how far a force is from solving them; defined once."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, ArrayLike, failure, scalars, shaped


def complementarity_residual(matrix: Any, force: ArrayLike, bias: ArrayLike) -> Array:
    """The residual: scaled violation of w = A f + b >= 0, f >= 0, f.w = 0 (syllabus row 20).

    max_i |min(D_i f_i, w_i)| / ((|A| |f|)_i + max_j |b_j|) with D = diag A:
    each row is judged against its own terms, so that heavy and light bodies
    in one system count alike. It is 0 where there is no contact or b = 0 and
    f = 0.

    Args:
        matrix: A, (..., c, c), or one sparse (c, c).
        force: f, (..., c).
        bias: b, (..., c).
    Returns:
        The residual, (...), without a unit.
    Raises:
        ValueError: shapes that do not belong together, NaN or infinity.
    """
    f, b = scalars("force", force), scalars("bias", bias)
    if hasattr(matrix, "tocsr"):
        count = matrix.shape[0]
        shaped("matrix", matrix, (count, count))
        scalars("matrix", matrix.data)
        shaped("force", f, (count,))
        shaped("bias", b, (count,))
        return residual_of(matrix.diagonal(), *products(matrix, f), f, b)
    a = scalars("matrix", matrix)
    if a.ndim < 2 or a.shape[-1] != a.shape[-2]:
        raise failure("matrix", "shape (..., c, c)", f"shape {a.shape}")
    for name, array in (("force", f), ("bias", b)):
        if array.ndim == 0 or array.shape[-1] != a.shape[-1]:
            raise failure(name, f"shape (..., {a.shape[-1]})", f"shape {array.shape}")
    return residual_of(np.diagonal(a, axis1=-2, axis2=-1), *products(a, f), f, b)


def products(matrix: Any, force: Array) -> tuple[Array, Array]:
    """A f and |A| |f|, (..., c), of one system, sparse or dense, or of a batch; nothing is checked."""
    magnitude = np.abs(force)
    if matrix.ndim == 2 and force.ndim == 1:
        return matrix @ force, abs(matrix) @ magnitude
    return np.einsum("...ij,...j->...i", matrix, force), np.einsum(
        "...ij,...j->...i", abs(matrix), magnitude
    )


def residual_of(
    diagonal: Array, product: Array, size: Array, force: Array, bias: Array
) -> Array:
    """``complementarity_residual`` from D, A f, |A| |f|, f and b; nothing is checked."""
    return np.abs(np.minimum(*scaled_rows(diagonal, product, size, force, bias))).max(
        axis=-1, initial=0.0
    )[()]


def scaled_rows(
    diagonal: Array,
    product: Array,
    size: Array,
    force: Array,
    bias: Array,
    *,
    axis: int = -1,
) -> tuple[Array, Array]:
    """D f and w, each row divided by its scale (0 where that is 0); the residual is max |min of both|.

    From D, A f, |A| |f|, f and b, the contacts along the axis; nothing is checked.
    """
    scale = size + np.abs(bias).max(axis=axis, keepdims=True, initial=0)
    scale = np.where(scale > 0, scale, np.inf)
    return diagonal * force / scale, (product + bias) / scale


def violation_of(diagonal: Array, product: Array, force: Array, bias: Array) -> Array:
    """|min(D f, w)|, (..., c) [m/s^2]: by how much a contact approaches, or parts although it pushes."""
    return np.abs(np.minimum(diagonal * force, product + bias))
