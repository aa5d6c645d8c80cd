"""ContactSystem: A and b of d_ddot = A f + b, checked once for all that solve it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, failure, scalars, shaped, vectors, written


@dataclass(frozen=True, eq=False)
class ContactSystem:
    """A and b of d_ddot = A f + b, and what they were made of.

    Args:
        A: (c, c), sparse or dense, or a dense batch (..., c, c); symmetric
            and positive semidefinite [1/kg].
        b: (c,) or (..., c), d_ddot without contact forces [m/s^2].
        jacobian: J, sparse (c, 6n); d_dot = J v for the velocities of all
            bodies, velocity then angular velocity, body by body. Columns of
            fixed bodies are zero.
        inverse_mass: M^-1, sparse (6n, 6n), of 6 x 6 blocks; A = J M^-1 J'.
        free_acceleration: (6n,), without contact forces, in the same order.
    The last three come together, with a sparse or dense A of one system;
    method "gauss" needs them.
    Raises:
        ValueError: shapes that do not belong together, NaN or infinity, A not
            symmetric or with a negative diagonal.
    """

    A: Any
    b: Array
    jacobian: Any = None
    inverse_mass: Any = None
    free_acceleration: Array | None = None

    def __post_init__(self) -> None:
        from scipy.sparse import csr_array, issparse

        b = scalars("b", self.b)
        if issparse(self.A):
            matrix = csr_array(self.A)
            scalars("A", matrix.data)
            if b.ndim != 1:
                raise failure("b", "shape (c,) with a sparse A", f"shape {b.shape}")
            shaped("A", matrix, (b.size, b.size))
            off, size = (
                abs(matrix - matrix.T).max() if b.size else 0.0,
                abs(matrix).max() if b.size else 0.0,
            )
        else:
            matrix = scalars("A", self.A)
            if b.ndim < 1:
                raise failure("b", "shape (c,) or (..., c)", f"shape {b.shape}")
            shaped("A", matrix, (*b.shape, b.shape[-1]))
            off = np.abs(matrix - np.swapaxes(matrix, -1, -2)).max(initial=0.0)
            size = np.abs(matrix).max(initial=0.0)
        if off > 1e-9 * size:
            raise failure("A", "a symmetric matrix", f"asymmetry {written(off)}")
        object.__setattr__(self, "A", matrix)
        object.__setattr__(self, "b", b)
        least = self.diagonal.min(initial=0.0)
        if least < 0:
            raise failure(
                "A",
                "a positive semidefinite matrix",
                f"{written(least)} on its diagonal",
            )
        self._check_origin()

    def _check_origin(self) -> None:
        parts = (self.jacobian, self.inverse_mass, self.free_acceleration)
        if all(part is None for part in parts):
            return
        if any(part is None for part in parts):
            expected = "jacobian, inverse_mass and free_acceleration together, or none"
            raise failure("jacobian", expected, "only some of them")
        assert self.free_acceleration is not None
        free = vectors(
            "free_acceleration",
            self.free_acceleration,
            size=np.size(self.free_acceleration),
        )
        if free.ndim != 1 or free.size % 6:
            raise failure("free_acceleration", "shape (6n,)", f"shape {free.shape}")
        if self.b.ndim != 1:
            raise failure(
                "jacobian",
                "None for a batch of systems",
                f"shape {np.shape(self.jacobian)}",
            )
        shaped("jacobian", self.jacobian, (self.b.size, free.size))
        shaped("inverse_mass", self.inverse_mass, (free.size, free.size))

    def __len__(self) -> int:
        """How many contacts a system has."""
        return self.b.shape[-1]

    @property
    def diagonal(self) -> Array:
        """D, the diagonal of A, (..., c): d_ddot of a contact by a unit of its own force [1/kg]."""
        return (
            self.A.diagonal()
            if hasattr(self.A, "tocsr")
            else np.diagonal(self.A, axis1=-2, axis2=-1)
        )
