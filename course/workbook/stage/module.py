"""The stage's program for the browser: its parts joined to one module, and its style."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

HERE = Path(__file__).parent
#: In this order: a part uses only those before it.
PARTS = (
    "film",
    "asking",
    "clock",
    "look",
    "labels",
    "matrices",
    "flat",
    "camera",
    "drawing",
    "space",
    "charts",
    "elements",
    "controls",
    "layout",
    "hands",
    "stage",
)
_IMPORT = re.compile(r"^import [^;]*?;\n", re.MULTILINE | re.DOTALL)
_EXPORT = re.compile(r"^export (?!default)", re.MULTILINE)


@cache
def program() -> str:
    """All parts as one module, whose default export is a widget's ``render``."""
    texts = [(HERE / "js" / f"{name}.js").read_text("utf-8") for name in PARTS]
    return "\n".join(_EXPORT.sub("", _IMPORT.sub("", text)) for text in texts)


@cache
def style() -> str:
    """The stage's style sheet."""
    return (HERE / "stage.css").read_text("utf-8")
