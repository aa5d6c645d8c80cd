"""What is kept about lessons: files in ``work/.course/``, so that work/ itself shows
lessons alone.

Earlier editions kept them beside the lessons. Such a file is taken along where it is
met; one that cannot be (a folder that may not be written) is used where it is.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

FOLDER = ".course"
#: Name -> where earlier editions kept it, below work/.
EARLIER = {
    "progress.jsonl": "progress.jsonl",
    "unrecognised.jsonl": "unrecognised.jsonl",
    "started-from": ".started-from",
    "workspaces": ".jupyter/workspaces",
}


def kept(work: Path, name: str) -> Path:
    """Where ``name`` is kept for the lessons in ``work``; its folder is made, its earlier
    file taken along.
    """
    path, earlier = work / FOLDER / name, work / EARLIER[name]
    with contextlib.suppress(OSError):
        path.parent.mkdir(exist_ok=True)
    if not earlier.exists():
        return path
    with contextlib.suppress(OSError):
        _take_along(earlier, path)
    return earlier if earlier.exists() else path


def kept_text(work: Path, name: str) -> str:
    """What a kept file says, with what its earlier one still says; nothing where there is
    none.
    """
    places = [work / EARLIER[name], work / FOLDER / name]
    kept(work, name)  # taken along first, so that nothing is read twice
    return "".join(_text(place) for place in places)


def append_line(work: Path, name: str, line: str) -> None:
    """Add a line to a kept file in one write; after an incomplete one (a crash, a full
    disk) begin a new one. A file that cannot be written is left.

    Under a lock: another notebook's half-written line looks like an incomplete one.
    """
    with contextlib.suppress(OSError):
        _append(kept(work, name), (line + "\n").encode())


def _take_along(earlier: Path, path: Path) -> None:
    """Move a file or folder, once, whichever notebook comes first.

    Where both exist (an earlier edition's kernel still wrote) the lines are joined.
    """
    with _one_at_a_time(path.parent):
        if not earlier.exists():
            return
        if earlier.is_dir():
            os.rename(earlier, path)  # refuses a folder that has something in it
            with contextlib.suppress(OSError):
                earlier.parent.rmdir()
            return
        try:
            if os.name == "nt":
                os.rename(earlier, path)  # refuses an existing target
                return
            os.link(earlier, path)
        except FileExistsError:
            if not os.path.samefile(earlier, path):
                _append(path, earlier.read_bytes())
        except OSError:  # a file system without hard links
            os.rename(earlier, path)
            return
        earlier.unlink(missing_ok=True)


@contextlib.contextmanager
def _one_at_a_time(folder: Path) -> Iterator[None]:
    with open(folder / "moving", "ab") as file:
        _wait_for_others(file.fileno())
        yield


def _append(path: Path, line: bytes) -> None:
    with path.open("a+b", buffering=0) as file:
        _wait_for_others(file.fileno())
        if file.seek(0, os.SEEK_END):
            file.seek(-1, os.SEEK_END)
            line = line if file.read(1) == b"\n" else b"\n" + line
        file.write(line)


def _wait_for_others(number: int) -> None:
    """Lock an open file until it is closed, where the system can."""
    fcntl: Any
    try:
        import fcntl
    except ImportError:  # Windows
        return
    fcntl.flock(number, fcntl.LOCK_EX)


def _text(path: Path) -> str:
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    return text if text.endswith("\n") or not text else text + "\n"
