"""The project's own notebooks through the grader: solutions get full marks, lessons as handed out "not attempted"."""

import shutil
from pathlib import Path

import pytest
from grading.toy_lessons import rows_in

from course.exercises.definition import all_lessons
from course.grading.grade import grade_folder

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.slow


def graded(folder: Path, tmp_path: Path) -> dict[str, dict[str, str]]:
    submissions = tmp_path / "submissions"
    shutil.copytree(
        folder, submissions, ignore=shutil.ignore_patterns(".ipynb_checkpoints")
    )
    # A fixed seed: that any seed will do is asked of the answers alone, and far more often, in tests/exercises.
    grade_folder(submissions, tmp_path / "grades.csv", seed=20_261)
    return rows_in(tmp_path / "grades.csv")


def test_solutions_get_full_marks(tmp_path):
    rows = graded(ROOT / "solutions", tmp_path)
    for lesson in all_lessons():
        row = rows[lesson.file_name]
        assert {e.name: row[f"{e.name}_state"] for e in lesson.exercises} == {
            e.name: "passed" for e in lesson.exercises
        }
        assert (
            float(row["total"])
            == float(row["out_of"])
            == sum(e.points for e in lesson.exercises)
        )


def test_lessons_as_handed_out_are_not_attempted(tmp_path):
    rows = graded(ROOT / "lessons", tmp_path)
    for lesson in all_lessons():
        row = rows[lesson.file_name]
        assert {row[f"{e.name}_state"] for e in lesson.exercises} == {"not attempted"}
        assert float(row["total"]) == 0.0
