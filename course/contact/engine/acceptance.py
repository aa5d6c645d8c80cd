"""Whether what a method found is to be believed: contacts that stray, forces in doubt, the solution judged."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, BoolArray
from course.contact.solution import ContactSolution
from course.contact.solvers.residual import products, residual_of, violation_of
from course.contact.systems import ContactSystem

#: See ``strays``: parts of max |b|, of |A| |f|, and of max |b| again.
SUSPICIOUS, EXCUSED, SURE = 1e-8, 2e-15, 1e-6
#: |A| |f| above this times max |b| cannot be sure of SURE: eps |A| |f| is as much.
HUGE = 1e9
#: |A| |f| above this times the largest |b|: rounding of A f moves the forces by more than 1e-11 of their size.
LARGE = 1e4
#: The residual of forces that are right to rounding, a contact: no more is rounding of A f.
RESIDUAL_ROUNDING = 4 * np.finfo(float).eps
#: Where the forces are right to rounding, rounding them once changes A f by eps |A| |f|; contacts that stray are
#: excused while that is at most this times the largest |b|.
EXCUSED_TO_ROUNDING = 1e-3


def strays(
    violation: Array,
    size: Array,
    bias: Array,
    *,
    largest: Array | None = None,
    tolerance: float = 0.0,
) -> BoolArray:
    """Which contacts are not where they should be, whatever the residual says.

    The residual is relative to the forces. Where they are large it may be as
    small as one likes while contacts approach, or part although they push, at
    the size of b itself; the forces are then as wrong. So the violation is
    held against b alone: above SUSPICIOUS max |b| (or 100 times the tolerance
    asked for, where that is more), and above what rounding of large forces
    excuses (EXCUSED |A| |f|, but never more than SURE max |b|),
    it strays. So does all beyond HUGE, where rounding hides SURE.

    From ``violation_of``, |A| |f| and b, each (..., c), and max |b| if it is
    not that of these b; nothing is checked.
    """
    if largest is None:
        largest = np.abs(bias).max(axis=-1, keepdims=True, initial=0)
    seen = max(SUSPICIOUS, 100 * tolerance)
    excused = seen * largest + np.minimum(EXCUSED * size, SURE * largest)
    return (violation > excused) | (size > HUGE * largest)


def doubtful(residual: Any, size: Array, bias: Array) -> Any:
    """Systems whose forces are not surely right to rounding, (...).

    A residual of RESIDUAL_ROUNDING c is no more than the rounding of A f as it is
    computed: f then solves a system within rounding of the stored one, each
    entry of A changed by a few units in its last place and b by as many of max
    |b|. Where forces are LARGE beside b that is not enough, as f itself is far
    more exact than w can be: such systems call for a closer look.

    From ``complementarity_residual``, (...), |A| |f| and b, (..., c).
    """
    largest = np.abs(bias).max(axis=-1, initial=0)
    rounding = RESIDUAL_ROUNDING * bias.shape[-1]
    return ~(residual <= rounding) | (size.max(axis=-1, initial=0) > LARGE * largest)


def contact_solution(
    system: ContactSystem,
    force: Array,
    iterations: Any,
    method: str,
    tolerance: float,
    *,
    known: tuple[Array, Array] | None = None,
    to_rounding: BoolArray | None = None,
) -> ContactSolution:
    """The solution of this force: its accelerations, its residual, and whether it solves the system.

    known: A f and |A| |f| (``products``), if they are at hand. to_rounding: (..., c),
    the contacts whose forces are right to rounding, however large they are.
    """
    product, size = products(system.A, force) if known is None else known
    residual = residual_of(system.diagonal, product, size, force, system.b)
    violation = violation_of(system.diagonal, product, force, system.b)
    missed = strays(violation, size, system.b, tolerance=tolerance)
    if to_rounding is not None and np.any(to_rounding & missed):
        largest = np.abs(system.b).max(axis=-1, keepdims=True, initial=0.0)
        missed &= ~to_rounding | (
            np.finfo(float).eps * size > EXCUSED_TO_ROUNDING * largest
        )
    return ContactSolution(
        force,
        product + system.b,
        residual,
        iterations,
        method,
        (residual <= tolerance) & ~missed.any(axis=-1),
    )
