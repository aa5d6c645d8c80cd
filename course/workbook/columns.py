"""A column of a table as text: numbers rounded alike, so that they can be compared."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import numpy as np

from course.exercises.letters import RAISED, with_letters
from course.workbook.numbers import NOISE, SETTLING, show

_NUMBER = re.compile(r"(?:below )?[-+]?(?:[\d,]*\.?\d+(?:e[-+]?\d+)?|inf)%?|nan|")
_PLAIN = re.compile(r"[-+]?\d+(?:\.(\d+))?")
_EXPONENT = re.compile(r"(?<![\w.])(\d[\d.]*)e([-+]?\d+)(?!\w)")


def column_text(
    cells: Sequence[Any], digits: int | None, decimals: int | None, noise: float
) -> list[str]:
    """The cells of a column as text: floats with ``decimals`` places after the point, or
    else with significant ``digits`` (3 where None), as ``show`` rounds them.

    Zeros at a number's end are kept as far as they are known and the column has places,
    unless its numbers are of such different sizes that some need an exponent.
    """
    if decimals is not None:
        return [_fixed(cell, decimals) for cell in cells]
    digits = 3 if digits is None else digits
    texts = [_text(cell, digits, noise) for cell in cells]
    found = [_PLAIN.fullmatch(text) for text in texts]
    if any(_EXPONENT.match(text.lstrip("-")) for text in texts):
        return texts
    longest = max((len(match.group(1) or "") for match in found if match), default=0)
    return [
        _padded(text, digits, longest) if match and _is_real(cell) else text
        for cell, text, match in zip(cells, texts, found, strict=True)
    ]


def is_number(text: str) -> bool:
    """Whether a cell holds a number, or "below" one, or nothing."""
    return _NUMBER.fullmatch(text) is not None


def with_powers(text: str) -> str:
    """A text with 2 × 10⁻⁶ in place of 2e-06."""
    return _EXPONENT.sub(_power_of_ten, text)


def _is_real(cell: Any) -> bool:
    return isinstance(cell, float | np.floating) or (
        isinstance(cell, np.ndarray) and cell.ndim == 0 and cell.dtype.kind == "f"
    )


def _text(cell: Any, digits: int, noise: float) -> str:
    if cell is None:
        return ""
    if isinstance(cell, str):
        return with_letters(cell)
    if _is_real(cell) or isinstance(cell, list | tuple | np.ndarray):
        return " ".join(show(cell, digits, noise=noise).split())
    return str(cell)


def _fixed(cell: Any, decimals: int) -> str:
    """Rounded twice, as in ``show``, and never -0."""
    if not _is_real(cell) or not np.isfinite(cell):
        return _text(cell, 3, NOISE)
    value = round(round(float(cell), decimals + SETTLING), decimals) + 0.0
    return f"{value:.{decimals}f}"


def _padded(text: str, digits: int, longest: int) -> str:
    """With zeros at its end: ``digits`` in all at most, ``longest`` after the point."""
    exponent = int(f"{float(text):e}".partition("e")[2])
    return f"{float(text):.{max(0, min(longest, digits - 1 - exponent))}f}"


def _power_of_ten(found: re.Match[str]) -> str:
    mantissa, power = found.group(1), str(int(found.group(2)))
    if float(mantissa) == 0:
        return "0"
    times = "" if mantissa == "1" else f"{mantissa} × "
    return f"{times}10{power.translate(RAISED)}"
