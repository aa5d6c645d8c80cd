"""When old marks stand: not after a change to what they hang on, and whatever else
changes.
"""

import os
import shutil
import subprocess
import sys
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from grading.toy_lessons import LESSONS, OTHER, THRICE, TOY, blank, write

from course.exercises.definition import Case, Property, all_lessons
from course.grading import batch as batching
from course.grading import fingerprints as printing
from course.grading.fingerprints import fingerprint, grader_version, source_digest
from course.grading.grade import grade_folder
from course.sandbox.session import SandboxFailure

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


def times(factor):
    return lambda x: factor * x


def _cases(rng):
    return [Case("by hand", {"x": np.ones(3)})]


def with_property(tolerance):
    return (Property("long", lambda case, got: 0.0, "It is short.", tolerance),)


CHANGES = [
    dict(points=2), dict(task="Return more."), dict(results=()), dict(level="stretch"),
    dict(reference=times(3)), dict(reference=times(4)), dict(reference=partial(times, 3)),
    dict(reference=np.sin), dict(reference=np.cos), dict(cases=_cases),
    dict(mistakes=(replace(THRICE.mistakes[0], message="Look."),)),
    dict(properties=with_property(1e-9)), dict(properties=with_property(1e-6)),
]  # fmt: skip


def test_a_change_to_a_lesson_is_seen():
    changed = [replace(THRICE, **change) for change in CHANGES]
    lessons = [(replace(OTHER, exercises=(one,)),) for one in changed]
    versions = [grader_version(one) for one in [(OTHER,), LESSONS, *lessons]]
    assert len(set(versions)) == len(versions)


def test_values_are_told_apart():
    values = [
        0, 0.0, False, None, "", "0", (), [0], {}, {"a": 1}, {"a": 2}, {1}, {2}, np.zeros(2),
        np.zeros(3), np.zeros(2, int), np.ones(2), lambda: 0, lambda: 1, lambda x=1: x,
        lambda x=2: x, lambda *, x=1: x, lambda x: x.real, lambda x: x.imag,
    ]  # fmt: skip
    assert len({fingerprint(value) for value in values}) == len(values)
    own = []
    own.append(own)
    assert fingerprint(own) == fingerprint(own)


def test_another_process_comes_to_the_same():
    """Sets of texts have another order there, and everything another address."""
    tests = os.path.dirname(os.path.dirname(__file__))
    code = (
        "import sys; sys.path.insert(0, sys.argv[1])\n"
        "from grading.toy_lessons import LESSONS\n"
        "from course.exercises.definition import all_lessons\n"
        "from course.grading.fingerprints import grader_version\n"
        "print(grader_version(LESSONS), grader_version(all_lessons()))"
    )
    told = {
        subprocess.run([sys.executable, "-c", code, tests], env=os.environ | {"PYTHONHASHSEED": seed},
                       capture_output=True, text=True, check=True).stdout
        for seed in "12"
    }  # fmt: skip
    assert told == {f"{grader_version(LESSONS)} {grader_version(all_lessons())}\n"}


@pytest.mark.parametrize(
    "file, matters",
    [
        ("exercises/comparison.py", True), ("exercises/verdict.py", True), ("grading/judge.py", True),
        ("dynamics/impulse.py", True), ("formulas/new.py", True), ("sandbox/box.py", True),
        ("workbook/plots.py", False), ("cli.py", False), ("exercises/notes.txt", False),
    ],
)  # fmt: skip
def test_the_grader_s_source_is_part_of_it(tmp_path, file, matters):
    package = tmp_path / "course"
    shutil.copytree(
        printing.PACKAGE, package, ignore=shutil.ignore_patterns("__pycache__")
    )
    before = source_digest(package)
    source_digest.cache_clear()
    (package / file).parent.mkdir(exist_ok=True)
    with (package / file).open("a") as changed:
        changed.write("# changed\n")
    assert (source_digest(package) != before) == matters
    source_digest.cache_clear()


@pytest.fixture
def folder(tmp_path):
    for name in ("ann", "ben", "dan"):
        write(tmp_path / "in" / f"{name}.ipynb", blank())
    return tmp_path / "in"


@pytest.mark.slow
def test_force_and_a_change_mark_all_again(folder, tmp_path, monkeypatch):
    out, seen = tmp_path / "grades.csv", []

    def again(lessons=LESSONS, **options):
        seen.clear()
        grade_folder(
            folder, out, lessons=lessons, on_progress=lambda *t: seen.append(t[2]), **options
        )  # fmt: skip
        return seen[1:]

    assert len(again()) == 3 and again() == []
    text = out.read_text()
    assert len(again(force=True)) == 3 and out.read_text() == text
    assert again() == []
    richer = (replace(TOY, exercises=(replace(TOY.exercises[0], points=5), *TOY.exercises[1:])), OTHER)  # fmt: skip
    assert len(again(richer)) == 3 and again(richer) == []
    assert ",0,10," in out.read_text()
    monkeypatch.setattr(printing, "source_digest", lambda package: "a newer grader")
    assert len(again(richer)) == 3 and again(richer) == []


@pytest.mark.slow
def test_a_table_that_is_marked_again_keeps_its_rows_until_then(folder, tmp_path):
    out = tmp_path / "grades.csv"
    grade_folder(folder, out, lessons=LESSONS)
    before = out.read_text()

    def stop(done, total, file):
        if file:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        grade_folder(
            folder, out, lessons=LESSONS, force=True, workers=1, on_progress=stop
        )
    assert out.read_text() == before, "one new row, two old ones, all alike"


@pytest.mark.slow
@pytest.mark.parametrize("fails", [1, 2])
def test_a_process_that_does_not_start_ends_no_batch(
    folder, tmp_path, monkeypatch, fails
):
    """Once: it is tried again. Twice: a person has to look, and the next call tries it
    again.
    """
    judged, tried = batching.judged, []

    def failing(judge, task, content):
        tried.append(task.file)
        if task.file == "ben.ipynb" and tried.count(task.file) <= fails:
            raise SandboxFailure("no process for an answer: out of memory")
        return judged(judge, task, content)

    monkeypatch.setattr(batching, "PAUSE", 0.0)
    monkeypatch.setattr(batching, "judged", failing)
    told = grade_folder(folder, tmp_path / "grades.csv", lessons=LESSONS)
    assert tried.count("ben.ipynb") == 2 and len(tried) == 4
    assert (told.marked, told.needs_person) == ((3, 0) if fails == 1 else (2, 1))
    assert ("out of memory" in (tmp_path / "grades.csv").read_text()) == (fails == 2)
    again = grade_folder(folder, tmp_path / "grades.csv", lessons=LESSONS)
    assert (again.marked, again.kept) == (3, 4 - fails if fails == 2 else 3)


@pytest.mark.slow
def test_what_was_not_let_is_a_column_and_on_the_pages(folder, tmp_path, monkeypatch):
    judged = batching.judged

    def refusing(judge, task, content):
        lesson, rows, _ = judged(judge, task, content)
        refused = ("opening a socket",) if task.file == "ben.ipynb" else ()
        return lesson, rows, refused

    monkeypatch.setattr(batching, "judged", refusing)
    told = grade_folder(folder, tmp_path / "grades.csv", lessons=LESSONS)
    pages = {p.name: p.read_text() for p in told.feedback.glob("*.html")}
    having = sorted(name for name, text in pages.items() if "opening a socket" in text)
    assert len(having) == 2 and having[0].startswith("ben--") and having[1] == "index.html"  # fmt: skip
    assert told.out.read_text().count("opening a socket") == 1


@pytest.mark.slow
def test_no_more_are_begun_than_can_soon_be_judged(tmp_path, monkeypatch):
    """A thousand results held at once are memory that grows with the batch."""
    for index in range(30):
        write(tmp_path / "in" / f"{index}.ipynb", f"no notebook {index}")
    begun = []
    monkeypatch.setattr(
        batching, "judged", lambda judge, task, lessons: begun.append(task) or (None, (), ())
    )  # fmt: skip
    ahead = []

    def tell(done, total, file):
        ahead.append(len(begun) - done)

    grade_folder(
        tmp_path / "in",
        tmp_path / "g.csv",
        lessons=LESSONS,
        workers=2,
        on_progress=tell,
    )
    assert len(begun) == 30 and max(ahead) <= 4


@pytest.mark.slow
def test_a_page_that_cannot_be_made_and_a_file_that_goes_stop_no_other(
    folder, tmp_path, monkeypatch
):
    write_page, read_content = batching.write_page, batching.read_content

    def failing(path, submission, **told):
        if submission.file == "ann.ipynb":
            raise RuntimeError("a bug")
        write_page(path, submission, **told)

    def vanishing(task):
        if task.file == "ben.ipynb":
            raise FileNotFoundError(2, "No such file or directory")
        return read_content(task)

    monkeypatch.setattr(batching, "write_page", failing)
    monkeypatch.setattr(batching, "read_content", vanishing)
    told = grade_folder(folder, tmp_path / "grades.csv", lessons=LESSONS)
    assert (told.marked, told.needs_person, told.again) == (2, 1, 1)
    assert len(told.unwritten) == 1 and "RuntimeError: a bug" in told.unwritten[0]
    assert "1 pages are missing" in str(told)
    assert "cannot be read: No such file" in told.out.read_text()
    monkeypatch.undo()
    told = grade_folder(folder, tmp_path / "grades.csv", lessons=LESSONS)
    assert (told.kept, told.marked, told.unwritten) == (1, 3, ())


@pytest.mark.slow
def test_what_a_spreadsheet_makes_of_names_is_put_right(tmp_path):
    """It takes "1-2" for the first of February; the row is known by its key all the
    same.
    """
    write(tmp_path / "in" / "1-2", "my notes")
    write(tmp_path / "in" / "2-2.ipynb", blank())
    out = tmp_path / "grades.csv"
    grade_folder(tmp_path / "in", out, lessons=LESSONS)
    before = out.read_text(encoding="utf-8-sig")
    assert "\n1-2,1-2," in before
    saved = before.replace("\n1-2,1-2,", "\n01. Feb,01. Feb,")
    out.write_bytes(saved.replace("\n", "\r\n").encode("utf-8-sig"))
    again = grade_folder(tmp_path / "in", out, lessons=LESSONS)
    assert again.kept == 2 and out.read_text(encoding="utf-8-sig") == before
