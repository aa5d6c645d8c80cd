"""What counts as an answer at all: blanks, arguments in another order, expressions that cannot be evaluated."""

import json
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

from course.exercises.answer import as_function, call
from course.exercises.expressions import evaluator
from course.exercises.source import is_blank
from course.workbook.building import blank

SOLUTIONS = sorted((Path(__file__).resolve().parents[2] / "solutions").glob("*.ipynb"))


@pytest.mark.parametrize(
    "source",
    [
        "def f(x):\n    ...",
        'def f(x):\n    """Words with ... in them."""\n    ...',
        "def f(x):\n    y = 2 * x\n    ...",
        "def f(x):\n    y = ...\n    return np.where(y > 0, y, 0)",
        "def f(x):\n    y: float = ...\n    return y",
        "def f(x):\n    return ...",
        "def f(x):\n    if x > 0:\n        ...",
        "def f(x):\n    return x\ndef f(x):\n    ...",
        "f = ...",
        "f = (\n    ...\n)",
    ],
)
def test_blanks(source):
    assert is_blank(source, "f")


@pytest.mark.parametrize(
    "source",
    [
        "def f(x):\n    return x[..., None]",
        'def f(x):\n    """..."""\n    return x',
        "def f(x: tuple[float, ...]) -> tuple[float, ...]:\n    y: tuple[float, ...] = x\n    return y",
        "def f(x):\n    return x\n    ...",
        "def f(x):\n    ...\n    return x",
        "def f(x):\n    def helper(y): ...\n    return x",
        "def f(x):\n    try:\n        return 1 / x\n    except ZeroDivisionError:\n        ...\n    return 0.0",
        "def f(x):\n    ...\ndef f(x):\n    return x",
        "def f(x):\n    return x\nclass Other:\n    def f(self): ...",
        "def f(x):\n    return x\ndef g(x):\n    f = ...",
        "f = lambda x: x",
        "def f(x):\n    pass",
    ],
)
def test_answers_that_are_no_blanks(source):
    assert not is_blank(source, "f")


@pytest.mark.parametrize("path", SOLUTIONS, ids=lambda p: p.stem)
def test_every_exercise_is_a_blank_as_handed_out_and_none_as_solved(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    told = [(c["metadata"]["course"]["exercise"], "".join(c["source"])) for c in cells
            if "exercise" in c["metadata"].get("course", {})]  # fmt: skip
    assert told
    for name, source in told:
        assert not is_blank(source, name) and is_blank(blank(source), name), name


def test_arguments_in_another_order_are_told():
    with pytest.raises(
        TypeError, match=r"in the order f\(a, b\); yours takes \(b, a\)"
    ):
        as_function(lambda b, a: a, "function", "f", ["a", "b"])
    assert as_function(lambda x, y: x, "function", "f", ["a", "b"])(1, 2) == 1


@pytest.mark.parametrize(
    ("expression", "words"),
    [
        (None, "expected a SymPy expression; got NoneType"),
        (np.zeros(3), "expected a SymPy expression; got ndarray"),
        (sp.Matrix([1]), "expected a SymPy expression; got"),
        (sp.Tuple(1, 2), "expected a SymPy expression; got Tuple"),
        (sp.Symbol("a") > 1, "got an equation"),
        (sp.true, "got an equation"),
        (sp.zoo, "divided by zero"),
        (1 / sp.Integer(0), "divided by zero"),
        (sp.Function("p")(sp.Symbol("a")), r"yours also contains p\(a\)"),
        (sp.Integral(sp.Symbol("a"), (sp.Symbol("a"), 0, 1)), "still to be worked out"),
        (sp.Derivative(sp.Symbol("a") ** 2, sp.Symbol("a")), "still to be worked out"),
        ([sp.Symbol("a")], "take its entry"),
    ],
)
def test_what_is_no_expression_is_told(expression, words):
    with pytest.raises((TypeError, ValueError), match=words):
        as_function(expression, "expression", "p_hat", ["a"])


def test_expressions_with_choices_are_evaluated_over_a_batch():
    a = sp.Symbol("a", real=True)
    points = np.array([-2.0, 3.0])
    for expression in (
        sp.Max(0, a),
        sp.Piecewise((a, a > 0), (0, True)),
        (a + sp.Abs(a)) / 2,
    ):
        np.testing.assert_array_equal(
            as_function(expression, "expression", "x", ["a"])(points), [0.0, 3.0]
        )
    np.testing.assert_array_equal(
        as_function(sp.Integer(4), "expression", "x", ["a"])(points), [4.0, 4.0]
    )


@pytest.mark.parametrize("start", (0, 1))
def test_a_sum_to_infinity_that_sympy_has_done_is_an_answer(start):
    """SymPy gives it in two branches; the one that does not converge has the sum itself, to oo."""
    h, e, g = sp.symbols("h e g", positive=True)
    k = sp.symbols("k", integer=True)
    fall = sp.sqrt(2 * h / g)
    rises = sp.summation(2 * fall * e**k, (k, start, sp.oo))
    answer = evaluator(fall + rises, ("h", "e", "g"))
    wanted = np.sqrt(2 * 3.0 / 9.81) * (1 + 2 * 0.5**start / (1 - 0.5))
    np.testing.assert_allclose(answer(3.0, np.array([0.5, 0.5]), 9.81), wanted)
    assert np.isnan(answer(3.0, 1.5, 9.81))


@pytest.mark.parametrize("endless", (sp.oo, -sp.oo, sp.zoo, sp.nan))
def test_an_expression_that_is_infinite_everywhere_is_none(endless):
    with pytest.raises(ValueError, match="finite"):
        evaluator(endless + sp.Symbol("h"), ("h",))


def test_a_symbol_in_the_place_of_a_number_is_told_by_its_name():
    e = sp.Symbol("e")
    outcome = call(lambda v: np.asarray(v) * e, {"v": np.ones(3)}, 1)
    assert outcome.kind == "unreadable"
    assert "SymPy expression in e" in outcome.text
