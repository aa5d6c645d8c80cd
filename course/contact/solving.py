"""One call for the forces of resting contact, whatever the method."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    IntArray,
    choice,
    failure,
    positive,
    scalar,
    scalars,
    whole_number,
    written,
)
from course.contact.assembly import ContactSystem
from course.contact.engine.acceptance import require_semidefinite
from course.contact.engine.automatic import solve_auto
from course.contact.engine.fallbacks import settled_qp
from course.contact.engine.interior_point import solve_gauss
from course.contact.engine.least_distance import solve_nnls
from course.contact.engine.mass_weighting import mass_weighted_jacobian
from course.contact.engine.scaling import ScaledSystem
from course.contact.solution import ContactSolution, NotConverged, contact_solution
from course.contact.solvers.pivot import solve_pivot

#: A b below this, or above its inverse, is solved for in another unit.
SMALLEST = 1e-30

METHODS = ("auto", "qp", "nnls", "pivot", "projected_gauss_seidel", "gauss")


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
    "auto" takes the system apart where contacts do not depend on each other,
        chooses for each part, checks, and tries the next method if need be.

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
    if not isinstance(system, ContactSystem):
        raise failure("system", "a ContactSystem", type(system).__name__)
    choice("method", method, METHODS)
    tolerance = scalar("tolerance", positive("tolerance", tolerance))
    limit = (
        None
        if max_iterations is None
        else whole_number("max_iterations", max_iterations, minimum=1)
    )
    relaxation = scalar("relaxation", relaxation)
    if not 0 < relaxation < 2:
        raise failure("relaxation", "a number above 0 and below 2", written(relaxation))
    begin = None if start is None else scalars("start", start)
    if begin is not None and begin.shape != system.b.shape:
        raise failure("start", f"shape {system.b.shape}", f"shape {begin.shape}")
    if method == "gauss" and system.jacobian is None:
        raise failure(
            "system", "jacobian and inverse_mass for method 'gauss'", "A and b alone"
        )
    run = partial(
        _solved, method=method, tolerance=tolerance, limit=limit, relaxation=relaxation
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


def _solved(
    system: ContactSystem,
    begin: Any,
    *,
    method: str,
    tolerance: float,
    limit: int | None,
    relaxation: float,
) -> ContactSolution:
    if method == "auto":
        return solve_auto(
            system, tolerance=tolerance, max_iterations=limit, start=begin
        )
    if system.jacobian is None:
        require_semidefinite(system.A)
    one = _ONE[method]
    count = len(system)
    force = np.zeros(system.b.shape)
    iterations = np.zeros(system.b.shape[:-1], dtype=np.intp)
    for index in np.ndindex(iterations.shape):
        a, b = (
            (system.A, system.b)
            if system.b.ndim == 1
            else (system.A[index], system.b[index])
        )
        pushing = np.flatnonzero(a.diagonal() > 0)
        if not np.any(b[pushing] < 0):
            continue
        if pushing.size < count:  # contacts that no force moves
            a, b = a[pushing][:, pushing], b[pushing]
        options = _Options(
            system,
            pushing,
            tolerance,
            limit,
            relaxation,
            None if begin is None else begin[index],
        )
        found, iterations[index] = one(a, b, options)
        force[(*index, pushing)] = np.maximum(found, 0.0)
    return contact_solution(system, force, iterations[()], method, tolerance)


class _Options:
    """What the methods may need besides A and b of the contacts that can push."""

    def __init__(
        self,
        system: ContactSystem,
        pushing: IntArray,
        tolerance: float,
        limit: int | None,
        relaxation: float,
        start: Any,
    ) -> None:
        self.system, self.pushing = system, pushing
        self.tolerance, self.limit, self.relaxation = tolerance, limit, relaxation
        self.start = None if start is None else start[pushing]

    @property
    def factor(self) -> Any:
        """J M^-1/2 of those contacts, or None."""
        factor = mass_weighted_jacobian(self.system)
        return None if factor is None else factor[self.pushing]


def _dense(a: Any) -> Array:
    return a.toarray() if hasattr(a, "toarray") else a


def _qp(a: Any, b: Array, options: _Options) -> tuple[Array, int]:
    # The solver stops at a gap, and where f and w are both small each is its root: so a hundredth, if it can.
    unit = ScaledSystem(a, b)
    for own in (0.01 * options.tolerance, options.tolerance):
        found, count = settled_qp(unit, own, options.tolerance, options.limit)
        if found is not None:
            return found, count
    return np.zeros(b.size), count


def _nnls(a: Any, b: Array, options: _Options) -> tuple[Array, int]:
    factor = options.factor
    found = solve_nnls(_dense(a), b, factor=None if factor is None else _used(factor).T)
    return found.force, int(np.count_nonzero(found.force))


def _used(factor: Any) -> Array:
    """The columns of J M^-1/2 that hold something, dense."""
    return factor[:, np.unique(factor.indices)].toarray()


def _pivot(a: Any, b: Array, options: _Options) -> tuple[Array, int]:
    found = solve_pivot(_dense(a), b, max_pivots=options.limit)
    return found.force, found.pivots


def _sweeps(a: Any, b: Array, options: _Options) -> tuple[Array, int]:
    from course.contact.solvers.projected_gauss_seidel import (
        solve_projected_gauss_seidel,
    )

    limit = 10_000 if options.limit is None else options.limit
    found = solve_projected_gauss_seidel(
        a,
        b,
        tolerance=options.tolerance,
        max_sweeps=limit,
        relaxation=options.relaxation,
        start=options.start,
    )
    return found.force, found.sweeps


def _gauss(a: Any, b: Array, options: _Options) -> tuple[Array, int]:
    limit = 100 if options.limit is None else options.limit
    factor = options.factor
    system = ScaledSystem(a, b, None if factor is None else lambda: factor)
    found = solve_gauss(system, tolerance=options.tolerance, max_iterations=limit)
    return found.force, found.iterations


_ONE: dict[str, Callable[[Any, Array, _Options], tuple[Array, int]]] = {
    "qp": _qp,
    "nnls": _nnls,
    "pivot": _pivot,
    "projected_gauss_seidel": _sweeps,
    "gauss": _gauss,
}
