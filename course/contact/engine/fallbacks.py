"""Fallbacks: another guess for a small system; for an island in doubt the exact answer, a proof, other methods."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray
from course.contact.engine.acceptance import SUSPICIOUS, strays
from course.contact.engine.active_set import settle
from course.contact.engine.block_pivots import block_pivot_one
from course.contact.engine.certificates import certificate
from course.contact.engine.exact import solve_exact
from course.contact.engine.interior_point import solve_gauss
from course.contact.engine.least_distance import solve_nnls
from course.contact.engine.refusals import require_semidefinite
from course.contact.engine.scaling import ScaledSystem
from course.contact.solvers.arguments import dense
from course.contact.solvers.pivot import solve_pivot
from course.contact.solvers.qp import solve_qp
from course.contact.solvers.residual import products, violation_of

#: Up to how many contacts the exact answer is sought (a tenth of a second), and the dense methods are tried.
EXACT_UP_TO, PIVOT_UP_TO, NNLS_UP_TO = 40, 400, 1000
#: Eigenvalues below minus this are no rounding where methods fail, in units of A's diagonal.
INDEFINITE_IN_DOUBT = 1e-12
#: Eigenvalues below this a contact are rounding, in units of A's diagonal.
SINGULAR = 16 * np.finfo(float).eps
#: Forces this large beside b are only believed where no proof holds within rounding of A that there are none.
ENORMOUS = 1e11


@dataclass(frozen=True, eq=False)
class Found:
    """Forces and where they come from; whether they are right to rounding; or the proof that there are none."""

    force: Array
    iterations: int
    method: str
    to_rounding: bool = False
    proof: Array | None = None


def by_another_guess(matrix: Array, bias: Array, limit: int | None) -> Found:
    """A small system by block pivots once more, those pushing at first whose b is not above 0."""
    pushing = (bias <= 0) & (matrix.diagonal() > 0)
    found = block_pivot_one(matrix, bias, pushing=pushing, max_iterations=limit)
    return Found(found.force, found.iterations, "block_pivot")


class Island:
    """Contacts that depend on each other, each with a diagonal above 0.

    Args:
        matrix, bias: A and b of these contacts alone.
        rows: None, or what gives their J M^-1/2.
        tolerance, limit: of ``solve``.
        largest: the largest |b| of the whole system, against which the residual is measured.
    """

    def __init__(
        self,
        matrix: Any,
        bias: Array,
        rows: Callable[[], Any] | None,
        *,
        tolerance: float,
        limit: int | None,
        largest: float,
    ) -> None:
        self.a, self.b, self._rows = matrix, bias, rows
        self._tolerance, self._limit, self._largest = tolerance, limit, largest

    @cached_property
    def _unit(self) -> ScaledSystem:
        return ScaledSystem(self.a, self.b, self._rows)

    @cached_property
    def _known_rows(self) -> Any:
        return None if self._rows is None else self._rows()

    def best_there_is(self, guess: Array) -> Found:
        """The best there is: exact forces, forces that hold, or the proof that there are none."""
        require_semidefinite(self.a, least=INDEFINITE_IN_DOUBT)
        answer = self._exactly(guess)
        if answer is not None:
            return answer
        best, quality = Found(guess, 0, ""), self._quality(guess)
        if quality[0]:
            proof = certificate(self.a, self.b, guess, rows=self._known_rows)
            if proof is not None:
                return replace(best, proof=proof)
        for attempt in (self.by_gauss, self._by_pivot, self._by_nnls, self._by_qp):
            if not quality[0]:
                break
            found = attempt()
            if found is not None and (after := self._quality(found.force)) < quality:
                best, quality = found, after
        if np.any(self._violation(best.force) > SUSPICIOUS * np.abs(self.b).max()):
            # Excused by large forces, if at all: these may point to a proof that was missed.
            f, rows = best.force, self._known_rows
            proof = certificate(self.a, self.b, f, search=False, rows=rows)
            best = replace(best, proof=proof)
        return best

    def _violation(self, force: Array) -> Array:
        product = self.a @ force
        return violation_of(self.a.diagonal(), product, force, self.b)

    def _exactly(self, guess: Array) -> Found | None:
        """The answer of the stored numbers, where it is for them to tell."""
        if self.b.size > EXACT_UP_TO:
            return None
        a, holds = dense(self.a), not self._quality(guess)[0]
        found = solve_exact(a, self.b, guess > 0)
        if found.force is None:
            # Rounding of a singular A proves nothing about J; what is solved to the tolerance needs no proof.
            if found.certificate is None or self._rows or holds:
                return None
            return Found(guess, 0, "", proof=found.certificate)
        if holds and _singular(a, found.force > 0):
            # The exact forces hang on A's rounding then, and may be as large as one likes.
            return Found(guess, 0, "")
        size = np.abs(a) @ found.force
        if np.any(size > ENORMOUS * np.abs(self.b).max()):
            proof = certificate(a, self.b, found.force, rows=self._known_rows)
            if proof is not None:
                return Found(guess, 0, "", proof=proof)
        return Found(found.force, 1, "exact", to_rounding=True)

    def _quality(self, force: Array) -> tuple[bool, float]:
        """Whether it does not hold; the residual by the scale of the whole system, or how far contacts stray."""
        product, size = products(self.a, force)
        violation = violation_of(self.a.diagonal(), product, force, self.b)
        residual = float((violation / (size + self._largest)).max())
        missed = residual > self._tolerance
        astray = strays(violation, size, self.b, tolerance=self._tolerance)
        return missed or bool(np.any(astray)), residual

    def by_gauss(self, huge: float = np.inf) -> Found:
        """By accelerations; given up above huge times the largest b."""
        limit, unit = 100 if self._limit is None else self._limit, self._unit
        largest = huge * float(np.abs(unit.unit_bias).max())
        found = solve_gauss(
            unit, tolerance=self._tolerance, max_iterations=limit, largest=largest
        )
        return Found(found.force, found.iterations, "gauss")

    def _by_pivot(self) -> Found | None:
        if self.b.size > PIVOT_UP_TO:
            return None
        found = solve_pivot(dense(self.a), self.b)
        return Found(found.force, found.pivots, "pivot")

    def _by_nnls(self) -> Found | None:
        if self.b.size > NNLS_UP_TO:
            return None
        found = solve_nnls(dense(self.a), self.b)
        return Found(found.force, int(np.count_nonzero(found.force)), "nnls")

    def _by_qp(self) -> Found | None:
        force, count = settled_qp(self._unit, 1e-10, self._tolerance, None)
        return None if force is None else Found(force, count, "qp")


def settled_qp(
    unit: ScaledSystem, own: float, tolerance: float, limit: int | None
) -> tuple[Array | None, int]:
    """The quadratic programme in units of A's diagonal, and then its set of pushing contacts settled.

    The programme does not care about those units, its tolerances do. An
    interior point ends a little inside: where f and w are both 0 in truth,
    each is about the root of the gap, and only the set tells them from 0.
    """
    size = float(np.abs(unit.unit_bias).max())
    matrix = unit.matrix / (unit.root[:, None] * unit.root)
    found, count = solve_qp(
        matrix, unit.unit_bias / size, tolerance=own, max_iterations=limit
    )
    if found is None:
        return None, count
    at = np.maximum(found * size, 0.0)
    if count == limit:  # stopped on its way: that is the answer
        return unit.force(at), count
    motion = unit.operator.times(at) + unit.unit_bias
    better = settle(unit, at, at > motion, tolerance=tolerance)
    chosen = better.force if better.residual < unit.residual(at) else at
    return unit.force(chosen), count


def _singular(a: Array, pushing: BoolArray) -> bool:
    """Whether A_SS is singular to rounding, on a diagonal of ones."""
    index = np.flatnonzero(pushing)
    scale = 1 / np.sqrt(a.diagonal()[index])
    unit = (a[np.ix_(index, index)] * scale[:, None]) * scale
    return bool(np.linalg.eigvalsh(unit)[0] <= SINGULAR * index.size)
