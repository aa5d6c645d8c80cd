"""Which cells an answer needs is told from names alone."""

import pytest

from course.exercises.source import mentions, names_of, needed_cells

CELLS = (
    "import numpy as np",  # 0
    "import sympy as sp",  # 1
    "g = 9.81",  # 2
    "def helper(x):\n    return g * x",  # 3
    "while True:\n    pass",  # 4
    "def other(x):\n    return x",  # 5
)


@pytest.mark.parametrize(
    "wanted, expected",
    [
        ("def f(x):\n    return x", ()),
        ("def f(x):\n    return np.sum(x)", (0,)),
        ("def f(x):\n    return helper(x)", (2, 3)),
        ("def f(x):\n    g = 1\n    return g", ()),
        ("def f(x):\n    global g\n    g = 1\n    return x", ()),
        ("def f(x):\n    global g\n    g += 1\n    return x", (2,)),
        ("def f(x, y=g):\n    return lambda: np.dot(x, other(y))", (0, 2, 5)),
        ("class A:\n    h = helper\ndef f(x):\n    return A().h(x)", (2, 3)),
        ("area = sp.Symbol('a')", (1,)),
        ("def f(x):\n    return eval('helper(x)')", (0, 1, 2, 3, 4, 5)),
        ("[helper(i) for i in range(3)]", (2, 3)),
        ("def f(x:", ()),
    ],
)
def test_needed(wanted, expected):
    assert needed_cells(CELLS, wanted) == expected


def test_a_cell_that_imports_everything_is_kept():
    assert needed_cells(
        ("from numpy import *", "x = 1"), "def f(y):\n    return sum(y)"
    ) == (0,)


def test_names_of_a_cell():
    bound, used = names_of(
        "import a.b as c\nd, (e, *f) = g\nfor h in i:\n    j += 1\ndef k(l=m):\n    return n(l)"
    )
    assert bound == {"c", "d", "e", "f", "h", "j", "k"}
    assert {"g", "i", "j", "m", "n"} <= used and "l" not in used


@pytest.mark.parametrize(
    "source",
    [
        "class f:\n    pass",
        "def make():\n    global f\n    f = 1",
        "if a:\n    f = 1",
        "print(f := 1)",
        "from h import g as f",
        "f, *rest = 1, 2",
        "check(g, 'f')",
        "check(g, name='f')",
        "globals()['f'] = 1",
        "exec('def f(x): return x')",
        "exec('f = 1')",
        "class A:\n    def f(self):\n        pass",
        "check(module.f)",
        "%%capture\nf = 1\nnot python",
    ],
)
def test_cells_that_may_make_an_answer_in_ways_no_definition_shows(source):
    assert mentions(source, "f")


@pytest.mark.parametrize(
    "source", ["f(1)", "f = use(f)", "check(f)", "print('of f')", "g = 1", "for_f = 2"]
)
def test_cells_that_only_use_an_answer(source):
    assert not mentions(source, "f")
