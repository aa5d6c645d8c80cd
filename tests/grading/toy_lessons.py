"""Two small lessons, and notebooks of them, for the tests of grading."""

import csv
import json
from pathlib import Path

import numpy as np

from course.exercises.definition import Case, Exercise, Lesson, Mistake, Value
from course.exercises.verdict import Verdict
from course.grading.judge import row_of
from course.grading.report import Submission

X = Value("x", "(..., 3)", "m")
POINT = {"x": np.array([1.0, 2.0, 4.0])}


def _draws(rng):
    return [Case("by hand", POINT), Case("drawn", {"x": rng.normal(size=3)}),
            Case("five", {"x": rng.normal(size=(5, 3))}, "batch")]  # fmt: skip


def exercise(name, reference, results, **more):
    options = dict(
        name=name, rows=(1,), points=2, minutes=5, task=f"Return {name} of x.", arguments=(X,), results=results,
        reference=reference, cases=_draws, hints=("look here", "the formula", "return ____"),
        mistakes=(Mistake("sign", _negative(reference), "The sign is turned round: look at it again."),),
    )  # fmt: skip
    return Exercise(**(options | more))


def _negative(reference):
    def negative(*arguments):
        answer = reference(*arguments)
        return tuple(-a for a in answer) if isinstance(answer, tuple) else -answer

    return negative


TWICE = exercise("twice", lambda x: 2 * x, (Value("twice", "(..., 3)", "m"),))
SPLIT = exercise(
    "split",
    lambda x: (x[..., 0], x[..., 1:]),
    (Value("first", "(...)", "m"), Value("rest", "(..., 2)", "m")),
)


def _areas(rng):
    a, b = rng.uniform(1, 2, (2, 4))
    return [
        Case("by hand", {"a": 2.0, "b": 3.0}),
        Case("drawn", {"a": a, "b": b}, "batch"),
    ]


AREA = exercise(
    "area",
    lambda a, b: a * b,
    (Value("area", "(...)", "m^2"),),
    kind="expression",
    points=3,
    arguments=(Value("a", "scalar", "m"), Value("b", "scalar", "m")),
    cases=_areas,
)
THRICE = exercise(
    "thrice", lambda x: 3 * x, (Value("thrice", "(..., 3)", "m"),), points=1
)

TOY = Lesson("90", "toy", "Toy", "Is it two?", 10, (TWICE, SPLIT, AREA))
OTHER = Lesson("91", "other-toy", "Other", "Is it three?", 5, (THRICE,))
LESSONS = (TOY, OTHER)

IMPORTS = """\
%matplotlib inline
import matplotlib.pyplot as plt
import numpy as np
import sympy as sp
from course.workbook import check, hint, plots, use
plots.style()"""
RIGHT = {
    "twice": "def twice(x):\n    return 2 * x\n\ncheck(twice)",
    "split": "def split(x):\n    return x[..., 0], x[..., 1:]\n\ncheck(split)",
    "area": "a, b = sp.symbols('a b')\narea = a * b\ncheck(area, 'area')",
    "thrice": "def thrice(x):\n    return 3 * x",
}
BLANK = {
    "twice": "def twice(x):\n    ...\n\ncheck(twice)",
    "split": "def split(x):\n    ...\n\ncheck(split)",
    "area": "a, b = sp.symbols('a b')\narea = (\n    ...\n)\ncheck(area, 'area')",
    "thrice": "def thrice(x):\n    ...",
}


def cell(source, **course):
    return {"cell_type": "code", "source": source, "metadata": {"course": course} if course else {},
            "outputs": [], "execution_count": None}  # fmt: skip


def notebook(lesson=TOY, *, cells=None, told=True, **answers):
    """A notebook of the lesson: the right answers but for those given; an answer None
    leaves the cell out.
    """
    sources = {e.name: RIGHT[e.name] for e in lesson.exercises} | answers
    own = [cell(s, exercise=name) for name, s in sources.items() if s is not None]
    metadata = {"course": {"lesson": lesson.number}} if told else {}
    return {"nbformat": 4, "nbformat_minor": 5, "metadata": metadata,
            "cells": [cell(IMPORTS, role="imports"), *(cells or ()), *own]}  # fmt: skip


def blank(lesson=TOY, **more):
    return notebook(lesson, **{e.name: BLANK[e.name] for e in lesson.exercises}, **more)


def only(name, source):
    """A notebook of the first lesson with one exercise tried and the others as handed
    out.
    """
    return notebook(**{e.name: BLANK[e.name] for e in TOY.exercises} | {name: source})


def write(path: Path, content) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(
        content if isinstance(content, str) else json.dumps(content), encoding="utf-8"
    )
    return path


def submission(*states, file="ann.ipynb", student="ann", key="0" * 64, lesson=TOY):
    """A marked submission with an exercise in each of these states."""
    rows = tuple(
        row_of(e, Verdict(e.name, state, e.points if state == "passed" else 0, reason=(f"because {state}",)))
        for e, state in zip(lesson.exercises, states, strict=True)
    )  # fmt: skip
    return Submission(file, student, key, lesson, rows)


def rows_in(out: Path) -> dict:
    """The rows of a table of marks by file, as a spreadsheet sees them."""
    with out.open(encoding="utf-8-sig", newline="") as file:
        return {row["file"]: row for row in csv.DictReader(file)}
