"""``solve``: one call for the forces of resting contact, whatever the method."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    choice,
    failure,
    positive,
    scalar,
    scalars,
    whole_number,
)
from course.contact.solution import ContactSolution, NotConverged
from course.contact.solvers.arguments import relaxation_of
from course.contact.systems import ContactSystem

#: A b below this, or above its inverse, is solved for in another unit.
SMALLEST = 1e-30


def solve(
    system: ContactSystem,
    *,
    method: str = "auto",
    tolerance: float = 1e-10,
    max_iterations: int | None = None,
    relaxation: float = 1.0,
    start: ArrayLike | None = None,
) -> ContactSolution:
    """Contact forces f >= 0 with d_ddot = A f + b >= 0 and f.d_ddot = 0 (syllabus rows 20, 21 and 25).

    "qp" the quadratic programme of row 25, through CVXPY and Clarabel;
    "nnls" non-negative least squares, after Lawson and Hanson;
    "pivot" one contact after the other, Baraff's method;
    "projected_gauss_seidel" sweeps; iterations are sweeps;
    "gauss" Gauss' principle in accelerations, an interior point method;
        needs the system's jacobian and inverse mass;
    "auto" takes the system apart into islands, which do not depend on each other,
        chooses for each, checks, and tries the next method if need be.

    Only "auto" raises where it does not converge; every other method returns
    what it reached, with its residual. f need not be unique, where contacts
    are redundant; A f, and so the motion, is.

    Args:
        system: of ``contact_system``, or A and b, or a dense batch of them.
        method: one of the six.
        tolerance: the residual (``complementarity_residual``) to reach.
        max_iterations: limit of the method's own count; each has its own
            where none is given.
        relaxation: for "projected_gauss_seidel", above 0 and below 2.
        start: force to begin with, (..., c); for "projected_gauss_seidel", and
            for "auto", which keeps it if it solves the system already.
    Returns:
        Force, acceleration, residual, iterations, method and converged.
    Raises:
        ValueError: an unknown method, wrong shapes, "gauss" without the jacobian.
        NoContactForce: "auto" found the proof that no force exists.
        NotConverged: "auto" did not reach the tolerance; has the best found.
    Example:
        Two contacts that feel each other; clipping each step of Gauss-Seidel by itself would answer (1, 0.5).

        >>> from course.contact import ContactSystem
        >>> answer = solve(ContactSystem(np.array([[1.0, 0.5], [0.5, 1.0]]), np.array([-1.0, -1.0])))
        >>> answer.force.round(4), bool(answer.converged)
        (array([0.6667, 0.6667]), True)
    """
    # Here, so that whoever only needs the geometry of contacts does not load every solver.
    from course.contact.engine.methods import METHODS, solved

    if not isinstance(system, ContactSystem):
        raise failure("system", "a ContactSystem", type(system).__name__)
    choice("method", method, METHODS)
    tolerance = scalar("tolerance", positive("tolerance", tolerance))
    limit = (
        None
        if max_iterations is None
        else whole_number("max_iterations", max_iterations, minimum=1)
    )
    relaxation = relaxation_of(relaxation)
    begin = None if start is None else scalars("start", start)
    if begin is not None and begin.shape != system.b.shape:
        raise failure("start", f"shape {system.b.shape}", f"shape {begin.shape}")
    if method == "gauss" and system.jacobian is None:
        raise failure(
            "system", "jacobian and inverse_mass for method 'gauss'", "A and b alone"
        )
    run = partial(
        solved, method=method, tolerance=tolerance, limit=limit, relaxation=relaxation
    )
    unit = _power_of_two(system.b)
    return run(system, begin) if unit is None else _in_units(system, unit, begin, run)


def _power_of_two(b: Array) -> Array | None:
    """About the size of each system's b, (..., 1), if the squares of any would leave the range of floating point."""
    size = np.abs(b).max(axis=-1, keepdims=True, initial=0.0)
    far = (size > 0) & ((size < SMALLEST) | (size > 1 / SMALLEST))
    return (
        None
        if not far.any()
        else np.where(far, np.ldexp(1.0, np.clip(np.frexp(size)[1], -1021, 1022)), 1.0)
    )


def _in_units(
    system: ContactSystem,
    unit: Array,
    start: Any,
    solved: Callable[[ContactSystem, Any], ContactSolution],
) -> ContactSolution:
    """Solved for b / unit: forces and accelerations are proportional to b."""
    scaled = replace(system, b=system.b / unit)

    def back(found: ContactSolution) -> ContactSolution:
        return replace(
            found, force=found.force * unit, acceleration=found.acceleration * unit
        )

    try:
        return back(solved(scaled, None if start is None else start / unit))
    except NotConverged as error:
        raise NotConverged(str(error), back(error.solution)) from None
