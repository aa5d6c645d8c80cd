"""Notebooks that are green in the kernel: what an answer leans on is what is there when it is checked.

Each of the first marked a right answer wrong while exercises were run cell by cell, chosen by the names in them; the
others are what IPython, its event loop, its magics and the programs that save notebooks make of a right one.
"""

import os
import re
import zlib

import pytest
from grading.green_notebooks import (
    CHECKED,
    GREEN,
    HARMLESS,
    PERSON,
    PLAIN,
    answer,
    lessons,
    mine,
)
from grading.kernel_runs import verdict_in_kernel
from grading.saved_notebooks import DRAWN, SAVED, book, shuffled
from grading.toy_lessons import IMPORTS, LESSONS, OTHER, TOY, cell
from sandbox.runs import EITHER_WAY, NO_BOX

from course.grading import judge as judging
from course.grading.judge import Judge
from course.sandbox.limits import Limits
from course.sandbox.running import Sandbox

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

#: One in so many is looked at in a minute's run, and in an everyday one where the rest is long.
DAILY, OFTEN, EIGHTH = 40, 12, 8
PACKAGES = re.compile("numba|cvxpy|plt|scipy|sp\\.|doctest|inspect|k3d|pandas")


def some(names, *, few=(), rest=pytest.mark.slow, one_in=DAILY):
    """The names: one in so many is marked as ``few``, the others as ``rest``."""
    return [
        pytest.param(name, marks=rest if _number(name) % one_in else few)
        for name in names
    ]


#: Half a thousand kernels and more take a quarter of an hour: all of them where this says so.
WHOLE = os.environ.get("COURSE_KERNELS") == "whole"


def often(names):
    """One in DAILY in a minute's run, one in EIGHTH every day, as many in the long tests; all if asked for."""
    return [
        pytest.param(
            name,
            marks=()
            if _number(name) % DAILY == 0
            else pytest.mark.slow
            if _number(name) % EIGHTH == 1
            else pytest.mark.long,
        )
        for name in names
        if WHOLE or _number(name) % DAILY == 0 or _number(name) % EIGHTH in (1, 5)
    ]


def kernels(names):
    """One name in OFTEN every day, one in EIGHTH in the long tests, all where asked for."""
    names = list(names)
    few = some(names, few=pytest.mark.slow, rest=pytest.mark.long, one_in=OFTEN)
    return [
        param
        for name, param in zip(names, few, strict=True)
        if WHOLE or _number(name) % OFTEN == 0 or _number(name) % EIGHTH == 1
    ]


def _number(name):
    return zlib.crc32(str(name).encode())


def written(cells, lesson=OTHER):
    return book(
        cell(IMPORTS, role="imports"),
        *cells,
        metadata={"course": {"lesson": lesson.number}},
    )


def judged(cells, *, boxed, lesson=OTHER, seconds=2.0):
    content = cells if isinstance(cells, bytes) else written(cells, lesson)
    judge = Judge(7, Sandbox(Limits(seconds), boxed), LESSONS)
    _, rows = judge.rows(content, "submission.ipynb")
    return {row.exercise.name: row for row in rows}


def green(name):
    """The notebook of this name, as a file."""
    if isinstance(name, int):
        return shuffled(name)
    return SAVED[name] if name in SAVED else written((GREEN | PERSON)[name])


@pytest.mark.parametrize("name", often([*GREEN, *SAVED, *range(DRAWN)]))
def test_what_is_green_in_the_kernel_passes(name):
    row = judged(green(name), boxed=not NO_BOX, seconds=4.0)["thrice"]
    assert (row.state, row.points) == ("passed", 1), row.reason


@pytest.mark.parametrize("name", kernels([*GREEN, *SAVED, *range(DRAWN)]))
@pytest.mark.long
def test_what_is_green_in_the_kernel_passes_without_a_box(name):
    row = judged(green(name), boxed=False, seconds=4.0)["thrice"]
    assert (row.state, row.points) == ("passed", 1), row.reason


@pytest.mark.parametrize("name", kernels([*GREEN, *PERSON, *SAVED, *range(DRAWN)]))
@pytest.mark.long
def test_it_is_green_in_a_kernel_indeed(name, tmp_path):
    assert verdict_in_kernel(green(name), tmp_path) == "passed"


@pytest.mark.parametrize("name", some(PERSON))
def test_what_leans_on_its_authors_machine_is_for_a_person(name):
    row = judged(PERSON[name], boxed=not NO_BOX)["thrice"]
    assert row.state in ("passed", "needs a person"), row.reason


def test_a_wrong_answer_that_does_not_lean_on_a_command_is_wrong():
    """Who has a command in a notebook has not got every wrong answer looked at."""
    cells = [
        mine("files = !ls\nname = input()"),
        answer("def thrice(x):\n    return 2 * x" + CHECKED),
    ]
    row = judged(cells, boxed=not NO_BOX)["thrice"]
    assert (row.state, row.points) == ("wrong", 0)


@EITHER_WAY
@pytest.mark.parametrize(
    "packages", [False, pytest.param(True, marks=pytest.mark.slow)]
)
@pytest.mark.long
def test_what_is_harmless_is_not_named(boxed, packages):
    """Those that load what takes seconds apart."""
    sources = [s for s in HARMLESS.values() if bool(PACKAGES.search(s)) == packages]
    cells = [mine(source) for source in sources]
    row = judged([*cells, answer("k = 3\n" + PLAIN)], boxed=boxed, seconds=20.0)
    assert row["thrice"].refused == ()
    assert row["thrice"].state == "passed", row["thrice"].reason


@pytest.mark.parametrize(
    ("attempt", "told"),
    [
        ("!cat /etc/passwd", "the command cat /etc/passwd"),
        ("!ls; rm -r ..", "the command ls; rm -r .."),
        ("%%bash\nrm -r ..", "the command rm -r .."),
        ("import os\nos.system('ls')", "os.system"),
        ("import subprocess\nsubprocess.run(['ls'])", "subprocess.Popen"),
        ("import ctypes\nctypes.c_int.from_address(0)", "ctypes.cdata"),
        ("open('../solutions/10-impulse.ipynb')", "reading "),
    ],
)
def test_what_is_denied_is_named(attempt, told):
    cells = [mine(attempt), answer("k = 3\n" + PLAIN)]
    row = judged(cells, boxed=not NO_BOX)["thrice"]
    assert [one for one in row.refused if one.startswith(told)], row.refused


@pytest.mark.slow
@EITHER_WAY
def test_a_symbol_of_the_lessons_own_cell(boxed):
    cells = [
        lessons("a, b = sp.symbols('a b')"),
        cell("area = a * b\ncheck(area, 'area')", exercise="area"),
    ]
    row = judged(cells, boxed=boxed, lesson=TOY)["area"]
    assert row.state == "passed", row.reason


@pytest.mark.slow
@EITHER_WAY
def test_two_answers_that_disagree_are_for_a_person(boxed):
    cells = [
        answer("def thrice(x):\n    return 3 * x" + CHECKED),
        answer("def thrice(x):\n    return 2 * x" + CHECKED),
    ]
    row = judged(cells, boxed=boxed)["thrice"]
    assert (row.state, row.points) == ("needs a person", None)
    assert "checked 2 times, and right 1 times" in row.reason


@pytest.mark.slow
def test_the_lessons_own_cells_are_run_where_they_are_needed_or_changed(monkeypatch):
    """Unchanged and not needed they are left out: most of a lesson's time is pictures and measurements."""
    slow, needed = "while True:\n    pass", "k = 3"
    digests = frozenset(map(judging.digest_of, (slow, needed)))
    monkeypatch.setattr(judging, "handed_out", lambda lesson: digests)
    cells = [lessons(slow), lessons(needed), answer(PLAIN)]
    row = judged(cells, boxed=False, seconds=60.0)["thrice"]
    assert row.state == "passed", row.reason


@pytest.mark.slow
@EITHER_WAY
def test_a_notebook_makes_as_many_processes_as_it_has_checks(boxed):
    """In a box the kernel counts: what a student forks past the hook is refused once that number is reached."""
    many = "for _ in range(500):\n    check(thrice)"
    row = judged([answer("def thrice(x):\n    return 3 * x"), mine(many)], boxed=boxed)
    assert row["thrice"].state in ("passed", "needs a person", "error")
    assert row["thrice"].seconds < 30


@pytest.mark.slow
@EITHER_WAY
def test_a_cell_that_ends_the_program_costs_what_is_in_it_alone(boxed):
    cells = [
        mine("k = 3"),
        mine("import os\nos._exit(0)"),
        answer(PLAIN),
    ]
    assert judged(cells, boxed=boxed)["thrice"].state == "passed"
