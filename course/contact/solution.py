"""What a contact solver found, and the two ways in which there may be nothing to find."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from course.arrays import Array


@dataclass(frozen=True, eq=False)
class ContactSolution:
    """Contact forces and what they lead to.

    Args:
        force: f >= 0, (..., c) [N]. It need not be unique; the accelerations of bodies are.
        acceleration: d_ddot = A f + b, (..., c) [m/s^2].
        residual: ``complementarity_residual`` of the force, (...).
        iterations: Newton systems, pivots, sweeps or sets, as the method
            counts, (...); the most of any island where a system falls apart.
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
