"""Repair: which changes a source has, what is found with them, and that nothing is told which was not tried."""

import ast

import numpy as np
import pytest

from course.exercises.answer import call_all
from course.exercises.definition import find_exercise
from course.exercises.inputs import inputs_of
from course.exercises.repair.changes import ChangedSource
from course.exercises.repair.edits import Code, edits_of
from course.exercises.repair.recipe import expression_recipe
from course.exercises.repair.search import Search

HEAD = "def speed_along(velocity, normal):\n    return "
AXES = {"velocity": 1, "normal": 1}


class Here(ChangedSource):
    """Runs changed sources in this process: for sources that end."""

    def __init__(self, inputs, source, axes):
        super().__init__(Code(source, axes))
        self._inputs, self._source = inputs, source
        drawn = (inputs, *inputs.others)
        self.cases = [case.arguments for one in drawn for case in one.cases]

    def ran(self, source, cases):
        space = {"np": np}
        exec(source, space)
        question = self._inputs.question
        arguments = [self.cases[i] for i in cases]
        return call_all(space[question.name], arguments, question.results)

    def unchanged(self):
        return self.ran(self._source, range(len(self._inputs.cases)))

    def outcomes(self, numbers, cases, *, after=-1, left=False):
        return [self.ran(self.source(n, after), cases) for n in numbers]


def repair_of_source(name, source, axes, seconds=20.0, answer=Here):
    inputs = inputs_of(find_exercise(name)[1])
    answer = answer(inputs, source, axes)
    return Search(inputs, answer, seconds).find(answer.unchanged())


@pytest.mark.parametrize(
    ("wrong", "kind"),
    [
        ("np.abs(np.sum(velocity * normal, axis=-1))", "abs() too many"),
        ("2 * np.sum(velocity * normal, axis=-1)", "a factor too many"),
        ("np.sum(velocity * normal, axis=-1) + 1", "a term too many"),
        ("np.sum(velocity * normal)", "sum() without axis=-1"),
        ("np.sum(velocity * normal, axis=0)", "the axis"),
        ("np.sum(velocity + normal, axis=-1)", "+ where * belongs"),
        ("np.max(velocity * normal, axis=-1)", "max() where sum() belongs"),
        ("np.sum(velocity * velocity, axis=-1)", "another name"),
        ("-np.sum(velocity * normal, axis=-1)", "a sign"),
        ("velocity * normal", "* where a dot product belongs"),
    ],
)
def test_the_kind_of_a_slip_is_found(wrong, kind):
    repair = repair_of_source("speed_along", HEAD + wrong + "\n", AXES)
    assert [step.kind for step in repair.steps] == [kind]
    assert repair.steps[0].line == f"return {wrong}"


def test_two_slips_are_found_one_after_the_other():
    source = (
        "def momentum_after(momentum_1, momentum_2, impulse, normal):\n"
        "    push = np.asarray(impulse)[..., None] * normal\n"
        "    return momentum_1 + 3 * push, np.abs(momentum_2 - push)\n"
    )
    repair = repair_of_source("momentum_after", source, {})
    kinds = [step.kind for step in repair.steps]
    assert kinds == ["abs() too many", "a factor too many"]
    source = (
        "def bouncing_ball_step(height, velocity, step, restitution, gravity):\n"
        "    hit = (height < 0) & (velocity < 0)\n"
        "    new = np.where(hit, restitution * velocity, velocity + gravity * step)\n"
        "    return height + step * new, new\n"
    )
    axes = dict.fromkeys("height velocity step restitution gravity hit new".split(), 0)
    repair = repair_of_source("bouncing_ball_step", source, axes)
    assert len(repair.steps) == 2
    assert all("sign" in step.kind for step in repair.steps)


def test_nothing_is_found_for_what_no_small_change_makes_right():
    assert (
        repair_of_source("speed_along", HEAD + "np.cosh(velocity[..., 0])\n", AXES)
        is None
    )


def test_nothing_is_found_after_the_time_is_over():
    source = HEAD + "2 * np.sum(velocity * normal, axis=-1)\n"
    assert repair_of_source("speed_along", source, AXES, seconds=-1.0) is None


def test_a_change_that_only_the_notebooks_cases_allow_is_not_told():
    """The change passes the notebook's cases and is made to fail the first of another seed."""

    class WrongElsewhere(Here):
        def ran(self, source, cases):
            own = len(self._inputs.cases)
            assert len(self.cases) > own
            came = super().ran(source, cases)
            spoilt = call_all(lambda v, n: np.float64(np.nan), [self.cases[own]], 1)[0]
            return [spoilt if i >= own else o for i, o in zip(cases, came, strict=True)]

    source = HEAD + "2 * np.sum(velocity * normal, axis=-1)\n"
    assert repair_of_source("speed_along", source, AXES, 5.0) is not None
    assert (
        repair_of_source("speed_along", source, AXES, 5.0, answer=WrongElsewhere)
        is None
    )


@pytest.mark.parametrize(
    "source",
    [
        "def f(a, b):\n    return (a +  # é\n        b) * a\n",
        "def f(a, b):\n    for i in range(3):\n        a += b[i]\n    return a\n",
        "def f(a, b):\n    x_a = a + b\n    x_b = a - b\n    if a < 0 and b > 1:\n"
        "        return x_a, x_b\n    return f'{a}', [a, b]\n",
        "def f(a, b):\n    g = lambda x: np.sum(x ** 2, axis=-1) / b\n    return g(a) if b > 0 else -g(b)\n",
    ],
)
def test_every_change_is_python_and_a_change(source):
    edits = edits_of(Code(source))
    changed = [e.applied(source) for e in edits]
    assert len(edits) > 30 and len({e.patches for e in edits}) == len(edits)
    for text in changed:
        assert ast.dump(ast.parse(text)) and text != source


def test_an_expression_becomes_a_function_of_numbers():
    cell = 'h, e, g = sp.symbols("h e g")\nt_0 = sp.sqrt(2 * h / g)\nrest_time = t_0 * (\n    1 + e\n)\n'
    recipe = expression_recipe(cell, "rest_time", ["h", "e", "g"])
    space = {}
    exec(recipe.prelude + recipe.source, space)
    assert space["rest_time"](2.0, 0.5, 1.0) == 3.0
    assert expression_recipe("rest_time = ", "rest_time", ["h"]) is None
