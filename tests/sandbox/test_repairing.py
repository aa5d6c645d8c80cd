"""The child that tries repairs: it finds what is there, and neither memory, time, files nor a crash get past it."""

import sys

import numpy as np
import pytest

from course.exercises.answer import call_all
from course.exercises.definition import find_exercise
from course.exercises.inputs import inputs_of
from course.exercises.repair.explanation import repair_parts
from course.exercises.repair.recipe import Recipe, expression_recipe
from course.exercises.verdict import judge
from course.sandbox import repairing

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

NAME = "speed_along"
RIGHT = "np.sum(velocity * normal, axis=-1)"


def source(value, before=""):
    return f"def speed_along(velocity, normal):\n{before}    return {value}\n"


def outcomes_of(text):
    return verdict_of(text).outcomes


def verdict_of(text):
    exercise = find_exercise(NAME)[1]
    space = {"np": np}
    exec(text, space)
    cases = exercise.draw()
    came = call_all(space[NAME], [c.arguments for c in cases], 1)
    return judge(exercise, cases, came)


def repair(text, outcomes=None, prelude="import numpy as np", seconds=4.0):
    exercise = find_exercise(NAME)[1]
    outcomes = outcomes_of(text) if outcomes is None else outcomes
    return repairing.repair_of(
        inputs_of(exercise), Recipe(text, prelude), outcomes, seconds
    )


def test_the_child_is_kept_warm():
    assert repair(source(f"2 * {RIGHT}")).steps[0].kind == "a factor too many"
    child = repairing._child
    assert repair(source(f"np.abs({RIGHT})")).steps[0].kind == "abs() too many"
    assert repairing._child is child


def test_nothing_is_told_where_the_source_does_something_else_there():
    text = source(f"2 * {RIGHT}")
    assert repair(text, outcomes_of(source(f"3 * {RIGHT}"))) is None


def test_nothing_is_told_where_the_prelude_fails():
    assert repair(source(f"2 * {RIGHT}"), prelude="import nothing_of_this_name") is None


def test_an_endless_loop_costs_its_time_and_no_more():
    before = "    n = 0\n    while n < 3:\n        n += 1\n"
    assert repair(source(f"n * {RIGHT}", before)) is not None


@pytest.mark.skipif(sys.platform != "linux", reason="memory is capped on Linux")
def test_memory_is_capped():
    text = source(f"2 * {RIGHT}", "    np.ones(10**4)\n")
    assert repair(text).steps[0].kind == "a factor too many"
    assert not repairing._child.watched
    hungry = "    block = np.ones((1, 4 * 10**8))[:, :1]\n"
    outcomes = outcomes_of(source(f"2 * {RIGHT}"))
    assert repair(source(f"2 * {RIGHT}", hungry), outcomes) is None


@pytest.mark.skipif(sys.platform == "win32", reason="ps tells the memory")
def test_memory_that_cannot_be_capped_is_watched(monkeypatch):
    """As on macOS: the child is ended from here while it grows, long before its cap."""
    monkeypatch.setattr(repairing, "_child", None)
    text = source(f"2 * {RIGHT}")
    outcomes = outcomes_of(text)
    child = repairing.Child(watched=True, memory_mb=400)
    inputs, prelude = inputs_of(find_exercise(NAME)[1]), "import numpy as np"
    grows = "    import time\n    block = np.ones(10**8)\n    time.sleep(4.0)\n"
    hungry = Recipe(source(f"2 * {RIGHT}", grows), prelude)
    assert repairing.repair_of(inputs, hungry, outcomes, child=child) is None
    assert child.ended_by_watch and child._process.returncode == -9
    modest = repairing.Child(watched=True, memory_mb=400)
    found = repairing.repair_of(inputs, Recipe(text, prelude), outcomes, child=modest)
    assert found.halved and not modest.ended_by_watch
    assert "only watched" in repair_parts(found)[-1].text
    modest.close()


@pytest.mark.parametrize("watched, budget", [(False, 4.0), (True, 2.0)])
def test_a_search_that_is_only_watched_has_half_its_time(monkeypatch, watched, budget):
    given = []

    class Stub:
        ask = None

    stub = Stub()
    stub.watched = watched
    monkeypatch.setattr(repairing, "_child", stub)
    monkeypatch.setattr(repairing, "search", lambda *a: given.append(a[-1]))
    repair(source(f"2 * {RIGHT}"))
    assert given == [budget]


def test_a_crash_ends_the_search_and_the_next_one_has_a_new_child():
    crash = "    import os\n    os._exit(1)\n"
    outcomes = outcomes_of(source(f"2 * {RIGHT}"))
    assert repair(source(f"2 * {RIGHT}", crash), outcomes) is None
    assert repair(source(f"2 * {RIGHT}")) is not None


def test_files_cannot_be_written(tmp_path):
    place = tmp_path / "written"
    writes = f"    open({str(place)!r}, 'w').close()\n"
    outcomes = outcomes_of(source(f"2 * {RIGHT}"))
    assert repair(source(f"2 * {RIGHT}", writes), outcomes) is None
    assert not place.exists()


def test_an_answer_whose_outcomes_say_what_is_wrong_is_not_searched():
    """Inputs written to, an ``if`` on a batch: a small change that helps is not the cause."""
    assert verdict_of(source(f"2 * {RIGHT}")).unexplained
    assert not verdict_of(source(RIGHT, "    velocity *= 1.5\n")).unexplained
    batch = f"    if {RIGHT} > 0:\n        return 0.0\n"
    assert not verdict_of(source(RIGHT, batch)).unexplained
    assert not verdict_of(source(RIGHT)).unexplained


def test_an_expression_is_repaired():
    import sympy as sp

    exercise = find_exercise("rest_time")[1]
    names = [a.name for a in exercise.arguments]
    cell = f"{', '.join(names)} = sp.symbols('{' '.join(names)}')\n"
    h, e, g = names
    cell += f"rest_time = sp.sqrt(2 * {h} * {g}) * (1 + {e}) / (1 - {e})\n"
    from course.exercises.answer import as_function

    space = {"sp": sp}
    exec(cell, space)
    function = as_function(space["rest_time"], "expression", "rest_time", names)
    outcomes = call_all(function, [c.arguments for c in exercise.draw()], 1)
    recipe = expression_recipe(cell, "rest_time", names)
    found = repairing.repair_of(inputs_of(exercise), recipe, outcomes)
    assert found.steps[0].kind == "* where / belongs"
