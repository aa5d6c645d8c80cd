"""Notebooks that are green in the kernel: what an answer leans on is what is there when it is checked.

Each of these marked a right answer wrong while exercises were run cell by cell, chosen by the names in them.
"""

import json

import pytest
from grading.toy_lessons import IMPORTS, LESSONS, OTHER, TOY, cell
from sandbox.runs import EITHER_WAY

from course.grading import judge as judging
from course.grading.judge import Judge
from course.sandbox.limits import Limits
from course.sandbox.running import Sandbox

pytestmark = pytest.mark.slow
CHECKED = "\ncheck(thrice)"
PLAIN = "def thrice(x):\n    return k * x" + CHECKED


def mine(source):
    return cell(source)


def answer(source):
    return cell(source, exercise="thrice")


def lessons(source):
    return cell(source, role="lesson")


GREEN = {
    "the answer's cell split in two": [
        answer("def twice_it(x):\n    return 2 * x"),
        answer("def thrice(x):\n    return twice_it(x) + x" + CHECKED),
    ],
    "split with the check alone": [
        answer("def thrice(x):\n    return 3 * x"),
        answer("check(thrice)"),
    ],
    "a helper in a copied cell": [
        answer("k = 3\ndef thrice(x):\n    ..."),
        answer(PLAIN),
    ],
    "a number in one of the lesson's own cells": [lessons("k = 3"), answer(PLAIN)],
    "the lesson's own cell, changed": [lessons("k = 2\nk = 3"), answer(PLAIN)],
    "inside if": [mine("if True:\n    k = 3"), answer(PLAIN)],
    "inside try": [
        mine("try:\n    k = int('3')\nexcept ValueError:\n    k = 0"),
        answer(PLAIN),
    ],
    "inside with": [
        mine("import contextlib\nwith contextlib.suppress(OSError):\n    k = 3"),
        answer(PLAIN),
    ],
    "inside for": [mine("for k in range(4):\n    pass"), answer(PLAIN)],
    "by walrus": [mine("print(k := 3)"), answer(PLAIN)],
    "by exec": [mine("exec('k = 3')"), answer(PLAIN)],
    "by globals": [mine("globals()['k'] = 3"), answer(PLAIN)],
    "the answer by exec": [answer("exec('def thrice(x): return 3 * x')" + CHECKED)],
    "the answer inside if": [
        answer("if True:\n    def thrice(x):\n        return 3 * x" + CHECKED)
    ],
    "by a timed line": [mine("%time k = 3"), answer(PLAIN)],
    "by a timed cell": [mine("%%time\nk = 3"), answer(PLAIN)],
    "an import moved": [
        mine("import math as m"),
        answer("def thrice(x):\n    return m.sqrt(9) * x" + CHECKED),
    ],
    "an import below": [
        answer("def thrice(x):\n    import math\n    return math.sqrt(9) * x" + CHECKED)
    ],
    "a value added to": [mine("k = 2"), mine("k += 1"), answer(PLAIN)],
    "an entry changed": [
        mine("k = np.array([2.0])"),
        mine("k[0] = 3"),
        answer(PLAIN),
    ],
    "appended to": [
        mine("parts = [1]"),
        mine("parts.append(2)"),
        answer("def thrice(x):\n    return sum(parts) * x" + CHECKED),
    ],
    "filled": [mine("k = np.zeros(1)"), mine("k.fill(3)"), answer(PLAIN)],
    "summed in a loop": [
        mine("k = 0"),
        mine("for i in range(3):\n    k += 1"),
        answer(PLAIN),
    ],
    "two cells": [mine("a = 1"), mine("k = a + 2"), answer(PLAIN)],
    "a class": [
        mine("class Scale:\n    factor = 3"),
        answer("def thrice(x):\n    return Scale.factor * x" + CHECKED),
    ],
    "a file written and imported": [
        mine("%%writefile scales.py\nk = 3"),
        mine("from scales import k"),
        answer(PLAIN),
    ],
    "a file read": [
        mine("with open('k.txt', 'w') as f:\n    f.write('3')"),
        mine("k = int(open('k.txt').read())"),
        answer(PLAIN),
    ],
    "prompts of Python pasted": [
        answer(">>> def thrice(x):\n...     return 3 * x\n...\n>>> check(thrice)")
    ],
    "prompts of IPython pasted": [
        mine("In [3]: k = 3"),
        answer(
            "In [4]: def thrice(x):\n   ...:     return k * x\n   ...:\n\nIn [5]: check(thrice)"
        ),
    ],
    "await": [
        mine(
            "import asyncio\nasync def three():\n    await asyncio.sleep(0)\n    return 3"
        ),
        mine("k = await three()"),
        answer(PLAIN),
    ],
    "a shell line that goes on": [mine("!echo \\\n  hello\nk = 3"), answer(PLAIN)],
    "a magic line that goes on": [
        mine("%time k = \\\n   3"),
        answer(PLAIN),
    ],
    "what a shell line gives": [mine("files = !ls\nk = 3"), answer(PLAIN)],
    "annotations of the future": [
        mine("from __future__ import annotations"),
        answer("def thrice(x: Not | Known) -> Here:\n    return 3 * x" + CHECKED),
    ],
    "a decorator": [
        mine("def scaled(f):\n    return lambda x: 3 * f(x)"),
        answer("@scaled\ndef thrice(x):\n    return x\n\ncheck(thrice, 'thrice')"),
    ],
    "a cell that fails": [mine("k = 3\n1 / 0"), answer(PLAIN)],
    "a cell that fails between": [mine("k = 3"), mine("nothing_here"), answer(PLAIN)],
    "a loop that was stopped by hand": [
        mine("while True:\n    pass"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "checked twice, right both times": [
        answer(PLAIN.replace("k *", "3 *")),
        mine("check(thrice)"),
    ],
    "checked while blank, then right": [
        answer("def thrice(x):\n    ..." + CHECKED),
        answer("def thrice(x):\n    return 3 * x" + CHECKED),
    ],
    "changed after the check": [
        answer("k = 3\n" + PLAIN),
        mine("k = 0"),
    ],
    "no check at all": [answer("def thrice(x):\n    return 3 * x")],
    "a magic for pictures": [mine("%matplotlib inline\nk = 3"), answer(PLAIN)],
    "help asked for": [mine("np.sum?\nk = 3"), answer(PLAIN)],
}


def judged(cells, *, boxed, lesson=OTHER, seconds=2.0):
    content = {
        "nbformat": 4,
        "nbformat_minor": 5,
        "metadata": {"course": {"lesson": lesson.number}},
        "cells": [cell(IMPORTS, role="imports"), *cells],
    }
    judge = Judge(7, Sandbox(Limits(seconds), boxed), LESSONS)
    _, rows = judge.rows(json.dumps(content).encode(), "submission.ipynb")
    return {row.exercise.name: row for row in rows}


@EITHER_WAY
@pytest.mark.parametrize("name", GREEN)
def test_what_is_green_in_the_kernel_passes(name, boxed):
    row = judged(GREEN[name], boxed=boxed)["thrice"]
    assert (row.state, row.points) == ("passed", 1), row.reason


@EITHER_WAY
def test_a_symbol_of_the_lessons_own_cell(boxed):
    cells = [
        lessons("a, b = sp.symbols('a b')"),
        cell("area = a * b\ncheck(area, 'area')", exercise="area"),
    ]
    row = judged(cells, boxed=boxed, lesson=TOY)["area"]
    assert row.state == "passed", row.reason


@EITHER_WAY
def test_two_answers_that_disagree_are_for_a_person(boxed):
    cells = [
        answer("def thrice(x):\n    return 3 * x" + CHECKED),
        answer("def thrice(x):\n    return 2 * x" + CHECKED),
    ]
    row = judged(cells, boxed=boxed)["thrice"]
    assert (row.state, row.points) == ("needs a person", None)
    assert "checked 2 times, and right 1 times" in row.reason


def test_the_lessons_own_cells_are_run_where_they_are_needed_or_changed(monkeypatch):
    """Unchanged and not needed they are left out: most of a lesson's time is pictures and measurements."""
    slow, needed = "while True:\n    pass", "k = 3"
    digests = frozenset(map(judging.digest_of, (slow, needed)))
    monkeypatch.setattr(judging, "handed_out", lambda lesson: digests)
    cells = [lessons(slow), lessons(needed), answer(PLAIN)]
    row = judged(cells, boxed=False, seconds=60.0)["thrice"]
    assert row.state == "passed", row.reason


@EITHER_WAY
def test_a_notebook_makes_as_many_processes_as_it_has_checks(boxed):
    """In a box the kernel counts: what a student forks past the hook is refused once that number is reached."""
    many = "for _ in range(500):\n    check(thrice)"
    row = judged([answer("def thrice(x):\n    return 3 * x"), mine(many)], boxed=boxed)
    assert row["thrice"].state in ("passed", "needs a person", "error")
    assert row["thrice"].seconds < 30


@EITHER_WAY
def test_a_cell_that_ends_the_program_costs_what_is_in_it_alone(boxed):
    cells = [
        mine("k = 3"),
        mine("import os\nos._exit(0)"),
        answer(PLAIN),
    ]
    assert judged(cells, boxed=boxed)["thrice"].state == "passed"
