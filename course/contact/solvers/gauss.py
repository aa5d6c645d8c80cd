"""Contact forces by Gauss' principle: an interior point method on the accelerations.

Of all accelerations that the contacts allow, nature takes the one nearest to
the free one, measured by mass:

    minimise (a - a_free)' M (a - a_free) / 2  with  J a + bias >= 0

(C. F. Gauss, 1829; syllabus row 25 in other unknowns). It is strictly convex
even where A = J M^-1 J' is singular, so a is unique where f is not; f are its
multipliers. The method is Mehrotra's predictor and corrector (S. Mehrotra, SIAM
Journal on Optimization 2(4), 1992) with one of Gondzio's centrality correctors
(J. Gondzio, Computational Optimization and Applications 6, 1996).
``engine.interior_point`` brings it any A and b (``solve_gauss``), says when it is done
and finishes to rounding.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from course.arrays import Array

#: 1/(shift) of the equality problem that gives the starting point.
START = 1e3
#: Shift kept in every Newton system, relative to a diagonal of ones: rank deficient systems stay solvable.
KEPT = 1e-13
#: By how much a step must get longer for a correction to be worth it.
LONGER = 0.01
#: Fraction of the way to the boundary.
FRACTION = 0.995
#: What is missing from w = A f + b counts if it is more than this times the terms' magnitudes.
MISSING_NOISE = 4e-15


class NewtonSystem(Protocol):
    """What the method asks of a system with a diagonal of ones (``engine.scaling.ScaledSystem``)."""

    unit_bias: Array  # b

    @property
    def operator(self) -> Any:
        """``factor(theta)``, then ``solve(q)``: x with (A + diag(1/theta)) x = q."""
        ...

    def tried(self, unit_force: Array) -> Any:
        """With ``unit_acceleration`` A f + b and ``unit_magnitude`` |A| |f| + |b|."""
        ...


@dataclass
class Iterate:
    """f > 0 and w > 0; at the solution w = A f + b and f w = 0."""

    f: Array
    w: Array

    @property
    def gap(self) -> float:
        """The mean of f w."""
        return float(np.mean(self.f * self.w))

    @property
    def sane(self) -> bool:
        """False once the forces have run away (no solution) or rounding has spoilt them."""
        both = np.concatenate([self.f, self.w])
        return bool(np.all(np.isfinite(both)) and np.all(both > 0))


def newton_steps(system: NewtonSystem) -> Iterator[tuple[Iterate, Any]]:
    """The iterates, and what ``system.tried`` says of their forces, while both are sane.

    Raises:
        LinAlgError: rounding, or an indefinite A, makes the next step impossible.
    """
    at = _start(system)
    while at.sane:
        now = system.tried(at.f)
        yield at, now
        at = _step(system, at, now)


def _start(system: NewtonSystem) -> Iterate:
    """Forces that stop all contacts, moved to f > 0 and w > 0 as Mehrotra does."""
    op, b = system.operator, system.unit_bias
    op.factor(np.full(b.size, START))
    f = -op.solve(b)
    w = -f / START
    f = f + max(-1.5 * float(f.min()), 0.0)
    w = w + max(-1.5 * float(w.min()), 0.0)
    product = float(f @ w)
    return Iterate(
        f + 0.5 * product / float(w.sum()), w + 0.5 * product / float(f.sum())
    )


def _step(system: NewtonSystem, at: Iterate, now: Any) -> Iterate:
    """One Newton step toward f w = a smaller common value, with its corrections; ``now`` is what f leads to."""
    op, f, w = system.operator, at.f, at.w
    missing = now.unit_acceleration - w
    # Where A is nearly singular, chasing rounding would move forces a long way.
    missing[np.abs(missing) <= MISSING_NOISE * now.unit_magnitude] = 0.0
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
    return Iterate(f + length * df, w + length * dw)


def _length(at: Iterate, df: Array, dw: Array) -> float:
    """The longest step, at most 1, that keeps f and w at or above 0."""
    fastest = max(float(np.max(-df / at.f)), float(np.max(-dw / at.w)), 1.0)
    return 1.0 / fastest
