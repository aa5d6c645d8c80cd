"""Find what was handed in: every file of a folder, and whose it is.

Nothing is parsed or run here.
"""

from __future__ import annotations

import hashlib
import os
import stat
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from course.exercises.definition import Lesson
from course.exercises.notebook_file import MAXIMUM_BYTES, UnusableNotebook, too_large
from course.exercises.untrusted_text import clean
from course.grading.identity import Student, distinct_names, student_of
from course.grading.lock import FIRST_LINE
from course.grading.naming import page_names
from course.grading.table import is_table
from course.grading.writing import CannotWrite, write_whole

#: What operating systems leave behind, in lower case; nobody hands it in.
LEFT_BEHIND = frozenset(
    {
        ".ds_store", "thumbs.db", "desktop.ini", "__macosx", ".ipynb_checkpoints", ".directory", ".fseventsd",
        ".spotlight-v100", ".trashes", "$recycle.bin", "system volume information",
    }
)  # fmt: skip
LEFT_BEHIND_BEGINS = ("~$", ".~lock.")
APPLE_DOUBLE = b"\x00\x05\x16\x07"  # "._name": what a Mac stores about a file beside it

#: In every folder of pages that we write, so that a later batch recognizes it.
MARKER = "written-by-course-grade.txt"
MARKER_TEXT = (
    "Pages of feedback, written by course grade. This file says so to later batches.\n"
)
OURS_ENDS = (".html", ".part", ".lock")


@dataclass(frozen=True)
class Task:
    """A file to mark: its name below the folder, its path, its student, and its page.

    ``reason`` says why it cannot be marked, if that is clear without parsing it.
    ``digest`` covers its place and its content.
    """

    file: str
    path: Path
    student: Student
    page: Path
    place: bytes
    reason: str = ""
    digest: str = ""


def find_tasks(
    folder: Path, lessons: Sequence[Lesson], feedback: Path, *, own: Sequence[Path] = ()
) -> list[Task]:
    """Every file in the folder and below; ``own`` is our own output, which may lie
    there too.

    A hidden file or a link gets one task that says so, and is not opened. Raises
    ``ValueError`` for an empty folder.
    """
    found = list(_found(folder, own))
    if not found:
        raise ValueError(
            f"folder: expected submissions in {folder}; got an empty folder"
        )
    inside = [path.relative_to(folder) for path, _ in found]
    students = [student_of(file, lessons) for file in inside]
    shown = distinct_names(students)
    places = [os.fsencode(file.as_posix()) for file in inside]
    stems = [
        f"{student.name} {file.name.removesuffix('.ipynb')}"
        if student.name != file.name.removesuffix(".ipynb")
        else student.name
        for student, file in zip(students, inside, strict=True)
    ]
    pages = page_names(list(zip(stems, places, strict=True)))
    return [
        _task(Task(clean(os.fsdecode(place), 1000), path, replace(student, name=name), feedback / page, place, reason))
        for (path, reason), student, name, place, page in zip(
            found, students, shown, places, pages, strict=True)
    ]  # fmt: skip


def read_content(task: Task) -> bytes:
    """A submission's content.

    Raises ``OSError`` if it cannot be read or has changed.
    """
    with _opened(task.path) as file:
        content = file.read(MAXIMUM_BYTES + 1)
    if len(content) > MAXIMUM_BYTES:
        raise OSError("it has grown meanwhile")
    return content


def read_plain_file(path: Path) -> bytes:
    """One notebook's content; raises ``UnusableNotebook`` if it cannot be read."""
    if not path.exists():
        raise UnusableNotebook("no such file")
    reason = _reason(path.resolve())
    if reason != "":
        raise UnusableNotebook(reason or "not a file")
    with _opened(path.resolve()) as file:
        return bytes(file.read(MAXIMUM_BYTES + 1))


def digest_of(task: Task, content: bytes) -> str:
    """A digest of a submission by its place and its content."""
    return hashlib.sha256(_begin(task) + content).hexdigest()


def write_marker(feedback: Path) -> None:
    """Make a folder of pages that a later batch recognizes; raises ``CannotWrite``."""
    try:
        feedback.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CannotWrite(feedback, error) from error
    if _first(feedback / MARKER, len(MARKER_TEXT)) != MARKER_TEXT.encode():
        write_whole(feedback / MARKER, MARKER_TEXT)


def _task(task: Task) -> Task:
    """The task with its digest, read in pieces, or with the reason why it cannot be
    read.
    """
    found = hashlib.sha256(_begin(task))
    if not task.reason:
        try:
            with _opened(task.path) as file:
                while piece := file.read(1 << 20):
                    found.update(piece)
        except OSError as error:
            task = replace(task, reason=f"cannot be read: {error.strerror or error}")
            found = hashlib.sha256(_begin(task))
    return replace(task, digest=found.hexdigest())


def _begin(task: Task) -> bytes:
    """Its place and its reason, before the content, so that no two tasks share a
    digest.
    """
    reason = task.reason.encode("utf-8", "replace")
    return b"%d %d\0" % (len(task.place), len(reason)) + task.place + reason


def _opened(path: Path):
    """A plain file, open for reading; a link or a pipe that was put in its place is
    refused, not waited for.
    """
    flags = os.O_RDONLY
    for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_BINARY", "O_CLOEXEC"):
        flags |= getattr(os, name, 0)
    file = os.fdopen(os.open(path, flags), "rb")
    if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
        file.close()
        raise OSError("not a file any more")
    return file


def _found(folder: Path, own: Sequence[Path]) -> Iterator[tuple[Path, str]]:
    """Every path handed in, in order, and why it cannot be marked; without our own
    output.
    """
    ours = {_inode(path) for path in own} - {None}
    waiting = [folder]
    while waiting:
        here = waiting.pop()
        try:
            names = sorted(os.listdir(here), key=os.fsencode)
        except OSError as error:
            if here == folder:
                raise
            yield here, f"a folder that cannot be opened: {error.strerror or error}"
            continue
        below = []
        for path in (here / name for name in names):
            if _left_behind(path) or _inode(path) in ours:
                continue
            reason = _reason(path)
            if reason is not None:
                if reason or not _is_output(path):
                    yield path, reason
            elif not _is_feedback(path):
                below.append(path)
        waiting += reversed(below)


def _inode(path: Path) -> tuple[int, int] | None:
    try:
        found = os.lstat(path)
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _reason(path: Path) -> str | None:
    """Why a path cannot be marked; "" for a file that can be, None for a folder to
    open.
    """
    try:
        found = os.lstat(path)
    except OSError as error:
        return f"cannot be read: {error.strerror or error}"
    is_junction = getattr(path, "is_junction", bool)  # a Windows link, Python 3.12
    folder = stat.S_ISDIR(found.st_mode)
    if stat.S_ISLNK(found.st_mode) or is_junction():
        return "a link: not followed; hand in the file itself"
    if path.name.startswith(".") or _hidden_on_windows(found):
        return f"a hidden {'folder' if folder else 'file'}: not looked into"
    if folder:
        return None
    if not stat.S_ISREG(found.st_mode):
        return "not a file but a pipe or a device"
    if found.st_size == 0:
        return "the file is empty"
    if found.st_size > MAXIMUM_BYTES:
        return too_large(found.st_size)
    return ""


def _hidden_on_windows(found: os.stat_result) -> bool:
    return bool(getattr(found, "st_file_attributes", 0) & stat.FILE_ATTRIBUTE_HIDDEN)


def _left_behind(path: Path) -> bool:
    name = path.name.lower()
    if name in LEFT_BEHIND or name.startswith(LEFT_BEHIND_BEGINS):
        return True
    return name.startswith("._") and _first(path, 4) == APPLE_DOUBLE


def _is_output(path: Path) -> bool:
    """Whether a file is a table of marks or a lock, of this or an earlier batch."""
    first = _first(path, 1 << 16)  # the header of a table of all lessons has 10 kB
    lock = path.suffix == ".lock" and first.startswith(FIRST_LINE.encode())
    return lock or is_table(first)


def _is_feedback(folder: Path) -> bool:
    """Whether a folder holds our own pages and nothing else.

    The marker alone must not hide anything that was handed in.
    """
    marker = folder / MARKER
    if _first(marker, len(MARKER_TEXT)) != MARKER_TEXT.encode():
        return False
    with os.scandir(folder) as entries:
        return all(
            entry.name == MARKER
            or (
                entry.name.endswith(OURS_ENDS)
                and not entry.is_dir(follow_symlinks=False)
            )
            for entry in entries
        )


def _first(path: Path, count: int) -> bytes:
    try:
        with _opened(path) as file:
            return bytes(file.read(count))
    except OSError:
        return b""
