"""Small contact systems in whole numbers: what the stored A and b say, with no rounding at all.

Every float64 is a whole number times a power of two, so the stored system has
an exact answer. It is found by principal pivots with the least index rule
(D. den Hertog, C. Roos and T. Terlaky, "The linear complementarity problem,
sufficient matrices, and the criss-cross method", Linear Algebra and its
Applications 187, 1993), which cannot cycle where A is positive semidefinite.
The tableau is kept as whole numbers over one denominator, the determinant of
A_SS, so that every division is exact (E. H. Bareiss, Mathematics of Computation
22, 1968). Thousands of times slower than floating point: for systems in doubt.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import frexp, ldexp

import numpy as np

from course.arrays import Array, BoolArray

#: Least index rules may take long; pivots after which the search is given up.
PIVOTS = 40


@dataclass(frozen=True, eq=False)
class ExactSolution:
    """What the stored numbers say.

    Args:
        force: f >= 0, (c,), rounded once, or None.
        certificate: None, or y >= 0, (c,), its largest entry 1, rounded once:
            A y = 0 and b.y < 0 hold for the unrounded one without any error.
        indefinite: whether the stored A has been seen to be indefinite; an
            answer is given nevertheless if there is one on the way.
    """

    force: Array | None
    certificate: Array | None = None
    indefinite: bool = False


def solve_exact(
    matrix: Array, bias: Array, pushing: BoolArray | None = None
) -> ExactSolution:
    """The exact answer of w = A f + b >= 0, f >= 0, f.w = 0 for the numbers as they are stored.

    Args:
        matrix: A, (c, c), symmetric positive semidefinite; its lower triangle is read.
        bias: b, (c,).
        pushing: (c,), a guess of who pushes, which saves pivots.
    Returns:
        The force, or the certificate that there is none; neither where A is
        indefinite, or after PIVOTS times c + 1 pivots.
    """
    tableau = _Tableau(np.asarray(matrix), bias)
    for guessed in () if pushing is None else np.flatnonzero(pushing).tolist():
        if tableau.rows[guessed][guessed] > 0:
            tableau.pivot(guessed)
    for _ in range(PIVOTS * (bias.size + 1)):
        k = tableau.first_wrong()
        if k is None:
            return ExactSolution(tableau.force(), indefinite=tableau.indefinite())
        if tableau.rows[k][k] > 0:
            tableau.pivot(k)
            continue
        if tableau.indefinite():
            return ExactSolution(None, indefinite=True)
        helper = tableau.first_helper(k)
        if helper is None:
            return ExactSolution(None, tableau.ray(k))
        tableau.pivot(helper)
        tableau.pivot(k)
    return ExactSolution(None)


class _Tableau:
    """The basic variables (f of those that push, w of the others) by the others: rows / denominator.

    The last column is their values while the others are 0. The denominator
    is det A_SS, above 0 as long as only positive pivots are taken.
    """

    def __init__(self, a: Array, b: Array) -> None:
        count = b.size
        # Powers of two bring the diagonal near 1, so that graded systems do not make long numbers.
        self.power = [-(frexp(d)[1] // 2) if d > 0 else 0 for d in a.diagonal()]
        entries = [
            [_split(float(a[max(i, j), min(i, j)]), self.power[i] + self.power[j]) for j in range(count)]
            for i in range(count)
        ]  # fmt: skip
        values = [_split(float(b[i]), self.power[i]) for i in range(count)]
        least = _least(one for row in entries for one in row)
        self.unit = _least(values) - least
        self.rows = [
            [_whole(one, least) for one in row] + [_whole(value, _least(values))]
            for row, value in zip(entries, values, strict=True)
        ]
        self.denominator, self.least = 1, least
        self.pushing = [False] * count

    def first_wrong(self) -> int | None:
        """The first contact that pulls or approaches."""
        return next((i for i, row in enumerate(self.rows) if row[-1] < 0), None)

    def first_helper(self, k: int) -> int | None:
        """Whose leaving lets the force at k stop the approach there, though A_kk itself is used up."""
        row = self.rows[k]
        return next((j for j, on in enumerate(self.pushing) if on and row[j] > 0), None)

    def indefinite(self) -> bool:
        """Whether a diagonal entry of the Schur complement is below 0, or is 0 in a row that is not."""
        rest = [i for i, on in enumerate(self.pushing) if not on]
        return any(
            self.rows[i][i] < 0
            or (self.rows[i][i] == 0 and any(self.rows[i][j] for j in rest))
            for i in rest
        )

    def pivot(self, k: int) -> None:
        """f_k and w_k change places."""
        row, before = self.rows[k], self.denominator
        pivot = row[k]
        for i, other in enumerate(self.rows):
            if i == k:
                continue
            at = other[k]
            if at:
                self.rows[i] = [
                    (value * pivot - at * across) // before
                    for value, across in zip(other, row, strict=True)
                ]
                self.rows[i][k] = at
            else:
                self.rows[i] = [value * pivot // before for value in other]
        self.rows[k] = [-value for value in row]
        self.rows[k][k] = before
        self.denominator = pivot
        self.pushing[k] = not self.pushing[k]

    def force(self) -> Array:
        """f, each rounded once."""
        return self._rounded(
            [row[-1] if on else 0 for row, on in zip(self.rows, self.pushing, strict=True)],
            self.unit,
        )  # fmt: skip

    def ray(self, k: int) -> Array:
        """A force of 1 at k with what keeps those that push from being moved by it: A y = 0."""
        y = [-self.rows[k][j] if on else 0 for j, on in enumerate(self.pushing)]
        y[k] = self.denominator
        return self._rounded(y, None)

    def _rounded(self, numerator: list[int], unit: int | None) -> Array:
        """D numerator / denominator times 2^unit; with unit None in units of the largest."""
        scaled = [
            Fraction(n, self.denominator) * Fraction(2) ** power
            for n, power in zip(numerator, self.power, strict=True)
        ]
        times = 1 / max(scaled) if unit is None else Fraction(2) ** unit
        return np.array([_float(one * times) for one in scaled])


def _split(value: float, shift: int) -> tuple[int, int]:
    """A whole number and a power of two that make value 2^shift."""
    mantissa, exponent = frexp(value)
    return int(ldexp(mantissa, 53)), exponent - 53 + shift


def _least(pairs: object) -> int:
    return min((power for whole, power in pairs if whole), default=0)  # type: ignore[attr-defined]


def _whole(pair: tuple[int, int], least: int) -> int:
    return pair[0] << (pair[1] - least) if pair[0] else 0


def _float(value: Fraction) -> float:
    try:
        return float(value)
    except OverflowError:
        return float("inf")
