"""What is said of a wrong answer's source: it is so, and it is said where it helps."""

import linecache
import sys

import numpy as np
import pytest
import sympy as sp

from course import formulas
from course.exercises.definition import all_lessons, find_exercise
from course.workbook import check, facts

EXERCISES = [e for lesson in all_lessons() for e in lesson.exercises]


@pytest.fixture(autouse=True)
def a_session_of_its_own(monkeypatch, tmp_path):
    monkeypatch.setattr(sys.modules["course.workbook.recording"], "_session", [])
    monkeypatch.chdir(tmp_path)


def written(source: str, name: str, **values):
    """A function as a notebook's cell leaves it behind."""
    file = f"<ipython-input-{name}>"
    linecache.cache[file] = (len(source), None, source.splitlines(keepends=True), file)
    space = {"np": np, "__name__": "__main__", **values}
    exec(compile(source, file, "exec"), space)
    return space[name]


def told(capsys, answer, *name) -> str:
    check(answer, *name)
    return " ".join(capsys.readouterr().out.split())


def test_an_argument_that_is_never_read_is_named(capsys):
    source = "def speed_along(velocity, normal):\n    return velocity[..., 2]\n"
    assert "It never uses normal." in told(capsys, written(source, "speed_along"))


@pytest.mark.parametrize(
    "body",
    [
        "return np.sum(velocity * normal, axis=0)",
        "normal += 0\n    return velocity[..., 2]",
        "return (lambda: normal[..., 2])()",
        "return eval('normal')[..., 2]",
    ],
)
def test_what_is_read_in_some_way_is_not_named(body):
    source = f"def speed_along(velocity, normal):\n    {body}\n"
    assert "normal" not in facts.unused_arguments(written(source, "speed_along"))


def test_a_symbol_that_is_not_there_is_named_and_one_that_drops_out_is_not(capsys):
    m, v, theta, e = sp.symbols("m v theta e")
    answer = (1 + e) * m * v**2
    assert "theta does not occur in it." in told(capsys, answer, "rod_impulse")
    rod = find_exercise("rod_impulse")[1]
    assert facts.lacking_symbols(rod, answer * theta) == ()  # ell is not needed


def test_every_formula_reads_what_it_is_given():
    for exercise in EXERCISES:
        if exercise.kind == "function":
            formula = getattr(formulas, exercise.name)
            assert facts.unused_arguments(formula) == (), exercise.name


def test_a_variable_that_a_helper_takes_is_told(capsys):
    source = (
        "def scaled(x):\n    return FACTOR * x\n"
        "def speed_along(velocity, normal):\n"
        "    return scaled(np.sum(velocity * normal, axis=-1))\n"
    )
    answer = written(source, "speed_along", FACTOR=2.0)
    assert "It takes FACTOR, a variable of the notebook" in told(capsys, answer)
    assert facts.borrowed_variables(answer) == ()


def test_a_call_without_axis_is_told_where_only_batches_are_wrong(capsys):
    source = "def speed_along(velocity, normal):\n    return np.max(velocity) * {}\n"
    of_one = source.format("0 + np.sum(velocity * normal)").replace(
        "np.max(velocity) *", ""
    )
    answer = written(
        "def rotate(v, theta):\n"
        "    angle = np.linalg.norm(theta)\n"
        "    if angle == 0:\n        return v\n"
        "    u = theta / angle\n"
        "    along = np.sum(u * v, axis=-1, keepdims=True)\n"
        "    c, s = np.cos(angle), np.sin(angle)\n"
        "    return c * v + s * np.cross(u, v) + (1 - c) * along * u\n",
        "rotate",
    )
    said = told(capsys, answer)
    assert "Right for one" in said and "np.linalg.norm(theta) has no axis" in said
    assert "np.sum(u * v" not in said
    assert "has no axis" not in told(
        capsys, written(source.format("normal"), "speed_along")
    )
    assert facts._of_missing_axes(written(of_one, "speed_along"))


def test_the_line_of_the_first_nan_is_told(capsys):
    source = (
        "def linear_kinetic_energy(p, v):\n"
        "    half = 0.5\n"
        "    m = p / v\n"
        "    return half * np.sum(m * v**2, axis=-1)\n"
    )
    said = told(capsys, written(source, "linear_kinetic_energy"))
    assert "The first NaN is there after the line m = p / v" in said
    assert sys.gettrace() is None
    returned = "def f(x):\n    return x / x\n"
    assert facts.first_nan(written(returned, "f"), {"x": np.zeros(2)}) == "return x / x"
    assert facts.first_nan(written(returned, "f"), {"x": np.ones(2)}) == ""
