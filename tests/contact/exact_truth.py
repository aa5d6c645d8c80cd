"""What small contact systems say exactly, by trying every set of pushing contacts in rational numbers."""

from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations

import numpy as np


@dataclass(frozen=True)
class Truth:
    """Of the stored A and b: "forces", "none" or "indefinite"; the forces found first; numbers about A.

    least: the least eigenvalue on a diagonal of ones, in floating point.
    gap: the least one that is not 0 to rounding.
    """

    verdict: str
    force: list | None
    least: float
    gap: float


def truth_of(a, b):
    """By enumeration: a solvable system has an answer whose A_SS is regular."""
    count = len(b)
    exact = [[Fraction(float(x)) for x in row] for row in a]
    bias = [Fraction(float(x)) for x in b]
    root = np.sqrt(np.where(a.diagonal() > 0, a.diagonal(), 1.0))
    values = np.linalg.eigvalsh((a / root[:, None]) / root)
    noise = 16 * count * np.finfo(float).eps
    seen = values[values > noise]
    numbers = float(values[0]), float(seen[0]) if seen.size else 0.0
    if not semidefinite(exact):
        return Truth("indefinite", None, *numbers)
    for size in range(count + 1):
        for support in combinations(range(count), size):
            f = solved(exact, bias, support)
            if f is None or min(f, default=0) < 0:
                continue
            w = motion(exact, bias, f)
            if min(w, default=0) >= 0:
                return Truth("forces", f, *numbers)
    return Truth("none", None, *numbers)


def semidefinite(a):
    """By elimination: a pivot below 0, or 0 beside something, is what a semidefinite matrix never shows."""
    rest = [row[:] for row in a]
    while rest:
        k = next((i for i, row in enumerate(rest) if row[i] != 0), None)
        if k is None:
            return not any(any(row) for row in rest)
        pivot = rest[k][k]
        if pivot < 0:
            return False
        keep = [i for i in range(len(rest)) if i != k]
        rest = [
            [rest[i][j] - rest[i][k] * rest[k][j] / pivot for j in keep] for i in keep
        ]
    return True


def solved(a, b, support):
    """f with A_SS f_S = -b_S, 0 elsewhere; None where A_SS is singular."""
    rows = [[a[i][j] for j in support] + [-b[i]] for i in support]
    for k in range(len(rows)):
        p = next((i for i in range(k, len(rows)) if rows[i][k] != 0), None)
        if p is None:
            return None
        rows[k], rows[p] = rows[p], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for i in range(len(rows)):
            if i != k and rows[i][k] != 0:
                rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k], strict=True)]  # fmt: skip
    f = [Fraction(0)] * len(b)
    for i, row in zip(support, rows, strict=True):
        f[i] = row[-1]
    return f


def motion(a, b, f):
    """A f + b."""
    return [sum(x * y for x, y in zip(row, f, strict=True)) + c for row, c in zip(a, b, strict=True)]  # fmt: skip


def violations(a, b, force):
    """|min(D f, w)| and |A| f + max |b| of stored numbers, without rounding."""
    exact = [[Fraction(float(x)) for x in row] for row in a]
    f, bias = [Fraction(float(x)) for x in force], [Fraction(float(x)) for x in b]
    w = motion(exact, bias, f)
    off = [abs(min(exact[i][i] * f[i], w[i])) for i in range(len(f))]
    largest = max((abs(x) for x in bias), default=Fraction(0))
    size = [sum(abs(x) * y for x, y in zip(row, f, strict=True)) + largest for row in exact]  # fmt: skip
    return off, size, largest


def moved(a, y):
    """The largest |A y| / |A| y, without rounding; y >= 0."""
    exact = [[Fraction(float(x)) for x in row] for row in a]
    f = [Fraction(float(x)) for x in y]
    parts = [
        (abs(sum(x * z for x, z in zip(row, f, strict=True))), sum(abs(x) * z for x, z in zip(row, f, strict=True)))
        for row in exact
    ]  # fmt: skip
    return float(max((off / size for off, size in parts if size), default=Fraction(0)))
