"""Packages that take seconds to load are loaded before an answer's clock starts, and only for answers that use them."""

import numpy as np
import pytest

from course.grading.limits import Limits
from course.grading.needed import modules_used
from course.grading.sandbox import Job, run_job

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
@pytest.mark.parametrize("word", ["cp", "np"])
def test_what_an_answer_uses_is_loaded_before_its_clock_starts(word):
    answer = (
        "import sys\nloaded = 'cvxpy' in sys.modules\n"
        f"def f(b):\n    own = {word}\n    return [1.0 if loaded else 0.0, float(b[0])]"
    )
    job = Job(
        ((IMPORTS, True), (answer, False)),
        "f",
        "function",
        ("b",),
        1,
        ({"b": np.array([-1.0, 2.0])},),
    )
    run = run_job(job, Limits(seconds=8.0))
    assert run.end == "replied", run
    assert run.reply.outcomes[0].values[0].tolist() == [
        1.0 if word == "cp" else 0.0,
        -1.0,
    ]


@pytest.mark.slow
def test_a_programme_is_solved_within_the_limits():
    answer = (
        "def f(b):\n    x = cp.Variable(2)\n"
        "    cp.Problem(cp.Minimize(cp.sum_squares(x) / 2 + b @ x), [x >= 0]).solve(solver=cp.CLARABEL)\n"
        "    return x.value"
    )
    job = Job(
        ((IMPORTS, True), (answer, False)),
        "f",
        "function",
        ("b",),
        1,
        ({"b": np.array([-1.0, 2.0])},),
    )
    run = run_job(job, Limits())
    assert run.end == "replied", run
    assert run.reply.outcomes[0].kind == "value", run.reply.outcomes[0].text
    np.testing.assert_allclose(run.reply.outcomes[0].values[0], [1.0, 0.0], atol=1e-6)
