"""The table and the page: cells that are no formulas, rows that survive a cut, pages that need nothing else."""

import csv
import re
from html.parser import HTMLParser

import pytest
from grading.toy_lessons import LESSONS, OTHER, TOY, TWICE

from course.exercises.verdict import Verdict
from course.grading.feedback import page
from course.grading.judge import Row
from course.grading.report import (
    Submission,
    Table,
    cells_of,
    columns,
    read_table,
    safe_cell,
)
from course.grading.submissions import student_of

KEY = "0" * 64


def submission(*states, file="ann.ipynb", student="ann", key=KEY, lesson=TOY):
    rows = tuple(
        Row(e, {"passed": e.points, "needs a person": None}.get(state, 0), state, f"because {state}",
            Verdict(e.name, state, reason=(f"because {state}",)))
        for e, state in zip(lesson.exercises, states, strict=True)
    )  # fmt: skip
    return Submission(file, student, key, lesson, rows)


@pytest.mark.parametrize(
    "value, cell",
    [
        ("=1+1", "'=1+1"), ("+1", "'+1"), ("-1", "'-1"), ("@sum", "'@sum"), ("\t=1", "'=1"),
        ("\n\r =cmd", "'=cmd"),
        ("\uff1d1", "'\uff1d1"), ("plain", "plain"), ("a\nb", "a b"), (-3, "-3"), (0, "0"),
        ("\x00\x1b[", "\ufffd\ufffd["),
        ("", ""),
    ],
)  # fmt: skip
def test_no_cell_is_a_formula(value, cell):
    assert safe_cell(value) == cell


def test_a_row_has_three_columns_an_exercise():
    cells = cells_of(
        submission("passed", "wrong", "needs a person"), seed=4, isolation="clock"
    )
    assert (cells["total"], cells["out_of"], cells["state"], cells["lesson"]) == (
        "2",
        "7",
        "needs a person",
        "90-toy",
    )
    assert [cells[c] for c in ("twice", "twice_state", "split", "split_state", "area", "area_state")] == [
        "2", "passed", "0", "wrong", "", "needs a person"
    ]  # fmt: skip
    assert cells["area_reason"] == "because needs a person"
    assert set(cells) == set(columns(["twice", "split", "area"]))
    broken = cells_of(
        Submission("=x.pdf", "", KEY, reason="not a notebook"), 4, "clock"
    )
    assert (broken["file"], broken["state"], broken["out_of"]) == (
        "'=x.pdf",
        "unusable",
        "",
    )


def test_rows_are_in_the_file_as_they_come_and_a_cut_one_is_left_out(tmp_path):
    path = tmp_path / "grades.csv"
    table = Table(path, ["twice", "split", "area"], [])
    for name in ("ben", "ann"):
        done = submission(
            "passed", "passed", "passed", file=f'{name}, "x".ipynb', key=name[0] * 64
        )
        table.add(cells_of(done, 4, "clock, memory"))
    # Not closed, as after a crash: both rows are there.
    exercises, rows = read_table(path)
    assert exercises == ("twice", "split", "area") and [
        r["file"][:3] for r in rows
    ] == ["ben", "ann"]
    whole = path.read_text()
    for length in range(len(whole) - 2, whole.index('"ann'), -7):
        path.write_text(whole[:length])
        assert [r["file"][:3] for r in read_table(path)[1]] in (["ben"], []), whole[
            :length
        ]
    path.write_text(whole)
    table.close()
    assert [r["file"][:3] for r in read_table(path)[1]] == ["ann", "ben"]


def test_a_file_that_is_no_table_is_not_written_over(tmp_path):
    other = tmp_path / "other.csv"
    other.write_text("name,mark\nann,3\n")
    with pytest.raises(
        ValueError, match="out: expected a table of marks or a new file"
    ):
        read_table(other)
    assert read_table(tmp_path / "new.csv") == ((), [])


def test_columns_are_the_union_of_old_and_new(tmp_path):
    path = tmp_path / "grades.csv"
    Table(
        path, ["thrice"], [cells_of(submission("passed", lesson=OTHER), 4, "")]
    ).close()
    exercises, rows = read_table(path)
    Table(path, ["twice", *exercises], rows).close()
    with path.open(newline="") as file:
        (row,) = csv.DictReader(file)
    assert (row["thrice"], row["twice"]) == ("1", "")


class _Tags(HTMLParser):
    VOID = {"meta", "br", "hr", "link", "img", "input"}

    def __init__(self):
        super().__init__()
        self.open, self.seen, self.text = [], [], ""

    def handle_starttag(self, tag, attrs):
        self.seen.append((tag, dict(attrs)))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data


def parsed(text):
    tags = _Tags()
    tags.feed(text)
    assert tags.open == []
    return tags


def test_a_page_says_what_is_right_and_what_to_try_next():
    tags = parsed(page(submission("passed", "wrong", "needs a person"), seed=4))
    text = " ".join(tags.text.split())
    assert "2 of 7 points, and a person has still to look" in text
    assert "Next: split. Open the lesson" in text and "hint('split')" in text
    assert (
        "hint look here" in text
    )  # nothing said in what way it is wrong: the first hint does
    assert "About 5 minutes of core exercises are left" in text
    assert "✓ Right" in text and "✗ Not yet" in text and "? of 3" in text
    done = " ".join(
        parsed(page(submission("passed", "passed", "passed"), seed=4)).text.split()
    )
    assert "7 of 7 points." in done and "Nothing is left to do in this lesson." in done


def test_a_page_stands_alone_and_can_be_read_aloud():
    text = page(submission("passed", "wrong", "error"), seed=4)
    tags = parsed(text)
    assert not re.search(r"https?:|<script|src=|@import|url\(", text)
    assert ("html", {"lang": "en"}) in tags.seen
    assert [t for t, _ in tags.seen if t in ("h1", "h2")] == ["h1", "h2", "h2", "h2"]
    names = {a["id"] for _, a in tags.seen if "id" in a}
    assert {a["href"][1:] for t, a in tags.seen if t == "a"} | {
        a["aria-labelledby"] for t, a in tags.seen if "aria-labelledby" in a
    } <= names
    assert [a.get("scope") for t, a in tags.seen if t == "th"] == ["col"] * 3 + [
        "row"
    ] * 3
    assert "title" in [t for t, _ in tags.seen] and "caption" in [
        t for t, _ in tags.seen
    ]


def test_what_a_student_wrote_is_escaped():
    nasty = "<script>alert(1)</script>"
    row = Row(TWICE, 0, "wrong", nasty, Verdict("twice", "wrong", reason=(nasty,)))
    for one in (
        Submission(nasty + ".ipynb", nasty, KEY, TOY, (row,)),
        Submission(nasty, nasty, KEY, reason=nasty),
    ):
        text = page(one, seed=4)
        assert "<script" not in text and "&lt;script&gt;" in text


def test_a_file_that_cannot_be_marked_has_a_page_too():
    text = parsed(
        page(
            Submission("a.pdf", "ann", KEY, reason="not a notebook: not text in UTF-8"),
            seed=4,
        )
    ).text
    assert "This file could not be marked" in text and "not text in UTF-8" in text
    assert "Hand in the notebook itself" in text


@pytest.mark.parametrize(
    "file, student",
    [
        ("ann.ipynb", "ann"), ("90-toy_ann_lee.ipynb", "ann_lee"), ("ann-90-toy.ipynb", "ann"),
        ("90-toy.ipynb", "90-toy"), ("90-toy (1).ipynb", "90-toy (1)"), ("Ann Lee/90-toy.ipynb", "Ann Lee"),
        ("Ann Lee_1234_assignsubmission_file_/90-toy.ipynb", "Ann Lee"), ("90-toy/ann.ipynb", "ann"),
        ("lesson 90/ann.ipynb", "ann"), ("group 1/Ann/work.ipynb", "Ann"), ("Ann/91-other-toy.ipynb", "Ann"),
        ("report.pdf", "report.pdf"), ("Žofie/a.ipynb", "Žofie"),
    ],
)  # fmt: skip
def test_whose_a_file_is(file, student, tmp_path):
    from pathlib import Path

    assert student_of(Path(file), LESSONS) == student
