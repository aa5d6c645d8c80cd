"""Write files whole or not at all, and say what to do where one cannot be written."""

from __future__ import annotations

import errno
import os
from pathlib import Path

CURES = {
    errno.ENOSPC: "free some room on its disk",
    getattr(errno, "EDQUOT", errno.ENOSPC): "free some room within your quota",
    errno.EFBIG: "raise the limit on the size of a file (ulimit -f)",
    errno.EACCES: "close it where it is open, or see to its permissions",
    errno.EPERM: "close it where it is open, or see to its permissions",
    errno.EBUSY: "close it where it is open",
    errno.EROFS: "choose a place that can be written to",
}


class CannotWrite(OSError):
    """A file of the grader's that cannot be written; names it, the reason and the
    remedy.
    """

    def __init__(self, path: Path, error: OSError, kept: str = "") -> None:
        cure = CURES.get(error.errno or 0, "see to that")
        words = f"{path} cannot be written ({error.strerror or error}): {cure}, then give the same command again"
        super().__init__(f"{words}; {kept}" if kept else words)


def write_whole(path: Path, text: str, *, lasting: bool = False) -> None:
    """Write a text file in UTF-8, whole or not at all; ``lasting`` waits for the disk.

    The text goes to ``NAME.part`` beside the file first; one that a killed grader left
    there is overwritten by the next. Raises ``CannotWrite``.
    """
    path = Path(os.path.realpath(path))
    part = path.with_name(path.name + ".part")
    try:
        with part.open("w", encoding="utf-8", errors="replace", newline="") as file:
            file.write(text)
            file.flush()
            if lasting:
                os.fsync(file.fileno())
        os.replace(part, path)
    except BaseException as error:
        try:
            part.unlink(missing_ok=True)
        except OSError:
            pass  # what cannot be written cannot always be deleted either
        if isinstance(error, OSError):
            raise CannotWrite(path, error) from error
        raise
