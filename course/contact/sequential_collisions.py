"""Sequential collision resolution: one Gauss-Seidel pass, each colliding contact as if it were alone.

Each impulse is a whole collision with its restitution and stays as it was made. The
"sequential impulses" of game engines (E. Catto, "Iterative Dynamics with Temporal
Coherence", 2005) are another method: many small ones, whose sum is kept at or above 0
and converges to the simultaneous answer.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled


@compiled
def sequential_pass(
    begin: IntArray,
    column: IntArray,
    entry: Array,
    diagonal: Array,
    strength: float,
    limit: float,
    velocity: Array,
    impulse: Array,
) -> None:
    """Each contact that approaches takes p = -(1 + e) u / a_ii, as if it were alone.

    u <- u + A p at once, so that the next contact sees it (syllabus rows 15-17).
    Row i of A is entry[begin[i]:begin[i + 1]] in these columns; strength is 1 + e;
    a contact approaches below the limit. velocity and impulse are changed.
    """
    for i in range(velocity.size):
        if velocity[i] < limit:
            p = -strength * velocity[i] / diagonal[i]
            impulse[i] += p
            for k in range(begin[i], begin[i + 1]):
                velocity[column[k]] += entry[k] * p


class Passes:
    """A contact matrix by its rows, as the kernel takes it.

    Args:
        matrix: A, (c, c) [1/kg], dense, its diagonal above 0.
    """

    def __init__(self, matrix: Array) -> None:
        row, column = np.nonzero(matrix)
        counts = np.bincount(row, minlength=len(matrix))
        begin = np.concatenate([[0], np.cumsum(counts)]).astype(np.intp)
        self._rows = (
            begin,
            np.ascontiguousarray(column),  # one type for the kernel
            matrix[row, column],
            matrix.diagonal().copy(),
        )

    def once(self, velocity: Array, e: float, limit: float) -> Array:
        """The impulses of all contacts, each taken once, from these normal velocities, (c,)."""
        impulse = np.zeros(velocity.size)
        sequential_pass(*self._rows, 1.0 + e, limit, velocity.copy(), impulse)
        return impulse


def warm() -> Any:
    """Call the kernel once (``course.jit``)."""
    return Passes(np.eye(1)).once(np.full(1, -1.0), 0.0, 0.0)
