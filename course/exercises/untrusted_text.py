"""Text that somebody else wrote, made fit for terminals, tables and pages."""

from __future__ import annotations

from typing import Any


def clean(text: Any, limit: int) -> str:
    """The text, cut, and without characters that terminals, tables or encoders stumble over."""
    if not isinstance(text, str):
        return ""
    plain = text[:limit].encode("utf-8", "replace").decode("utf-8")
    return "".join(
        c if c.isprintable() or c in "\n\t" else "\N{REPLACEMENT CHARACTER}"
        for c in plain
    )
