"""Numbers as pictures and their alternative texts write them."""

from __future__ import annotations


def signed(value: float, digits: int = 2) -> str:
    """With its sign, a real minus, and a plain 0 for what rounds to nothing."""
    if abs(value) < 0.5 * 10.0**-digits:
        return "0"
    return f"{value:+.{digits}f}".replace("-", "\N{MINUS SIGN}")


def plain(value: float) -> str:
    """Two decimals, and never a minus zero."""
    return f"{round(float(value), 2) + 0.0:.2f}"
