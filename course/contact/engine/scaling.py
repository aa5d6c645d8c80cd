"""Scaling: from A to D^-1/2 A D^-1/2 with a diagonal of ones, on which Newton steps and active sets work."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from course.arrays import Array
from course.contact.engine.acceptance import strays
from course.contact.engine.regularization import RegularizedSystem, regularized
from course.contact.solvers.residual import scaled_rows, violation_of


class ScaledSystem:
    """D^-1/2 A D^-1/2, D^-1/2 b and, for a force D^1/2 f of it, the residual of the system it came from.

    Args:
        matrix: A, (c, c), sparse or dense, its diagonal above 0.
        bias: b, (c,).
        rows: None, or what gives G', sparse (c, m) with A = G'G, such as J M^-1/2, if it is needed.
    """

    def __init__(
        self, matrix: Any, bias: Array, rows: Callable[[], Any] | None = None
    ) -> None:
        self.matrix, self.bias, self._rows = matrix, bias, rows
        self.diagonal: Array = matrix.diagonal()
        self.root = np.sqrt(self.diagonal)
        self.unit_bias = bias / self.root
        self._magnitude = abs(matrix)

    def __len__(self) -> int:
        return self.bias.size

    @cached_property
    def operator(self) -> RegularizedSystem:
        """The matrix with ones on its diagonal."""
        inverse = 1.0 / self.root
        if not hasattr(self.matrix, "tocsr"):
            return regularized(self.matrix * (inverse[:, None] * inverse))
        a = _scaled(self.matrix, inverse)
        a.data *= inverse[a.indices]
        rows = self._rows
        return regularized(
            a, None if rows is None else lambda: _scaled(rows(), inverse)
        )

    def force(self, unit_force: Array) -> Array:
        """f of the system it came from."""
        return unit_force / self.root

    def tried(self, unit_force: Array) -> Trial:
        """What this force leads to."""
        return Trial(self, unit_force)

    def residual(self, unit_force: Array) -> float:
        """``complementarity_residual`` of this force in the system it came from."""
        return self.tried(unit_force).residual

    def products(self, unit_force: Array) -> tuple[Array, Array, Array]:
        """f, A f and |A| |f| of the system it came from."""
        f = self.force(unit_force)
        return f, self.matrix @ f, self._magnitude @ np.abs(f)


@dataclass(frozen=True, eq=False)
class Trial:
    """A force of the unit system and, found when asked for, what it leads to in the system it came from."""

    system: ScaledSystem
    unit_force: Array

    @cached_property
    def products(self) -> tuple[Array, Array, Array]:
        """f, A f and |A| |f|."""
        return self.system.products(self.unit_force)

    @cached_property
    def rows(self) -> tuple[Array, Array]:
        """D f and A f + b, each row by its scale (``scaled_rows``)."""
        force, product, size = self.products
        return scaled_rows(self.system.diagonal, product, size, force, self.system.bias)

    @cached_property
    def residual(self) -> float:
        """``complementarity_residual``."""
        return float(np.max(np.abs(np.minimum(*self.rows)), initial=0.0))

    def stray(self, tolerance: float) -> float:
        """The largest |min(D f, w)|, 0 where no contact ``strays`` for a residual of this tolerance."""
        force, product, size = self.products
        system = self.system
        violation = violation_of(system.diagonal, product, force, system.bias)
        if not np.any(strays(violation, size, system.bias, tolerance=tolerance)):
            return 0.0
        return float(np.max(violation))

    @property
    def unit_acceleration(self) -> Array:
        """A f + b of the unit system."""
        return self.products[1] / self.system.root + self.system.unit_bias

    @property
    def unit_magnitude(self) -> Array:
        """|A| |f| + |b| of the unit system: what A f + b is rounded from."""
        return self.products[2] / self.system.root + np.abs(self.system.unit_bias)


def _scaled(rows: Any, scale: Array) -> Any:
    """A sparse matrix with its rows multiplied."""
    from scipy.sparse import csr_array

    rows = csr_array(rows)
    data = rows.data * np.repeat(scale, np.diff(rows.indptr))
    return csr_array((data, rows.indices, rows.indptr), shape=rows.shape)
