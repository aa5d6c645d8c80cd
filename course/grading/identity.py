"""Whose a file is, from where a download put it.

Students are distinguished by the download's data (a name and a number in Moodle's), else
by their folder's path; an equal name alone does not make two of them one person.
"""

from __future__ import annotations

import os
import re
import unicodedata
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePath

from course.exercises.definition import Lesson
from course.exercises.untrusted_text import clean

#: "Ann Lee_101_assignsubmission_file_" is a folder; in a download without folders the
#: file's name follows it.
MOODLE = re.compile(r"(.*?)_(\d+)_assignsubmission_[a-z]+_?(.*)", re.DOTALL)
#: What Moodle calls everybody where names are hidden, in a few languages.
NOBODY = re.compile(r"(participa|teilnehm|deelnem)\w*", re.IGNORECASE)
#: Folders that students make inside their own, and folders that hold several students.
WORK = frozenset("work src notebook notebooks final solution abgabe".split())
SEVERAL = re.compile(
    r"(group|gruppe|class|section|tutorial|team|week|lessons?|submissions?|submitted|handed in)[\s_-]*\w{0,3}",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Student:
    """Whose a file is: the name to show, what identifies the student, and a suffix.

    The suffix is added where two students have the same name.
    """

    name: str
    identity: bytes
    more: tuple[str, ...] = ()


def student_of(file: PurePath, lessons: Sequence[Lesson]) -> Student:
    """Whose a file is: by Moodle's name and number, else by folder, else by name."""
    for depth, part in enumerate(file.parts):
        moodle = MOODLE.fullmatch(part)
        if moodle:
            return _of_moodle(file.parts[:depth], moodle[1], moodle[2])
    folders = list(file.parts[:-1])
    while folders and (folders[-1].lower() in WORK or _is_lesson(folders[-1], lessons)):
        folders.pop()
    if folders:
        return _of_folder(tuple(folders), lessons)
    return _of_file(file, lessons)


def distinct_names(students: Sequence[Student]) -> list[str]:
    """The names to show; students of the same name get a distinguishing suffix."""
    names = [student.name for student in students]
    for more in range(2):
        people = defaultdict(set)
        for name, student in zip(names, students, strict=True):
            people[_same(name)].add(student.identity)
        names = [
            f"{name} ({student.more[more]})"
            if len(people[_same(name)]) > 1 and more < len(student.more)
            else name
            for name, student in zip(names, students, strict=True)
        ]
    return names


def _same(name: str) -> str:
    return unicodedata.normalize("NFC", name).casefold()


def _of_moodle(above: tuple[str, ...], name: str, number: str) -> Student:
    shown = clean(name, 200) or "Participant"
    if NOBODY.fullmatch(name) or not name:
        shown = f"{shown} {number}"
    return Student(
        shown, _identity("moodle", *above, name, number), (number, _path(above))
    )


def _of_folder(folders: tuple[str, ...], lessons: Sequence[Lesson]) -> Student:
    named = [
        part
        for part in folders[:-1]
        if not SEVERAL.fullmatch(part) and not _is_lesson(part, lessons)
    ]
    shown = _path((*named, folders[-1]))
    return Student(shown, _identity("folder", *folders), (_path(folders),))


def _of_file(file: PurePath, lessons: Sequence[Lesson]) -> Student:
    stem = file.name.removesuffix(".ipynb")
    for notebook in sorted((le.stem for le in lessons), key=len, reverse=True):
        stem = stem.replace(notebook, " ")
    rest = stem.strip(" _-.,()")
    named = rest if re.search(r"[^\W\d_]", rest) else file.stem
    place = file.parts[:-1]
    return Student(
        clean(named, 200), _identity("file", *place, named), (_path((*place, named)),)
    )


def _path(parts: Sequence[str]) -> str:
    return clean("/".join(parts), 200)


def _identity(*parts: str) -> bytes:
    return os.fsencode("\0".join(parts))


def _is_lesson(name: str, lessons: Sequence[Lesson]) -> bool:
    """Whether a folder is named after a lesson: "10", "lesson 10", "10-impulse"."""
    words = re.sub(r"[\W_]+", " ", name.lower()).split()
    for lesson in lessons:
        number, named = lesson.number.split("-"), lesson.stem.lower().split("-")
        if words in (number, ["lesson", *number], named, ["lesson", *named]):
            return True
    return False
