"""Whose a file is: two students are never taken for one, and one download's names are
understood.
"""

from pathlib import PurePosixPath

import pytest
from grading.toy_lessons import LESSONS

from course.grading.identity import distinct_names, student_of

ANN = "Ann Lee_1234_assignsubmission_file_"


def whose(file):
    return student_of(PurePosixPath(file), LESSONS)


@pytest.mark.parametrize(
    "file, student",
    [
        ("ann.ipynb", "ann"), ("90-toy_ann_lee.ipynb", "ann_lee"), ("ann-90-toy.ipynb", "ann"),
        ("90-toy.ipynb", "90-toy"), ("90-toy (1).ipynb", "90-toy (1)"), ("Ann Lee/90-toy.ipynb", "Ann Lee"),
        (f"{ANN}/90-toy.ipynb", "Ann Lee"), ("90-toy/ann.ipynb", "ann"),
        ("lesson 90/ann.ipynb", "ann"), ("group 1/Ann/work.ipynb", "Ann"), ("Ann/91-other-toy.ipynb", "Ann"),
        ("report.pdf", "report.pdf"), ("Žofie/a.ipynb", "Žofie"),
        (f"{ANN}/work/90-toy.ipynb", "Ann Lee"), (f"{ANN}/a/b/90-toy.ipynb", "Ann Lee"),
        (f"lesson 90/{ANN}/x.pdf", "Ann Lee"), ("Ann/work/90-toy.ipynb", "Ann"),
        ("Dan_3_assignsubmission_file_90-toy.ipynb", "Dan"),
        ("Dan_3_assignsubmission_onlinetext_x.html", "Dan"), ("D_2_77_assignsubmission_file_/x", "D_2"),
        ("Participant_11_assignsubmission_file_/90-toy.ipynb", "Participant 11"),
        ("Teilnehmer_7_assignsubmission_file/90-toy.ipynb", "Teilnehmer 7"),
        ("Ann/first/second/90-toy.ipynb", "Ann/first/second"), ("work/90-toy.ipynb", "90-toy"),
    ],
)  # fmt: skip
def test_whose_a_file_is(file, student):
    assert whose(file).name == student


@pytest.mark.parametrize(
    "one, other",
    [
        (f"{ANN}/90-toy.ipynb", f"{ANN}/work/deeper/91-other-toy.ipynb"),
        (f"{ANN}/90-toy.ipynb", f"{ANN}91-other-toy.ipynb"),
        ("Ann/90-toy.ipynb", "Ann/90-toy (1).ipynb"),
        ("ann-90-toy.ipynb", "91-other-toy_ann.ipynb"),
        ("Ann/90-toy/a.ipynb", "Ann/work/a.ipynb"),
    ],
)
def test_one_student_is_known_again(one, other):
    assert whose(one).identity == whose(other).identity


@pytest.mark.parametrize(
    "one, other",
    [
        ("Ana_101_assignsubmission_file_/a.ipynb", "Ana_202_assignsubmission_file_/a.ipynb"),
        ("Participant_1_assignsubmission_file_/a", "Participant_11_assignsubmission_file_/a"),
        ("Ann Lee/a.ipynb", "Ann_Lee/a.ipynb"), ("ann/a.ipynb", "Ann/a.ipynb"),
        ("group 1/Ann/a.ipynb", "group 2/Ann/a.ipynb"), ("Zo\u00eb/a", "Zoe\u0308/a"),
        ("Ann/a.ipynb", "Ann.ipynb"), ("90-toy.ipynb", "90-toy (1).ipynb"),
        # A folder of one's own that bears another's name.
        ("Eve_9_assignsubmission_file_/Ana_101_assignsubmission_file_/a", "Ana_101_assignsubmission_file_/a"),
        ("Eve/Ana_101_assignsubmission_file_/a", "Ana_101_assignsubmission_file_/a"),
        ("Eve_9_assignsubmission_file_Ana_101_assignsubmission_file_a", "Ana_101_assignsubmission_file_a"),
        ("a\udcff/x", "a\udcfe/x"),
    ],
)  # fmt: skip
def test_two_students_are_never_one(one, other):
    assert whose(one).identity != whose(other).identity


def test_two_of_one_name_are_shown_with_what_tells_them_apart():
    files = [
        "Ana_101_assignsubmission_file_/90-toy.ipynb", "Ana_202_assignsubmission_file_/90-toy.ipynb",
        "Ana_202_assignsubmission_file_/91-other-toy.ipynb", "Bo_7_assignsubmission_file_/90-toy.ipynb",
        "group 1/Cy/90-toy.ipynb", "group 2/Cy/90-toy.ipynb",
        "lesson 90/Di_5_assignsubmission_file_/a.ipynb", "lesson 91/Di_5_assignsubmission_file_/a.ipynb",
    ]  # fmt: skip
    assert distinct_names([whose(file) for file in files]) == [
        "Ana (101)", "Ana (202)", "Ana (202)", "Bo", "Cy (group 1/Cy)", "Cy (group 2/Cy)",
        "Di (5) (lesson 90)", "Di (5) (lesson 91)",
    ]  # fmt: skip
