"""What is kept about lessons: one folder, earlier editions' files taken along once, nothing stops a student."""

import json
import os
import subprocess
import sys

import pytest

from course.workbook import course_folder, recording
from course.workbook.course_folder import EARLIER, append_line, kept, kept_text
from course.workbook.work_folder import open_lesson

EVENT = '{"kind": "check", "name": "cross", "state": "passed"}'


@pytest.fixture
def work(tmp_path):
    (tmp_path / "lessons").mkdir()
    folder = tmp_path / "work"
    folder.mkdir()
    return folder


def names(folder):
    return sorted(path.name for path in folder.iterdir())


def test_the_working_folder_shows_lessons_alone(work, monkeypatch):
    (work.parent / "lessons" / "10-impulse.ipynb").write_text("{}")
    open_lesson("10", work.parent)
    monkeypatch.chdir(work)
    recording.record("check", "cross", state="passed")
    recording.record_unrecognised("cross", "source", "message")
    visible = [name for name in names(work) if not name.startswith(".")]
    assert [name for name in visible if name.endswith(".ipynb")] == ["10-impulse.ipynb"]
    assert [n for n in visible if not n.endswith((".ipynb", ".md"))] == []
    assert names(work / ".course") == [
        "progress.jsonl", "started-from", "unrecognised.jsonl",
    ]  # fmt: skip


@pytest.mark.parametrize(
    "name", ["progress.jsonl", "unrecognised.jsonl", "started-from"]
)
@pytest.mark.parametrize("links", [True, False], ids=["hard links", "no hard links"])
def test_an_earlier_edition_s_file_is_taken_along(work, monkeypatch, name, links):
    if not links:
        monkeypatch.setattr(
            os,
            "link",
            lambda *names: (_ for _ in ()).throw(PermissionError("no links here")),
        )
    (work / EARLIER[name]).write_text("a line\n")
    append_line(work, name, "another")
    assert kept(work, name).read_text() == "a line\nanother\n"
    assert not (work / EARLIER[name]).exists()


def test_the_arrangement_of_tabs_is_taken_along(work):
    old = work / EARLIER["workspaces"]
    old.mkdir(parents=True)
    (old / "tabs").write_text("here")
    assert (kept(work, "workspaces") / "tabs").read_text() == "here"
    assert names(work) == [".course"]


def test_what_an_old_kernel_still_writes_is_joined(work):
    append_line(work, "progress.jsonl", "new")
    (work / "progress.jsonl").write_text("old, cut o")
    assert kept_text(work, "progress.jsonl") == "new\nold, cut o\n"
    append_line(work, "progress.jsonl", "newest")
    assert kept_text(work, "progress.jsonl").splitlines() == [
        "new", "old, cut o", "newest",
    ]  # fmt: skip
    assert not (work / "progress.jsonl").exists()


def test_a_move_cut_off_between_its_steps_doubles_nothing(work):
    (work / "progress.jsonl").write_text(EVENT + "\n")
    (work / ".course").mkdir()
    os.link(work / "progress.jsonl", work / ".course" / "progress.jsonl")
    assert kept_text(work, "progress.jsonl") == EVENT + "\n"
    assert names(work) == [".course"]


@pytest.mark.slow
def test_two_notebooks_at_once_lose_nothing(work):
    earlier = [f"before{i}" for i in range(100)]
    (work / "progress.jsonl").write_text("".join(f'{{"name": "{n}", "kind": "check"}}\n' for n in earlier))  # fmt: skip
    code = "from course.workbook.recording import record\nfor i in range(100): record('check', f'{who}{i}', state='')"
    both = [
        subprocess.Popen([sys.executable, "-c", f"who = {who!r}\n{code}"], cwd=work)
        for who in "ab"
    ]
    assert [p.wait(60) for p in both] == [0, 0]
    said = [json.loads(line)["name"] for line in kept_text(work, "progress.jsonl").splitlines()]  # fmt: skip
    assert sorted(said) == sorted([*earlier, *(f"{w}{i}" for w in "ab" for i in range(100))])  # fmt: skip
    assert not (work / "progress.jsonl").exists()


@pytest.mark.parametrize("earlier", [True, False])
def test_a_folder_that_cannot_be_made_stops_nothing(work, monkeypatch, earlier):
    """Where nothing can be moved, the earlier file is read and written as before."""
    (work / ".course").write_text("a file stands in the way")
    monkeypatch.chdir(work)
    if earlier:
        (work / "progress.jsonl").write_text(EVENT + "\n")
    recording.record("check", "normalise", state="passed")
    recording.record_unrecognised("cross", "source", "message")
    monkeypatch.setattr(recording, "_session", [])
    expected = {"cross", "normalise"} if earlier else set()
    assert recording.state().passed == expected
    (work.parent / "lessons" / "10-impulse.ipynb").write_text("{}")
    assert open_lesson("10", work.parent).path.exists()


def test_it_says_nothing_of_where_there_is_no_folder(tmp_path):
    nowhere = tmp_path / "nowhere"
    assert kept_text(nowhere, "progress.jsonl") == ""
    append_line(nowhere, "progress.jsonl", "lost")
    assert not nowhere.exists() and course_folder.FOLDER == ".course"
