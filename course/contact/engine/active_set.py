"""Active sets: from a guess of who pushes to the forces, right to rounding, correcting the guess on the way.

Where the set S of pushing contacts is known, A_SS f_S = -b_S. A_SS may be
singular, so the proximal point method is used (R. T. Rockafellar, SIAM Journal
on Control and Optimization 14(5), 1976): f <- f - (A_SS + shift)^-1 (A f + b)_S
converges whenever a solution exists, by shift/(shift + lambda) a step in the
direction of an eigenvalue lambda, and leaves alone what A cannot see. Contacts
that then pull leave the set, those that approach join it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array, BoolArray
from course.contact.engine.scaling import ScaledSystem

#: Added to a diagonal of ones; the second where refinement is too slow with the first, A_SS being nearly singular.
SHIFTS = (1e-8, 1e-13)
#: A set is refined when A f + b on it is below these parts of the largest b and f, on a diagonal of ones.
SET_REFINED = (1e-9, 1e-14)
#: How many sets are tried, and how many refinements each gets.
SETS, REFINEMENTS_OF_A_SET = 6, 10
#: A guess with a larger share of wrong contacts than this is given up at once.
FEW_WRONG = 0.03


@dataclass(frozen=True)
class Settled:
    """The best force found, f >= 0 in the unit system, its residual, and how many matrices were factored."""

    force: Array
    residual: float
    iterations: int


def settle(
    system: ScaledSystem,
    force: Array,
    pushing: BoolArray,
    *,
    tolerance: float,
    sets: int = SETS,
) -> Settled:
    """Forces on the set S, and on the sets that follow from it while they get better.

    Args:
        system: in units of its diagonal.
        force: a guess, (c,), from which the solution of a singular A_SS starts.
        pushing: S, (c,).
        tolerance: residual at which it stops.
        sets: how many sets may be tried.
    """
    best = Settled(np.zeros(len(system)), np.inf, 0)
    wrong_before: float = FEW_WRONG * len(system) + 10
    for count in range(1, sets + 1):
        force = np.where(pushing, force, 0.0)
        on_set = _on_set(system, force, pushing)
        if on_set is None:
            break
        force = on_set
        kept = system.tried(np.maximum(force, 0.0))
        if kept.residual < best.residual:
            best = Settled(kept.unit_force, kept.residual, count)
        push, motion = system.tried(force).rows
        pulls, approaches = (
            pushing & (push < -0.1 * tolerance),
            ~pushing & (motion < -0.1 * tolerance),
        )
        wrong = int(np.count_nonzero(pulls | approaches))
        solved = kept.residual <= tolerance and kept.stray(tolerance) == 0
        if solved or not wrong or wrong > 0.7 * wrong_before:
            break
        wrong_before = wrong
        pushing = (pushing & ~pulls) | approaches
    return Settled(best.force, best.residual, count)


def _on_set(system: ScaledSystem, force: Array, pushing: BoolArray) -> Array | None:
    """Forces with A f + b = 0 on the set, from this force; None where no factor exists."""
    found = None
    for shift in SHIFTS:
        try:
            system.operator.factor(np.where(pushing, 1.0 / shift, 0.0))
        except np.linalg.LinAlgError:
            break
        force, missing = _refined(system, force, pushing)
        found = force
        largest = [float(np.abs(x).max(initial=0.0)) for x in (system.unit_bias, force)]
        if missing <= SET_REFINED[0] * largest[0] + SET_REFINED[1] * largest[1]:
            break
    return found


def _refined(
    system: ScaledSystem, force: Array, pushing: BoolArray
) -> tuple[Array, float]:
    """The force of the refinement that leaves least of A f + b on the set, and how much that is."""
    best, least = force, np.inf
    for _ in range(REFINEMENTS_OF_A_SET):
        w = np.where(pushing, system.operator.times(force) + system.unit_bias, 0.0)
        size = float(np.max(np.abs(w), initial=0.0))
        slow = not size < 0.3 * least
        if size < least:
            best, least = force, size
        if slow:
            break
        force = force - system.operator.solve(w)
    return best, least
