"""A lesson's second notebook, which goes deeper: its name, place, links, bar and marks are its own."""

import json
from dataclasses import replace
from pathlib import PurePosixPath

import pytest
from grading.toy_lessons import TOY

from course.exercises.notebook_file import Outline, parse_notebook
from course.grading.identity import student_of
from course.workbook import overview
from course.workbook.checking import whats_next
from course.workbook.links import link_line
from course.workbook.work_folder import find_lesson, lesson_files

CORE = replace(TOY, exercises=TOY.exercises[:2])
MORE = replace(
    TOY, number="90-more", exercises=(replace(TOY.exercises[2], level="stretch"),)
)
TITLES = {
    "00-start.ipynb": "Start",
    "90-toy.ipynb": "Toy",
    "90-toy-more.ipynb": "Toy, deeper",
    "91-x.ipynb": "X",
}


def test_it_is_named_after_its_lesson():
    assert (MORE.file_name, CORE.file_name) == ("90-toy-more.ipynb", "90-toy.ipynb")
    assert MORE.core == () and MORE.counted == MORE.exercises
    assert CORE.counted == CORE.core


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("90", "90-toy"), ("toy", "90-toy"), ("90-toy", "90-toy"), ("to", "90-toy"),
        ("90-more", "90-toy-more"), ("toy-more", "90-toy-more"), ("90-toy-more.ipynb", "90-toy-more"),
        ("work/90-toy-more (new 2).ipynb", "90-toy-more"), ("0", "00-start"),
    ],
)  # fmt: skip
def test_it_is_opened_by_name(tmp_path, name, file):
    (tmp_path / "lessons").mkdir()
    for each in TITLES:
        (tmp_path / "lessons" / each).write_text("{}")
    assert [f.name for f in lesson_files(tmp_path)] == list(TITLES)
    assert find_lesson(name, tmp_path).stem == file


@pytest.mark.parametrize("name", ["00-more", "more-90", "-more"])
def test_what_there_is_not_is_not_opened(tmp_path, name):
    (tmp_path / "lessons").mkdir()
    for each in ("00-start.ipynb", "90-toy.ipynb"):
        (tmp_path / "lessons" / each).write_text("{}")
    with pytest.raises(ValueError, match="expected a lesson's number or name"):
        find_lesson(name, tmp_path)


def test_lessons_lead_past_it_and_into_it():
    core = link_line(TITLES, "90-toy.ipynb")
    assert "[← Start](00-start.ipynb)" in core and "[X →](91-x.ipynb)" in core
    assert "(90-toy-more.ipynb)" in core
    more = link_line(TITLES, "90-toy-more.ipynb")
    assert "[← Toy](90-toy.ipynb)" in more and "[X →](91-x.ipynb)" in more
    assert "toy-more" not in more + link_line(TITLES, "91-x.ipynb")


def test_its_minutes_are_not_among_those_left(monkeypatch):
    monkeypatch.setattr(overview, "all_lessons", lambda: (CORE, MORE))
    names = {CORE.file_name, MORE.file_name}
    minutes = sum(e.minutes for e in CORE.core)
    text = overview.page(names, set())
    assert f"About {minutes} minutes of core exercises are left" in text
    assert "(90-toy-more.ipynb)" in text and "0 of 1" in text
    done = overview.page(names, {e.name for e in CORE.exercises})
    assert "All core exercises have passed." in done


def test_after_its_last_exercise_its_end_is_said():
    (only,) = MORE.exercises
    passed = frozenset({only.name})
    assert "last exercise of this notebook" in whats_next(
        MORE, only, frozenset(), passed
    )
    assert "all exercises of this notebook" in whats_next(MORE, only, passed, passed)


@pytest.mark.parametrize(
    ("file", "lesson"),
    [
        ("90-toy.ipynb", "90"), ("90-toy-more.ipynb", "90-more"), ("ann_90-toy-more (1).ipynb", "90-more"),
        ("90-toy_ann-moreau.ipynb", "90"),
    ],
)  # fmt: skip
def test_a_submission_is_of_the_notebook_that_it_names(file, lesson):
    outlines = [Outline(le.number, tuple(e.name for e in le.exercises)) for le in (CORE, MORE)]  # fmt: skip
    cell = {"cell_type": "code", "source": "x = 1", "metadata": {}, "outputs": [], "execution_count": None}  # fmt: skip
    notebook = {"nbformat": 4, "nbformat_minor": 5, "cells": [cell], "metadata": {}}
    told = parse_notebook(json.dumps(notebook).encode(), file, outlines)
    assert told.lesson == lesson


@pytest.mark.parametrize(
    ("file", "student"),
    [
        ("90-toy-more_ann.ipynb", "ann"), ("Ann/90-toy-more.ipynb", "Ann"), ("90-toy-more/ann.ipynb", "ann"),
        ("lesson 90-more/ann.ipynb", "ann"),
    ],
)  # fmt: skip
def test_its_file_names_the_student(file, student):
    assert student_of(PurePosixPath(file), (CORE, MORE)).name == student
