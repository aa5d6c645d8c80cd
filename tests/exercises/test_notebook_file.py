"""Submissions are read without being run: the lesson, the import cell, and where each answer is."""

import json
import time

import pytest

from course.exercises.notebook_file import Outline, UnusableNotebook, parse_notebook
from course.exercises.source import (
    MAXIMUM_CELL,
    defined_names,
    definitions_only,
    is_blank,
    names_of,
    python_only,
)

LESSONS = (
    Outline("70", ("speed_along", "p_hat")),
    Outline("71", ("momentum_after",)),
)


def cell(source, **course):
    return {"cell_type": "code", "source": source, "metadata": {"course": course} if course else {},
            "outputs": [], "execution_count": None}  # fmt: skip


def notebook(*cells, lesson="70"):
    return {"nbformat": 4, "nbformat_minor": 5, "cells": list(cells),
            "metadata": {"course": {"lesson": lesson}} if lesson else {}}  # fmt: skip


@pytest.fixture
def read():
    def reads(*cells, lesson="70", name="x.ipynb", content=None):
        whole = notebook(*cells, lesson=lesson) if content is None else content
        raw = whole if isinstance(whole, bytes) else json.dumps(whole).encode()
        return parse_notebook(raw, name, LESSONS)

    return reads


def found(told):
    return {c.name: c for c in told.cells}


IMPORTS = cell("import numpy as np", role="imports")
SPEED = cell("def speed_along(x):\n    return x", exercise="speed_along")
P_HAT = cell("p_hat = 1", exercise="p_hat")


def test_a_whole_notebook(read):
    told = read(IMPORTS, cell("speed_along(3)", role="play"), SPEED, P_HAT)
    assert told.lesson == "70" and told.preamble == ("import numpy as np",)
    assert [(c.name, c.fault) for c in told.cells] == [
        ("speed_along", ""),
        ("p_hat", ""),
    ]
    assert found(told)["p_hat"].source == "p_hat = 1"


@pytest.mark.parametrize(
    "content, words",
    [
        (b"", "the file is empty"),
        (b"\xff\xfe\x00", "not text in UTF-8"),
        (b"PK\x03\x04zip", "not JSON"),
        (b"print('hello')", "not JSON"),
        (b"[1, 2]", "without a notebook's format number"),
        (b"{}", "without a notebook's format number"),
        (b'{"nbformat": "4", "cells": []}', "without a notebook's format number"),
        (b'{"nbformat": 4}', "no list of cells"),
        (b'{"nbformat": 4, "cells": {}}', "no list of cells"),
        (b'{"nbformat": 4, "cells": []}', "without a code cell"),
        (
            b'{"nbformat": 4, "cells": [1, {"cell_type": "code", "source": 3}]}',
            "without a code cell",
        ),
        (b"[" * 100_000, "nested too deeply"),
        (b'{"nbformat": ' + b"4" * 5000 + b"}", "not JSON"),
        (
            json.dumps(notebook(cell("x = 1"), lesson="")).encode(),
            "none of the lessons",
        ),
        (
            json.dumps(notebook(cell("x = 1"), lesson="99")).encode(),
            "none of the lessons",
        ),
    ],
    ids=lambda v: v[:30] if isinstance(v, bytes) else "",
)
def test_files_that_cannot_be_marked_say_why(read, content, words):
    with pytest.raises(UnusableNotebook, match=words):
        read(content=content)


def test_too_much_is_not_read(read, monkeypatch):
    with pytest.raises(UnusableNotebook, match="20,001 code cells are too many"):
        read(*[cell("x = 1")] * 20_001)
    monkeypatch.setattr("course.exercises.notebook_file.MAXIMUM_BYTES", 100)
    with pytest.raises(UnusableNotebook, match="too large for a notebook"):
        read(SPEED)


def test_what_jupyter_opens_is_read_though_the_schema_forbids_it(read):
    loose = {"nbformat": 4, "nbformat_minor": 0, "metadata": None, "extra": 1,
             "cells": [{"cell_type": "code", "source": ["def speed_along(x):\n", "    return x"], "more": {}},
                       {"cell_type": "markdown", "source": 7}]}  # fmt: skip
    assert (
        found(read(content=loose))["speed_along"].source
        == "def speed_along(x):\n    return x"
    )
    assert (
        found(read(content=b"\xef\xbb\xbf" + json.dumps(notebook(SPEED)).encode()))[
            "speed_along"
        ].fault
        == ""
    )


@pytest.mark.slow
def test_a_notebook_of_an_older_format_is_read(read):
    old = {"nbformat": 3, "nbformat_minor": 0, "metadata": {"name": ""}, "worksheets": [{"metadata": {}, "cells": [
        {"cell_type": "code", "collapsed": False, "input": "def speed_along(x):\n    return x", "language": "python",
         "metadata": {}, "outputs": [], "prompt_number": 1}]}]}  # fmt: skip
    assert found(read(content=old))["speed_along"].source.startswith("def speed_along")


@pytest.mark.parametrize(
    "told, name, cells, number",
    [
        ("71", "70-first.ipynb", (SPEED,), "71"),
        ("", "ann_70-first.ipynb", (cell("momentum_after = 1"),), "70"),
        ("99", "71-second (2).ipynb", (SPEED,), "71"),
        ("", "homework.ipynb", (cell("momentum_after = 1"),), "71"),
        ("", "1970-first.ipynb", (cell("momentum_after = 1"),), "71"),
    ],
)
def test_which_lesson_it_is(read, told, name, cells, number):
    assert read(*cells, lesson=told, name=name).lesson == number


@pytest.mark.parametrize(
    "source, names",
    [
        ("def f(x):\n    g = 1\n    return g", ("f",)),
        ("a = b = 1\nc, (d, e) = 1, (2, 3)\nf: int = 2", ("a", "b", "c", "f")),
        ("x.y = 1\nx[0] = 2", ()),
        ("f = use(f)", ()),
        ("f = used(f)", ("f",)),
        ("%matplotlib inline\n!pip list\n?f\nf?\nx = %timeit 1\ny = 2", ("x", "y")),
        ("def f(:", ()),
        ("x = 1" + " " * MAXIMUM_CELL, ()),
        ("x = " + "-" * 90_000 + "1", ()),
        ("a" + ".b" * 60_000, ()),
        ("x = '\\d'", ("x",)),
    ],
    ids=lambda v: v[:20] if isinstance(v, str) else "",
)
def test_what_a_cell_defines(source, names):
    assert defined_names(source) == names


def test_ipython_lines_are_left_out_and_python_is_left_alone():
    assert (
        python_only("%time x\ny = 1\n    \nif y:\n    !ls\n    np.sum?")
        == "0\ny = 1\n    \nif y:\n    0\n    0"
    )
    plain = 'x = (7\n% 4)\ntext = """\n%not magic\nreally?\n"""'
    assert python_only(plain) == plain
    assert python_only("%%bash\nls -l | grep x").startswith("0")


@pytest.mark.parametrize(
    "hard",
    [
        "x = " + " " * 150_000 + "?!y(",
        (" " * 300 + "a b\n") * 500,
        "a," * 70_000 + "= (",
        "x" * 190_000 + "? y",
        "if a:\n    pass\n" + "elif b:\n    f = 1\n" * 5_000,
        "\n".join(f"name_{i} = {i}" for i in range(12_000)),
    ],
    ids=["spaces", "indents", "names", "one word", "elif", "many names"],
)
@pytest.mark.slow
def test_source_is_read_in_a_time_that_grows_with_its_length(hard):
    """A pattern that tries its spaces twice took a minute for 40 kB; each of these takes a tenth of a second."""
    started = time.process_time()
    for read_in_some_way in (python_only, defined_names, definitions_only, names_of):
        read_in_some_way(hard)
    is_blank(hard, "f")
    assert time.process_time() - started < 10


def test_the_answer_is_where_it_was_checked(read):
    """The exercise's own cell before cells that students added, those before the lesson's; a blank comes last."""
    blank = cell("def speed_along(x):\n    ...", exercise="speed_along")
    theirs = cell("def speed_along(x):\n    return 2 * x")
    later = cell("speed_along = 3.5\np_hat = 2", role="play")
    assert (
        found(read(SPEED, P_HAT, theirs, later))["speed_along"].source
        == SPEED["source"]
    )
    assert (
        found(read(blank, P_HAT, theirs, later))["speed_along"].source
        == theirs["source"]
    )
    assert found(read(blank, P_HAT, later))["speed_along"].source == blank["source"]
    assert found(read(blank, P_HAT, later))["p_hat"].source == "p_hat = 1"
    assert found(read(later))["p_hat"].source == later["source"]
    again = cell("def speed_along(x):\n    return 3 * x")
    assert found(read(blank, theirs, again))["speed_along"].source == again["source"]
    assert (
        found(read(SPEED, cell("speed_along = use(speed_along)")))["speed_along"].source
        == SPEED["source"]
    )


def test_renamed_deleted_and_broken_cells(read):
    told = found(
        read(cell("def speed_alnog(x):\n    return x", exercise="speed_along"))
    )
    assert (
        told["speed_along"].needs_person
        and told["speed_along"].nearest == "speed_alnog"
    )
    assert "the nearest name is speed_alnog" in told["speed_along"].fault
    assert (
        told["p_hat"].needs_person
        and told["p_hat"].fault == "no cell defines p_hat: was it deleted?"
    )
    elsewhere = cell("def speed_allong(x):\n    return x")
    moved = found(read(elsewhere))["speed_along"]
    assert (moved.nearest, moved.source) == ("speed_allong", elsewhere["source"])
    entirely = found(read(cell("def foo(x):\n    return x", exercise="speed_along")))[
        "speed_along"
    ]
    assert entirely.nearest == "foo"
    symbols = found(read(cell("m_1, m_2 = 1, 2\nm_1 + m_2", exercise="p_hat")))["p_hat"]
    assert (
        symbols.needs_person
        and not symbols.nearest
        and "defines no p_hat" in symbols.fault
    )
    broken = found(
        read(cell("def speed_along(x)\n    return x", exercise="speed_along"))
    )["speed_along"]
    assert not broken.needs_person and broken.fault.startswith(
        "the cell is not valid Python: expected ':' (line 1)"
    )
    magic = found(read(cell("%time 1\ndef speed_along(x", exercise="speed_along")))[
        "speed_along"
    ]
    assert "line 2" in magic.fault
    long = found(read(cell("#" * (MAXIMUM_CELL + 1), exercise="speed_along")))[
        "speed_along"
    ]
    assert "characters are too many" in long.fault


def test_helpers_in_cells_that_students_added_come_along(read):
    added = cell(
        "g = 9.81\nprint('no')\n\ndef helper(x):\n    return g * x\nfor i in range(3): pass"
    )
    lessons_own = cell("figure = 1\ndef draw(): pass", role="play")
    told = read(IMPORTS, added, lessons_own, SPEED, cell("speed_along = 2\nother = 1"))
    assert told.preamble == (
        "import numpy as np",
        "g = 9.81\n\ndef helper(x):\n    return g * x",
    )


@pytest.mark.parametrize(
    "metadata",
    [None, 3, {"course": 3}, {"course": {"exercise": ["speed_along"]}}],
    ids=repr,
)
def test_metadata_that_is_none(read, metadata):
    odd = SPEED | {"metadata": metadata}
    assert found(read(odd))["speed_along"].source == SPEED["source"]
