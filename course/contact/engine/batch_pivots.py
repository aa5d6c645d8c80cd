"""Block principal pivoting of many small systems: the compiled loop over them.

A kernel module (``course.jit``): import it where it is called. ``block_pivots`` has
the method and its source.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.contact.solvers.projected_gauss_seidel import sweep
from course.jit import compiled

#: Sweeps for the second guess: random systems of 8 to 16 contacts then go on for about half the rounds.
SWEEPS = 4


@compiled
def eliminate(upper: Array, size: int) -> bool:
    """A = U' D^-1 U in place, D on the diagonal of U; False where A is not positive definite."""
    for k in range(size):
        if not upper[k, k] > 0.0:
            return False
        for i in range(k + 1, size):
            share = upper[k, i] / upper[k, k]
            for j in range(i, size):
                upper[i, j] -= share * upper[k, j]
    return True


@compiled
def substitute(upper: Array, size: int, x: Array) -> None:
    """x <- the solution of U' D^-1 U x = x."""
    for k in range(size):
        x[k] /= upper[k, k]
        for i in range(k + 1, size):
            x[i] -= upper[k, i] * x[k]
    for k in range(size - 1, -1, -1):
        for i in range(k + 1, size):
            x[k] -= upper[k, i] / upper[k, k] * x[i]


@compiled
def forces_on_set(
    a: Array, b: Array, which: IntArray, shift: float, upper: Array, x: Array
) -> bool:
    """(A_SS + shift) x = -b_S and one refinement of A_SS x = -b_S; False where that is not positive definite."""
    size = which.size
    for i in range(size):
        for j in range(i, size):
            upper[i, j] = a[which[i], which[j]]
        upper[i, i] += shift
        x[i] = -b[which[i]]
    if not eliminate(upper, size):
        return False
    substitute(upper, size, x)
    missing = np.empty(size)
    for i in range(size):
        missing[i] = -b[which[i]]
        for j in range(size):
            missing[i] -= a[which[i], which[j]] * x[j]
    substitute(upper, size, missing)
    for i in range(size):
        x[i] += missing[i]
    return True


@compiled
def wrong_contacts(
    a: Array,
    b: Array,
    force: Array,
    pushing: BoolArray,
    rounding: float,
    wrong: BoolArray,
) -> int:
    """Marks those that pull or approach, on a diagonal of ones; returns how many."""
    number, total, largest = 0, 0.0, 0.0
    for i in range(b.size):
        total += abs(force[i])
        largest = max(largest, abs(b[i]))
    for i in range(b.size):
        value = force[i]
        if not pushing[i]:
            value = b[i]
            for j in range(b.size):
                value += a[i, j] * force[j]
        wrong[i] = value < -rounding * (total + largest)
        number += wrong[i]
    return number


@compiled
def pivot_one(
    a: Array,
    b: Array,
    moves: Array,
    limit: int,
    constants: tuple[float, float, int],
    pushing: BoolArray,
    force: Array,
) -> int:
    """Forces of one system on a diagonal of ones, and how often it was solved; below 0 where A is indefinite.

    moves: 1, or 0 where no force moves the contact. pushing: the set at the end.
    """
    shift, rounding, most = constants
    count = b.size
    upper, x, wrong = (
        np.empty((count, count)),
        np.empty(count),
        np.empty(count, dtype=np.bool_),
    )
    fewest, patience = count + 1, most
    for i in range(count):
        pushing[i] = moves[i] > 0.0
    for rounds in range(1, limit + 1):
        if rounds == 2:
            guess(a, b, moves, pushing)
        which = np.flatnonzero(pushing)
        if not forces_on_set(a, b, which, shift, upper, x):
            return -rounds
        force[:] = 0.0
        for i in range(which.size):
            force[which[i]] = x[i]
        number = wrong_contacts(a, b, force, pushing, rounding, wrong)
        if number == 0:
            return rounds
        patience = most if number < fewest else patience - 1
        fewest = min(number, fewest)
        for i in range(count - 1, -1, -1):
            if wrong[i]:
                pushing[i] = not pushing[i]
                if patience < 0:  # Murty's rule: the last one alone
                    break
    return limit


@compiled
def guess(a: Array, b: Array, moves: Array, pushing: BoolArray) -> None:
    """The contacts that push after a few sweeps: a guess that suits where not all push."""
    count = b.size
    begin, column = (
        np.empty(count + 1, dtype=np.intp),
        np.empty(count * count, dtype=np.intp),
    )
    for k in range(count * count):
        column[k] = k % count
    for i in range(count + 1):
        begin[i] = i * count
    force = np.zeros(count)
    for _ in range(SWEEPS):
        sweep(begin, column, a.ravel(), moves, b, 1.0, force)
    for i in range(count):
        pushing[i] = force[i] > 0.0


@compiled
def pivot_all(
    matrix: Array,
    bias: Array,
    limit: int,
    constants: tuple[float, float, int],
    force: Array,
    pushing: BoolArray,
    rounds: IntArray,
) -> None:
    """``pivot_one`` for A (s, c, c) and b (s, c), each brought to a diagonal of ones first."""
    systems, count = bias.shape
    a, b, scale, moves = (
        np.empty((count, count)),
        np.empty(count),
        np.empty(count),
        np.empty(count),
    )
    for s in range(systems):
        for i in range(count):
            moves[i] = 1.0 if matrix[s, i, i] > 0.0 else 0.0
            scale[i] = 1.0 / np.sqrt(matrix[s, i, i]) if moves[i] > 0.0 else 0.0
        for i in range(count):
            b[i] = scale[i] * bias[s, i]
            for j in range(count):
                a[i, j] = scale[i] * matrix[s, i, j] * scale[j]
        rounds[s] = pivot_one(a, b, moves, limit, constants, pushing[s], force[s])
        for i in range(count):
            force[s, i] = max(force[s, i], 0.0) * scale[i]


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    force, pushing = np.zeros((1, 1)), np.zeros((1, 1), dtype=bool)
    rounds = np.zeros(1, dtype=np.intp)
    pivot_all(np.ones((1, 1, 1)), np.ones((1, 1)), 3, (1e-9, 1e-13, 3), force, pushing, rounds)  # fmt: skip
