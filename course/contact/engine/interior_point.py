"""Interior point for any A and b: Newton steps on Gauss' principle until it is clear who pushes, and the finish.

The steps are those of ``solvers.gauss``. Each Newton system is solved by whichever elimination of ``regularization`` is
cheapest. Once it is clear which contacts push, ``active_set`` finishes to rounding.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from course.arrays import Array
from course.contact.engine.active_set import settle
from course.contact.engine.scaling import ScaledSystem, Trial
from course.contact.solvers.gauss import Iterate, newton_steps

#: Share of contacts that may be undecided when ``active_set`` is tried.
UNDECIDED = 0.1
#: Newton steps after which it is tried anyway; and those a contact that still strays is given.
STEPS_WITHOUT_FALL = 6


@dataclass(frozen=True)
class InteriorPoint:
    """Where the method stopped.

    Args:
        force: f >= 0, (c,).
        residual: of that force.
        iterations: Newton systems factored, those of ``active_set`` included.
    """

    force: Array
    residual: float
    iterations: int


def solve_gauss(
    system: ScaledSystem,
    *,
    tolerance: float = 1e-10,
    max_iterations: int = 100,
    largest: float = np.inf,
) -> InteriorPoint:
    """Contact forces of a system whose A has a positive diagonal.

    Args:
        system: A and b, and J M^-1/2 for elimination by accelerations.
        tolerance: residual at which it stops.
        max_iterations: how many Newton systems may be factored.
        largest: a force above which it stops, in the unit system: where no
            solution exists forces grow without bound.
    Returns:
        The best force met, or the last if it was too large; f >= 0 in every case.
    """
    best, finish, count = _Best(tolerance), _Finish(len(system)), 0
    # LinAlgError: A is not positive semidefinite, or rounding has spoilt the iterate.
    with suppress(np.linalg.LinAlgError):
        for at, now in newton_steps(system):
            count += 1
            if np.max(at.f, initial=0.0) > largest:
                return InteriorPoint(system.force(at.f), now.residual, count)
            best.offer(now)
            if count >= max_iterations or best.stalls():
                break
            if finish.is_due(at, count):
                found = settle(system, at.f, at.f > at.w, tolerance=tolerance)
                count = finish.counted(count, found.iterations)
                best.offer(system.tried(found.force))
                if best.settled or count >= max_iterations:
                    break
    if best.trial is None:
        return InteriorPoint(np.zeros(len(system)), np.inf, 1)
    force = system.force(best.trial.unit_force)
    return InteriorPoint(force, best.trial.residual, count)


class _Best:
    """The best force met, and whether going on still helps."""

    def __init__(self, tolerance: float) -> None:
        self.trial: Trial | None = None
        self._tolerance, self._stray, self._patience = (
            tolerance,
            np.inf,
            STEPS_WITHOUT_FALL,
        )

    def offer(self, trial: Trial) -> None:
        """Keep it if it is better."""
        if self.trial is None or _better(trial, self.trial, self._tolerance):
            self.trial = trial

    @property
    def _good(self) -> bool:
        return self.trial is not None and self.trial.residual <= self._tolerance

    @property
    def settled(self) -> bool:
        """Whether the residual is small and no contact strays."""
        return (
            self.trial is not None
            and self._good
            and self.trial.stray(self._tolerance) == 0
        )

    def stalls(self) -> bool:
        """Whether the residual is small and the contacts no longer stray less; asked once an iterate.

        Large forces make the residual small before w is: go on while that falls.
        """
        if self.trial is None or not self._good:
            return False
        before, self._stray = self._stray, self.trial.stray(self._tolerance)
        falls = self._stray <= 0.5 * before
        self._patience = STEPS_WITHOUT_FALL if falls else self._patience - 1
        return self._stray == 0 or self._patience < 0


class _Finish:
    """When it is time to settle who pushes: few are undecided, and fewer than last time, or steps have gone by."""

    def __init__(self, contacts: int) -> None:
        self._contacts, self._tried = contacts, STEPS_WITHOUT_FALL
        self._undecided = contacts + 1.0

    def is_due(self, at: Iterate, count: int) -> bool:
        """Asked once an iterate, with the Newton systems factored so far."""
        now = _undecided(at)
        clear = now <= UNDECIDED * self._contacts and now <= 0.5 * self._undecided
        if not clear and count - self._tried < STEPS_WITHOUT_FALL:
            return False
        self._undecided, self._tried = min(now, self._undecided), count
        return True

    def counted(self, count: int, more: int) -> int:
        """The count with the systems that settling factored."""
        self._tried += more
        return count + more


def _better(one: Trial, other: Trial, tolerance: float) -> bool:
    """Whether its residual is less, or small enough and the contacts stray less."""
    if one.residual <= tolerance and other.residual <= tolerance:
        return (one.stray(tolerance), one.residual) < (
            other.stray(tolerance),
            other.residual,
        )
    return one.residual < other.residual


def _undecided(at: Iterate) -> int:
    """How many contacts neither clearly push nor clearly part."""
    ratio = (at.f * float(np.mean(at.w))) / (at.w * float(np.mean(at.f)))
    return int(np.count_nonzero((ratio > 1e-3) & (ratio < 1e3)))
