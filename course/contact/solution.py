"""What a contact solver found, and the two ways in which there may be nothing to find."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray
from course.contact.assembly import ContactSystem
from course.contact.solvers.residual import (
    products,
    residual_of,
    strays,
    violation_of,
)

#: Of forces that are right to rounding, what their own rounding does to A f may reach this times the largest |b|.
SEEN = 1e-3


@dataclass(frozen=True, eq=False)
class ContactSolution:
    """Contact forces and what they lead to.

    Args:
        force: f >= 0, (..., c) [N]. It need not be unique; the accelerations of bodies are.
        acceleration: d_ddot = A f + b, (..., c) [m/s^2].
        residual: ``complementarity_residual`` of the force, (...).
        iterations: Newton systems, pivots, sweeps or sets, as the method
            counts, (...); the most of any part where a system falls apart.
        method: the name of the method; for "auto" those it used.
        converged: residual <= tolerance, and no contact approaches, or parts
            although it pushes, by more than 100 times that (or 1e-8) of max |b|
            beside what rounding of large forces excuses, (...).
    """

    force: Array
    acceleration: Array
    residual: Any
    iterations: Any
    method: str
    converged: Any


class NotConverged(RuntimeError):
    """No method reached the tolerance; ``solution`` is the best that was reached."""

    def __init__(self, message: str, solution: ContactSolution) -> None:
        super().__init__(message)
        self.solution = solution


class NoContactForce(RuntimeError):
    """No forces f >= 0 keep all d_ddot >= 0; ``certificate`` is the proof.

    It is y >= 0, (..., c), with J'y = 0 (so A y = 0) and b.y < 0: forces y
    move no body, yet d_ddot . y = b.y < 0 whatever f is, so some d_ddot is
    below 0. Zero means: of the stored numbers exactly, or to their own
    rounding, |A y| <= eps |A| y. Then a matrix whose entries differ from the
    stored ones by one unit in the last place proves that there is no force, and
    a force for the stored one itself would be enormous, (|A| f).y >= -b.y / eps.
    In a batch y is 0 for the systems that have a solution.
    """

    def __init__(self, message: str, certificate: Array) -> None:
        super().__init__(message)
        self.certificate = certificate


def contact_solution(
    system: ContactSystem,
    force: Array,
    iterations: Any,
    method: str,
    tolerance: float,
    *,
    known: tuple[Array, Array] | None = None,
    exact: BoolArray | None = None,
) -> ContactSolution:
    """The solution of this force: its accelerations, its residual, and whether it solves the system.

    known: A f and |A| |f| (``products``), if they are at hand. exact: (..., c),
    the contacts whose forces are right to rounding, however large they are.
    """
    product, size = products(system.A, force) if known is None else known
    residual = residual_of(system.diagonal, product, size, force, system.b)
    violation = violation_of(system.diagonal, product, force, system.b)
    missed = strays(violation, size, system.b, tolerance=tolerance)
    if exact is not None and np.any(exact & missed):
        largest = np.abs(system.b).max(axis=-1, keepdims=True, initial=0.0)
        missed &= ~exact | (np.finfo(float).eps * size > SEEN * largest)
    return ContactSolution(
        force,
        product + system.b,
        residual,
        iterations,
        method,
        (residual <= tolerance) & ~missed.any(axis=-1),
    )
