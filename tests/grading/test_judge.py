"""From a submission to its rows: right, wrong, blank, renamed, broken and hostile answers."""

import json
import signal
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from grading.toy_lessons import (
    BLANK,
    IMPORTS,
    LESSONS,
    OTHER,
    RIGHT,
    TOY,
    blank,
    cell,
    notebook,
    only,
)
from sandbox.runs import NO_BOX

from course.grading import marking
from course.grading.judge import Judge
from course.sandbox import session as sessions
from course.sandbox.findings import Answers, Run
from course.sandbox.limits import Limits
from course.sandbox.running import Sandbox
from course.sandbox.session import Cancelled, SandboxFailure

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


def judged(content, *, seed=None, seconds=20.0, cancel=None):
    """The rows of a notebook, in a box where there is one."""
    judge = Judge(seed, Sandbox(Limits(seconds), not NO_BOX, cancel), LESSONS)
    _, rows = judge.rows(json.dumps(content).encode(), "submission.ipynb")
    return {row.exercise.name: row for row in rows}


@pytest.fixture
def rows_of():
    return judged


@pytest.fixture
def one(rows_of):
    """The row of a notebook of one exercise, thrice, whose cell is the source."""

    def row(source, *, seconds=20.0, cells=None):
        return rows_of(notebook(OTHER, cells=cells, thrice=source), seconds=seconds)[
            "thrice"
        ]

    return row


@pytest.mark.slow
def test_right_answers_get_all_points_in_the_order_of_the_lesson(rows_of):
    rows = rows_of(notebook(), seed=5)
    assert [(n, r.points, r.state, r.reason) for n, r in rows.items()] == [
        ("twice", 2, "passed", ""), ("split", 2, "passed", ""), ("area", 3, "passed", "")
    ]  # fmt: skip
    assert all(row.seconds > 0 and row.verdict.passed for row in rows.values())


def test_blanks_are_not_attempted_and_not_run(rows_of, monkeypatch):
    monkeypatch.setattr(sessions.Session, "_report", None)
    rows = rows_of(blank())
    assert {(r.points, r.state, r.reason) for r in rows.values()} == {
        (0, "not attempted", "")
    }
    # a lesson's author may blank the whole line: then the cell defines nothing
    rows = rows_of(
        notebook(
            twice=BLANK["twice"],
            split=BLANK["split"],
            area="a, b = sp.symbols('a b')\n...",
        )
    )
    assert rows["area"].state == "not attempted"


@pytest.mark.slow
def test_a_renamed_answer_with_a_hole_left_beside_it_is_for_a_person(rows_of):
    """Renamed, it is no blank although a ``...`` stands in it; renamed and blank, it is one."""
    answered = "def splitted(x):\n    ...\n    return x[..., 0], x[..., 1:]"
    rows = rows_of(notebook(split=answered))
    assert rows["split"].state == "needs a person"
    rows = rows_of(notebook(split="def splitted(x):\n    ..."))
    assert rows["split"].state == "not attempted"


@pytest.mark.slow
def test_wrong_answers_are_told_what_is_wrong(rows_of):
    rows = rows_of(notebook(twice="def twice(x):\n    return -2 * x", split="def split(x):\n    return x[..., 0], x",
                            area="a, b = sp.symbols('a b')\narea = a + b"))  # fmt: skip
    assert {r.state for r in rows.values()} == {"wrong"} and {
        r.points for r in rows.values()
    } == {0}
    assert (
        "The sign is turned round" in rows["twice"].reason
        and "got: [-2., -4., -8.] m" in rows["twice"].reason
    )
    assert "shape (3,) where (2,) is expected" in rows["split"].reason
    assert (
        "expected: 6 m^2" in rows["area"].reason and "got: 5 m^2" in rows["area"].reason
    )


@pytest.mark.slow
def test_the_grader_draws_other_inputs_than_the_notebook_does(rows_of):
    """An answer that knows the notebook's inputs by heart passes there, and not here."""
    known = "\n".join(
        f"    if x.shape == {c.arguments['x'].shape} and abs(x.ravel()[0] - {c.arguments['x'].ravel()[0]!r}) < 1e-9:\n"
        f"        return np.array({(2 * c.arguments['x']).tolist()!r})"
        for c in TOY.exercises[0].draw()
    )
    content = only("twice", f"def twice(x):\n{known}\n    return 0 * x")
    assert rows_of(content)["twice"].state == "passed"
    assert rows_of(content, seed=7)["twice"].state == "wrong"


HOSTILE = {
    "loop": (
        "def thrice(x):\n    while True: pass",
        "error",
        "it did not finish within 1 s",
    ),
    "loop in the cell": (
        "while True: pass\nthrice = 3",
        "error",
        "its cell, outside the function, did not finish within 1 s",
    ),
    "flood": (
        "def thrice(x):\n    while True: print('a' * 1000)",
        "error",
        "it printed more than 1,000,000 characters",
    ),
    "flood in the cell": (
        "while True: print('a' * 1000)\nthrice = 3",
        "error",
        "its cell stopped with OutputFlood: it printed more",
    ),
    "exit": (
        "import sys\ndef thrice(x):\n    sys.exit(0)",
        "error",
        "it stopped with SystemExit: 0",
    ),
    "quit in the cell": (
        "quit()\ndef thrice(x):\n    return 3 * x",
        "error",
        "its cell stopped with SystemExit",
    ),
    "hard exit": (
        "import os\ndef thrice(x):\n    os._exit(0)",
        "needs a person",
        "it ended the whole program (exit code 0)",
    ),
    "hard exit in the cell": (
        "import os\nos._exit(3)\nthrice = 3",
        "needs a person",
        "its cell, outside the function, ended the whole program",
    ),
    "crash": (
        "import signal\ndef thrice(x):\n    signal.raise_signal(11)",
        "needs a person",
        "it crashed Python (SIGSEGV)",
    ),
    "interrupt": (
        "def thrice(x):\n    raise KeyboardInterrupt",
        "error",
        "it stopped with KeyboardInterrupt",
    ),
    "fork": (
        "import os\ndef thrice(x):\n    os.fork(); return 3 * x",
        "error",
        "PermissionError: os.fork is not allowed",
    ),
    "kill": (
        "import os\ndef thrice(x):\n    os.killpg(os.getpgid(os.getppid()), 9)",
        "error",
        "PermissionError: os.killpg",
    ),
    "kill all": (
        "import os\nos.kill(-1, 9)\ndef thrice(x):\n    return x",
        "wrong",
        "its cell stopped with PermissionError: os.kill",
    ),
    "memory": (
        "def thrice(x):\n    return np.zeros(10**11)",
        "error",
        "Unable to allocate",
    ),
    "recursion": ("def thrice(x):\n    return thrice(x)", "error", "RecursionError"),
    "billion": (
        "def thrice(x):\n    return np.zeros(10**9, np.int8)",
        "error",
        "at most 1,000,000 numbers | got: 1,000,000,000",
    ),
    "object": (
        "def thrice(x):\n    return object()",
        "error",
        "expected: numbers | got: object",
    ),
    "objects": (
        "def thrice(x):\n    return np.array([x, None, 'a'], dtype=object)",
        "error",
        "expected: numbers | got: ndarray",
    ),
    "string": (
        "def thrice(x):\n    return 'passed'",
        "wrong",
        "shape () (a single number) where (3,) is expected",
    ),
    "strings": (
        "def thrice(x):\n    return np.full(x.shape, 'a' * 5000)",
        "needs a person",
        "cannot be read",
    ),
    "module": ("thrice = np", "error", "expected a function; got module"),
    "none": ("def thrice(x):\n    y = 3 * x", "error", "it returned None"),
    "writes": (
        "def thrice(x):\n    x *= 3\n    return x",
        "wrong",
        "it wrote into its input (x)",
    ),
    "raises at import": (
        "raise ValueError('not today')\ndef thrice(x):\n    return 3 * x",
        "error",
        "its cell stopped with ValueError: not today in the line: raise ValueError",
    ),
    "two arguments": (
        "def thrice(x, y):\n    return 3 * x",
        "error",
        "a function that takes thrice(x); yours takes (x, y)",
    ),
    "syntax": (
        "def thrice(x)\n    return 3 * x",
        "error",
        "the cell is not valid Python: expected ':' (line 1)",
    ),
    "deleted by itself": (
        "def thrice(x):\n    return 3 * x\ndel thrice",
        "needs a person",
        "there is no thrice after it",
    ),
    "asks the course": (
        "from course.toy import thrice as ours\ndef thrice(x):\n    return ours(x)",
        "error",
        "It calls the course itself, which is not there",
    ),
    "equal to all": (
        "class Same(np.ndarray):\n    def __eq__(self, other): return np.True_\n    def __abs__(self): return 0.0\n"
        "def thrice(x):\n    return x.view(Same)",
        "wrong",
        "expected: [ 3., 6., 12.]",
    ),
    "array that raises": (
        "class Bad:\n    def __array__(self, *a, **k): raise SystemExit('out')\n"
        "def thrice(x):\n    return Bad()",
        "error",
        "SystemExit: out",
    ),
    "error without words": (
        "class E(Exception):\n    def __str__(self): raise E\ndef thrice(x):\n    raise E",
        "error",
        "it stopped with E",
    ),
    "patches": (
        "import json, builtins\nnp.array = np.zeros = lambda *a, **k: 'passed'\njson.dumps = lambda *a, **k: '{}'\n"
        "def thrice(x):\n    return 1.0",
        "needs a person",
        "cannot be read",
    ),
    "prints a verdict": (
        "print('passed')\ndef thrice(x):\n    print('✓ Right: thrice'); return x",
        "wrong",
        "expected: [ 3., 6., 12.]",
    ),
}


@pytest.fixture(scope="module")
def hostile():
    """The rows of all hostile answers, two at a time, as a batch judges them."""

    def row(name):
        content = notebook(OTHER, thrice=HOSTILE[name][0])
        return judged(content, seconds=1.0 if "loop" in name else 20.0)["thrice"]

    with ThreadPoolExecutor(2) as pool:
        return dict(zip(HOSTILE, pool.map(row, HOSTILE), strict=True))


@pytest.mark.slow
@pytest.mark.parametrize("name", HOSTILE)
def test_broken_and_hostile_answers(hostile, name):
    _, state, words = HOSTILE[name]
    row = hostile[name]
    assert row.state == state, row
    assert words in row.reason, row.reason
    assert row.points == (None if state == "needs a person" else 0)
    assert "\n" not in row.reason and len(row.reason) <= 500


def test_what_a_cell_raises_after_the_function_does_not_matter(one):
    assert (
        one("def thrice(x):\n    return 3 * x\nthrice('a', 2)\nraise SystemExit").state
        == "passed"
    )


@pytest.mark.slow
def test_cells_before_are_run_as_far_as_they_are_needed(rows_of):
    """A cell that raises stops no other, one that loops costs its own exercise alone, and helpers are found."""
    helper = cell(
        "factor = 2\n%time x = 1\n\ndef times(x):\n    return factor * x\n\nprint(times(3))"
    )
    looping = rows_of(
        notebook(
            cells=[helper],
            twice="twice = 0\nwhile True: pass",
            split="def split(x):\n    return times(x)[..., 0] / 2, x[..., 1:]\nraise ValueError('later')",
            area=BLANK["area"],
        ),
        seconds=1.0,
    )
    assert [looping[n].state for n in ("twice", "split", "area")] == [
        "error",
        "passed",
        "not attempted",
    ]
    twice = "def twice(x):\n    return 2 * x"
    halves = "def split(x):\n    return twice(x)[..., 0] / 2, twice(x)[..., 1:] / 2"
    using = rows_of(notebook(twice=twice, split=halves, area=BLANK["area"]))
    assert using["split"].state == "passed"


@pytest.mark.slow
@pytest.mark.parametrize("background", [False, True])
def test_an_endless_cell_is_interrupted_and_the_notebook_goes_on(rows_of, background):
    """Where a shell has put the grader into the background, too: SIGINT is ignored there."""
    content = notebook(twice="def twice(x):\n    return 2 * x\nwhile True: pass",
                       split="def split(x):\n    return twice(x)[..., 0] / 2, x[..., 1:]",
                       area=RIGHT["area"] + "\nunused = twice")  # fmt: skip
    before = signal.getsignal(signal.SIGINT)
    signal.signal(signal.SIGINT, signal.SIG_IGN if background else before)
    try:
        rows = rows_of(content, seconds=1.0)
    finally:
        signal.signal(signal.SIGINT, before)
    assert "its cell, outside the function, did not finish" in rows["twice"].reason
    assert rows["split"].state == rows["area"].state == "passed"


def test_a_cell_before_that_raised_is_told(one):
    cells = [
        cell("def half(x):\n    return x / 2"),
        cell("scale = undefined_name\n\ndef scaled(x):\n    return scale * x"),
    ]
    row = one("def thrice(x):\n    return scaled(x)", cells=cells)
    assert (
        row.state == "error" and "NameError: name 'scaled' is not defined" in row.reason
    )
    assert "another cell stopped with NameError: name 'undefined_name'" in row.reason


@pytest.mark.slow
def test_a_renamed_function_needs_a_person_and_is_tried_under_its_name(rows_of):
    rows = rows_of(
        notebook(
            twice="def twise(x):\n    return 2 * x",
            split="def splt(x):\n    return x",
            area=None,
        )
    )
    assert [(r.state, r.points) for r in rows.values()] == [
        ("needs a person", None)
    ] * 3
    assert rows["twice"].reason.endswith(
        "the nearest name is twise, and under that name it is right"
    )
    assert rows["split"].reason.endswith(
        "the nearest name is splt, and under that name it is not right"
    )
    assert "no cell defines area: was it deleted?" in rows["area"].reason
    assert (
        rows_of(notebook(OTHER, thrice="def thryce(x):\n    ..."))["thrice"].state
        == "not attempted"
    )


@pytest.mark.slow
def test_imports_that_fail_do_not_take_the_others_along(one):
    cells = [
        cell(
            "import not_installed_here\nfrom course.nowhere import anything\nimport math"
        )
    ]
    assert (
        one("def thrice(x):\n    return math.sqrt(9) * x", cells=cells).state
        == "passed"
    )
    assert (
        "plots.style()" in IMPORTS
    )  # a call of the course in the import cell does nothing


def test_a_judge_that_fails_leaves_it_to_a_person(one, monkeypatch):
    def fails(*_):
        raise ZeroDivisionError("in a property")

    monkeypatch.setattr(marking, "judge_answer", fails)
    row = one(RIGHT["thrice"])
    assert (row.state, row.points) == ("needs a person", None)
    assert "the judge stopped: ZeroDivisionError: in a property" in row.reason


def test_a_machine_at_fault_is_no_fault_of_the_submission(one, monkeypatch):
    def fails(*_, **__):
        raise OSError("no space left")

    monkeypatch.setattr(sessions.subprocess, "Popen", fails)
    with pytest.raises(SandboxFailure, match="no space left"):
        one(RIGHT["thrice"])


@pytest.mark.slow
def test_a_run_that_was_killed_from_outside_is_run_again_alone(rows_of, monkeypatch):
    """Out of memory, the system ends what it likes: a right answer loses no mark by it."""
    asked, report = [], sessions.Session._report

    def dies_once(session, patience):
        asked.append(session)
        if len(asked) == 1:
            session._process.kill()
            session._process.wait()
        return report(session, patience)

    monkeypatch.setattr(sessions.Session, "_report", dies_once)
    rows = rows_of(notebook())
    assert {r.state for r in rows.values()} == {"passed"}
    assert len(set(asked)) == 4  # the lesson's, then each alone
    monkeypatch.setattr(sessions.Session, "_report", lambda *_: None)
    rows = rows_of(notebook())
    assert {(r.state, r.points) for r in rows.values()} == {("needs a person", None)}
    assert "ended from outside" in rows["twice"].reason


@pytest.mark.slow
def test_what_was_tried_and_refused_is_told(one):
    row = one("import os\ndef thrice(x):\n    os.fork()\n    return 3 * x")
    assert (row.state, row.refused) == ("error", ("os.fork",))


@pytest.mark.parametrize(
    "end, words",
    [
        (
            Answers((Run("files", 1),)),
            "it wrote more than 100 MB, or thousands of files",
        ),
        (Answers((Run("memory", 0),)), "it took more than 2000 MB of memory"),
        (
            Answers(own=("crashed", "SIGBUS")),
            "its cell, outside the function, crashed Python (SIGBUS)",
        ),
        (
            Answers(own=("time", "")),
            "its cell, outside the function, did not finish within 20 s",
        ),
    ],
)
def test_every_end_has_its_words(one, monkeypatch, end, words):
    monkeypatch.setattr(sessions, "checked_answers", lambda *_: end)
    assert words in one(RIGHT["thrice"]).reason


def test_a_batch_that_is_stopped_stops_judging(rows_of):
    cancel = threading.Event()
    cancel.set()
    with pytest.raises(Cancelled):
        rows_of(notebook(OTHER), cancel=cancel)


def test_inputs_and_names_are_all_that_is_sent(monkeypatch, rows_of):
    """References, seeds and expected values stay at home."""
    sent, send = [], sessions.Session._send

    def spy(session, request):
        sent.append(request)
        send(session, request)

    monkeypatch.setattr(sessions.Session, "_send", spy)
    rows_of(notebook(OTHER), seed=3)
    read, asked = sent
    assert set(read) == {"notebook", "file", "lessons", "limits"}
    (question,) = asked["questions"]
    drawn = OTHER.exercises[0].draw(3)
    assert [
        np.array_equal(c["x"], d.arguments["x"])
        for c, d in zip(question["cases"], drawn, strict=True)
    ] == [True] * 3
    names = "index name kind arguments results cases most"
    assert set(question) == set(names.split())
