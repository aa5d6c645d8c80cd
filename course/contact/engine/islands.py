"""Islands: a contact system taken apart, each island solved by what suits it, checked, or left to the fallbacks.

Contacts that share no free body, not even through others, do not depend on
each other: they are separate islands. Small islands of like size are solved
together as one batch; large ones by the interior point method. What was found
is accepted by the residual of the whole system. Where it is too large, or where
forces ran away, the other methods are tried, and a proof that there is nothing
to find.
"""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from course.arrays import BoolArray, IntArray
from course.contact.engine.acceptance import (
    HUGE,
    LARGE,
    RESIDUAL_ROUNDING,
    SUSPICIOUS,
    strays,
)
from course.contact.engine.block_pivots import block_pivot
from course.contact.engine.fallbacks import (
    EXACT_UP_TO,
    Found,
    Island,
    by_another_guess,
)
from course.contact.engine.mass_weighting import mass_weighted_jacobian
from course.contact.engine.refusals import require_semidefinite
from course.contact.solvers.arguments import dense, proof_by_the_unmoved
from course.contact.solvers.residual import products, violation_of
from course.contact.systems import ContactSystem

#: Islands of up to this many contacts go to ``block_pivot``, in batches.
SMALL = 128
#: Systems of up to this many contacts are not looked through for islands: that costs more than solving them whole.
WHOLE = SMALL
#: Sizes to which small islands are filled up, so that they form few batches.
SIZES = np.array([1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, SMALL])


class Islands:
    """One system, its forces as they are found, and the proof where there are none.

    After ``solve``: force, (c,), the best there is; proof, (c,), 0 but where no
    force exists; iterations, the most of any island; method, all that were used.
    """

    def __init__(
        self, system: ContactSystem, tolerance: float, limit: int | None
    ) -> None:
        self.system, self.tolerance, self.limit = system, tolerance, limit
        # Small matrices are handled faster dense.
        self.matrix = dense(system.A) if system.b.size <= SMALL else system.A
        self.force, self.proof = np.zeros(system.b.shape), np.zeros(system.b.shape)
        self.to_rounding = np.zeros(system.b.shape, dtype=bool)
        self.iterations, self._used = 0, set[str]()
        self._all_rows: Any = None
        self._largest = float(np.abs(system.b).max(initial=0.0))

    @property
    def method(self) -> str:
        return "auto: " + (", ".join(sorted(self._used)) or "nothing pushes")

    def solve(self) -> None:
        """Island by island; those that fail by other methods."""
        a, b = self.matrix, self.system.b
        diagonal = a.diagonal()
        if self.system.jacobian is None or b.size <= SMALL:
            require_semidefinite(a)
        unmoved = proof_by_the_unmoved(diagonal, b)
        if unmoved is not None:
            self.proof = unmoved
            return
        if not np.any(b < 0):
            return
        label = _labels(self.system.A)
        size = np.bincount(label)
        approaching = np.bincount(label, weights=b < 0) > 0
        if size.size == 1 and b.size <= SMALL:
            # A small system has been tried whole before it came here.
            self._take(slice(None), by_another_guess(a, b, self.limit))
        else:
            self._small(self.system.A, label, size, approaching & (size <= SMALL))
            for island in np.flatnonzero(approaching & (size > SMALL)):
                index = (
                    slice(None) if size.size == 1 else np.flatnonzero(label == island)
                )
                self._take(index, self._island(index).by_gauss(huge=10 * HUGE))
        for island in self._failing(label, size > SMALL):
            self._fall_back(np.flatnonzero((label == island) & (diagonal > 0)))

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
            rounds = int(found.iterations.max())
            self._take(contacts, Found(found.force[where], rounds, "block_pivot"))

    def _take(self, index: Any, found: Found) -> None:
        self.force[index], self.to_rounding[index] = found.force, found.to_rounding
        self.iterations = max(self.iterations, found.iterations)
        self._used.add(found.method)

    def _failing(self, label: IntArray, large: BoolArray) -> IntArray:
        """Islands that miss the tolerance, or whose forces are not to be believed yet.

        Small ones are held to rounding, ``large`` ones to what the interior point method can do.
        """
        a, b, force = self.matrix, self.system.b, self.force
        diagonal = a.diagonal()
        product, size = products(a, force)
        violation = violation_of(diagonal, product, force, b)
        missed = violation > self.tolerance * (size + self._largest)
        largest, beyond = np.zeros((2, int(label.max()) + 1))
        np.maximum.at(largest, label, np.abs(b))
        astray = strays(
            violation, size, b, largest=largest[label], tolerance=self.tolerance
        )
        scale = size + largest[label]
        np.maximum.at(beyond, label, violation / np.where(scale > 0, scale, np.inf))
        count = np.bincount(label)
        unsure = ~large & (beyond > RESIDUAL_ROUNDING * count)
        hard = (count[label] <= EXACT_UP_TO) | (violation > SUSPICIOUS * largest[label])
        astray |= (size > LARGE * largest[label]) & hard
        return np.unique(np.append(label[missed | astray], np.flatnonzero(unsure)))

    def _fall_back(self, index: IntArray) -> None:
        """An island that the first method did not surely solve; one more look whether it falls apart."""
        label = _connected(self.system.A[index][:, index])
        for k in range(int(label.max(initial=-1)) + 1):
            here = index[label == k]
            if not np.any(self.system.b[here] < 0):
                continue
            found = self._island(here).best_there_is(self.force[here])
            if found.proof is not None:
                self.proof[here] = found.proof
            if found.method:
                self._take(here, found)

    def _island(self, index: Any) -> Island:
        whole = isinstance(index, slice)
        a = self.system.A if whole else self.system.A[index][:, index]
        return Island(
            a,
            self.system.b[index],
            None if self.system.jacobian is None else partial(self._rows, index),
            tolerance=self.tolerance,
            limit=self.limit,
            largest=self._largest,
        )

    def _rows(self, index: Any) -> Any:
        """J M^-1/2 of these contacts."""
        if self._all_rows is None:
            self._all_rows = mass_weighted_jacobian(self.system)
        return self._all_rows[index]


def _labels(a: Any) -> IntArray:
    """For each contact the number of the island it belongs to."""
    if a.shape[0] <= WHOLE:
        return np.zeros(a.shape[0], dtype=np.intp)
    return _connected(a)


def _connected(a: Any) -> IntArray:
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import connected_components

    return connected_components(csr_array(a), directed=False)[1].astype(np.intp)
