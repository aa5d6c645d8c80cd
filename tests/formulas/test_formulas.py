"""What every formula keeps to: one an exercise, short, with its source, and the same
lines in the solution's cell. What the house says of them: table, names, slides."""

import ast
import inspect
import json
import re
import textwrap
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
from course.workbook.syllabus import read_syllabus

ROOT = Path(__file__).resolve().parents[2]
EXERCISES = [(le, e) for le in all_lessons() for e in le.exercises]
each = pytest.mark.parametrize("lesson, exercise", EXERCISES, ids=lambda x: x.name)
#: Of lessons that are there; a formula may come before its lesson.
MODULES = [
    path
    for path in sorted((ROOT / "course" / "formulas").glob("[a-z]*.py"))
    if path.stem[7:9] in {le.number for le in all_lessons()}
]
#: Formulas of the lecture that no exercise asks for.
BESIDE = {
    "bounding_box",
    "box_axes",
    "edge_normals",
    "point_in_sphere",
    "project",
    "separation_acceleration",
}
every = pytest.mark.parametrize("name", formulas.__all__)


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
    assert set(formulas.__all__) == {e.name for _, e in EXERCISES} | BESIDE
    assert len(formulas.__all__) == len(EXERCISES) + len(BESIDE)
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


@every
def test_is_short(name):
    """Lines of the function as it is written, the docstring counted as one and the
    imports in it not at all."""
    function = function_in(source_of(getattr(formulas, name)), name)
    assert ast.get_docstring(function)
    text = function.body[0]
    lines = function.end_lineno - (text.end_lineno - text.lineno)
    for node in function.body:
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            lines -= 2  # and the empty line after it
    stretch = name in {e.name for _, e in EXERCISES if e.level == "stretch"}
    assert 3 <= lines <= (30 if stretch else 25), lines


@every
def test_says_equation_slide_and_source(name):
    text = inspect.getdoc(getattr(formulas, name))
    assert "\nSource: " in text and "returns" in text
    assert "[" in text, "units"
    rows = {row for _, e in EXERCISES if e.name == name for row in e.rows}
    assert "syllabus row" in text and (set(rows_of(text)) & rows or name in BESIDE)


@pytest.mark.parametrize("path", MODULES, ids=lambda p: p.stem)
def test_module_has_the_name_and_the_title_of_its_lesson(path):
    """``from course.formulas import separation`` must never be ambiguous."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    held = {n.name for n in tree.body if isinstance(n, ast.FunctionDef)}
    both = [le for le in all_lessons() if le.number[:2] == path.stem[7:9]]
    lesson = both[0]
    assert held - BESIDE == {e.name for le in both for e in le.exercises}
    assert held <= set(formulas.__all__) and path.stem not in formulas.__all__
    definitions = ROOT / "course" / "exercises" / "definitions"
    assert [p for p in definitions.glob(f"{path.stem}*") if p.stem == path.stem]
    first = ast.get_docstring(tree).splitlines()[0]
    assert first.startswith(f"Lesson {lesson.number}, {lesson.title}: ")


def test_the_table_of_the_formulas_is_that_of_the_modules():
    said = inspect.getdoc(formulas)
    for path in MODULES:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        held = [n.name for n in tree.body if isinstance(n, ast.FunctionDef)]
        lesson = next(le for le in all_lessons() if le.number == path.stem[7:9])
        names = textwrap.fill(", ".join(held), 82, initial_indent="    ", subsequent_indent="    ")  # fmt: skip
        assert f"\n{path.stem} ({lesson.title})\n{names}\n" in said


def rows_of(text):
    """The rows of the syllabus that a text names, "15-17, 21 and 22" one by one."""
    found = []
    for some in re.findall(r"\brows?\s+(\d[\d\s,and-]*)", text):
        for first, last in re.findall(r"(\d+)(?:-(\d+))?", some):
            found += range(int(first), int(last or first) + 1)
    return found


SLIDE_OF = {row.number: row.slide for row in read_syllabus()}


def row_faults(text):
    """Where a text takes a row of the syllabus for a slide (from row 10 on it is the
    slide before), or names a row that is none."""
    said = re.findall(r"\bslides?\s+rows?\b|\brows?\s+of\s+the\s+slides?\b", text)
    for rows, slides in re.findall(r"\brows?\s+([\d-]+),\s+slides?\s+([\d-]+)", text):
        ends = zip(rows.split("-"), slides.split("-"), strict=True)
        said += [
            f"row {r} is not slide {s}" for r, s in ends if SLIDE_OF[int(r)] != int(s)
        ]
    return said


@pytest.mark.slow
def test_no_docstring_takes_a_row_for_a_slide():
    for path in sorted((ROOT / "course").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            kinds = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
            text = (isinstance(node, kinds) and ast.get_docstring(node)) or ""
            assert row_faults(text) == [], path
            if "yllabus row" in text:
                assert set(rows_of(text)) <= set(SLIDE_OF), path


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


@pytest.mark.parametrize(
    "text, count",
    [
        ("syllabus row 17, misprint 3", 0),
        ("row 17, slide 16", 0),
        ("rows 15-17, slides 14-16", 0),
        ("row 17, slide 17", 1),
        ("rows 15-17,\n  slides 14-17", 1),
        ("slide row 17", 1),
        ("slide\n  rows 17 and 18", 1),
    ],
)
def test_a_row_taken_for_a_slide_is_found(text, count):
    assert len(row_faults(text)) == count


def test_rows_are_counted_one_by_one():
    assert rows_of("rows 15-17, 21 and 22, misprint 3; row 9") == [*range(15, 18), 21, 22, 9]  # fmt: skip
