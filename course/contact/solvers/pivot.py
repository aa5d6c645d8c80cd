"""Contact forces by pivoting, one contact after the other: Baraff's method, after Cottle and Dantzig."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, ArrayLike, BoolArray
from course.contact.solvers.arguments import dense, proof_by_the_unmoved, square_system

#: Numbers below this times the largest of their kind count as 0 (in units of the diagonal).
COUNTS_AS_ZERO = 1e-11


@dataclass(frozen=True, eq=False)
class PivotSolution:
    """What ``solve_pivot`` found.

    Args:
        force: f >= 0, (c,), as far as it came.
        pivots: how often a contact joined or left the pushing ones.
        finished: whether every contact has been dealt with.
        ray: None, or y >= 0, (c,), its largest entry 1, along which forces may grow
            for ever: A y = 0 and b.y < 0 as far as the tableau can tell.
            ``engine.certificates.certificate`` makes a proof of it, or refutes it.
    """

    force: Array
    pivots: int
    finished: bool
    ray: Array | None = None


def solve_pivot(
    matrix: Any, bias: ArrayLike, *, max_pivots: int | None = None
) -> PivotSolution:
    """Pivoting: a force f with w = A f + b >= 0, f >= 0, f.w = 0, for symmetric positive semidefinite A.

    D. Baraff, "Fast contact force computation for nonpenetrating rigid
    bodies", SIGGRAPH 1994, after R. W. Cottle and G. B. Dantzig, "Complementary
    pivot theory of mathematical programming", 1968 (syllabus row 20). Contacts
    are dealt with one by one. The force of the next one grows until its w is
    0; those that push already keep w = 0 meanwhile. When one of them would
    pull, it leaves; when one at rest would approach, it joins. A redundant
    contact never has to join: its force changes no w, and grows only until
    another's has become 0. If nothing stops it, no force exists.

    The tableau says how the forces of those that push and the w of the others
    answer to a unit of force at each; a pivot changes it by a matrix of rank 1.

    Args:
        matrix: A, (c, c), sparse or dense, symmetric positive semidefinite.
        bias: b, (c,).
        max_pivots: 20 c + 100 if not given.
    Raises:
        ValueError: shapes that do not belong together, NaN or infinity.
    """
    a, b = square_system(dense(matrix), bias)
    root = np.sqrt(np.maximum(a.diagonal(), 0.0))
    unmoved = proof_by_the_unmoved(root, b)
    if unmoved is not None:
        return PivotSolution(np.zeros(b.shape), 0, False, unmoved)
    scale = np.divide(1.0, root, out=np.zeros_like(root), where=root > 0)
    tableau = _Tableau(a * (scale[:, None] * scale), b * scale)
    limit = 20 * b.size + 100 if max_pivots is None else max_pivots
    for contact in np.argsort(b * scale, kind="stable"):
        ray = tableau.settle(int(contact), limit)
        if ray is not None:
            ray = ray * scale
            return PivotSolution(
                np.maximum(tableau.f, 0) * scale,
                tableau.pivots,
                False,
                ray / ray.max(),
            )
        if tableau.pivots >= limit:
            return PivotSolution(
                np.maximum(tableau.f, 0) * scale, tableau.pivots, False
            )
    return PivotSolution(
        np.maximum(tableau.refined(), 0.0) * scale, tableau.pivots, True
    )


class _Tableau:
    """A system with a diagonal of ones, its forces f, its w, who pushes, and who has been dealt with.

    ``answer[:, d]`` holds what a unit of force at d does: to f of those that
    push, which keep their w = 0, and to w of the others.
    """

    def __init__(self, a: Array, b: Array) -> None:
        self.a, self.b, self.answer = a, b, a.copy()
        self.f, self.w = np.zeros(b.size), b.copy()
        self.pushing: BoolArray = np.zeros(b.size, dtype=bool)
        self.dealt_with: BoolArray = np.zeros(b.size, dtype=bool)
        self.pivots = 0

    def settle(self, d: int, limit: int) -> Array | None:
        """Raise the force at d until w_d is 0; the ray if nothing stops it."""
        self.dealt_with[d] = True
        size, still = float(np.abs(self.b).max()), 0
        while not self.pushing[d] and self.w[d] < -COUNTS_AS_ZERO * (
            size + float(self.f.max())
        ):
            if self.pivots >= limit:
                return None
            change = self.answer[:, d].copy()
            step, who = self._first_to_stop(d, change, by_index=still > 5)
            if who is None:
                ray = np.where(self.pushing, np.maximum(change, 0.0), 0.0)
                ray[d] = 1.0
                return ray
            still = still + 1 if step <= 0 else 0
            self.f[self.pushing] += step * change[self.pushing]
            self.w[~self.pushing] += step * change[~self.pushing]
            self.f[d] += step
            self._exchange(who)
        if self.f[d] > 0 and not self.pushing[d] and self.answer[d, d] > COUNTS_AS_ZERO:
            self._exchange(d)
        return None

    def _first_to_stop(
        self, d: int, change: Array, by_index: bool
    ) -> tuple[float, int | None]:
        """How far the force at d may grow, and whose f or w is 0 then."""
        least = COUNTS_AS_ZERO * max(1.0, float(np.abs(change).max()))
        room = np.where(self.pushing, self.f, self.w)
        falls = (
            (change < -least)
            & self.dealt_with
            & (self.pushing | (self.answer.diagonal() > COUNTS_AS_ZERO))
        )
        falls[d] = change[d] > least
        who = np.flatnonzero(falls)
        if not who.size:
            return 0.0, None
        steps = np.maximum(
            np.where(who == d, -room[who], room[who]) / np.abs(change[who]), 0.0
        )
        step = float(steps.min())
        tied = who[steps <= step * (1 + 1e-12)]
        # Of those that stop it together the largest pivot is the safest, the
        # least index the one that cannot go round in circles.
        best = tied[0] if by_index else tied[np.argmax(np.abs(self.answer[tied, tied]))]
        return step, int(best)

    def _exchange(self, i: int) -> None:
        """f_i and w_i change places: i joins those that push, or leaves them."""
        self.pivots += 1
        self.f[i] = self.f[i] if not self.pushing[i] else 0.0
        self.w[i] = 0.0
        self.pushing[i] = not self.pushing[i]
        m = self.answer
        pivot, row, column = 1.0 / m[i, i], m[i].copy(), m[:, i].copy()
        column[i] = 0.0
        m -= (column * pivot)[:, None] * row
        m[:, i] = column * pivot
        m[i] = -row * pivot
        m[i, i] = pivot

    def refined(self) -> Array:
        """The forces once more from A itself, if that is better: many pivots add up rounding."""
        s = np.flatnonzero(self.f > 0)
        if not s.size:
            return self.f
        w = self.a[s] @ self.f + self.b[s]
        better = self.f.copy()
        better[s] -= np.linalg.lstsq(self.a[np.ix_(s, s)], w, rcond=1e-12)[0]
        worst = [
            float(np.abs(np.minimum(f, self.a @ f + self.b)).max())
            for f in (self.f, better)
        ]
        return better if worst[1] < worst[0] else self.f
