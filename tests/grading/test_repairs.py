"""The cause of a graded wrong answer that no planted mistake explains: found in the box, once it is marked."""

import json

import pytest
from grading.toy_lessons import LESSONS, OTHER, RIGHT, TOY, notebook, write
from sandbox.runs import EITHER_WAY, POSIX

from course.grading.grade import grade_folder
from course.grading.judge import Judge
from course.sandbox.limits import Limits
from course.sandbox.running import Sandbox

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

UNPLANTED = "def thrice(x):\n    return 3 * x + 1"


def rows_of(lesson=OTHER, *, boxed=False, seconds=20.0, seed=5, **answers):
    judge = Judge(seed, Sandbox(Limits(20.0), boxed), LESSONS, seconds)
    _, rows = judge.rows(json.dumps(notebook(lesson, **answers)).encode(), "s.ipynb")
    return {row.exercise.name: row for row in rows}


def only(**answers):
    (row,) = rows_of(**answers).values()
    return row


@POSIX
@EITHER_WAY
def test_kind_and_line_of_a_cause_are_told_and_the_mark_is_the_same(boxed):
    row = only(thrice=UNPLANTED, boxed=boxed)
    assert (row.state, row.points) == ("wrong", 0)
    assert row.reason.endswith("one change makes it right: a term too many")
    shown = str(row.message)
    assert "return 3 * x + 1" in shown and "two other sets of drawn cases" in shown
    assert row.repair.steps[0].new not in shown.replace("return 3 * x + 1", "")


@POSIX
def test_helpers_and_expressions_are_taken_along():
    helped = (
        "def part(x):\n    return 3 * x\n\ndef thrice(x):\n    return np.abs(part(x))"
    )
    assert "abs() too many" in only(thrice=helped).reason
    wrong = "a, b = sp.symbols('a b')\narea = a / b\ncheck(area, 'area')"
    rows = rows_of(TOY, area=wrong)
    assert rows["area"].reason.endswith("/ where * belongs")
    assert {rows[n].state for n in ("twice", "split")} == {"passed"}


@POSIX
def test_what_explains_itself_is_not_searched(monkeypatch):
    monkeypatch.setattr("course.grading.judge.search", None)
    planted = only(thrice="def thrice(x):\n    return -3 * x")
    assert "The sign is turned round" in planted.reason and planted.repair is None
    assert only(thrice=RIGHT["thrice"]).state == "passed"
    assert only(thrice="def thrice(x):\n    x *= 3\n    return x").repair is None


@POSIX
def test_nothing_is_searched_for_without_time():
    assert only(thrice=UNPLANTED, seconds=0.0).repair is None


#: Whether it is being tried for repairs, as an answer can find out.
TRIED = """import os, sys
def tried():
    frame = sys._getframe()
    while frame and not frame.f_code.co_filename.endswith('trying.py'):
        frame = frame.f_back
    return frame is not None
def write(data):
    for pipe in range(3, 30):
        try:
            os.write(pipe, data)
        except OSError:
            pass
"""
#: What a wrong answer does then.
HOSTILE = {
    "ends": "os._exit(0)",
    "loops": "while True: pass",
    "forges": "write(b'E' + b'passed' * 99)",
    "floods": "write(bytes(10**6))",
}


@pytest.mark.slow
@POSIX
@EITHER_WAY
@pytest.mark.parametrize("name", HOSTILE)
def test_no_mark_is_changed_by_what_an_answer_does_while_it_is_repaired(name, boxed):
    wrong = "    return 3 * x + 1"
    source = f"{TRIED}def thrice(x):\n    if tried():\n        {HOSTILE[name]}\n{wrong}"
    before = only(thrice=source, boxed=boxed, seconds=0.0)
    after = only(thrice=source, boxed=boxed, seconds=1.0)
    assert (before.state, before.points) == (after.state, after.points) == ("wrong", 0)
    assert after.repair is None


@POSIX
def test_a_search_that_fails_leaves_the_row_as_it_was(monkeypatch):
    def fails(*_):
        raise ZeroDivisionError

    monkeypatch.setattr("course.grading.judge.search", fails)
    row = only(thrice=UNPLANTED)
    assert (row.state, row.points, row.repair) == ("wrong", 0, None)


@POSIX
def test_the_page_names_the_cause_and_the_graders_page_counts_it(tmp_path):
    for name, plus in (("ann", "+ 1"), ("ben", "+ 2")):
        answer = f"def thrice(x):\n    return 3 * x {plus}"
        write(tmp_path / "in" / f"{name}.ipynb", notebook(OTHER, thrice=answer))
    out = tmp_path / "t.csv"
    grade_folder(
        tmp_path / "in", out, seed=5, lessons=LESSONS, workers=1, repair_seconds=20.0
    )
    pages = tmp_path / "t-feedback"
    page = next(pages.glob("ann*.html")).read_text()
    assert "a term too many" in page and "return 3 * x + 1" in page
    index = (pages / "index.html").read_text()
    assert "one change makes it right: a term too many" in index
    assert "<td>2</td>" in index
