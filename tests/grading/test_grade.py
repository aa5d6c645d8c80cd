"""A folder of submissions of every kind: each gets its row, the batch goes on, and a
cut-off batch continues.
"""

import json
import os
import re
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest
from grading.toy_lessons import (
    LESSONS,
    OTHER,
    RIGHT,
    TOY,
    blank,
    cell,
    notebook,
    only,
    rows_in,
    write,
)

from course.exercises.notebook_file import UnusableNotebook
from course.grading import judge as judging
from course.grading.batch import standing
from course.grading.grade import _isolation, check_notebook, grade_folder
from course.grading.identity import Student
from course.grading.submissions import Task
from course.sandbox import running
from course.sandbox.box import Isolation, Start
from course.sandbox.session import SandboxFailure

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")


def fill(folder):
    write(folder / "right.ipynb", notebook())
    write(folder / "blank.ipynb", blank())
    write(
        folder / "Ann Lee_12_assignsubmission_file_" / "90-toy.ipynb",
        only("twice", "def twice(x):\n    return -2 * x"),
    )
    write(folder / "Ben" / "90-toy.ipynb", only("twice", RIGHT["twice"]))
    write(folder / "Ben" / "91-other-toy.ipynb", notebook(OTHER))
    write(folder / "Ben" / "90-toy (1).ipynb", blank())
    write(
        folder / "renamed.ipynb",
        only("split", "def splits(x):\n    return x[..., 0], x[..., 1:]"),
    )
    write(folder / "deleted.ipynb", only("area", None))
    write(folder / "loop.ipynb", only("twice", "def twice(x):\n    while True: pass"))
    write(
        folder / "loop_in_cell.ipynb",
        only("twice", "twice = 1\nwhile True: print('x')"),
    )
    write(
        folder / "exits.ipynb",
        only("twice", "import os\ndef twice(x):\n    os._exit(0)"),
    )
    write(folder / "=1+1.ipynb", blank())
    write(folder / "empty.ipynb", "")
    write(folder / "notes.txt", "my notes")
    write(folder / "half.ipynb", json.dumps(notebook())[:300])
    write(
        folder / "no_code.ipynb",
        {"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": []},
    )
    write(folder / "foreign.ipynb", {"nbformat": 4, "nbformat_minor": 5, "metadata": {},
          "cells": [{"cell_type": "code", "source": "x = 1", "metadata": {}}]})  # fmt: skip
    (folder / "photo.ipynb").write_bytes(bytes(range(256)))
    write(folder / ".ipynb_checkpoints" / "right-checkpoint.ipynb", notebook())
    write(folder / ".DS_Store", "x")
    (folder / "a_folder.ipynb").mkdir()
    return folder


@pytest.fixture(scope="module")
def batch(tmp_path_factory):
    root = tmp_path_factory.mktemp("batch")
    told = []
    folder, out = fill(root / "handed in"), root / "grades.csv"
    summary = grade_folder(
        folder,
        out,
        seed=11,
        time_limit=6.0,
        lessons=LESSONS,
        on_progress=lambda *t: told.append(t),
    )
    return SimpleNamespace(
        folder=folder, out=out, summary=summary, rows=rows_in(out), told=told
    )


@pytest.mark.slow
def test_who_handed_in_several_has_a_page_with_all_of_them(batch):
    pages = batch.summary.feedback
    (own,) = pages.glob("student--*.html")  # the others have one submission each
    assert re.fullmatch(r"student--Ben--[0-9a-f]{10}\.html", own.name)
    text = own.read_text()
    *links, index = re.findall(r'<a href="([^"]+)">', text)
    assert len(links) == len(set(links)) == 3 and index == "index.html"
    assert all((pages / link).is_file() for link in links)
    assert "Handed in by Ben" in text and "91-other-toy" in text and "2 of" in text


@pytest.mark.slow
def test_the_grader_has_a_page_with_links_both_ways(batch):
    pages = batch.summary.feedback
    index = (pages / "index.html").read_text()
    links = set(re.findall(r'<a href="([^"]+)">', index)) - {"index.html"}
    assert links == {p.name for p in pages.glob("*--*.html")}
    for link in links:
        assert '<a href="index.html">' in (pages / link).read_text()
    text = " ".join(re.sub(r"<[^>]+>", " ", index).split())
    assert "9 marked, 6 unusable, 3 need a person." in text
    assert "Ann Lee Ann Lee_12_assignsubmission_file_/90-toy.ipynb ✗ 0" in text
    assert "notes.txt unusable not a notebook" in text
    assert " =1+1 =1+1.ipynb" in text and "renamed renamed.ipynb ○ 0 ? ○ 0" in text


STATES = {
    "right.ipynb": ("marked", "7", ""),
    "blank.ipynb": ("marked", "0", ""),
    "Ann Lee_12_assignsubmission_file_/90-toy.ipynb": (
        "marked",
        "0",
        "The sign is turned round",
    ),
    "Ben/90-toy.ipynb": ("marked", "2", ""),
    "Ben/91-other-toy.ipynb": ("marked", "1", ""),
    "Ben/90-toy (1).ipynb": ("marked", "0", ""),
    "renamed.ipynb": (
        "needs a person",
        "0",
        "the nearest name is splits, and under that name it is right",
    ),
    "deleted.ipynb": ("needs a person", "0", "no cell defines area: was it deleted?"),
    "loop.ipynb": ("marked", "0", "it did not finish within 6 s"),
    "loop_in_cell.ipynb": ("marked", "0", ""),
    "exits.ipynb": ("needs a person", "0", "it ended the whole program (exit code 0)"),
    "'=1+1.ipynb": ("marked", "0", ""),
    "empty.ipynb": ("unusable", "0", "the file is empty"),
    "notes.txt": ("unusable", "0", "not a notebook"),
    "half.ipynb": ("unusable", "0", "not a notebook"),
    "no_code.ipynb": ("unusable", "0", "a notebook without a code cell"),
    "foreign.ipynb": ("unusable", "0", "none of the lessons"),
    "photo.ipynb": ("unusable", "0", "not text in UTF-8"),
}


@pytest.mark.slow
def test_every_file_has_its_row(batch):
    assert set(batch.rows) == set(STATES)
    for file, (state, total, words) in STATES.items():
        row = batch.rows[file]
        assert (row["state"], row["total"]) == (state, total), row
        assert words in " ".join(
            v for k, v in row.items() if k and k.endswith("reason")
        ), row
    s = batch.summary
    assert (s.submissions, s.kept, s.marked, s.needs_person, s.unusable) == (
        18,
        0,
        9,
        3,
        6,
    )
    assert "repeat with --seed 11" in str(s) and "audit hook" in str(s)
    assert s.isolation.startswith("trusted") == ("were trusted" in str(s))


@pytest.mark.slow
def test_columns_and_names(batch):
    ann, ben = (
        batch.rows["Ann Lee_12_assignsubmission_file_/90-toy.ipynb"],
        batch.rows["Ben/91-other-toy.ipynb"],
    )
    assert list(ann)[:8] == [
        "file",
        "student",
        "lesson",
        "total",
        "out_of",
        "state",
        "reason",
        "refused",
    ]
    assert list(ann)[-4:] == ["seed", "isolation", "page", "key"]
    assert list(ann)[8:-4:3] == ["twice", "split", "area", "thrice"]
    assert (ann["student"], ann["lesson"], ann["out_of"]) == ("Ann Lee", "90-toy", "7")
    assert (ann["twice_state"], ann["split_state"], ann["thrice_state"]) == (
        "wrong",
        "not attempted",
        "",
    )
    assert (ben["student"], ben["lesson"], ben["out_of"], ben["thrice"]) == (
        "Ben",
        "91-other-toy",
        "1",
        "1",
    )
    assert (
        batch.rows["renamed.ipynb"]["split"] == ""
        and batch.rows["renamed.ipynb"]["twice"] == "0"
    )
    assert {row["seed"] for row in batch.rows.values()} == {"11"}
    loop = batch.rows["loop_in_cell.ipynb"]
    # Its output or the clock, whichever is first.
    assert loop["twice_state"] == "error" and "its cell" in loop["twice_reason"]
    assert list(batch.rows) == sorted(batch.rows)


@pytest.mark.slow
def test_progress_is_told(batch):
    assert batch.told[0] == (0, 18, "") and [t[0] for t in batch.told] == list(
        range(19)
    )
    assert {t[2] for t in batch.told[1:]} == {f.removeprefix("'") for f in STATES}


@pytest.mark.slow
def test_every_submission_has_a_page_of_its_own(batch):
    pages = {row["page"] for row in batch.rows.values()}
    assert len(pages) == 18
    written = {p.name: p.read_text() for p in batch.summary.feedback.glob("*.html")}
    assert len(written) == 18 + 2  # and Ben's, with all three of his, and the grader's
    assert pages < set(written)
    assert all(text.startswith("<!DOCTYPE html>") for text in written.values())
    ann = batch.rows["Ann Lee_12_assignsubmission_file_/90-toy.ipynb"]["page"]
    assert re.fullmatch(r"Ann_Lee_90-toy--[0-9a-f]{10}\.html", ann)
    assert "The sign is turned round" in written[ann]
    assert "7 of 7 points" in written[batch.rows["right.ipynb"]["page"]]


@pytest.mark.slow
def test_a_batch_that_is_done_is_not_done_again(folder, tmp_path, monkeypatch):
    out = tmp_path / "new" / "grades.csv"
    first = grade_folder(folder, out, lessons=LESSONS)
    text, pages = out.read_text(), sorted(first.feedback.iterdir())
    monkeypatch.setattr(judging.Judge, "rows", None)
    again = grade_folder(folder, out, lessons=LESSONS)
    assert (again.kept, again.seed, again.marked, again.isolation) == (
        5,
        first.seed,
        5,
        first.isolation,
    )
    assert out.read_text() == text and sorted(first.feedback.iterdir()) == pages


@pytest.mark.slow
def test_what_changed_is_marked_again(folder, tmp_path):
    out = tmp_path / "grades.csv"
    first = grade_folder(folder, out, lessons=LESSONS)
    (folder / "cal.ipynb").unlink()
    write(folder / "ann.ipynb", notebook(OTHER))
    (folder / "eve.ipynb").unlink()
    next(first.feedback.glob("ben--*.html")).unlink()
    told = []
    again = grade_folder(
        folder, out, lessons=LESSONS, on_progress=lambda *t: told.append(t[2])
    )
    assert sorted(told) == ["", "ann.ipynb", "ben.ipynb"] and again.kept == 1
    rows = rows_in(out)
    assert (
        rows["ann.ipynb"]["thrice"] == "1" and "eve.ipynb" in rows
    )  # a row without its file stays
    assert grade_folder(folder, out, lessons=LESSONS, seed=first.seed + 1).kept == 0
    assert grade_folder(folder, out, lessons=LESSONS).seed == first.seed + 1
    assert grade_folder(folder, out, lessons=LESSONS, time_limit=9.0).kept == 0
    assert len(rows_in(out)) == 5


@pytest.mark.slow
def test_the_seed_is_random_when_none_is_given(folder, tmp_path):
    seeds = {
        grade_folder(folder, tmp_path / f"{i}.csv", lessons=LESSONS).seed
        for i in range(2)
    }
    assert len(seeds) == 2


@pytest.mark.slow
def test_what_was_done_before_an_interruption_is_kept(folder, tmp_path):
    out = tmp_path / "grades.csv"

    def interrupt(done, total, file):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        grade_folder(folder, out, lessons=LESSONS, workers=1, on_progress=interrupt)
    kept = rows_in(out)
    assert len(kept) == 2
    done = grade_folder(folder, out, lessons=LESSONS)
    assert (
        done.kept == 2
        and done.marked == 5
        and {r["seed"] for r in rows_in(out).values()} == {str(done.seed)}
    )
    now = rows_in(out)
    assert all(now[file].items() >= row.items() for file, row in kept.items())


INTERRUPTED = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from grading.toy_lessons import LESSONS
from course.grading.grade import grade_folder
grade_folder(Path(sys.argv[2]), Path(sys.argv[3]), lessons=LESSONS, time_limit=60.0, workers=2,
             on_progress=lambda done, total, file: print(done, flush=True))
"""


@pytest.mark.slow
@POSIX
def test_ctrl_c_ends_a_batch_at_once_and_leaves_no_process(folder, tmp_path):
    write(folder / "loop.ipynb", only("twice", "def twice(x):\n    while True: pass"))
    tests, out = os.path.dirname(os.path.dirname(__file__)), tmp_path / "grades.csv"
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    process = subprocess.Popen([sys.executable, "-c", INTERRUPTED, tests, str(folder), str(out)], text=True,
                               env=os.environ | {"TMPDIR": str(temporary)},
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)  # fmt: skip
    assert process.stdout is not None
    for line in process.stdout:
        if int(line) == 5:  # all but the one that loops
            break
    time.sleep(0.2)
    process.send_signal(signal.SIGINT)
    started = time.monotonic()
    _, errors = process.communicate(timeout=50)
    assert time.monotonic() - started < 20 and "stopped by SIGINT" in errors
    assert len(rows_in(out)) == 5
    assert list(temporary.iterdir()) == []


@pytest.mark.slow
def test_a_fault_of_ours_in_one_submission_stops_no_other(
    folder, tmp_path, monkeypatch
):
    rows = judging.Judge.rows

    def fails(self, content, file):
        if file == "ben.ipynb":
            raise RuntimeError("a bug")
        return rows(self, content, file)

    monkeypatch.setattr(judging.Judge, "rows", fails)
    told = grade_folder(folder, tmp_path / "grades.csv", lessons=LESSONS)
    assert (told.marked, told.needs_person, told.again) == (4, 1, 1)
    reason = rows_in(told.out)["ben.ipynb"]["reason"]
    assert "not its author's fault: RuntimeError: a bug" in reason
    assert "the same command retries them" in str(told)
    monkeypatch.undo()
    told = grade_folder(folder, tmp_path / "grades.csv", lessons=LESSONS)
    assert (told.kept, told.marked, told.again) == (4, 5, 0)


def test_a_machine_that_runs_no_answer_says_so_before_anything_is_marked(
    folder, tmp_path, monkeypatch
):
    broken = (sys.executable, "-c", "raise SystemExit(3)")
    for way in ("start_plain", "start_in_box"):
        monkeypatch.setattr(running, way, lambda *_: Start(broken, {}, "."))
    with pytest.raises(SandboxFailure, match="exit code 3"):
        grade_folder(folder, tmp_path / "grades.csv", lessons=LESSONS)
    assert not (tmp_path / "grades.csv").exists()


@pytest.mark.slow
def test_output_inside_the_folder_is_no_submission(folder):
    out = folder / "grades.csv"
    assert grade_folder(folder, out, lessons=LESSONS).submissions == 5
    assert grade_folder(folder, out, lessons=LESSONS).kept == 5


@pytest.mark.parametrize(
    "change, words",
    [
        (dict(folder="nowhere"), "folder: expected a folder of submissions"),
        (dict(folder="nothing"), "folder: expected submissions in"),
        (dict(out="in"), "out: expected the name of a table"),
        (dict(out="/dev/null"), "out: expected the name of a table, .* device"),
        (dict(feedback="in/ann.ipynb"), "feedback: expected a folder"),
        (dict(seed=-1), "seed: expected a whole number"),
        (dict(time_limit=0.0), "time_limit: expected"),
        (dict(memory_mb=1), "memory_mb: expected"),
        (dict(out="in/ann.ipynb"), "out: expected a table of marks or a new file"),
    ],
    ids=lambda v: next(iter(v)) if isinstance(v, dict) else "",
)
def test_arguments_that_cannot_be_used_are_refused(folder, tmp_path, change, words):
    (tmp_path / "nothing").mkdir()
    paths = {k: tmp_path / v if isinstance(v, str) else v for k, v in change.items()}
    given = {
        "folder": folder,
        "out": tmp_path / "grades.csv",
        "lessons": LESSONS,
    } | paths
    before = (folder / "ann.ipynb").read_text()
    with pytest.raises(ValueError, match=words):
        grade_folder(given.pop("folder"), given.pop("out"), **given)
    assert (folder / "ann.ipynb").read_text() == before and not (
        tmp_path / "grades.csv"
    ).exists()


@pytest.mark.slow
def test_a_notebook_is_checked_on_its_own_inputs(tmp_path):
    seen = []
    path = write(tmp_path / "a.ipynb", notebook(OTHER))
    told = check_notebook(path, lessons=LESSONS, on_row=seen.append)
    assert told.passed and list(told) == seen and len(told) == 1
    assert str(told) == "91 Other\n✓ thrice  1/1  Right"
    write(path, only("twice", "def twice(x):\n    return -2 * x"))
    told = check_notebook(path, lessons=LESSONS)
    assert not told.passed and [r.state for r in told] == [
        "wrong",
        "not attempted",
        "not attempted",
    ]
    assert "✗ twice  0/2  Not yet" in str(told) and "The sign is turned round" in str(
        told
    )
    assert "○ area   0/3  Not attempted" in str(told)
    with pytest.raises(UnusableNotebook, match="the file is empty"):
        check_notebook(write(path, ""), lessons=LESSONS)


DOWNLOAD = [
    "Ana_1_assignsubmission_file_/work/90-toy.ipynb", "Ana_1_assignsubmission_file_/work/deep/91-other-toy.ipynb",
    "Ana_2_assignsubmission_file_/90-toy.ipynb", "Ana_2_assignsubmission_file_/91-other-toy.ipynb",
    "Participant_11_assignsubmission_file_/90-toy.ipynb", "Participant_12_assignsubmission_file_/90-toy.ipynb",
    "Dan_3_assignsubmission_file_90-toy.ipynb", "Dan_3_assignsubmission_file_91-other-toy.ipynb",
    "Dan_30_assignsubmission_file_90-toy.ipynb",
]  # fmt: skip


@pytest.mark.slow
def test_in_a_download_nobody_sees_another_s_marks(tmp_path):
    for index, file in enumerate(DOWNLOAD):
        lesson = OTHER if "91" in file else TOY
        write(tmp_path / "in" / file, blank(lesson, cells=[cell(f"# {index}")]))
    told = grade_folder(tmp_path / "in", tmp_path / "grades.csv", lessons=LESSONS)
    rows = rows_in(told.out)
    assert [rows[file]["student"] for file in DOWNLOAD] == [
        *["Ana (1)"] * 2, *["Ana (2)"] * 2, "Participant 11", "Participant 12", *["Dan (3)"] * 2, "Dan (30)",
    ]  # fmt: skip
    for page in told.feedback.glob("*--*.html"):
        text = page.read_text()
        shown = {file.split("_assign")[0] for file in DOWNLOAD if file in text}
        assert len(shown) == 1, page
    overviews = [p.name.split("--")[1] for p in told.feedback.glob("student--*.html")]
    assert sorted(overviews) == ["Ana_1", "Ana_2", "Dan_3"]


TRUSTED_ROW = {"key": "k", "file": "a", "isolation": "trusted: audit hook"}


def test_what_was_trusted_before_is_told_though_all_is_boxed_now():
    boxed = {"isolation": "bubblewrap"}
    assert _isolation(None, [boxed, TRUSTED_ROW]) == "trusted: audit hook"
    now = Isolation(True, ("bubblewrap", "clock"))
    assert _isolation(now, [boxed, TRUSTED_ROW]) == "trusted: audit hook"
    assert _isolation(now, [boxed]) == "bubblewrap, clock"


def test_no_trusted_row_stands_where_a_box_is_required(tmp_path):
    page = tmp_path / "a.html"
    page.touch()
    task = Task("a", tmp_path / "a", Student("Ann", b"a"), page, b"a")
    rows, keys = [TRUSTED_ROW], {"k": task}
    assert [len(part) for part in standing(rows, keys, [task])] == [1, 0]
    assert [len(part) for part in standing(rows, keys, [task], boxed=True)] == [0, 1]
