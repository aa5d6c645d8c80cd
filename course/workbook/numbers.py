"""Numbers as text that every processor prints the same."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import written

NOISE = 1e-12
SETTLING = 3  # additional digits of the first rounding


class Shown(str):
    """Text that a notebook shows without quotes."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def show(value: Any, digits: int, *, noise: float = NOISE) -> Shown:
    """A number or an array as text, rounded to significant digits of its largest entry.

    Integers stay whole. Rounding must stay well above the tolerance of the computation,
    or another processor prints something else. Numbers are rounded twice, first to some
    digits more, so that one whose exact value lies on the edge (a half, an eighth) or
    whose largest entry is a power of ten prints the same whichever way its last bit
    fell.

    Minus zero never shows; a number below ``noise`` in magnitude shows as "below
    1e-12", an entry of an array as 0. A larger ``noise`` is for errors whose size
    depends on the processor: their bound is printed, and an error that exceeds it as it
    is.

    Raises ``ValueError`` for digits outside 1..15 and for what is not numeric.
    """
    if not isinstance(digits, int) or isinstance(digits, bool) or not 1 <= digits <= 15:
        raise ValueError(
            f"digits: expected a whole number from 1 to 15; got {written(digits)}"
        )
    array = np.asarray(value)
    if array.dtype.kind not in "biuf":
        raise ValueError(
            f"value: expected a number or an array of numbers; got {type(value).__name__}"
        )
    if array.dtype.kind in "biu":
        return Shown(np.array2string(array, separator=", ", threshold=50))
    if array.ndim == 0:
        return Shown(_scalar(float(array), digits, noise))
    largest = float(np.abs(array[np.isfinite(array)]).max(initial=0.0))
    exponent = (
        int(f"{_settled(largest, digits):.{digits - 1}e}".partition("e")[2])
        if largest >= noise
        else 0
    )
    decimals = digits - 1 - exponent
    settled = np.round(np.round(array.astype(float), decimals + SETTLING), decimals)
    rounded = (
        np.where(np.abs(array) < noise, 0.0, settled) + 0.0
    )  # + 0.0: no minus zero
    precision = max(
        decimals, digits - 1
    )  # the second is for numbers so large that they are shown with an exponent
    return Shown(
        np.array2string(
            rounded,
            separator=", ",
            threshold=50,
            max_line_width=100,
            precision=precision,
        )
    )


def _scalar(value: float, digits: int, noise: float) -> str:
    if abs(value) < noise:
        return f"below {noise:g}"
    if not np.isfinite(value):
        return str(value)
    value = _settled(value, digits)
    if 1e-4 <= abs(value) < 1e7:  # in full: 20000 rather than 2e+04
        return np.format_float_positional(
            value, precision=digits, fractional=False, trim="-"
        )
    return f"{value:.{digits}g}"


def _settled(value: float, digits: int) -> float:
    return float(f"{value:.{digits + SETTLING}g}")
