"""Contact forces by projected Gauss-Seidel sweeps over the contacts, and how fast these converge.

A kernel module (``course.jit``): import it where it is called.
"""

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
from course.contact.solvers.arguments import dense, relaxation_of, square_system
from course.contact.solvers.residual import residual_of
from course.jit import compiled


@compiled
def step(
    i: int,
    begin: IntArray,
    column: IntArray,
    entry: Array,
    diagonal: Array,
    bias: Array,
    relaxation: float,
    force: Array,
) -> None:
    """f_i <- max(0, f_i - relaxation w_i / a_ii), w_i = (A f + b)_i of the newest forces.

    Row i of A is entry[begin[i]:begin[i + 1]] in these columns; force is changed.
    """
    w = bias[i]
    for k in range(begin[i], begin[i + 1]):
        w += entry[k] * force[column[k]]
    force[i] = max(0.0, force[i] - relaxation * w / diagonal[i])


@compiled
def sweep(
    begin: IntArray,
    column: IntArray,
    entry: Array,
    diagonal: Array,
    bias: Array,
    relaxation: float,
    force: Array,
) -> None:
    """One Gauss-Seidel sweep: one contact after the other; one that no force moves is left out."""
    for i in range(bias.size):
        if diagonal[i] > 0.0:
            step(i, begin, column, entry, diagonal, bias, relaxation, force)


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
    """Projected Gauss-Seidel: each contact in turn gets the force that makes its own w = 0, never one below 0.

    f_i <- max(0, f_i - relaxation w_i / a_ii). What is limited is the
    accumulated force, not its change: clipping changes instead answers
    (1, .5) on A = [[1, .5], [.5, 1]], b = (-1, -1), where (2/3, 2/3) is right.
    (R. W. Cottle, J.-S. Pang, R. E. Stone, The Linear Complementarity Problem,
    1992, section 5.2; converges for 0 < relaxation < 2.)

    Args:
        matrix: A, (c, c), sparse or dense, positive semidefinite.
        bias: b, (c,).
        tolerance: residual at which it stops; below 0 it never does.
        max_sweeps: how often all contacts are gone through at most.
        relaxation: above 0, below 2; over 1 looks ahead.
        start: forces to begin with, (c,); negative ones count as 0. The
            last moment's forces are a good guess for the next.
    Returns:
        The last force, its residual and the sweeps done.
    Raises:
        ValueError: relaxation outside 0..2, shapes that do not belong together.
    """
    a, b = square_system(matrix, bias)
    r = relaxation_of(relaxation)
    whole_number("max_sweeps", max_sweeps)
    f = np.zeros(b.size) if start is None else np.maximum(scalars("start", start), 0.0)
    shaped("start", f, b.shape)
    system = _Sweeps(a, b)
    f = np.where(system.diagonal > 0, f, 0.0)
    count, check = 0, 0
    while True:
        if count == check:
            residual = system.residual(f)
            # Looking costs as much as a sweep, so it is done ever more rarely.
            check = min(count + 1 + count // 10, max_sweeps)
            if residual <= tolerance or count >= max_sweeps:
                return Swept(f, residual, count)
        system.sweep(f, r)
        count += 1


class _Sweeps:
    """A system by its rows, as the kernels take it."""

    def __init__(self, matrix: Any, bias: Array) -> None:
        from scipy.sparse import csr_array

        rows = csr_array(matrix)
        self.matrix: Any = rows
        self.bias, self.diagonal = bias, np.asarray(rows.diagonal())
        self._magnitude = abs(rows)
        self.rows = (
            rows.indptr.astype(np.intp),
            rows.indices.astype(np.intp),
            rows.data.astype(np.float64),
            self.diagonal,
            np.ascontiguousarray(bias),
        )

    def sweep(self, force: Array, relaxation: float) -> None:
        """Go through all contacts once; force is changed."""
        sweep(*self.rows, relaxation, force)

    def residual(self, f: Array) -> float:
        product, size = self.matrix @ f, self._magnitude @ f
        return float(residual_of(self.diagonal, product, size, f, self.bias))


def gauss_seidel_path(
    matrix: Any, bias: ArrayLike, sweeps: int, *, relaxation: float = 1.0
) -> Array:
    """The Gauss-Seidel path: the forces from 0 on, after each single step of the sweeps, (sweeps c + 1, c)."""
    system = _Sweeps(*square_system(matrix, bias))
    force = np.zeros(system.bias.size)
    path = [force.copy()]
    for i in list(range(force.size)) * whole_number("sweeps", sweeps):
        step(i, *system.rows, relaxation, force)
        path.append(force.copy())
    return np.array(path)


def predicted_gauss_seidel_factor(matrix: Any, *, relaxation: float = 1.0) -> float:
    """The convergence factor of Gauss-Seidel sweeps where all contacts push: what is left of the error after each.

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
        The convergence factor; below 1 it converges.
    """
    from scipy.linalg import eigvals, eigvalsh, solve_triangular

    a = scalars("matrix", dense(matrix))
    if not a.size:
        return 0.0
    root = np.sqrt(a.diagonal())
    a = a / (root[:, None] * root)
    nullity = int(np.count_nonzero(eigvalsh(a) < 1e-12 * len(a)))
    lower = np.tril(a, -1) + np.eye(len(a)) / relaxation
    values = eigvals(solve_triangular(lower, lower - a, lower=True))
    values = values[np.argsort(np.abs(values - 1))][nullity:]
    return float(np.abs(values).max(initial=0.0))


def measured_gauss_seidel_factor(
    matrix: Any, bias: ArrayLike, *, sweeps: int = 200, relaxation: float = 1.0
) -> float:
    """The convergence factor measured: by what a sweep shrinks the change of the forces, over the last tenth.

    Sweeps stop before rounding takes over, when the change has fallen to
    1e-11 of the forces.

    Args:
        matrix, bias: A, (c, c), and b, (c,).
        sweeps: how many are made, at least 20.
        relaxation: above 0, below 2.
    """
    whole_number("sweeps", sweeps, minimum=20)
    system = _Sweeps(*square_system(matrix, bias))
    f, changes = np.zeros(system.bias.size), []
    for _ in range(sweeps):
        before = f.copy()
        system.sweep(f, relaxation)
        changes.append(float(np.linalg.norm(np.sqrt(system.diagonal) * (f - before))))
        if changes[-1] <= 1e-11 * float(np.linalg.norm(np.sqrt(system.diagonal) * f)):
            break
    tail = max(len(changes) // 10, 1)
    if len(changes) <= tail or changes[-1] == 0:
        return 0.0
    return float((changes[-1] / changes[-1 - tail]) ** (1 / tail))


def optimal_relaxation(convergence_factor: float) -> float:
    """The relaxation with the fastest convergence, from the convergence factor at relaxation 1.

    2 / (1 + sqrt(1 - rho)) (Young, 1971, for matrices such as a stack's,
    with one contact an interface, whose contacts couple in a chain); it brings
    rho, the convergence factor, down to ``optimal_relaxation - 1``.
    """
    rho = scalar("convergence_factor", convergence_factor)
    if not 0 <= rho < 1:
        raise failure("convergence_factor", "a number from 0, below 1", written(rho))
    return 2.0 / (1.0 + float(np.sqrt(1.0 - rho)))


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    gauss_seidel_path(np.eye(1), [-1.0], 1)
    solve_projected_gauss_seidel(np.eye(1), [-1.0])
