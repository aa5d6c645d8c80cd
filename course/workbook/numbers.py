"""Numbers as text that every processor prints the same."""

from __future__ import annotations

from typing import Any

import numpy as np

NOISE = 1e-12


class Shown(str):
    """Text that a notebook shows without quotes."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def show(value: Any, digits: int) -> Shown:
    """A number or an array as text, rounded to ``digits`` significant digits of its largest entry.

    Rounding must stay well above the tolerance of the computation, or another processor prints something else.
    Minus zero never shows; a number below 1e-12 in magnitude shows as "below 1e-12", an entry of an array as 0.
    Raises ``ValueError`` for digits outside 1..15 and for what is not numeric.
    """
    if not isinstance(digits, int) or not 1 <= digits <= 15:
        raise ValueError(f"digits: expected a whole number from 1 to 15; got {digits!r}")
    array = np.asarray(value)
    if array.dtype.kind not in "biuf":
        raise ValueError(f"value: expected a number or an array of numbers; got {type(value).__name__}")
    if array.dtype.kind in "biu":
        return Shown(np.array2string(array, separator=", ", threshold=50))
    if array.ndim == 0:
        return Shown(_scalar(float(array), digits))
    finite = np.abs(array[np.isfinite(array)])
    largest = finite.max(initial=0.0)
    decimals = digits - 1 - int(np.floor(np.log10(largest))) if largest > NOISE else 0
    rounded = np.where(np.abs(array) < max(NOISE, 0.0), 0.0, np.round(array, decimals)) + 0.0
    text = np.array2string(rounded, separator=", ", threshold=50, max_line_width=100, precision=max(decimals, 0))
    return Shown(text)


def _scalar(value: float, digits: int) -> str:
    if abs(value) < NOISE:
        return "below 1e-12"
    if not np.isfinite(value):
        return str(value)
    if 1e-4 <= abs(value) < 1e7:  # in full: 20000 rather than 2e+04
        return np.format_float_positional(value, precision=digits, fractional=False, trim="-")
    return f"{value:.{digits}g}"
