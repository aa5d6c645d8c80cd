"""File names of pages: readable, and unique to a submission on every file system."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections import Counter
from collections.abc import Sequence

LONGEST = 80  # bytes of the readable part; most file systems allow 255 in all
SHORT_DIGEST = 10


def readable(text: str) -> str:
    """A name as part of a file's: letters, digits and single hyphens, never ``--``."""
    plain = unicodedata.normalize("NFC", text[:500])
    plain = plain.encode("utf-8", "replace").decode()
    plain = re.sub(r"-{2,}", "-", re.sub(r"[^\w.-]+", "_", plain))
    cut = plain.strip("._-").encode()[:LONGEST].decode("utf-8", "ignore")
    return cut.strip("._-") or "unnamed"


def page_names(
    named: Sequence[tuple[str, bytes]], *, prefix: str = ""
) -> tuple[str, ...]:
    """A file name for each (readable text, identifying bytes).

    For instance ``Ann_Lee--0123456789.html``. Names with a ``prefix`` (``student``)
    never collide with those without. Where two would be equal on a file system that
    ignores case, both get their full digest.
    """
    begin = f"{prefix}--" if prefix else ""
    stems = [begin + readable(text) for text, _ in named]
    digests = [hashlib.sha256(own).hexdigest() for _, own in named]
    short = [
        f"{stem}--{digest[:SHORT_DIGEST]}"
        for stem, digest in zip(stems, digests, strict=True)
    ]
    count = Counter(name.casefold() for name in short)
    return tuple(
        f"{name}.html" if count[name.casefold()] == 1 else f"{stem}--{digest}.html"
        for name, stem, digest in zip(short, stems, digests, strict=True)
    )
