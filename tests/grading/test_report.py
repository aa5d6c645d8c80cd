"""A submission's row and page: cells that are no formulas, pages that need nothing
else.
"""

import re
from html.parser import HTMLParser

import pytest
from grading.toy_lessons import TOY, TWICE, submission

from course.exercises.verdict import Verdict
from course.grading.feedback import page
from course.grading.judge import row_of
from course.grading.report import Submission, cells_of, columns, safe_cell

KEY = "0" * 64


@pytest.mark.parametrize(
    "value, cell",
    [
        ("=1+1", "'=1+1"), ("+1", "'+1"), ("-1", "'-1"), ("@sum", "'@sum"), ("\t=1", "'=1"),
        ("\n\r =cmd", "'=cmd"),
        ("\uff1d1", "'\uff1d1"), ("plain", "plain"), ("a\nb", "a b"), (-3, "-3"), (0, "0"),
        ("\x00\x1b[", "\ufffd\ufffd["),
        ("", ""), ("a;=1+1", "a;'=1+1"), ("a; -1", "a; '-1"), ("a; b", "a; b"),
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
    row = row_of(TWICE, Verdict("twice", "wrong", reason=(nasty,)))
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


def test_what_was_refused_is_told_without_blame():
    one = Submission("a.ipynb", "ann", KEY, TOY, refused=("opening a socket", "<b>"))
    text = page(one, seed=4)
    assert "it was refused: opening a socket; &lt;b&gt;. Marking works" in text
    assert cells_of(one, 4, "clock")["refused"] == "opening a socket; <b>"
    assert "refused" not in page(Submission("a.ipynb", "ann", KEY, TOY), seed=4)


def test_a_fault_of_the_machine_is_a_person_s_to_look_at():
    one = Submission("a.ipynb", "ann", KEY, reason="its process died", again=True)
    cells = cells_of(one, 4, "clock")
    assert (cells["state"], cells["key"]) == ("needs a person", f"again-{KEY}")
    text = page(one, seed=4)
    assert "A person will look at it" in text and "Hand in" not in text


def test_a_page_leads_to_the_grader_s_where_there_is_one():
    one = Submission("a.ipynb", "ann", KEY, TOY)
    assert '<a href="index.html">' in page(one, seed=4, index="index.html")
    assert "<a " not in page(one, seed=4)
