"""The methods of ``solve`` by name: each on the contacts that can push, system by system."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from course.arrays import Array, IntArray
from course.contact.engine.acceptance import contact_solution
from course.contact.engine.automatic import solve_auto
from course.contact.engine.fallbacks import settled_qp
from course.contact.engine.interior_point import solve_gauss
from course.contact.engine.least_distance import solve_nnls
from course.contact.engine.mass_weighting import mass_weighted_jacobian
from course.contact.engine.refusals import require_semidefinite
from course.contact.engine.scaling import ScaledSystem
from course.contact.solution import ContactSolution
from course.contact.solvers.arguments import dense
from course.contact.solvers.pivot import solve_pivot
from course.contact.systems import ContactSystem


def solved(
    system: ContactSystem,
    begin: Any,
    *,
    method: str,
    tolerance: float,
    limit: int | None,
    relaxation: float,
) -> ContactSolution:
    """``solve`` with arguments that have been checked; begin: the start, or None."""
    if method == "auto":
        return solve_auto(
            system, tolerance=tolerance, max_iterations=limit, start=begin
        )
    if system.jacobian is None:
        require_semidefinite(system.A)
    one = _ONE_SYSTEM[method]
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
        known = None if begin is None else begin[index]
        options = _Options(system, pushing, tolerance, limit, relaxation, known)
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
    def rows(self) -> Any:
        """J M^-1/2 of those contacts, or None."""
        rows = mass_weighted_jacobian(self.system)
        return None if rows is None else rows[self.pushing]


def _qp(a: Any, b: Array, options: _Options) -> tuple[Array, int]:
    # The solver stops at a gap, and where f and w are both small each is its root: so a hundredth, if it can.
    unit = ScaledSystem(a, b)
    for own in (0.01 * options.tolerance, options.tolerance):
        found, count = settled_qp(unit, own, options.tolerance, options.limit)
        if found is not None:
            return found, count
    return np.zeros(b.size), count


def _nnls(a: Any, b: Array, options: _Options) -> tuple[Array, int]:
    rows = options.rows
    found = solve_nnls(dense(a), b, columns=None if rows is None else _used(rows).T)
    return found.force, int(np.count_nonzero(found.force))


def _used(rows: Any) -> Array:
    """The columns of J M^-1/2 that hold something, dense."""
    return rows[:, np.unique(rows.indices)].toarray()


def _pivot(a: Any, b: Array, options: _Options) -> tuple[Array, int]:
    found = solve_pivot(dense(a), b, max_pivots=options.limit)
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
    rows = options.rows
    system = ScaledSystem(a, b, None if rows is None else lambda: rows)
    found = solve_gauss(system, tolerance=options.tolerance, max_iterations=limit)
    return found.force, found.iterations


_ONE_SYSTEM: dict[str, Callable[[Any, Array, _Options], tuple[Array, int]]] = {
    "qp": _qp,
    "nnls": _nnls,
    "pivot": _pivot,
    "projected_gauss_seidel": _sweeps,
    "gauss": _gauss,
}
#: The words that ``solve`` takes.
METHODS = ("auto", *_ONE_SYSTEM)
