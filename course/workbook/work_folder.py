"""The place to work: opening a lesson copies it from lessons/ to work/.

Nothing there is ever overwritten. Every file is created exclusively, whole or not at
all, so that even two starts at once cannot replace what a student saved.
``work/.course/started-from`` is only ever appended to: one line per copy, the SHA-256 of the
lesson it was made from. A lesson counts as newer when its content is one that no copy
was made from; dates and line endings do not matter.
"""

from __future__ import annotations

import difflib
import hashlib
import os
import re
import secrets
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from course.exercises.definition import DEEPER
from course.workbook.course_folder import append_line, kept_text

ROOT = Path(__file__).resolve().parents[2]
RECORD = "started-from"
#: What is handed out: read there, never written.
READ_ONLY = ("lessons", "solutions")


@dataclass(frozen=True)
class Opened:
    """A lesson opened for work: the notebook, a newer one beside it (or None), a
    message.
    """

    path: Path
    newer: Path | None = None
    message: str = ""


def lesson_files(root: Path = ROOT) -> list[Path]:
    """The lessons that can be opened, in order."""
    return in_order((root / "lessons").glob("[0-9][0-9]-*.ipynb"))


def in_order(notebooks: Iterable[Path]) -> list[Path]:
    """Notebooks as they are read: what goes deeper comes after its lesson."""
    return sorted(notebooks, key=lambda path: path.stem)


def find_lesson(name: str | Path, root: Path = ROOT) -> Path:
    """The lesson that ``name`` means.

    "10", "10-impulse", "impulse", "imp", or a path to the lesson or to a copy; "10-more"
    or "impulse-more" for what goes deeper. Raises ``ValueError`` naming the nearest
    lesson where there is none.
    """
    wanted = re.sub(r" \(new \d+\)$", "", Path(name).name.removesuffix(".ipynb"))
    known = {path.stem: path for path in lesson_files(root)}
    for stem, path in known.items():
        number, _, title = stem.partition("-")
        if wanted in (stem, title) or _is_number(wanted, number, stem.endswith(DEEPER)):
            return path
    holders = [path for stem, path in known.items() if wanted and wanted in stem]
    if len(holders) == 1 or len(holders) == 2 and _are_of_one_lesson(*holders):
        return holders[0]
    near = difflib.get_close_matches(
        wanted, [*known, *(stem[3:] for stem in known)], n=1, cutoff=0.5
    )
    advice = (
        f"did you mean {near[0]!r}?"
        if near
        else f"known: {', '.join(known) or 'none yet'}"
    )
    raise ValueError(
        f"lesson: expected a lesson's number or name; got {str(name)!r}; {advice}"
    )


def _is_number(wanted: str, number: str, deeper: bool) -> bool:
    digits = wanted.removesuffix(DEEPER) if deeper else wanted
    return (
        digits.isdecimal()
        and int(digits) == int(number)
        and (digits != wanted or not deeper)
    )


def _are_of_one_lesson(first: Path, second: Path) -> bool:
    return second.stem == first.stem + DEEPER


def open_lesson(name: str | Path, root: Path = ROOT) -> Opened:
    """Copy a lesson to work/ unless it is there; put a changed lesson beside the old
    copy.

    A copy that the student deleted is made again; a newer one that they deleted is not
    offered again. Raises ``ValueError`` for an unknown lesson and ``OSError`` where
    work/ cannot be written.
    """
    lesson = find_lesson(name, root)
    work = root / "work"
    work.mkdir(exist_ok=True)
    content = lesson.read_bytes()
    version = _version(content)
    target = work / lesson.name
    if not target.exists():
        _note(
            work, version, target.name
        )  # first, so that no copy ever lacks its version
        if create_exclusively(target, content):
            return Opened(
                target,
                message=f"{lesson.name} was copied to work/. Your work is saved there.",
            )
    started_from = _versions(work, lesson.stem)
    if version in started_from or _version(target.read_bytes()) == version:
        return Opened(target)
    return _offer(work, target, content, known_start=bool(started_from))


def _offer(work: Path, target: Path, content: bytes, *, known_start: bool) -> Opened:
    """Put a newer lesson beside the student's copy, under the first free number."""
    number = 2
    while True:
        beside = work / f"{target.stem} (new {number}).ipynb"
        if not beside.exists():
            _note(work, _version(content), beside.name)
            if create_exclusively(beside, content):
                break
        number += 1
    why = (
        "This lesson has changed since you started it."
        if known_start
        else "It is not known from which version of this lesson yours was started."
    )
    return Opened(
        target,
        beside,
        f"{why} Yours is left as it is; the new one lies beside it: work/{beside.name}",
    )


def create_exclusively(path: Path, content: bytes) -> bool:
    """Create a file whole or not at all.

    False, changing nothing, if the name is taken.
    """
    beside = path.with_name(f".{secrets.token_hex(8)}.part")
    try:
        with open(beside, "xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        if os.name == "nt":
            os.rename(
                beside, path
            )  # refuses an existing target; on POSIX it would replace it
        else:
            _link(beside, path)
    except FileExistsError:
        return False
    finally:
        beside.unlink(missing_ok=True)
    return True


def _link(source: Path, target: Path) -> None:
    """Give a finished file its name, all at once, unless the name is taken."""
    try:
        os.link(source, target)
    except FileExistsError:
        raise
    except OSError:  # a file system without hard links (a memory stick, some networks)
        with open(target, "xb") as file:
            try:
                file.write(source.read_bytes())
            except OSError:
                target.unlink()
                raise


def _version(content: bytes) -> str:
    return hashlib.sha256(content.replace(b"\r\n", b"\n")).hexdigest()


def _note(work: Path, version: str, name: str) -> None:
    append_line(work, RECORD, f"{version}  {name}")


def _versions(work: Path, stem: str) -> set[str]:
    """The versions of a lesson that copies were made from; unreadable lines are
    skipped.
    """
    text = kept_text(work, RECORD)
    form = re.compile(rf"([0-9a-f]{{64}})  {re.escape(stem)}(?: \(new \d+\))?\.ipynb")
    return {
        found.group(1) for line in text.splitlines() if (found := form.fullmatch(line))
    }
