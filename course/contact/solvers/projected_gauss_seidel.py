"""Contact forces by sweeping over the contacts, and how fast that converges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    IntArray,
    failure,
    scalar,
    scalars,
    shaped,
    whole_number,
    written,
)
from course.contact.solvers.residual import scaled_rows

#: Up to this many contacts the rows of a colour are kept dense.
DENSE = 400


@dataclass(frozen=True)
class Swept:
    """Force f >= 0, (c,), its residual, and how many sweeps it took."""

    force: Array
    residual: float
    sweeps: int


def solve_projected_gauss_seidel(
    matrix: Any,
    bias: ArrayLike,
    *,
    tolerance: float = 1e-10,
    max_sweeps: int = 10_000,
    relaxation: float = 1.0,
    start: ArrayLike | None = None,
) -> Swept:
    """Give each contact in turn the force that makes its own w = 0, but never one below 0.

    f_i <- max(0, f_i - relaxation w_i / a_ii). What is limited is the
    accumulated force, not its change: clipping changes instead answers
    (1, .5) on A = [[1, .5], [.5, 1]], b = (-1, -1), where (2/3, 2/3) is right.
    (R. W. Cottle, J.-S. Pang, R. E. Stone, The Linear Complementarity Problem,
    1992, section 5.2; converges for 0 < relaxation < 2.)

    Contacts are taken by colours: those of one colour share no entry of A, so
    that moving all of them at once is the same as one after the other
    (``sweep_order``).

    Args:
        matrix: A, (c, c), sparse or dense, positive semidefinite.
        bias: b, (c,).
        tolerance: residual at which it stops.
        max_sweeps: how often all contacts are gone through at most.
        relaxation: above 0, below 2; over 1 looks ahead.
        start: forces to begin with, (c,); negative ones count as 0. The
            last moment's forces are a good guess for the next.
    Returns:
        The last force, its residual and the sweeps done.
    Raises:
        ValueError: relaxation outside 0..2, shapes that do not belong together.
    """
    b = scalars("bias", bias)
    factor = scalar("relaxation", relaxation)
    if not 0 < factor < 2:
        raise failure("relaxation", "a number above 0 and below 2", written(factor))
    whole_number("max_sweeps", max_sweeps)
    f = np.zeros(b.size) if start is None else np.maximum(scalars("start", start), 0.0)
    shaped("start", f, b.shape)
    system = _Sweeps(matrix, b)
    f = np.where(system.diagonal > 0, f, 0.0)
    sweep, check = 0, 0
    while True:
        if sweep == check:
            residual = system.residual(f)
            # Looking costs as much as a sweep, so it is done ever more rarely.
            check = min(sweep + 1 + sweep // 10, max_sweeps)
            if residual <= tolerance or sweep >= max_sweeps:
                return Swept(f, residual, sweep)
        f = system.swept(f, factor)
        sweep += 1


class _Sweeps:
    """A system with its rows sorted by colour."""

    def __init__(self, matrix: Any, bias: Array) -> None:
        from scipy.sparse import csr_array, issparse

        self.matrix: Any = (
            csr_array(matrix) if issparse(matrix) else scalars("matrix", matrix)
        )
        self.bias, self.diagonal = bias, self.matrix.diagonal()
        self._magnitude = abs(self.matrix)
        self._colours = []
        for rows in sweep_order(self.matrix):
            rows = rows[self.diagonal[rows] > 0]
            part: Any = self.matrix[rows]
            if issparse(part) and bias.size <= DENSE:
                part = part.toarray()
            self._colours.append((rows, part, bias[rows], 1.0 / self.diagonal[rows]))

    def swept(self, force: Array, relaxation: float) -> Array:
        f = force.copy()
        for rows, part, b, inverse in self._colours:
            f[rows] = np.maximum(f[rows] - relaxation * inverse * (part @ f + b), 0.0)
        return f

    def residual(self, f: Array) -> float:
        rows = scaled_rows(
            self.diagonal, self.matrix @ f, self._magnitude @ f, f, self.bias
        )
        return float(np.abs(np.minimum(*rows)).max(initial=0.0))


def sweep_order(matrix: Any) -> list[IntArray]:
    """The contacts by colours, in the order in which a sweep takes them.

    Greedy: each contact takes the first colour that none of those coupled to
    it has. Two contacts of one colour have a_ij = 0.

    Args:
        matrix: A, (c, c), sparse or dense.
    """
    from scipy.sparse import csr_array

    rows = csr_array(matrix)
    start, neighbours = rows.indptr.tolist(), rows.indices.tolist()
    colour = [-1] * rows.shape[0]
    for i in range(rows.shape[0]):
        taken = {colour[j] for j in neighbours[start[i] : start[i + 1]]}
        k = 0
        while k in taken:
            k += 1
        colour[i] = k
    colours = np.array(colour, dtype=np.intp)
    return [np.flatnonzero(colours == k) for k in range(colours.max(initial=-1) + 1)]


def predicted_gauss_seidel_factor(matrix: Any, *, relaxation: float = 1.0) -> float:
    """By what factor a sweep brings the forces closer to the solution in the end, where all contacts push.

    The largest |eigenvalue| of (D/r + L)^-1 ((1/r - 1) D - L'), A = L + D +
    L' in the order of the sweep (Cottle, Pang and Stone, section 5.2; D. M.
    Young, Iterative Solution of Large Linear Systems, 1971). Where A is
    singular its null vectors have the eigenvalue 1 and are left out: what they
    change no acceleration sees. Contacts that do not push are to be left out
    of A first.

    For a stack of n boxes with one contact an interface it is
    cos^2(pi / 2n); for a box on one that is R times lighter, R/(1 + R).

    Args:
        matrix: A of the contacts that push, (c, c), sparse or dense; its
            eigenvalues are computed, so c should not exceed about 1,000.
        relaxation: r, above 0, below 2.
    Returns:
        The factor; below 1 it converges.
    """
    from scipy.linalg import eigvals, eigvalsh, solve_triangular

    a = matrix.toarray() if hasattr(matrix, "toarray") else scalars("matrix", matrix)
    if not a.size:
        return 0.0
    order = np.concatenate(sweep_order(a))
    root = np.sqrt(a.diagonal())[order]
    a = a[np.ix_(order, order)] / (root[:, None] * root)
    nullity = int(np.count_nonzero(eigvalsh(a) < 1e-12 * len(a)))
    lower = np.tril(a, -1) + np.eye(len(a)) / relaxation
    values = eigvals(solve_triangular(lower, lower - a, lower=True))
    values = values[np.argsort(np.abs(values - 1))][nullity:]
    return float(np.abs(values).max(initial=0.0))


def measured_gauss_seidel_factor(
    matrix: Any, bias: ArrayLike, *, sweeps: int = 200, relaxation: float = 1.0
) -> float:
    """By what factor a sweep shrinks the change of the forces, measured over the last tenth of the sweeps.

    Sweeps stop before rounding takes over, when the change has fallen to
    1e-11 of the forces.

    Args:
        matrix, bias: A, (c, c), and b, (c,).
        sweeps: how many are made, at least 20.
        relaxation: above 0, below 2.
    """
    whole_number("sweeps", sweeps, minimum=20)
    system = _Sweeps(matrix, scalars("bias", bias))
    f, changes = np.zeros(system.bias.size), []
    for _ in range(sweeps):
        after = system.swept(f, relaxation)
        changes.append(float(np.linalg.norm(np.sqrt(system.diagonal) * (after - f))))
        f = after
        if changes[-1] <= 1e-11 * float(np.linalg.norm(np.sqrt(system.diagonal) * f)):
            break
    tail = max(len(changes) // 10, 1)
    if len(changes) <= tail or changes[-1] == 0:
        return 0.0
    return float((changes[-1] / changes[-1 - tail]) ** (1 / tail))


def optimal_relaxation(factor: float) -> float:
    """The relaxation with the fastest convergence, from the factor at relaxation 1.

    2 / (1 + sqrt(1 - factor)) (Young, 1971, for matrices such as a stack's,
    with one contact an interface, whose contacts couple in a chain); it brings
    the factor down to ``optimal_relaxation - 1``.
    """
    rho = scalar("factor", factor)
    if not 0 <= rho < 1:
        raise failure("factor", "a number from 0, below 1", written(rho))
    return 2.0 / (1.0 + float(np.sqrt(1.0 - rho)))
