"""A contact system taken apart: each part solved by what suits it, judged, and rescued by other methods.

Contacts that share no free body, not even through others, do not depend on
each other: they are separate islands. Small islands of like size are solved
together as one batch; large ones by the interior point method. What was found
is judged by the residual of the whole system. Where it is too large, or where
forces ran away, the other methods are tried, and a proof that there is nothing
to find.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.contact.contact_system import ContactSystem
from course.contact.judgement import HUGE, doubtful, require_semidefinite
from course.contact.solvers.active_set import settle
from course.contact.solvers.block_pivot import block_pivot, block_pivot_one
from course.contact.solvers.certificate import certificate
from course.contact.solvers.gauss import solve_gauss
from course.contact.solvers.mass_factor import mass_factor
from course.contact.solvers.nnls import solve_nnls
from course.contact.solvers.pivot import solve_pivot
from course.contact.solvers.qp import solve_qp
from course.contact.solvers.residual import SUSPICIOUS, products, runs_away, scaled_rows
from course.contact.solvers.unit_system import UnitSystem

#: Islands of up to this many contacts go to ``block_pivot``, in batches.
SMALL = 128
#: Systems of up to this many contacts are not looked through for islands: that costs more than solving them whole.
WHOLE = SMALL
#: Sizes to which small islands are filled up, so that they form few batches.
SIZES = np.array([1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, SMALL])
#: Up to how many contacts the dense methods are tried.
PIVOT_UP_TO, NNLS_UP_TO = 400, 1000


class Parts:
    """One system, its forces as they are found, and the proof where there are none.

    After ``solve``: force, (c,), the best there is; proof, (c,), 0 but where no
    force exists; iterations, the most of any part; method, all that were used.
    """

    def __init__(
        self, system: ContactSystem, tolerance: float, limit: int | None
    ) -> None:
        self.system, self.tolerance, self.limit = system, tolerance, limit
        # Small matrices are handled faster dense.
        self.matrix = dense(system.A) if system.b.size <= SMALL else system.A
        self.force, self.proof = np.zeros(system.b.shape), np.zeros(system.b.shape)
        self.iterations, self._used, self._factor = 0, set[str](), None
        self._largest = float(np.abs(system.b).max(initial=0.0))

    @property
    def method(self) -> str:
        return "auto: " + (", ".join(sorted(self._used)) or "nothing pushes")

    def solve(self) -> None:
        """Island by island; those that fail by other methods."""
        a, b = self.matrix, self.system.b
        diagonal = a.diagonal()
        nothing_helps = (diagonal == 0) & (b < 0)
        if np.any(nothing_helps):
            self.proof[nothing_helps] = 1.0
            return
        if not np.any(b < 0):
            return
        label = _islands(self.system.A)
        size = np.bincount(label)
        approaching = np.bincount(label, weights=b < 0) > 0
        if size.size == 1 and b.size <= SMALL:
            # Another first guess than the one that failed before a small system came here.
            found = block_pivot_one(
                a, b, pushing=(b <= 0) & (diagonal > 0), max_iterations=self.limit
            )
            self._take(slice(None), found.force, found.iterations, "block_pivot")
        else:
            self._small(self.system.A, label, size, approaching & (size <= SMALL))
            for island in np.flatnonzero(approaching & (size > SMALL)):
                index = (
                    slice(None) if size.size == 1 else np.flatnonzero(label == island)
                )
                self._take(index, *self._by_gauss(index, huge=10 * HUGE))
        failing = self._failing(a, b, diagonal, label)
        for island in np.unique(label[failing]) if np.any(failing) else ():
            self._rescue(np.flatnonzero((label == island) & (diagonal > 0)))

    def _small(
        self, a: Any, label: IntArray, size: IntArray, chosen: BoolArray
    ) -> None:
        """All small islands, in batches of like size."""
        if not np.any(chosen):
            return
        from scipy.sparse import csr_array

        entries = csr_array(a).tocoo()
        local = np.empty(label.size, dtype=np.intp)
        order = np.argsort(label, kind="stable")
        local[order] = np.arange(label.size) - np.repeat(np.cumsum(size) - size, size)
        filled = SIZES[np.searchsorted(SIZES, np.minimum(size, SMALL))]
        for count in np.unique(filled[chosen]):
            islands = np.flatnonzero(chosen & (filled == count))
            slot = np.full(size.size, -1)
            slot[islands] = np.arange(islands.size)
            # A contact with a = 1 and b = 0 fills up: it takes no force.
            matrix, bias = (
                np.tile(np.eye(count), (islands.size, 1, 1)),
                np.zeros((islands.size, count)),
            )
            here = slot[label[entries.row]] >= 0
            row, column = entries.row[here], entries.col[here]
            matrix[slot[label[row]], local[row], local[column]] = entries.data[here]
            contacts = np.flatnonzero(slot[label] >= 0)
            where = (slot[label[contacts]], local[contacts])
            bias[where] = self.system.b[contacts]
            found = block_pivot(matrix, bias, max_iterations=self.limit)
            self._take(
                contacts, found.force[where], int(found.iterations.max()), "block_pivot"
            )

    def _take(self, index: Any, force: Array, iterations: int, method: str) -> None:
        self.force[index] = force
        self.iterations = max(self.iterations, iterations)
        self._used.add(method)

    def _failing(self, a: Any, b: Array, diagonal: Array, label: IntArray) -> BoolArray:
        """Which contacts miss the tolerance, or have forces that are not to be believed yet."""
        product, size = products(a, self.force)
        push, motion = scaled_rows(diagonal, product, size, self.force, b)
        largest = np.zeros(int(label.max()) + 1)
        np.maximum.at(largest, label, np.abs(b))
        missed = np.abs(np.minimum(push, motion)) > self.tolerance
        return missed | doubtful(product, size, b, largest[label])

    def _rescue(self, index: IntArray) -> None:
        """An island that the first method did not solve: a proof, or other methods, or the best there is."""
        a, b = self.system.A[index][:, index], self.system.b[index]
        require_semidefinite(a)
        proof = certificate(a, b, self.force[index], factor=self._rows(index))
        if proof is not None:
            self.proof[index] = proof
            return
        best = self.force[index]
        least, approaches = self._judged(a, b, best)
        for attempt in (self._by_gauss, self._by_pivot, self._by_nnls, self._by_qp):
            if least <= self.tolerance and not approaches:
                break
            found = attempt(index)
            if found is None:
                continue
            residual, still = self._judged(a, b, found[0])
            if residual < least or (residual <= self.tolerance and not still):
                best, least, approaches = found[0], residual, still
                self._take(index, *found)
        self.force[index] = best
        if np.any(a @ best + b < -SUSPICIOUS * self._largest):
            # However large the forces are: these may point to a proof that was missed.
            proof = certificate(a, b, best, search=False, factor=self._rows(index))
            self.proof[index] = 0.0 if proof is None else proof

    def _judged(self, a: Any, b: Array, force: Array) -> tuple[float, bool]:
        """The residual of an island by the scale of the whole system, and whether forces seem to run away."""
        product, size = products(a, force)
        residual = np.abs(np.minimum(a.diagonal() * force, product + b)) / (
            size + self._largest
        )
        return float(residual.max()), bool(np.any(runs_away(product, size, b)))

    def _rows(self, index: Any) -> Any:
        """J M^-1/2 of these contacts, or None."""
        if self._factor is None:
            self._factor = mass_factor(self.system)
        return None if self._factor is None else self._factor[index]

    def _unit(self, index: Any) -> UnitSystem:
        a = (
            self.system.A
            if isinstance(index, slice)
            else self.system.A[index][:, index]
        )
        rows = None if self.system.jacobian is None else partial(self._rows, index)
        return UnitSystem(a, self.system.b[index], rows)

    def _by_gauss(self, index: Any, huge: float = np.inf) -> tuple[Array, int, str]:
        limit, unit = 100 if self.limit is None else self.limit, self._unit(index)
        largest = huge * float(np.abs(unit.unit_bias).max())
        found = solve_gauss(
            unit, tolerance=self.tolerance, max_iterations=limit, largest=largest
        )
        return found.force, found.iterations, "gauss"

    def _by_pivot(self, index: Any) -> tuple[Array, int, str] | None:
        unit = self._unit(index)
        if len(unit) > PIVOT_UP_TO:
            return None
        found = solve_pivot(dense(unit.matrix), unit.bias)
        return found.force, found.pivots, "pivot"

    def _by_nnls(self, index: Any) -> tuple[Array, int, str] | None:
        unit = self._unit(index)
        if len(unit) > NNLS_UP_TO:
            return None
        found = solve_nnls(dense(unit.matrix), unit.bias)
        return found.force, int(np.count_nonzero(found.force)), "nnls"

    def _by_qp(self, index: Any) -> tuple[Array, int, str] | None:
        unit = self._unit(index)
        size = float(np.abs(unit.unit_bias).max())
        scaled = dense(unit.matrix) / (unit.root[:, None] * unit.root)
        found, count = solve_qp(scaled, unit.unit_bias / size, tolerance=1e-10)
        if found is None:
            return None
        at = np.maximum(found * size, 0.0)
        motion = unit.operator.times(at) + unit.unit_bias
        better = settle(unit, at, at > motion, tolerance=self.tolerance)
        chosen = better.force if better.residual < unit.residual(at) else at
        return unit.force(chosen), count, "qp"


def _islands(a: Any) -> IntArray:
    """For each contact the number of the island it belongs to."""
    if a.shape[0] <= WHOLE:
        return np.zeros(a.shape[0], dtype=np.intp)
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import connected_components

    return connected_components(csr_array(a), directed=False)[1].astype(np.intp)


def dense(a: Any) -> Array:
    return a.toarray() if hasattr(a, "toarray") else a
