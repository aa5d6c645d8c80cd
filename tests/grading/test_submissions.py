"""A folder of submissions: what is hidden or a link is told, no page is another's, our
own output is none.
"""

import os
import sys
import unicodedata

import pytest
from grading.toy_lessons import LESSONS, blank, write

from course.grading import submissions
from course.grading.grade import grade_folder
from course.grading.naming import page_names
from course.grading.submissions import MARKER, MARKER_TEXT, find_tasks


def found(folder, **more):
    return {
        task.file: task.reason
        for task in find_tasks(folder, LESSONS, folder / "pages", **more)
    }


def test_every_path_has_one_task(tmp_path):
    outside = write(tmp_path / "outside" / "secret.ipynb", blank())
    folder = tmp_path / "in"
    write(folder / "ann" / "a.ipynb", blank())
    write(folder / "ann" / ".hidden" / "deep" / "b.ipynb", blank())
    write(folder / "ann" / ".c.ipynb", blank())
    write(folder / "ben" / "empty.ipynb", "")
    (folder / "large.ipynb").touch()
    os.truncate(folder / "large.ipynb", 60_000_000)
    for junk in (".DS_Store", "Thumbs.db", "desktop.ini", "~$a.docx", ".~lock.a.odt#",
                 "__MACOSX/a.ipynb", ".ipynb_checkpoints/a.ipynb", "ann/.DS_Store"):  # fmt: skip
        write(folder / junk, "x")
    (folder / "._a.ipynb").write_bytes(b"\x00\x05\x16\x07" + bytes(100))
    write(folder / "._b.ipynb", "a student's own")
    if sys.platform != "win32":
        (folder / "linked").symlink_to(tmp_path / "outside")
        (folder / "linked.ipynb").symlink_to(outside)
        (folder / "broken.ipynb").symlink_to("nowhere")
        (folder / "round").symlink_to(folder)
        os.mkfifo(folder / "pipe.ipynb")
        link = "a link: not followed; hand in the file itself"
        links = dict.fromkeys(["linked", "linked.ipynb", "broken.ipynb", "round"], link)
        links["pipe.ipynb"] = "not a file but a pipe or a device"
    else:
        links = {}
    assert found(folder) == links | {
        "ann/a.ipynb": "", "ann/.hidden": "a hidden folder: not looked into",
        "ann/.c.ipynb": "a hidden file: not looked into", "ben/empty.ipynb": "the file is empty",
        "._b.ipynb": "a hidden file: not looked into",
        "large.ipynb": "60 MB is too large for a notebook (limit 50 MB)",
    }  # fmt: skip


@pytest.mark.skipif(sys.platform == "win32", reason="paths of POSIX")
def test_what_cannot_be_opened_is_told(tmp_path, monkeypatch):
    write(tmp_path / "in" / "closed" / "a.ipynb", blank())
    write(tmp_path / "in" / "b.ipynb", blank())
    listdir, opened = os.listdir, os.open

    def no_listing(path):
        if os.fspath(path).endswith("closed"):
            raise PermissionError(13, "Permission denied")
        return listdir(path)

    def no_opening(path, *more):
        if os.fspath(path).endswith("b.ipynb"):
            raise PermissionError(13, "Permission denied")
        return opened(path, *more)

    monkeypatch.setattr(submissions.os, "listdir", no_listing)
    monkeypatch.setattr(submissions.os, "open", no_opening)
    assert found(tmp_path / "in") == {
        "closed": "a folder that cannot be opened: Permission denied",
        "b.ipynb": "cannot be read: Permission denied",
    }


def test_nothing_is_parsed(tmp_path, monkeypatch):
    """Parsing what a stranger wrote can take hours; it is done one at a time, under a
    limit.
    """
    write(tmp_path / "deep.ipynb", "[" * 100_000)
    monkeypatch.setattr("json.loads", None)
    monkeypatch.setattr("ast.parse", None)
    assert found(tmp_path) == {"deep.ipynb": ""}


def test_a_digest_is_of_place_and_content(tmp_path):
    def digests():
        return [t.digest for t in find_tasks(tmp_path, LESSONS, tmp_path / "pages")]

    write(tmp_path / "a.ipynb", "one")
    write(tmp_path / "b.ipynb", "one")
    first = digests()
    assert len(set(first)) == 2 and digests() == first
    write(tmp_path / "b.ipynb", "two")
    assert digests()[0] == first[0] and digests()[1] not in first
    task = find_tasks(tmp_path, LESSONS, tmp_path / "pages")[0]
    content = submissions.read_content(task)
    assert submissions.digest_of(task, content) == task.digest


STRANGE = [
    "Ann Lee", "Ann_Lee", "ann lee", "ANN LEE", "Ann  Lee", "Ann-Lee", "Ann--Lee", "victim", "victim--10-impulse",
    "student--victim", "student", "index", "Zo\u00eb", "Zoe\u0308", "\u202eevil", "\U0001f600", "\U0001f601", "a\nb",
    "a\tb", "con", "x" * 240, "x" * 239 + "y", "\u4f60" * 80, "\u4f60" * 79 + "\u597d", "<b>", "a&b", "'q'", '"q"',
    "#1", "50%", "a?b", "%41", "a..", "-rf",
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="names that Windows refuses")
@pytest.mark.long
def test_no_page_is_ever_written_over_another_s(tmp_path):
    """On the folder's own file system, and as the names would be on one without case
    and normal forms.
    """
    folder = tmp_path / "in"
    names = [*STRANGE, os.fsdecode(b"raw\xff"), os.fsdecode(b"raw\xfe")]
    for name in names:
        for file in ("90-toy.ipynb", "91-other-toy.ipynb"):
            write(folder / name / file, f"{name!a} {file}")
        write(folder / f"{name}.ipynb", f"{name!a}")
    told = grade_folder(folder, tmp_path / "grades.csv", lessons=LESSONS)
    assert told.submissions == 3 * len(names) == told.unusable
    pages = [page.name for page in told.feedback.glob("*.html")]
    assert len(pages) == 3 * len(names) + len(names) + 1  # one with both, the index
    assert len({unicodedata.normalize("NFD", p).casefold() for p in pages}) == len(
        pages
    )
    assert all(len(os.fsencode(page)) + len(".part") <= 255 for page in pages)
    # Every student's own page leads to that student's two pages and no other's.
    tasks = find_tasks(folder, LESSONS, told.feedback, own=(told.out, told.feedback))
    shown = {}
    for page in told.feedback.glob("student--*--*.html"):
        text = page.read_text()
        own = [task for task in tasks if f'href="{task.page.name}"' in text]
        ascii_only = [task for task in own if task.page.name.isascii()]
        assert len(own) == len(ascii_only) in (0, 2)
        assert len({task.student.identity for task in own}) < 2
        shown |= dict.fromkeys((task.file for task in own), page)
    assert len(shown) > 40
    again = grade_folder(folder, tmp_path / "grades.csv", lessons=LESSONS)
    assert again.kept == again.submissions


def test_names_that_would_meet_have_their_whole_digest():
    names = page_names([("a", b"1"), ("A", b"1"), ("b", b"2")])
    assert len(names[0]) == len("a--.html") + 64 and len(names[2]) == len("b--.html") + 10  # fmt: skip
    assert page_names([("student", b"1")])[0].count("--") == 1
    assert page_names([("a--b", b"1")], prefix="student")[0].startswith("student--a-b--")  # fmt: skip


@pytest.mark.slow
def test_earlier_output_in_the_folder_is_no_submission(tmp_path):
    """By whatever name; and the mark of our folders hides nothing that was handed in."""
    folder = tmp_path / "in"
    for name in ("ann", "ben"):
        write(folder / name / "90-toy.ipynb", blank())
    for out in ("grades.csv", "ann/second.csv", "third.txt"):
        told = grade_folder(folder, folder / out, lessons=LESSONS)
        assert (told.submissions, told.marked) == (2, 2), out
    text = (folder / "grades.csv").read_text(encoding="utf-8-sig")
    (folder / "saved.csv").write_bytes(text.replace(",", ";").encode("cp1252"))
    write(folder / "grades.csv.lock", "lock of course grade\n1\nx\ny\n")
    assert list(found(folder)) == ["ann/90-toy.ipynb", "ben/90-toy.ipynb"]
    write(folder / "eve" / MARKER, MARKER_TEXT)
    write(folder / "eve" / "90-toy.ipynb", blank())
    write(folder / "eve" / "page.html", "x")
    assert set(found(folder)) >= {"eve/90-toy.ipynb", f"eve/{MARKER}", "eve/page.html"}
    write(folder / "marks.csv", "file,student,lesson\nmine,x,y\n")
    assert "marks.csv" in found(folder)


@pytest.mark.skipif(sys.platform == "win32", reason="paths of POSIX")
def test_folders_deeper_than_a_path_can_be_are_told(tmp_path):
    write(tmp_path / "in" / "ann.ipynb", blank())
    here = os.open(tmp_path / "in", os.O_RDONLY)
    for _ in range(60):
        os.mkdir("d" * 100, dir_fd=here)
        below = os.open("d" * 100, os.O_RDONLY, dir_fd=here)
        os.close(here)
        here = below
    os.close(here)
    told = found(tmp_path / "in")
    assert len(told) == 2 and told["ann.ipynb"] == ""
    assert "cannot be read: File name too long" in told.values()
