"""Find what was handed in: every file of a folder, whose it is, and which lesson it is of. Nothing is run here."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from course.exercises.definition import Lesson
from course.exercises.notebook_file import (
    MAXIMUM_BYTES,
    NotebookFile,
    UnusableNotebook,
    read_notebook,
)
from course.grading.reply import clean
from course.grading.report import digest_of

LEFT_BEHIND = frozenset({"thumbs.db", "desktop.ini", "__macosx"})
MOODLE = re.compile(r"_\d+_assignsubmission_.*$")


@dataclass(frozen=True)
class Task:
    """A file to mark: its name below the folder, whose it is, a digest of what is in it, and where its page goes.

    ``notebook`` is None for a file that cannot be marked, and ``reason`` says why.
    """

    file: str
    student: str
    digest: str
    page: Path
    notebook: NotebookFile | None = None
    reason: str = ""


def find_tasks(
    folder: Path, lessons: Sequence[Lesson], feedback: Path, *, own: Sequence[Path] = ()
) -> list[Task]:
    """Every file in the folder and below it, read but not run; ``own`` is our own output, which may lie there too.

    Raises ``ValueError`` for a folder without any.
    """
    tasks = [_task(folder, path, lessons, feedback) for path in _files(folder, own)]
    if not tasks:
        raise ValueError(
            f"folder: expected submissions in {folder}; got an empty folder"
        )
    names = [task.page.name.lower() for task in tasks]
    return [
        task if names.count(task.page.name.lower()) == 1 else _with_own_page(task)
        for task in tasks
    ]


def _with_own_page(task: Task) -> Task:
    """The task with a page that no other submission has, though the student's name is the same."""
    return replace(
        task, page=task.page.with_name(f"{task.page.stem}-{task.digest[:8]}.html")
    )


def _files(folder: Path, own: Sequence[Path]) -> list[Path]:
    """Every file that was handed in, in order; what systems leave behind and our own output are left out."""
    ours = {path.resolve() for path in own}
    found = []
    for place, folders, names in os.walk(folder):
        here = Path(place)
        folders[:] = sorted(
            n
            for n in folders
            if not _left_behind(n) and (here / n).resolve() not in ours
        )
        found += [
            here / n
            for n in sorted(names)
            if not _left_behind(n) and (here / n).resolve() not in ours
        ]
    return found


def _left_behind(name: str) -> bool:
    return name.startswith((".", "~$")) or name.lower() in LEFT_BEHIND


def _task(folder: Path, path: Path, lessons: Sequence[Lesson], feedback: Path) -> Task:
    file = clean(path.relative_to(folder).as_posix(), 1000)
    notebook, reason, content = None, "", b""
    try:
        if path.is_symlink() or not path.is_file():
            raise UnusableNotebook("not a file but a link or a device")
        if path.stat().st_size <= MAXIMUM_BYTES:
            content = path.read_bytes()
        notebook = read_notebook(path, lessons)
    except UnusableNotebook as error:
        reason = str(error)
    except Exception as error:  # one file that cannot be read stops no other
        reason = f"cannot be read: {type(error).__name__}: {error}"
    lesson = notebook.lesson if notebook else None
    student = student_of(path.relative_to(folder), lessons)
    ending = f"{lesson.number}-{lesson.name}" if lesson else "unusable"
    page = feedback / f"{page_name(student or path.stem)}--{ending}.html"
    return Task(
        file, student, digest_of(content, file, notebook), page, notebook, reason
    )


def student_of(file: Path, lessons: Sequence[Lesson]) -> str:
    """Whose a file is, told from its folder (one a student) or else from its own name without the lesson's."""
    parent = MOODLE.sub("", file.parent.name)
    if parent and not any(_is_lesson(parent, lesson) for lesson in lessons):
        return clean(parent, 200)
    stem = file.name.removesuffix(".ipynb")
    for lesson in lessons:
        stem = re.sub(rf"{lesson.number}-{re.escape(lesson.name)}", " ", stem)
    rest = stem.strip(" _-.,()")
    return clean(rest if re.search(r"[^\W\d_]", rest) else file.stem, 200)


def _is_lesson(name: str, lesson: Lesson) -> bool:
    """Whether a folder is named after a lesson: "10", "lesson 10", "10-impulse"."""
    words = re.sub(r"[\W_]+", " ", name.lower()).split()
    named = [lesson.number, *lesson.name.lower().split("-")]
    return words in (
        [lesson.number],
        ["lesson", lesson.number],
        named,
        ["lesson", *named],
    )


def page_name(name: str) -> str:
    """A student's name as a part of a file's."""
    return re.sub(r"[^\w.-]+", "_", name).strip("._")[:50] or "unnamed"
