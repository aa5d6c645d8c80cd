"""Small contact systems, one or many at once: exchange all wrong contacts of each, until none is wrong.

Block principal pivoting (J. J. Judice and F. M. Pires, Computers and
Operations Research 21(5), 1994, after M. M. Kostreva): guess the set S of
contacts that push, solve A_SS f_S = -b_S, and exchange every contact that
pulls or approaches. Where their number has not fallen for some rounds, only
the last one is exchanged (Murty's rule, which cannot cycle while A_SS is
regular). A_SS is regularised by a small shift on its diagonal of ones, whose
effect is refined away, so that redundant contacts do no harm.

In a batch the arrays hold the system's own axes first and the batch last:
each step of the elimination is one operation on all systems.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.contact.solvers.residual import scaled_rows

#: Added to a diagonal of ones.
SHIFT = 1e-9
#: How often the effect of the shift is refined away, in a batch and at most in a single system.
REFINEMENTS = (1, 3)
#: A single system is refined until a correction is smaller than this part of the forces; the next is smaller by far.
REFINED = 1e-13
#: Residual above which a system of a batch is solved once more on its own.
EXACT = 1e-12
#: A contact is wrong if it pulls or approaches by more than this, relative to the forces on a diagonal of ones.
WRONG = 1e-13
#: Rounds in which the number of wrong contacts need not fall.
PATIENCE = 3
#: Numbers in the matrices worked on at a time: they fit a processor's cache.
BLOCK = 2**14


@dataclass(frozen=True)
class Pivoted:
    """Forces (s, c), their residuals (s,) and how often each system was solved (s,)."""

    force: Array
    residual: Array
    iterations: IntArray


def block_pivot(matrix: Array, bias: Array, *, max_iterations: int | None = None) -> Pivoted:
    """Contact forces of s systems of c contacts.

    Args:
        matrix: A, (s, c, c), symmetric positive semidefinite.
        bias: b, (s, c).
        max_iterations: how often a system is solved at most; 2 c + 20 if not given.
    Returns:
        Forces, residuals and iterations. A large residual says that the
        method failed there, or that there is no solution.
    """
    systems, count = bias.shape
    limit = 2 * count + 20 if max_iterations is None else max_iterations
    result = Pivoted(np.zeros(bias.shape), np.zeros(systems), np.zeros(systems, dtype=np.intp))
    diagonal = np.einsum("sii->si", matrix)
    state = _State((bias <= 0) & (diagonal > 0), np.full(systems, count + 1), np.full(systems, PATIENCE))
    block, round_ = max(256, BLOCK // max(count * count, 1)), 0
    todo = np.arange(systems)
    while round_ < limit and todo.size >= max(8, count**3 // 100):
        round_ += 1
        todo = np.concatenate([
            _round(matrix, bias, todo[k : k + block], state, result, round_)
            for k in range(0, todo.size, block)
        ])  # fmt: skip
    inexact = (result.residual > EXACT) & (result.iterations > 0)
    for k in np.concatenate([todo, inexact.nonzero()[0]]):
        result.force[k], result.residual[k], more = _one(matrix[k], bias[k], state.pushing[k], limit)
        result.iterations[k] = round_ + more
    return result


@dataclass
class _State:
    """For each system the guessed set (s, c), the fewest wrong contacts so far, and the rounds left to better it."""

    pushing: BoolArray
    fewest: IntArray
    patience: IntArray


def _round(
    matrix: Array, bias: Array, index: IntArray, state: _State, result: Pivoted, round_: int
) -> IntArray:
    """One round of the systems of the index; which of them go on."""
    a, b, s = _batch_last(matrix[index]), _batch_last(bias[index]), _batch_last(state.pushing[index])
    root = np.sqrt(np.einsum("iis->is", a))
    scale = np.divide(1.0, root, out=np.zeros_like(root), where=root > 0)
    on, unit_b = np.where(s, scale, 0.0), scale * b
    solve = _elimination(a * (on[:, None] * on), s)
    unit = -solve(on * b)
    for _ in range(REFINEMENTS[0]):
        unit -= solve(on * (np.einsum("ijs,js->is", a, scale * unit) + b))
    force = scale * unit
    product = np.einsum("ijs,js->is", a, force)
    least = -WRONG * (np.abs(unit).sum(axis=0) + np.abs(unit_b).max(axis=0, initial=0.0))
    wrong = (np.where(s, unit, scale * product + unit_b) < least) & (scale > 0)
    number = np.count_nonzero(wrong, axis=0)
    if np.any(ended := number == 0):
        done = index[ended]
        force = np.maximum(force, 0.0)
        result.force[done] = force[:, ended].T
        result.residual[done] = _residual(a, force, b)[ended]
        result.iterations[done] = round_
    going = index[~ended]
    _exchange(state, going, wrong[:, ~ended], number[~ended])
    return going


def _batch_last(x: Any) -> Any:
    return np.ascontiguousarray(np.moveaxis(x, 0, -1))


def _exchange(state: _State, index: IntArray, wrong: BoolArray, number: IntArray) -> None:
    fewer = number < state.fewest[index]
    state.patience[index] = patience = np.where(fewer, PATIENCE, state.patience[index] - 1)
    state.fewest[index] = np.where(fewer, number, state.fewest[index])
    stuck = np.flatnonzero(patience < 0)
    last = wrong.shape[0] - 1 - np.argmax(wrong[::-1, stuck], axis=0)
    wrong[:, stuck] = False
    wrong[last, stuck] = True
    state.pushing[index] ^= wrong.T


def _residual(a: Array, force: Array, b: Array) -> Array:
    """``complementarity_residual`` of systems (c, c, s)."""
    product, size = np.einsum("ijs,js->is", a, force), np.einsum("ijs,js->is", np.abs(a), force)
    rows = scaled_rows(np.einsum("iis->is", a), product, size, force, b, axis=0)
    return np.max(np.abs(np.minimum(*rows)), axis=0, initial=0.0)


def _elimination(a: Array, pushing: BoolArray) -> Callable[[Array], Array]:
    """Solves (A + shift) x = q for all systems, in place: A = L D L' on vectors over the batch.

    A and q are 0 outside S; a is overwritten.
    """
    count = pushing.shape[0]
    np.einsum("iis->is", a)[:] += np.where(pushing, SHIFT, 1.0)
    inverse, lower = np.empty(pushing.shape), np.empty(a.shape)
    for k in range(count):
        np.divide(1.0, a[k, k], out=inverse[k])
        np.multiply(a[k + 1 :, k], inverse[k], out=lower[k + 1 :, k])
        for i in range(k + 1, count):
            a[i:, i] -= lower[i, k] * a[i:, k]

    def solve(q: Array) -> Array:
        for k in range(count - 1):
            q[k + 1 :] -= lower[k + 1 :, k] * q[k]
        q *= inverse
        for k in range(count - 1, 0, -1):
            q[:k] -= lower[k, :k] * q[k]
        return q

    return solve


def _one(matrix: Array, bias: Array, pushing: BoolArray, limit: int) -> tuple[Array, float, int]:
    """A single system by LAPACK: force, residual, rounds."""
    diagonal = matrix.diagonal()
    root = np.sqrt(diagonal)
    scale = np.divide(1.0, root, out=np.zeros_like(root), where=root > 0)
    a, b = matrix * (scale[:, None] * scale), scale * bias
    fewest, patience, bound = b.size + 1, PATIENCE, float(np.abs(b).max(initial=0.0))
    unit, pushing, rounds = np.zeros(b.size), pushing.copy(), 0
    while rounds < limit:
        rounds += 1
        unit, w = _on_set(a, b, pushing.nonzero()[0])
        wrong = (np.where(pushing, unit, w) < -WRONG * (float(np.abs(unit).sum()) + bound)) & (scale > 0)
        number = int(np.count_nonzero(wrong))
        if not number:
            break
        fewest, patience = (number, PATIENCE) if number < fewest else (fewest, patience - 1)
        if patience < 0:
            wrong[: wrong.nonzero()[0][-1]] = False
        pushing ^= wrong
    force = np.maximum(unit, 0.0) * scale
    push, motion = scaled_rows(diagonal, matrix @ force, np.abs(matrix) @ force, force, bias)
    return force, float(np.abs(np.minimum(push, motion)).max(initial=0.0)), rounds


def _on_set(a: Array, b: Array, s: IntArray) -> tuple[Array, Array]:
    """Forces with A_SS f_S = -b_S, 0 elsewhere, and A f + b."""
    from scipy.linalg.lapack import dpotrf, dpotrs

    force = np.zeros(b.size)
    if not s.size:
        return force, b
    columns = a[:, s]
    small = columns[s]
    small.flat[:: s.size + 1] += SHIFT
    factor = dpotrf(small.T, lower=1, overwrite_a=1, clean=0)[0]
    on, w = np.zeros(s.size), b
    for _ in range(1 + REFINEMENTS[1]):
        correction = dpotrs(factor, w[s], lower=1)[0]
        on -= correction
        w = columns @ on + b
        if np.abs(correction).max() <= REFINED * np.abs(on).max():
            break
    force[s] = on
    return force, w
