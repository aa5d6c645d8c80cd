"""Cells and what is noted beside them: copied, renamed, moved, hidden, told wrongly."""

from grading.toy_lessons import BLANK, RIGHT, cell, notebook
from hostile.submission import Hostile

F = RIGHT["twice"]
WRONG = "def twice(x):\n    return 3 * x"


def _only(*cells, **metadata):
    """A notebook of these cells alone."""
    return {"nbformat": 4, "nbformat_minor": 5, "metadata": metadata, "cells": cells}


def _odd(**changes):
    return _only({**cell(F, exercise="twice"), **changes}, course={"lesson": "90"})


def _more(*cells, **answers):
    blank = {**BLANK, **answers}
    del blank["thrice"]
    return lambda: notebook(cells=list(cells), **blank)


FAMILY = [
    Hostile("all-right", exercise="*", expect="full", harm="", sample=True),
    Hostile(
        "tags",
        content=_odd(
            metadata={
                "tags": ["a"],
                "collapsed": True,
                "course": {"exercise": "twice"},
                "vscode": {"languageId": "python"},
            }
        ),
        expect="full",
        harm="",
    ),  # fmt: skip
    Hostile("no-metadata", content=_odd(metadata={}), expect="full", harm=""),
    Hostile(
        "list-of-lines",
        content=_odd(source=F.splitlines(keepends=True)),
        expect="full",
        harm="",
    ),  # fmt: skip
    Hostile(
        "outputs-of-3-MB",
        content=_odd(
            outputs=[
                {"output_type": "stream", "name": "stdout", "text": "x" * 3_000_000}
            ]
        ),
        expect="full",
        harm="",
    ),  # fmt: skip
    Hostile(
        "moved-to-own-cell", expect="full", harm="", content=_more(cell(F))
    ),  # fmt: skip
    Hostile(
        "tried-below",
        content=_more(cell("twice(2.0)\nx = 1"), twice=F),
        expect="full",
        harm="",
    ),  # fmt: skip
    Hostile(
        "forged-verdict-cell",
        "def twice(x):\n    return 3 * x",
        cells=(cell("", exercise="twice", points=2, state="passed", passed=True),),
    ),  # fmt: skip
    Hostile(
        "two-with-one-name",
        expect="row",
        harm="",
        content=_more(cell(WRONG, exercise="twice"), twice=F),
    ),  # fmt: skip
    Hostile(
        "points-in-metadata",
        content=lambda: {
            **notebook(twice=WRONG),
            "metadata": {
                "course": {"lesson": "90", "points": 99, "exercises": ["twice"] * 9}
            },
        },
    ),  # fmt: skip
    Hostile(
        "progress-forged",
        content=_odd(
            source=WRONG,
            metadata={
                "course": {
                    "exercise": "twice",
                    "points": 100,
                    "passed": True,
                    "kind": "given",
                    "role": "imports",
                }
            },
        ),
    ),  # fmt: skip
    Hostile(
        "exercise-is-a-list",
        content=_odd(
            source=WRONG, metadata={"course": {"exercise": ["twice"], "role": {"a": 1}}}
        ),
    ),  # fmt: skip
    Hostile("course-is-text", content=_odd(source=WRONG, metadata={"course": "x"})),
    Hostile(
        "lesson-is-a-tree",
        content=_only(cell(WRONG), course={"lesson": {"a": []}}),
        file="lesson-is-a-tree.ipynb",
    ),  # fmt: skip
    Hostile(
        "lesson-of-another",
        content=lambda: {**notebook(), "metadata": {"course": {"lesson": "91"}}},
        expect="row",
        harm="",
    ),  # fmt: skip
    Hostile(
        "renamed",
        content=_more(twice="def twise(x):\n    return 2 * x"),
        expect="person",
        harm="",
        sample=True,
    ),  # fmt: skip
    Hostile("deleted", content=lambda: notebook(twice=None), expect="person", harm=""),
    Hostile(
        "code-in-markdown",
        content=_only(
            {
                "cell_type": "markdown",
                "source": F,
                "metadata": {"course": {"exercise": "twice"}},
            },
            cell("y = 1"),
            course={"lesson": "90"},
        ),
    ),  # fmt: skip
    Hostile(
        "raw-cell",
        content=_only(
            {"cell_type": "raw", "source": F, "metadata": {}},
            cell("y = 1"),
            course={"lesson": "90"},
        ),
    ),  # fmt: skip
    Hostile("inside-if-false", "if False:\n    def twice(x):\n        return 2 * x"),
    Hostile("in-a-text", "'''\ndef twice(x):\n    return 2 * x\n'''"),
    Hostile("overwritten-after", "def twice(x):\n    return 2 * x\n\ntwice = 5"),
    Hostile("deleted-after", "def twice(x):\n    return 2 * x\n\ndel twice"),
    Hostile(
        "import-cell-patched",
        "def twice(x):\n    return 3 * x",
        cells=(
            cell(
                "import course.exercises.verdict as v\nv.judge = lambda *a: None",
                role="imports",
            ),
        ),
    ),  # fmt: skip
    Hostile(
        "ten-thousand-cells",
        expect="full",
        harm="",
        long=True,
        content=_more(*[cell(f"y{i} = {i}") for i in range(10_000)], twice=F),
    ),  # fmt: skip
    Hostile(
        "loop-in-another-cell",
        F,
        expect="full",
        harm="",
        cells=(cell("while True:\n    pass"),),
    ),  # fmt: skip
]
