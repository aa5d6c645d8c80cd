"""Method "auto": a small system whole, a batch at once; by islands, with fallbacks, where that does not settle it."""

from __future__ import annotations

from dataclasses import replace
from math import prod

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.contact.engine.acceptance import contact_solution, doubtful
from course.contact.engine.block_pivots import (
    Pivoted,
    block_pivot,
    block_pivot_one,
)
from course.contact.engine.islands import SMALL, Islands
from course.contact.engine.refusals import (
    require_convergence,
    require_semidefinite,
    require_solution,
)
from course.contact.solution import ContactSolution
from course.contact.solvers.arguments import dense
from course.contact.solvers.residual import products
from course.contact.systems import ContactSystem

#: Rounds of a system solved whole, before it is looked at more closely; of 20 it ever solves, 19 are solved by then.
ROUNDS = 20


def solve_auto(
    system: ContactSystem,
    *,
    tolerance: float,
    max_iterations: int | None = None,
    start: Array | None = None,
) -> ContactSolution:
    """``solve`` with method "auto"; see there."""
    if start is not None:
        force = np.maximum(start, 0.0)
        kept = contact_solution(system, force, 0, "auto: start", tolerance)
        if np.all(kept.converged):
            if system.jacobian is None:
                require_semidefinite(system.A)
            return kept
    if system.b.ndim > 1:
        return _batch(system, tolerance, max_iterations)
    found = _whole(system, tolerance, max_iterations) if len(system) <= SMALL else None
    return _by_islands(system, tolerance, max_iterations) if found is None else found


def _whole(
    system: ContactSystem, tolerance: float, limit: int | None
) -> ContactSolution | None:
    """A small system at one go; None where none pushes, where forces are in doubt, or where one moves nothing."""
    a, b = dense(system.A), system.b
    if not (b.min(initial=0.0) < 0 < a.diagonal().min()):
        return None
    found = block_pivot_one(
        a, b, max_iterations=ROUNDS if limit is None else min(limit, ROUNDS)
    )
    # A tolerance below what rounding allows is for other methods to try.
    missed = found.indefinite or not found.residual <= tolerance
    if missed or doubtful(found.residual, found.size, b):
        return None
    return _pivoted(found, b, tolerance)


def _pivoted(found: Pivoted, b: Array, tolerance: float) -> ContactSolution:
    """The same, as ``solve`` gives it."""
    motion, residual, method = found.product + b, found.residual, "auto: block_pivot"
    return ContactSolution(
        found.force, motion, residual, found.iterations, method, residual <= tolerance
    )


def _by_islands(
    system: ContactSystem, tolerance: float, limit: int | None
) -> ContactSolution:
    """A system island by island, and by other methods where the first fails."""
    islands = Islands(system, tolerance, limit)
    islands.solve()
    require_solution(islands.proof, system.b)
    known = products(islands.matrix, islands.force)
    solution = contact_solution(
        system,
        islands.force,
        islands.iterations,
        islands.method,
        tolerance,
        known=known,
        to_rounding=islands.to_rounding,
    )
    require_convergence(solution, tolerance)
    return solution


def _batch(
    system: ContactSystem, tolerance: float, limit: int | None
) -> ContactSolution:
    """All systems of a batch at once where they are small; one by one where that is in doubt."""
    shape, count = system.b.shape, len(system)
    a = system.A.reshape(prod(shape[:-1]), count, count)
    # With the batch as the fastest axis: reductions over the few contacts of each system are quicker by far.
    b = np.asfortranarray(system.b.reshape(prod(shape[:-1]), count))
    if count > SMALL:
        force, iterations = np.zeros(b.shape), np.zeros(len(b), dtype=np.intp)
        return _one_by_one(
            system,
            a,
            b,
            np.ones(len(b), dtype=bool),
            force,
            iterations,
            tolerance,
            limit,
        )
    found = block_pivot(a, b, max_iterations=limit)
    bad = ~(found.residual <= tolerance) | found.indefinite
    bad |= doubtful(found.residual, found.size, b)
    bad |= ~np.diagonal(a, axis1=1, axis2=2).all(axis=1)
    if np.any(bad):
        force, iterations = found.force, found.iterations
        return _one_by_one(system, a, b, bad, force, iterations, tolerance, limit)
    whole = _pivoted(found, b, tolerance)
    arrays = {k: v for k, v in vars(whole).items() if k != "method"}
    shaped = {
        k: v.reshape(shape if v.ndim > 1 else shape[:-1]) for k, v in arrays.items()
    }
    return replace(whole, **shaped)


def _one_by_one(
    system: ContactSystem,
    a: Array,
    b: Array,
    bad: BoolArray,
    force: Array,
    iterations: IntArray,
    tolerance: float,
    limit: int | None,
) -> ContactSolution:
    """The systems that are in doubt, each by islands; of the others the force is known and kept."""
    shape = system.b.shape
    proof, to_rounding = np.zeros(b.shape), np.zeros(b.shape, dtype=bool)
    used = {"block_pivot"} if len(system) <= SMALL else set[str]()
    for k in np.flatnonzero(bad):
        islands = Islands(ContactSystem(a[k], b[k]), tolerance, limit)
        islands.solve()
        force[k], proof[k], iterations[k] = (
            islands.force,
            islands.proof,
            islands.iterations,
        )
        to_rounding[k] = islands.to_rounding
        used.add(islands.method.removeprefix("auto: "))
    require_solution(proof.reshape(shape), system.b)
    solution = contact_solution(
        system,
        force.reshape(shape),
        iterations.reshape(shape[:-1]),
        "auto: " + ", ".join(sorted(used)),
        tolerance,
        to_rounding=to_rounding.reshape(shape),
    )
    require_convergence(solution, tolerance)
    return solution
