"""Contact forces by Gauss' principle: an interior point method on the accelerations.

Of all accelerations that the contacts allow, nature takes the one nearest to
the free one, measured by mass:

    minimise (a - a_free)' M (a - a_free) / 2  with  J a + bias >= 0

(C. F. Gauss, 1829; syllabus row 25 in other unknowns). It is strictly convex
even where A = J M^-1 J' is singular, so a is unique where f is not; f are its
multipliers. The method is Mehrotra's predictor and corrector (S. Mehrotra, SIAM
Journal on Optimization 2(4), 1992) with one of Gondzio's centrality correctors
(J. Gondzio, Computational Optimization and Applications 6, 1996), and each
Newton system is solved by whichever elimination of ``regularized`` is cheapest.
Once it is clear which contacts push, ``active_set`` finishes to rounding.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array
from course.contact.engine.active_set import settle
from course.contact.engine.scaling import ScaledSystem, Trial

#: 1/(shift) of the equality problem that gives the starting point.
START = 1e3
#: Shift kept in every Newton system, relative to a diagonal of ones: rank deficient systems stay solvable.
KEPT = 1e-13
#: By how much a step must get longer for a correction to be worth it.
LONGER = 0.01
#: Fraction of the way to the boundary.
FRACTION = 0.995
#: Share of contacts that may be undecided when ``active_set`` is tried.
UNDECIDED = 0.1
#: Newton steps after which it is tried anyway; and those a contact that still strays is given.
PATIENCE = 6
#: What is missing from w = A f + b counts if it is more than this times the terms' magnitudes.
NOISE = 4e-15


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


@dataclass
class _Iterate:
    f: Array
    w: Array

    @property
    def gap(self) -> float:
        return float(np.mean(self.f * self.w))


def solve_gauss(
    system: ScaledSystem,
    *,
    tolerance: float = 1e-10,
    max_iterations: int = 100,
    largest: float = np.inf,
) -> InteriorPoint:
    """Contact forces of a system whose A has a positive diagonal.

    Args:
        system: A and b, and the factor of A for elimination by accelerations.
        tolerance: residual at which it stops.
        max_iterations: how many Newton systems may be factored.
        largest: a force above which it stops, in the unit system: where no
            solution exists forces grow without bound.
    Returns:
        The best force met, or the last if it was too large; f >= 0 in every case.
    """
    try:
        at = _start(system)
    except np.linalg.LinAlgError:  # A is not positive semidefinite
        return InteriorPoint(np.zeros(len(system)), np.inf, 1)
    best, stray, patience = system.tried(at.f), np.inf, PATIENCE
    count, tried, undecided_then = 1, PATIENCE, len(system) + 1.0
    while count < max_iterations and _sane(at):
        now = system.tried(at.f)
        if np.max(at.f, initial=0.0) > largest:
            return InteriorPoint(system.force(at.f), now.residual, count)
        if _better(now, best, tolerance):
            best = now
        if best.residual <= tolerance:
            # Large forces make the residual small before w is: go on while that falls.
            before, stray = stray, best.stray
            patience = PATIENCE if stray <= 0.5 * before else patience - 1
            if stray == 0 or patience < 0:
                break
        undecided = _undecided(at)
        clear = (
            undecided <= UNDECIDED * len(system) and undecided <= 0.5 * undecided_then
        )
        if clear or count - tried >= PATIENCE:
            undecided_then, tried = min(undecided, undecided_then), count
            found = settle(system, at.f, at.f > at.w, tolerance=tolerance)
            count, tried = count + found.iterations, tried + found.iterations
            settled = system.tried(found.force)
            if _better(settled, best, tolerance):
                best = settled
            if best.residual <= tolerance and best.stray == 0:
                break
        try:
            at = _step(now, at)
        except np.linalg.LinAlgError:
            break
        count += 1
    return InteriorPoint(system.force(best.unit_force), best.residual, count)


def _better(one: Trial, other: Trial, tolerance: float) -> bool:
    """Whether its residual is less, or small enough and the contacts stray less."""
    if one.residual <= tolerance and other.residual <= tolerance:
        return (one.stray, one.residual) < (other.stray, other.residual)
    return one.residual < other.residual


def _start(system: ScaledSystem) -> _Iterate:
    """Forces that stop all contacts, moved to f > 0 and w > 0 as Mehrotra does."""
    op, b = system.operator, system.unit_bias
    op.factor(np.full(b.size, START))
    f = -op.solve(b)
    w = -f / START
    f = f + max(-1.5 * float(f.min()), 0.0)
    w = w + max(-1.5 * float(w.min()), 0.0)
    product = float(f @ w)
    return _Iterate(
        f + 0.5 * product / float(w.sum()), w + 0.5 * product / float(f.sum())
    )


def _step(now: Trial, at: _Iterate) -> _Iterate:
    """One Newton step toward f w = a smaller common value, with its corrections; ``now`` is what f leads to."""
    op, f, w = now.system.operator, at.f, at.w
    missing = now.unit_acceleration - w
    # Where A is nearly singular, chasing rounding would move forces a long way.
    missing[np.abs(missing) <= NOISE * now.unit_magnitude] = 0.0
    kept = w + KEPT * f
    op.factor(f / kept)

    def direction(product: Array) -> tuple[Array, Array]:
        """df, dw with A df - dw = -missing and w df + f dw = product, up to the shift that is kept."""
        df = op.solve(product / f - missing)
        return df, (product - w * df) / f

    gap = at.gap
    df, dw = direction(-f * w)
    length = _length(at, df, dw)
    reached = float(np.mean((f + length * df) * (w + length * dw)))
    target = (reached / gap) ** 3 * gap
    product = target - f * w - df * dw
    df, dw = direction(product)
    length = _length(at, df, dw)
    if length < 1.0 - LONGER:
        aim = min(1.0, max(1.5 * length, length + 0.3))
        ahead = (f + aim * df) * (w + aim * dw)
        more = np.maximum(
            np.clip(ahead, 0.1 * target, 10 * target) - ahead, -10 * target
        )
        df_2, dw_2 = direction(product + more)
        if (length_2 := _length(at, df_2, dw_2)) > length + LONGER:
            df, dw, length = df_2, dw_2, length_2
    length *= FRACTION
    return _Iterate(f + length * df, w + length * dw)


def _length(at: _Iterate, df: Array, dw: Array) -> float:
    """The longest step, at most 1, that keeps f and w at or above 0."""
    fastest = max(float(np.max(-df / at.f)), float(np.max(-dw / at.w)), 1.0)
    return 1.0 / fastest


def _undecided(at: _Iterate) -> int:
    """How many contacts neither clearly push nor clearly part."""
    ratio = (at.f * float(np.mean(at.w))) / (at.w * float(np.mean(at.f)))
    return int(np.count_nonzero((ratio > 1e-3) & (ratio < 1e3)))


def _sane(at: _Iterate) -> bool:
    """False once the forces have run away (no solution) or rounding has spoilt them."""
    return bool(
        np.all(np.isfinite(at.f))
        and np.all(np.isfinite(at.w))
        and np.all(at.f > 0)
        and np.all(at.w > 0)
    )
