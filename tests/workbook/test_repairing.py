"""What a student is told of a repair: kind and line with the verdict, the change only by hint."""

import re
import sys
from dataclasses import replace

import numpy as np
import pytest

from course.exercises.definition import find_exercise
from course.exercises.inputs import inputs_of
from course.workbook import check, checking, hint, repairing
from course.workbook.judging import judge_here

FACTOR = 2.0


def halved(x):
    return np.multiply(0.5, x)


halved.__module__ = "__main__"  # as in a notebook


def speed_along(velocity, normal):
    return halved(FACTOR * np.abs(np.sum(velocity * normal, axis=-1)))


@pytest.fixture(autouse=True)
def a_session_of_its_own(monkeypatch, tmp_path):
    monkeypatch.setattr(sys.modules["course.workbook.recording"], "_session", [])
    monkeypatch.setattr(repairing, "found", {})
    monkeypatch.chdir(tmp_path)


def said(capsys):
    return re.sub(r"\s+", " ", capsys.readouterr().out)


def test_an_answer_is_taken_elsewhere_with_its_helpers_and_numbers():
    recipe = repairing.recipe_of(find_exercise("speed_along")[1], speed_along)
    assert "def halved" in recipe.prelude and "import numpy as np" in recipe.prelude
    assert recipe.values == {"FACTOR": 2.0}


def test_kind_and_line_are_told_and_the_change_is_left_to_the_hint(capsys):
    exercise = find_exercise("speed_along")[1]
    verdict = judge_here(exercise, speed_along)
    message = str(repairing.look_for_repair(inputs_of(exercise), speed_along, verdict))
    assert "abs() too many" in message and "return halved(" in message
    assert "becomes" not in message
    hint("speed_along")
    assert "becomes" in said(capsys)


def test_a_passed_answer_takes_an_earlier_repair_back():
    exercise = find_exercise("speed_along")[1]
    verdict = judge_here(exercise, speed_along)
    repairing.look_for_repair(inputs_of(exercise), speed_along, verdict)
    assert repairing.found
    right = judge_here(exercise, lambda v, n: np.sum(v * n, axis=-1))
    assert (
        right.passed
        and repairing.look_for_repair(inputs_of(exercise), None, right) is None
    )
    assert not repairing.found


def test_an_interrupt_ends_the_search_and_no_more(monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    exercise = find_exercise("speed_along")[1]
    verdict = judge_here(exercise, speed_along)
    monkeypatch.setattr("course.sandbox.repairing.repair_of", interrupted)
    assert repairing.look_for_repair(inputs_of(exercise), speed_along, verdict) is None


def test_a_check_in_a_notebook_tells_of_it_after_the_verdict(monkeypatch, capsys):
    monkeypatch.setattr(checking, "in_notebook", lambda: True)
    monkeypatch.setattr(checking, "borrowed_variables", lambda answer: ())
    check(speed_along)
    told = said(capsys)
    assert told.index("Not yet: speed_along") < told.index("One change makes")


@pytest.mark.parametrize("answer", [len, np.sum, lambda v, n: v])
def test_what_has_no_source_of_its_name_is_left_alone(answer):
    assert repairing.recipe_of(find_exercise("speed_along")[1], answer) is None


def test_half_a_search_is_said_to_be_one():
    from course.exercises.repair.changes import Step
    from course.exercises.repair.search import Repair

    repair = Repair((Step("a sign", "return -a", "-a", "a"),))
    assert "half its time" in str(
        repairing.repair_message("f", replace(repair, halved=True))
    )
    assert "half its time" not in str(repairing.repair_message("f", repair))


def test_what_a_repair_names_is_not_kept_as_unrecognised(monkeypatch, tmp_path):
    """Nor what its outcomes explain; what nothing names is."""
    kept = []
    monkeypatch.setattr(checking, "in_notebook", lambda: True)
    monkeypatch.setattr(checking, "borrowed_variables", lambda answer: ())
    record = sys.modules["course.workbook.recording"]
    monkeypatch.setattr(record, "record_unrecognised", lambda *a: kept.append(a))
    check(speed_along)
    check(_named(lambda v, n: [1.0] if np.sum(v * n, axis=-1) > 0 else 0.0))
    assert kept == []
    monkeypatch.setattr(checking, "look_for_repair", lambda *_: None)
    check(speed_along)
    assert [name for name, *_ in kept] == ["speed_along"]


def _named(function):
    function.__name__ = "speed_along"
    return function
