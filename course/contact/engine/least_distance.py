"""Contact forces by least squares for any A and b: non-negative, or of least distance, or the proof of none.

With A = G'G, and b = -G't for some t, non-negative least squares (``solvers.nnls``)
gives the forces. For any other b they come from Lawson and Hanson's least distance
problem, which also shows where no force exists.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, ArrayLike, failure, scalars, written
from course.contact.engine.acceptance import strays
from course.contact.engine.certificates import certificate
from course.contact.engine.refusals import INDEFINITE
from course.contact.solvers.arguments import dense, proof_by_the_unmoved, square_system
from course.contact.solvers.nnls import ACCEPTED, nonnegative_least_squares
from course.contact.solvers.residual import (
    complementarity_residual,
    products,
    violation_of,
)


@dataclass(frozen=True, eq=False)
class NonNegativeSolution:
    """What ``solve_nnls`` found.

    Args:
        force: f >= 0, (c,); zeros where a certificate says that there is none.
        residual: ``complementarity_residual`` of the force.
        certificate: None, or y >= 0, (c,), with A y = 0 and b.y < 0, the proof
            that no force exists.
    """

    force: Array
    residual: float
    certificate: Array | None = None


def solve_nnls(
    matrix: Any, bias: ArrayLike, *, columns: ArrayLike | None = None
) -> NonNegativeSolution:
    """A force f with w = A f + b >= 0, f >= 0, f.w = 0, for symmetric positive semidefinite A.

    With A = G'G, and b = -G't for some t, f is the non-negative least squares
    solution of G f = t. For any other b it is Lawson and Hanson's least
    distance problem (chapter 23, section 4): minimise |E u - e| over u >= 0
    with E = (G; -b'), e = (0, ..., 0, 1). At the minimum f = u / (1 + b.u);
    a zero residual means that no force exists, and u is the proof: A u = 0,
    b.u < 0. f need not be unique; A f is.

    Args:
        matrix: A, (c, c), sparse or dense, symmetric positive semidefinite.
        bias: b, (c,).
        columns: G with G'G = A, (m, c), such as M^-1/2 J'; more accurate than
            the one found from A.
    Returns:
        Force, residual, and the certificate where no force exists.
    Raises:
        ValueError: shapes that do not belong together, A not symmetric or not positive semidefinite.
    """
    a, b = square_system(dense(matrix), bias)
    if not b.size or np.all(b >= 0):
        return NonNegativeSolution(np.zeros(b.shape), 0.0)
    g = _columns(a) if columns is None else scalars("columns", columns)
    if columns is not None and (g.ndim != 2 or g.shape[1] != b.size):
        raise failure("columns", f"shape (m, {b.size})", f"shape {g.shape}")
    target = np.linalg.lstsq(g.T, -b, rcond=None)[0]
    force = _polished(a, b, nonnegative_least_squares(g, target))
    if not _holds(a, b, force):  # there is no t, or A is too nearly singular for it
        other, proof = _least_distance(a, b, g, given=columns is not None)
        if proof is not None:
            zero = np.zeros(b.shape)
            return NonNegativeSolution(
                zero, float(complementarity_residual(a, zero, b)), proof
            )
        other = _polished(a, b, other)
        if _better(a, b, other, force):
            force = other
    return NonNegativeSolution(force, float(complementarity_residual(a, force, b)))


def _holds(a: Array, b: Array, force: Array) -> bool:
    return not _astray(a, b, force) > 0 and not (
        complementarity_residual(a, force, b) > ACCEPTED
    )


def _astray(a: Array, b: Array, force: Array) -> float:
    """The largest |min(D f, w)| if a contact ``strays``, else 0."""
    product, size = products(a, force)
    violation = violation_of(a.diagonal(), product, force, b)
    return float(violation.max()) if np.any(strays(violation, size, b)) else 0.0


def _better(a: Array, b: Array, one: Array, other: Array) -> bool:
    return (_astray(a, b, one), complementarity_residual(a, one, b)) < (
        _astray(a, b, other),
        complementarity_residual(a, other, b),
    )


def _columns(a: Array) -> Array:
    """G with G'G = A, from the eigenvectors; rounding noise below the rank is left out."""
    if np.max(np.abs(a - a.T)) > 1e-9 * np.max(np.abs(a)):
        raise failure(
            "matrix",
            "a symmetric matrix",
            f"asymmetry {written(np.max(np.abs(a - a.T)))}",
        )
    # With a diagonal of ones first, so that noise is small beside every
    # contact, not only beside the one of the lightest bodies.
    size = np.sqrt(np.maximum(np.diagonal(a), 0.0))
    unit = np.divide(
        a, size[:, None] * size, out=np.zeros(a.shape), where=(size[:, None] * size) > 0
    )
    values, axes = np.linalg.eigh(unit)
    off_diagonal = np.abs(a[size == 0]).max(initial=0.0)
    if values[0] < -INDEFINITE or off_diagonal > 0:
        raise failure(
            "matrix",
            "a positive semidefinite matrix",
            f"least eigenvalue {written(np.linalg.eigvalsh(a)[0])}",
        )
    kept = values > a.shape[0] * np.finfo(float).eps * max(values[-1], 0.0)
    return np.sqrt(values[kept])[:, None] * axes[:, kept].T * size


def _least_distance(
    a: Array, b: Array, g: Array, *, given: bool
) -> tuple[Array, Array | None]:
    """Force and None, or zeros and the certificate that none exists; given: whether G is, not found from A."""
    from scipy.sparse import csr_array

    length = np.sqrt(np.sum(g * g, axis=0))
    unmoved = proof_by_the_unmoved(length, b)
    if unmoved is not None:
        return np.zeros(b.shape), unmoved
    scale = 1.0 / np.max(np.abs(b) / np.where(length > 0, length, np.inf))
    end = np.zeros(g.shape[0] + 1)
    end[-1] = 1.0
    for _ in range(4):
        u = nonnegative_least_squares(np.vstack([g, -scale * b]), end)
        s, moved = 1.0 + scale * float(b @ u), g @ u
        if s < 0.5:
            if np.sqrt(np.sum(moved**2)) <= 1e-10 * np.sum(length * u):
                rows = csr_array(g.T) if given else None
                proof = certificate(a, b, u, search=False, rows=rows)
                if proof is not None:
                    return np.zeros(b.shape), proof / np.sum(proof)
            # The same s without the cancellation: |G u|^2 + s^2 = s at the minimum.
            square = min(float(np.sum(moved**2)), 0.25)
            s = 2.0 * square / (1.0 + np.sqrt(1.0 - 4.0 * square))
        if s > 1e-3 or s <= 0:
            break
        scale *= np.sqrt(s)  # the force is large: bring f'A f back to about 1
    return (u / (s * scale) if s > 0 else np.zeros(b.shape)), None


def _polished(a: Array, b: Array, force: Array) -> Array:
    """One more solve on the contacts that push, kept only if it is better."""
    push = np.flatnonzero(force > 0)
    if not push.size:
        return force
    # With a diagonal of ones, so that light and heavy bodies count alike.
    scale = 1 / np.sqrt(a.diagonal()[push])
    block = (a[np.ix_(push, push)] * scale[:, None]) * scale
    missing = -(a[push] @ force + b[push]) * scale
    better = force.copy()
    change = scale * np.linalg.lstsq(block, missing, rcond=None)[0]
    better[push] = np.maximum(force[push] + change, 0.0)
    return better if _better(a, b, better, force) else force
