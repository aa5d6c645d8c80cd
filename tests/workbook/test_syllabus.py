"""The syllabus: all rows there, and what it says of the lessons that are built is true."""

import json
import re
from pathlib import Path

import pytest

from course.exercises.definition import all_lessons
from course.workbook.syllabus import (
    Topic,
    headings,
    problems,
    read_syllabus,
    syllabus_table,
)

ROOT = Path(__file__).resolve().parents[2]


def test_every_row_is_there_and_slides_follow_each_other():
    rows = {row.number: row for row in read_syllabus()}
    assert sorted(rows) == list(range(26))
    assert [rows[number].slide for number in (1, 9, 10, 11, 25)] == [
        1,
        9,
        9,
        10,
        24,
    ]  # rows 9 and 10 share one
    slides = [rows[number].slide for number in range(1, 26)]
    assert slides == sorted(slides) and set(slides) == set(range(1, 25))


def test_every_lesson_is_named_in_the_syllabus():
    named = {topic.lesson for row in read_syllabus() for topic in row.topics}
    assert {name[:2] for name in named} == {f"{number:02}" for number in range(19)}
    built = {path.stem for path in (ROOT / "solutions").glob("*.ipynb")}
    assert built <= named


def test_nothing_is_missing_where_a_lesson_is_built():
    assert problems() == []


def test_every_exercise_stands_in_the_syllabus_or_goes_with_a_row_that_does():
    rows = {
        row.number: {topic.lesson for topic in row.topics} for row in read_syllabus()
    }
    for lesson in all_lessons():
        for exercise in lesson.exercises:
            assert exercise.rows and set(exercise.rows) <= set(rows), exercise.name


def test_slide_numbers_live_only_in_the_data():
    """Code and lessons speak of rows; which page of the deck that is, stands in one file."""
    for path in [
        *(ROOT / "course").rglob("*.py"),
        *(ROOT / "solutions").glob("*.ipynb"),
    ]:
        if path.name != "syllabus.py":
            assert not re.search(
                r"\bslides? \d", path.read_text(encoding="utf-8"), flags=re.IGNORECASE
            ), path


def test_the_table_says_what_is_not_built():
    table = syllabus_table()
    assert table.count("\nrow ") + table.startswith("row ") == 25
    topics = [topic for row in read_syllabus() for topic in row.topics]
    unbuilt = [
        topic
        for topic in topics
        if not (ROOT / "solutions" / f"{topic.lesson}.ipynb").exists()
    ]
    assert table.count("not built yet") == len(unbuilt)
    for topic in unbuilt:
        assert f"{topic.lesson}: not built yet" in table


# It must be able to find fault.

GOOD = {
    "what": "momentum", "lesson": "10-impulse", "section": "Derive", "code": "course.dynamics.momentum_after",
    "exercise": "momentum_after", "test": "tests/test_x.py::test_it",
}  # fmt: skip


@pytest.fixture
def project(tmp_path):
    (tmp_path / "solutions").mkdir()
    (tmp_path / "tests").mkdir()
    code = "def test_it():\n    assert 1\nclass TestMore:\n    def test_in(self): ...\n"
    (tmp_path / "tests" / "test_x.py").write_text(code)
    cells = [{"cell_type": "markdown", "source": ["# 10 Impulse\n", "## **Derive**\n", "text"]},
             {"cell_type": "code", "source": ["# Build\n"]}]  # fmt: skip
    (tmp_path / "solutions" / "10-impulse.ipynb").write_text(
        json.dumps({"cells": cells})
    )
    return tmp_path


def data(project, *, number=15, **changed):
    topic = {
        key: value for key, value in {**GOOD, **changed}.items() if value is not None
    }
    lines = [f"{key} = {json.dumps(value)}" for key, value in topic.items()]
    path = project / "syllabus.toml"
    path.write_text(
        f"[[row]]\nnumber = {number}\nslide = 3\n[[row.topics]]\n" + "\n".join(lines)
    )
    return path


@pytest.mark.parametrize(
    "changed, said",
    [
        ({}, None),
        ({"test": "tests/test_x.py::TestMore::test_in"}, None),
        ({"section": None}, "no section is named"),
        ({"code": None}, "no code is named"),
        ({"exercise": None}, "no exercise is named"),
        ({"test": None}, "no test is named"),
        ({"section": "Build"}, "has no heading 'Build'"),  # it stands in a code cell
        ({"code": "course.dynamics.no_such_thing"}, "no_such_thing cannot be imported"),
        ({"code": "course.no_such_room.thing"}, "cannot be imported"),
        (
            {"exercise": "no_such_exercise"},
            "no exercise 'no_such_exercise' is registered",
        ),
        ({"exercise": "wall_bounce"}, "belongs to lesson 11"),
        (
            {"number": 16, "exercise": "kinetic_energy_lost"},
            "names the rows (15, 17), not this one",
        ),
        (
            {"test": "tests/test_x.py::test_other"},
            "there is no test tests/test_x.py::test_other",
        ),
        ({"test": "tests/test_y.py::test_it"}, "there is no test"),
        ({"test": "tests/test_x.py"}, "there is no test"),
        (
            {
                "lesson": "12-impulse-and-spin",
                "section": None,
                "code": "course.nowhere",
            },
            None,
        ),  # not built: not asked
    ],
)
def test_what_is_missing_is_reported(project, changed, said):
    found = problems(project, data(project, **changed))
    assert (found == []) if said is None else (any(said in line for line in found)), (
        found
    )


def test_what_is_missing_is_shown_in_the_table(project):
    table = syllabus_table(project, data(project, test=None))
    assert (
        "10-impulse: Derive -> course.dynamics.momentum_after -> momentum_after -> no test"
        in table
    )
    assert "! no test is named" in table


def test_a_wrong_key_names_its_row(project):
    with pytest.raises(ValueError, match="row 15: expected number, slide and topics"):
        read_syllabus(data(project, colour="red"))


def test_headings_are_read_without_their_marks(project):
    assert headings(project / "solutions" / "10-impulse.ipynb") == {
        "10 impulse",
        "derive",
    }


def test_a_topic_is_plain_data():
    assert Topic("a", "10-impulse").test == ""
