"""Small contact systems, one or many at once: exchange all wrong contacts of each, until none is wrong.

Block principal pivoting (J. J. Judice and F. M. Pires, Computers and
Operations Research 21(5), 1994, after M. M. Kostreva): guess the set S of
contacts that push, solve A_SS f_S = -b_S, and exchange every contact that
pulls or approaches. Where their number has not fallen for some rounds, only
the last one is exchanged (Murty's rule, which cannot cycle while A_SS is
regular). The first guess is that all push: most contacts at rest do. A_SS is
regularised by a small shift on its diagonal of ones, whose effect is refined
away, so that redundant contacts do no harm.

In a batch the arrays hold the system's own axes first and the batch last:
each step of the elimination is one operation on all systems. There the second
guess is that of a few sweeps of projected Gauss-Seidel, which cost little.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.contact.solvers.residual import products, residual_of, scaled_rows

#: Added to a diagonal of ones. Below minus this an eigenvalue is no rounding: A is indefinite.
SHIFT = 1e-9
#: Added instead where a single A_SS is so nearly singular that its effect is not refined away.
LITTLE = 1e-13
#: How often the effect of the shift is refined away, in a batch and at most in a single system.
REFINEMENTS = (1, 3)
#: A single system is refined until A_SS f_S + b_S is below these parts of the forces and of b, on a diagonal of ones:
#: the first is rounding, the second keeps it small beside b where forces are enormous.
REFINED = (1e-15, 1e-11)
#: Residual, a contact, above which a system of a batch is solved once more on its own: no more is rounding.
EXACT = 4 * np.finfo(float).eps
#: Where more than this part of the forces is left, the shift is too large.
SLOW = 1e-13
#: A contact is wrong if it pulls or approaches by more than this, relative to the forces on a diagonal of ones.
WRONG = 1e-13
#: Sweeps for the second guess in a batch: random systems of 8 to 16 contacts then go on for about half the rounds.
SWEEPS = 4
#: Rounds in which the number of wrong contacts need not fall.
PATIENCE = 3
#: Numbers in the matrices worked on at a time: they fit a processor's cache.
BLOCK = 2**14


@dataclass(frozen=True)
class Pivoted:
    """Forces, A f and |A| f, (..., c); residuals, how often each was solved, whether A is indefinite, (...)."""

    force: Array
    product: Array
    size: Array
    residual: Any
    iterations: Any
    indefinite: Any


def block_pivot(
    matrix: Array, bias: Array, *, max_iterations: int | None = None
) -> Pivoted:
    """Contact forces of s systems of c contacts.

    Args:
        matrix: A, (s, c, c), symmetric positive semidefinite.
        bias: b, (s, c).
        max_iterations: how often a system is solved at most; 2 c + 20 if not given.
    Returns:
        Forces, what they do, residuals and iterations. A large residual says
        that the method failed there, or that there is no solution.
    """
    systems, count = bias.shape
    limit = 2 * count + 20 if max_iterations is None else max_iterations
    force, product, size = np.zeros((3, count, systems))
    found = Pivoted(
        force.T,
        product.T,
        size.T,
        np.zeros(systems),
        np.zeros(systems, dtype=np.intp),
        np.zeros(systems, dtype=bool),
    )
    state = _State(
        np.einsum("sii->is", matrix) > 0,
        np.full(systems, count + 1),
        np.full(systems, PATIENCE),
    )
    block, round_ = max(256, BLOCK // max(count * count, 1)), 0
    todo = np.arange(systems)
    while round_ < limit and todo.size >= max(8, count**3 // 100):
        round_ += 1
        todo = np.concatenate([
            _round(matrix, bias, todo[k : k + block], state, found, round_)
            for k in range(0, todo.size, block)
        ])  # fmt: skip
    again = ~(found.residual <= EXACT * count)
    again[todo] = True
    for k in again.nonzero()[0]:
        one = block_pivot_one(
            matrix[k], bias[k], pushing=state.pushing[:, k], max_iterations=limit
        )
        found.force[k], found.product[k], found.size[k] = (
            one.force,
            one.product,
            one.size,
        )
        found.residual[k], found.iterations[k] = one.residual, round_ + one.iterations
        found.indefinite[k] |= one.indefinite
    return found


@dataclass
class _State:
    """For each system the guessed set (c, s), the fewest wrong contacts so far, and the rounds left to better it."""

    pushing: BoolArray
    fewest: IntArray
    patience: IntArray


def _round(
    matrix: Array,
    bias: Array,
    index: IntArray,
    state: _State,
    found: Pivoted,
    round_: int,
) -> IntArray:
    """One round of the systems of the index; which of them go on, with what is found for the others."""
    # Indices without a gap, as in the first round, are read and written as a slice: that is faster.
    where = (
        slice(index[0], index[-1] + 1)
        if index[-1] - index[0] == index.size - 1
        else index
    )
    a, b = matrix[where].transpose(1, 2, 0).copy(), bias[where].T.copy()
    scale = 1.0 / np.sqrt(
        np.where((diagonal := np.einsum("iis->is", a)) > 0, diagonal, np.inf)
    )
    if round_ == 2:
        state.pushing[:, where] = _swept(a, b, scale)
    s = state.pushing[:, where]
    on, unit_b = np.where(s, scale, 0.0), scale * b
    solve, least = _elimination(a, on, s)
    found.indefinite[where] |= ~(least > 0)
    unit = 0.0 - solve(on * b)  # no -0
    for _ in range(REFINEMENTS[0]):
        unit -= solve(on * (_times(a, scale * unit) + b))
    force = scale * unit
    product = _times(a, force)
    below = -WRONG * (
        np.abs(unit).sum(axis=0) + np.abs(unit_b).max(axis=0, initial=0.0)
    )
    wrong = np.where(s, unit, scale * product + unit_b) < below
    going = wrong.any(axis=0)
    if np.any(clipped := (force < 0).any(axis=0) & ~going):
        force[:, clipped] = np.maximum(force[:, clipped], 0.0)
        product[:, clipped] = _times(a[:, :, clipped], force[:, clipped])
    size = _times(np.abs(a, out=a), force)
    # What goes on is found anew, in a later round.
    found.force.T[:, where], found.product.T[:, where], found.size.T[:, where] = (
        force,
        product,
        size,
    )
    rows = scaled_rows(diagonal, product, size, force, b, axis=0)
    found.residual[where] = np.abs(np.minimum(*rows)).max(axis=0, initial=0.0)
    found.iterations[where] = round_
    return (
        _exchange(state, index[going], wrong[:, going]) if np.any(going) else index[:0]
    )


def _times(a: Array, x: Array) -> Array:
    """A x of systems (c, c, s) and (c, s)."""
    return np.einsum("ijs,js->is", a, x)


def _swept(a: Array, b: Array, scale: Array) -> BoolArray:
    """The contacts that push after a few sweeps of projected Gauss-Seidel: a guess that suits where not all push."""
    force = np.zeros(b.shape)
    for i in SWEEPS * list(range(len(b))):
        step = scale[i] * (scale[i] * (np.einsum("js,js->s", a[i], force) + b[i]))
        np.maximum(force[i] - step, 0.0, out=force[i])
    return force > 0


def _exchange(state: _State, index: IntArray, wrong: BoolArray) -> IntArray:
    """The next guess of these systems, where these contacts are wrong; returns the index."""
    number = np.count_nonzero(wrong, axis=0)
    fewer = number < state.fewest[index]
    state.patience[index] = patience = np.where(
        fewer, PATIENCE, state.patience[index] - 1
    )
    state.fewest[index] = np.where(fewer, number, state.fewest[index])
    stuck = np.flatnonzero(patience < 0)
    last = wrong.shape[0] - 1 - np.argmax(wrong[::-1, stuck], axis=0)
    wrong[:, stuck] = False
    wrong[last, stuck] = True
    state.pushing[:, index] ^= wrong
    return index


def _elimination(
    a: Array, on: Array, pushing: BoolArray
) -> tuple[Callable[[Array], Array], Array]:
    """Solves (A_SS + shift) x = q for all systems, on a diagonal of ones: A = L D L' on vectors over the batch.

    With it the sign of the least of D and infinity, (s,): not above 0 where A is indefinite.

    A (c, c, s); on (c, s) brings its diagonal to ones and is 0 outside S, as
    q must be; q is overwritten.
    """
    count = pushing.shape[0]
    column = [a[k:, k] * (on[k:] * on[k]) for k in range(count)]
    inverse, lower = np.empty(pushing.shape), np.empty(a.shape)
    for k in range(count):
        column[k][0] += np.where(pushing[k], SHIFT, 1.0)
        np.divide(1.0, column[k][0], out=inverse[k])
        np.multiply(column[k][1:], inverse[k], out=lower[k + 1 :, k])
        for i in range(k + 1, count):
            column[i] -= lower[i, k] * column[k][i - k :]

    def solve(q: Array) -> Array:
        for k in range(count - 1):
            q[k + 1 :] -= lower[k + 1 :, k] * q[k]
        q *= inverse
        for k in range(count - 1, 0, -1):
            q[:k] -= lower[k, :k] * q[k]
        return q

    return solve, inverse.min(axis=0, initial=np.inf)


def block_pivot_one(
    matrix: Array,
    bias: Array,
    *,
    pushing: BoolArray | None = None,
    max_iterations: int | None = None,
) -> Pivoted:
    """Contact forces of one system of c contacts, by LAPACK.

    Args:
        matrix: A, (c, c), symmetric positive semidefinite.
        bias: b, (c,).
        pushing: (c,), the contacts that push, as a first guess; all that a
            force moves if not given.
        max_iterations: how often it is solved at most; 2 c + 20 if not given.
    Returns:
        As ``block_pivot``, without the axis of the batch.
    """
    limit = 2 * bias.size + 20 if max_iterations is None else max_iterations
    diagonal = matrix.diagonal()
    moves = diagonal > 0
    scale = 1.0 / np.sqrt(np.where(moves, diagonal, np.inf))
    a, b = matrix * (scale[:, None] * scale), scale * bias
    bound = float(np.abs(b).max(initial=0.0)) or 1.0
    b /= bound
    pushing = moves if pushing is None else pushing.copy()
    fewest, patience, rounds, on = b.size + 1, PATIENCE, 0, _OnSet(b)
    while rounds < limit:
        rounds += 1
        on = _on_set(a, b, pushing)
        wrong = on.wrong(pushing)
        if on.indefinite:
            break
        if not np.any(wrong) and not on.refined:
            on = _on_set(a, b, pushing, shift=LITTLE)
            wrong = on.wrong(pushing)
        number = int(np.count_nonzero(wrong))
        if not number:
            break
        fewest, patience = (
            (number, PATIENCE) if number < fewest else (fewest, patience - 1)
        )
        if patience < 0:
            wrong[: wrong.nonzero()[0][-1]] = False
        pushing ^= wrong
    force = np.maximum(on.force, 0.0) * (scale * bound)
    product, size = products(matrix, force)
    residual = residual_of(diagonal, product, size, force, bias)
    return Pivoted(force, product, size, residual, rounds, on.indefinite)


class _OnSet:
    """Forces with A_SS f_S = -b_S, 0 elsewhere; A f + b; the sum of |f|; what is known of A_SS."""

    def __init__(self, bias: Array) -> None:
        self.force, self.motion, self.total = np.zeros(bias.size), bias, 0.0
        self.indefinite, self.refined = False, True

    def wrong(self, pushing: BoolArray) -> BoolArray:
        """Which contacts pull or approach."""
        below = -WRONG * (self.total + 1.0)
        return np.where(pushing, self.force, self.motion) < below


def _on_set(a: Array, b: Array, pushing: BoolArray, *, shift: float = SHIFT) -> _OnSet:
    """The forces on a set, on a diagonal of ones. The largest |b| is 1."""
    from scipy.linalg.lapack import dpotrf, dpotrs

    found, s = _OnSet(b), pushing.nonzero()[0]
    if not s.size:
        return found
    columns = a if s.size == b.size else a[:, s]
    matrix = columns[s]
    matrix.flat[:: s.size + 1] += shift
    factor, info = dpotrf(matrix.T, lower=1, overwrite_a=1, clean=0)
    if info:
        found.indefinite = True
        return found
    on, missing = 0.0, b[s]
    for _ in range(1 + REFINEMENTS[1]):
        on = on - dpotrs(factor, missing, lower=1)[0]
        found.motion, found.total = columns @ on + b, float(np.abs(on).sum())
        missing = found.motion[s]
        off = float(np.abs(missing).max())
        if off <= min(REFINED[0] * (found.total + 1.0), REFINED[1]):
            break
    found.refined = off <= SLOW * (found.total + 1.0)
    found.force[s] = on
    return found
