"""How far a force is from solving the contact conditions; defined once."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike, failure, scalars


def complementarity_residual(matrix: ArrayLike, force: ArrayLike, bias: ArrayLike) -> Array:
    """Scaled violation of w = A f + b >= 0, f >= 0, f.w = 0 (syllabus row 20).

    max_i |min(D_i f_i, w_i)| / ((|A| |f|)_i + max_j |b_j|) with D = diag A:
    each row is judged against its own terms, so that heavy and light bodies
    in one system count alike. It is 0 where there is no contact or b = 0 and
    f = 0.

    Args:
        matrix: A, (..., c, c).
        force: f, (..., c).
        bias: b, (..., c).
    Returns:
        The residual, (...), without a unit.
    Raises:
        ValueError: shapes that do not belong together, NaN or infinity.
    """
    a, f, b = scalars("matrix", matrix), scalars("force", force), scalars("bias", bias)
    if a.ndim < 2 or a.shape[-1] != a.shape[-2]:
        raise failure("matrix", "shape (..., c, c)", f"shape {a.shape}")
    for name, array in (("force", f), ("bias", b)):
        if array.ndim == 0 or array.shape[-1] != a.shape[-1]:
            raise failure(name, f"shape (..., {a.shape[-1]})", f"shape {array.shape}")
    w = np.einsum("...ij,...j->...i", a, f) + b
    diagonal = np.diagonal(a, axis1=-2, axis2=-1)
    scale = np.einsum("...ij,...j->...i", np.abs(a), np.abs(f)) + np.abs(b).max(
        axis=-1, keepdims=True, initial=0
    )
    violation = np.abs(np.minimum(diagonal * f, w))
    ratio = np.divide(violation, scale, out=np.zeros(np.shape(violation)), where=scale > 0)
    return ratio.max(axis=-1, initial=0.0)[()]
