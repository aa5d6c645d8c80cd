"""Block principal pivoting of small contact systems, one or many: exchange all wrong contacts until none is.

Block principal pivoting (J. J. Judice and F. M. Pires, Computers and
Operations Research 21(5), 1994, after M. M. Kostreva): guess the set S of
contacts that push, solve A_SS f_S = -b_S, and exchange every contact that
pulls or approaches. Where their number has not fallen for some rounds, only
the last one is exchanged (Murty's rule, which cannot cycle while A_SS is
regular). The first guess is that all push: most contacts at rest do. A_SS is
regularised by a small shift on its diagonal of ones, whose effect is refined
away, so that redundant contacts do no harm.

A batch runs through the compiled loop of ``batch_pivots``, where the second guess
is that of a few sweeps of projected Gauss-Seidel. A single system is solved by
LAPACK, which is as fast from a few contacts on and needs no compiler.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray
from course.contact.engine.acceptance import RESIDUAL_ROUNDING
from course.contact.solvers.residual import products, residual_of

#: Added to a diagonal of ones. Below minus this an eigenvalue is no rounding: A is indefinite.
SHIFT = 1e-9
#: Added instead where a single A_SS is so nearly singular that its effect is not refined away.
LITTLE = 1e-13
#: How often the effect of the shift is refined away at most in a single system; in a batch it is once.
REFINEMENTS = 3
#: A single system is refined until A_SS f_S + b_S is below these parts of the forces and of b, on a diagonal of ones:
#: the first is rounding, the second keeps it small beside b where forces are enormous.
FULLY_REFINED = (1e-15, 1e-11)
#: Where more than this part of the forces is left, the shift is too large.
SLOW = 1e-13
#: A contact is wrong if it pulls or approaches by more than this, relative to the forces on a diagonal of ones.
WRONG = 1e-13
#: Rounds in which the number of wrong contacts need not fall.
ROUNDS_WITHOUT_FALL = 3


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
    from course.contact.engine.batch_pivots import pivot_all

    systems, count = bias.shape
    limit = 2 * count + 20 if max_iterations is None else max_iterations
    a, b = np.ascontiguousarray(matrix), np.ascontiguousarray(bias)
    force, pushing = np.zeros((systems, count)), np.zeros((systems, count), dtype=bool)
    rounds = np.zeros(systems, dtype=np.intp)
    pivot_all(a, b, limit, (SHIFT, WRONG, ROUNDS_WITHOUT_FALL), force, pushing, rounds)
    # With the batch as the fastest axis, in which sums over few contacts are quicker.
    force, b = np.asfortranarray(force), np.asfortranarray(bias)
    product, size = (np.asfortranarray(each) for each in products(a, force))
    diagonal = np.asfortranarray(np.einsum("sii->si", a))
    residual = residual_of(diagonal, product, size, force, b)
    found = Pivoted(force, product, size, residual, np.abs(rounds), rounds < 0)
    # Those that are not right to rounding, once more on their own.
    for k in np.flatnonzero(~(residual <= RESIDUAL_ROUNDING * count)):
        one = block_pivot_one(a[k], b[k], pushing=pushing[k], max_iterations=limit)
        force[k], product[k], size[k] = one.force, one.product, one.size
        residual[k] = one.residual
        found.iterations[k] += one.iterations
        found.indefinite[k] |= one.indefinite
    return found


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
    fewest, patience, rounds, on = b.size + 1, ROUNDS_WITHOUT_FALL, 0, _OnSet(b)
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
            (number, ROUNDS_WITHOUT_FALL) if number < fewest else (fewest, patience - 1)
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
    for _ in range(1 + REFINEMENTS):
        on = on - dpotrs(factor, missing, lower=1)[0]
        found.motion, found.total = columns @ on + b, float(np.abs(on).sum())
        missing = found.motion[s]
        off = float(np.abs(missing).max())
        if off <= min(FULLY_REFINED[0] * (found.total + 1.0), FULLY_REFINED[1]):
            break
    found.refined = off <= SLOW * (found.total + 1.0)
    found.force[s] = on
    return found
