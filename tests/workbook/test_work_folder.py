"""The place to work: copies whole or not at all, nothing ever overwritten, newer lessons laid beside."""

import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from course.workbook import work_folder
from course.workbook.course_folder import FOLDER
from course.workbook.work_folder import (
    RECORD,
    create_exclusively,
    find_lesson,
    lesson_files,
    open_lesson,
)

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def root(tmp_path):
    (tmp_path / "lessons").mkdir()
    write(tmp_path, "00-start-here", "start")
    write(tmp_path, "10-impulse", "first version\n")
    (tmp_path / "lessons" / "notes.ipynb").write_text("no lesson")
    return tmp_path


def write(root, name, text):
    (root / "lessons" / f"{name}.ipynb").write_bytes(text.encode())


def files(root):
    return {
        path.name: path.read_text()
        for path in (root / "work").iterdir()
        if path.name != FOLDER
    }


def test_lessons_are_those_with_a_number(root):
    assert [path.stem for path in lesson_files(root)] == ["00-start-here", "10-impulse"]


@pytest.mark.parametrize(
    "name", ["10", "10-impulse", "impulse", "imp", "10-impulse.ipynb", "lessons/10-impulse.ipynb",
             Path("work/10-impulse (new 3).ipynb")],
)  # fmt: skip
def test_a_lesson_goes_by_several_names(root, name):
    assert find_lesson(name, root).name == "10-impulse.ipynb"


def test_a_number_may_lack_its_zero(root):
    assert find_lesson("0", root).name == "00-start-here.ipynb"


@pytest.mark.parametrize("name, said", [("inpulse", "did you mean 'impulse'?"), ("", "known: "), ("s", "known: "),
                                        ("99", "known: 00-start-here, 10-imp")])  # fmt: skip
def test_an_unknown_lesson_is_named_with_the_nearest(root, name, said):
    with pytest.raises(ValueError, match="lesson: expected") as error:
        find_lesson(name, root)
    assert said in str(error.value) and repr(name) in str(error.value)


def test_the_first_opening_copies_and_the_next_leaves_alone(root):
    opened = open_lesson("10", root)
    assert opened.path == root / "work" / "10-impulse.ipynb" and opened.newer is None
    assert "copied to work/" in opened.message
    opened.path.write_text("my answers")
    again = open_lesson("10", root)
    assert again.path == opened.path and again.newer is None and again.message == ""
    assert files(root) == {"10-impulse.ipynb": "my answers"}


def test_a_changed_lesson_is_laid_beside_once(root):
    open_lesson("10", root).path.write_text("my answers")
    write(root, "10-impulse", "second version\n")
    opened = open_lesson("10", root)
    assert opened.path.read_text() == "my answers"
    assert opened.newer == root / "work" / "10-impulse (new 2).ipynb"
    assert (
        "has changed since you started it" in opened.message
        and "(new 2)" in opened.message
    )
    assert open_lesson("10", root).newer is None
    opened.newer.write_text("begun as well")
    write(root, "10-impulse", "third version\n")
    assert open_lesson("10", root).newer.name == "10-impulse (new 3).ipynb"
    assert files(root) == {"10-impulse.ipynb": "my answers", "10-impulse (new 2).ipynb": "begun as well",
                           "10-impulse (new 3).ipynb": "third version\n"}  # fmt: skip


def test_only_a_lesson_that_changed_counts(root):
    open_lesson("10", root).path.write_text("mine")
    os.utime(root / "lessons" / "10-impulse.ipynb", (2e9, 2e9))  # a newer date
    assert open_lesson("10", root).newer is None
    write(root, "10-impulse", "first version\r\n")  # another checkout's line endings
    assert open_lesson("10", root).newer is None
    write(root, "00-start-here", "another lesson")
    assert open_lesson("10", root).newer is None


def test_a_lesson_changed_back_is_not_offered_again(root):
    open_lesson("10", root)
    write(root, "10-impulse", "second version\n")
    open_lesson("10", root).newer.unlink()  # the student does not want it
    assert open_lesson("10", root).newer is None
    write(root, "10-impulse", "first version\n")
    assert open_lesson("10", root).newer is None


def test_a_deleted_copy_is_made_anew(root):
    open_lesson("10", root).path.unlink()
    assert open_lesson("10", root).path.read_text() == "first version\n"


def test_a_copy_of_unknown_origin_is_kept_and_the_lesson_laid_beside(root):
    (root / "work").mkdir()
    (root / "work" / "10-impulse.ipynb").write_text(
        "brought along from another machine"
    )
    opened = open_lesson("10", root)
    assert opened.path.read_text() == "brought along from another machine"
    assert opened.newer.read_text() == "first version\n"
    assert "not known from which version" in opened.message


def test_a_copy_of_unknown_origin_that_equals_the_lesson_needs_no_other(root):
    open_lesson("10", root)
    (root / "work" / FOLDER / RECORD).unlink()
    assert open_lesson("10", root).newer is None


def test_a_damaged_record_is_read_as_far_as_it_goes(root):
    open_lesson("10", root).path.write_text("mine")
    record = root / "work" / FOLDER / RECORD
    record.write_bytes(b"\xff\x00 garbage\n" + record.read_bytes() + b"cut o")
    assert open_lesson("10", root).newer is None


def test_a_name_taken_by_the_student_is_passed_over(root):
    open_lesson("10", root).path.write_text("mine")
    (root / "work" / "10-impulse (new 2).ipynb").write_text("also mine")
    write(root, "10-impulse", "second version\n")
    assert open_lesson("10", root).newer.name == "10-impulse (new 3).ipynb"
    assert (root / "work" / "10-impulse (new 2).ipynb").read_text() == "also mine"


def test_saved_between_the_look_and_the_copy_it_is_not_overwritten(root, monkeypatch):
    real = work_folder.create_exclusively

    def late(path, content):
        path.write_text("saved at the last moment")
        return real(path, content)

    monkeypatch.setattr(work_folder, "create_exclusively", late)
    opened = open_lesson("10", root)
    assert opened.path.read_text() == "saved at the last moment"
    assert list(files(root)) == ["10-impulse.ipynb"]


@pytest.mark.parametrize("links", [True, False], ids=["hard links", "no hard links"])
def test_exclusive_creation(tmp_path, monkeypatch, links):
    if not links:
        monkeypatch.setattr(
            os,
            "link",
            lambda *names: (_ for _ in ()).throw(PermissionError("no links here")),
        )
    target = tmp_path / "a"
    assert create_exclusively(target, b"first") is True
    assert create_exclusively(target, b"second") is False
    assert target.read_bytes() == b"first"
    assert [path.name for path in tmp_path.iterdir()] == ["a"]  # no leftovers


def test_a_full_disk_leaves_nothing_half_written(tmp_path, monkeypatch):
    monkeypatch.setattr(
        os,
        "fsync",
        lambda number: (_ for _ in ()).throw(OSError(28, "No space left on device")),
    )
    with pytest.raises(OSError, match="No space"):
        create_exclusively(tmp_path / "a", b"first")
    assert list(tmp_path.iterdir()) == []


def test_of_many_at_once_one_wins_and_all_agree(root):
    results, start = [], threading.Barrier(8)

    def race():
        start.wait()
        results.append(open_lesson("10", root))

    threads = [threading.Thread(target=race) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert {result.path.name for result in results} == {"10-impulse.ipynb"}
    assert sum("copied" in result.message for result in results) == 1
    assert files(root) == {"10-impulse.ipynb": "first version\n"}


def test_a_copy_may_be_written_as_any_file_of_the_student(root):
    (root / "lessons" / "10-impulse.ipynb").chmod(0o444)
    path = open_lesson("10", root).path
    fresh = root / "work" / "fresh"
    fresh.write_text("")
    assert path.stat().st_mode == fresh.stat().st_mode


def test_git_ignores_the_place_to_work():
    if subprocess.run(
        ["git", "rev-parse"], cwd=ROOT, capture_output=True, check=False
    ).returncode:
        pytest.skip("no git checkout")
    ignored = subprocess.run(["git", "check-ignore", "work/10-impulse.ipynb", f"work/{FOLDER}/{RECORD}"], cwd=ROOT,
                             capture_output=True, text=True, check=False)  # fmt: skip
    assert len(ignored.stdout.split()) == 2


def test_reading_the_module_is_cheap():
    code = "import course.workbook.work_folder, sys; print('matplotlib' in sys.modules, 'scipy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT,
                          check=True).stdout.split() == ["False", "False"]  # fmt: skip
