"""What every formula keeps to: one an exercise, short, with its source, and the same
lines in the solution's cell."""

import ast
import inspect
import json
from pathlib import Path

import numpy as np
import pytest

from course import formulas
from course.exercises.answer import call_all
from course.exercises.comparison import same
from course.exercises.definition import all_lessons
from course.exercises.expressions import evaluator
from course.exercises.formula_source import own_statements, source_of
from course.exercises.inputs import answers_of

ROOT = Path(__file__).resolve().parents[2]
EXERCISES = [(le, e) for le in all_lessons() for e in le.exercises]
each = pytest.mark.parametrize("lesson, exercise", EXERCISES, ids=lambda x: x.name)
MODULES = sorted((ROOT / "course" / "formulas").glob("[a-z]*.py"))


def solution_cell(lesson, exercise):
    path = ROOT / "solutions" / lesson.file_name
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["metadata"].get("course", {}).get("exercise") == exercise.name:
            return "".join(cell["source"])
    raise AssertionError(f"{path.name} has no cell for {exercise.name}")


def bare(function):
    """The statements of a function as a tree in words, without docstring, annotations
    and imports."""
    for node in ast.walk(function):
        if isinstance(node, (ast.FunctionDef, ast.Lambda)):
            for name in ast.walk(node.args):
                if isinstance(name, ast.arg):
                    name.annotation = None
            if isinstance(node, ast.FunctionDef):
                node.returns = None
    names = [argument.arg for argument in function.args.args]
    return names, [ast.dump(statement) for statement in own_statements(function.body)]


def function_in(source, name):
    return next(
        node
        for node in ast.parse(source).body
        if isinstance(node, ast.FunctionDef) and node.name == name
    )


def test_formulas_are_those_of_the_exercises():
    assert sorted(formulas.__all__) == sorted(e.name for _, e in EXERCISES)
    for _, exercise in EXERCISES:
        assert exercise.reference is getattr(formulas, exercise.name)


@each
def test_arguments_are_the_declared_ones(lesson, exercise):
    names = list(inspect.signature(exercise.reference).parameters)
    assert names == [a.name for a in exercise.arguments]


@each
def test_solution_cell_holds_the_same_lines(lesson, exercise):
    cell = solution_cell(lesson, exercise)
    if exercise.kind == "function":
        mine = bare(function_in(source_of(exercise.reference), exercise.name))
        assert bare(function_in(cell, exercise.name)) == mine


@each
def test_solution_expression_has_the_same_values(lesson, exercise):
    if exercise.kind == "function":
        return
    import sympy as sp

    names, space = [a.name for a in exercise.arguments], {"sp": sp}
    exec(cell_without_check(solution_cell(lesson, exercise)), space)
    cases = exercise.draw(5)
    theirs = call_all(
        evaluator(space[exercise.name], names), [c.arguments for c in cases], 1
    )
    mine = answers_of(exercise.reference, exercise, cases)
    for one, other in zip(mine, theirs, strict=True):
        assert one.kind == other.kind == "value"
        assert same(exercise.results, one.values, other.values)


def cell_without_check(cell):
    return "\n".join(x for x in cell.splitlines() if not x.startswith("check("))


@each
def test_is_short(lesson, exercise):
    """Lines of the function as it is written, the docstring counted as one and the
    imports in it not at all."""
    function = function_in(source_of(exercise.reference), exercise.name)
    assert ast.get_docstring(function)
    text = function.body[0]
    lines = function.end_lineno - (text.end_lineno - text.lineno)
    for node in function.body:
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            lines -= 2  # and the empty line after it
    assert 3 <= lines <= (30 if exercise.level == "stretch" else 25), lines


@each
def test_says_equation_slide_and_source(lesson, exercise):
    text = inspect.getdoc(exercise.reference)
    assert "slide row" in text and "\nSource: " in text and "returns" in text
    assert "[" in text, "units"


@pytest.mark.parametrize("path", MODULES, ids=lambda p: p.stem)
def test_module_is_no_function_s_name(path):
    """``from course.formulas import wall_bounce`` must never be ambiguous."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    held = [n.name for n in tree.body if isinstance(n, ast.FunctionDef)]
    assert held and path.stem not in formulas.__all__
    assert set(held) <= set(formulas.__all__)
    lesson = next(
        le for le in all_lessons() if held[0] in [e.name for e in le.exercises]
    )
    assert sorted(held) == sorted(e.name for e in lesson.exercises)


@pytest.mark.parametrize(
    "exercise", [e for _, e in EXERCISES if e.sample], ids=lambda e: e.name
)
def test_samples_have_the_shapes_of_the_formula(exercise):
    cases = exercise.draw(3)
    shown = answers_of(exercise.sample, exercise, cases)
    found = answers_of(exercise.reference, exercise, cases)
    for one, other in zip(shown, found, strict=True):
        assert one.kind == other.kind == "value"
        assert [np.shape(v) for v in one.values] == [np.shape(v) for v in other.values]


# The tests above must be able to fail.


def test_trees_are_compared_without_what_does_not_count():
    plain = "def f(x, y):\n    return x + y"
    dressed = (
        'def f(x: int, y) -> int:\n    """Words."""\n    import os\n\n    return x + y'
    )
    one, other = (bare(function_in(source, "f")) for source in (plain, dressed))
    assert one == other
    for wrong in (plain.replace("+", "-"), plain.replace("x, y)", "y, x)")):
        assert bare(function_in(wrong, "f")) != one
