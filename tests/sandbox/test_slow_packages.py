"""Packages that take seconds to load are loaded before an answer's clock starts, and only for answers that use them."""

import numpy as np
import pytest
from sandbox.runs import EITHER_WAY, run

from course.exercises.source import modules_used

IMPORTS = "import cvxpy as cp\nimport numpy as np"


@pytest.mark.parametrize(
    ("answers", "found"),
    [
        (["def f(b):\n    return cp.Variable(2)"], ("cvxpy",)),
        (["def f(b):\n    return np.sum(b)"], ()),
        (["def f(b):\n    import cvxpy\n    return cvxpy.Variable(2)"], ("cvxpy",)),
        (["from cvxpy import Variable\nf = lambda b: Variable(2)"], ("cvxpy",)),
        (
            [
                "def helper(b):\n    return cp.Variable(2)",
                "def f(b):\n    return helper(b)",
            ],
            ("cvxpy",),
        ),
        (["def f(b):\n    return 'cp'"], ()),
        (["def f(b:\n"], ()),
        ([], ()),
    ],
)
def test_what_answers_use_is_told_from_their_cells(answers, found):
    assert modules_used([IMPORTS], answers, frozenset({"cvxpy"})) == found


@pytest.mark.slow
@EITHER_WAY
@pytest.mark.parametrize("word", ["cp", "np"])
def test_what_an_answer_uses_is_loaded_before_its_clock_starts(word, boxed):
    answer = (
        "import sys\nloaded = 'cvxpy' in sys.modules\n"
        f"def f(b):\n    own = {word}\n    return [1.0 if loaded else 0.0, float(b[0])]"
    )
    case = {"b": np.array([-1.0, 2.0])}
    told = run(IMPORTS, answer, case=case, seconds=8.0, boxed=boxed)
    assert told.end == "replied", told
    used = 1.0 if word == "cp" else 0.0
    assert told.reply.answer.outcomes[0].values[0].tolist() == [used, -1.0]


@pytest.mark.slow
@EITHER_WAY
def test_a_programme_is_solved_within_the_limits(boxed):
    answer = (
        "def f(b):\n    x = cp.Variable(2)\n"
        "    cp.Problem(cp.Minimize(cp.sum_squares(x) / 2 + b @ x), [x >= 0]).solve(solver=cp.CLARABEL)\n"
        "    return x.value"
    )
    case = {"b": np.array([-1.0, 2.0])}
    told = run(IMPORTS, answer, case=case, seconds=10.0, boxed=boxed)
    assert told.end == "replied", told
    assert told.reply.answer.outcomes[0].kind == "value", told.reply.answer.outcomes[
        0
    ].text
    np.testing.assert_allclose(
        told.reply.answer.outcomes[0].values[0], [1.0, 0.0], atol=1e-6
    )
