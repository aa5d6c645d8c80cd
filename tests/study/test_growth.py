"""Cost over the number of contacts: what is asked, what is left out, and the exponent."""

import numpy as np
import pytest

from course.contact import solve
from course.scenes import stack
from course.study import SolverGrowth, solver_growth

SYSTEMS = [stack(n, corners=1).system() for n in (2, 4, 8)]


def test_every_method_is_measured_up_to_its_limit():
    methods = {
        name: lambda s, name=name: solve(s, method=name) for name in ("nnls", "pivot")
    }
    found = solver_growth(SYSTEMS, methods, up_to={"pivot": 4}, repeats=1)
    assert found.contacts.tolist() == [2, 4, 8] and found.method == ("nnls", "pivot")
    assert np.all(np.isfinite(found.seconds[0])) and np.all(found.seconds[0] > 0)
    assert np.isnan(found.seconds[1, 2]) and np.all(np.isfinite(found.residual[1, :2]))
    assert found.steps[1, :2].tolist() == [2, 4]  # each box joins once
    assert np.nanmax(found.residual) <= 1e-10


def test_the_exponent_is_that_of_all_sizes():
    n = np.array([1.0, 10, 100, 1000])
    rows = np.stack([1e-3 * n**2, n, np.array([1.0, 1.0, 1.0, 10.0])])
    rows[0, 3] = np.nan  # not asked
    growth = SolverGrowth(n, ("square", "line", "late"), rows, rows, rows)
    assert growth.exponent("square") == pytest.approx(2) and growth.exponent(
        "line"
    ) == pytest.approx(1)
    # logarithms 0, 0, 0, 1 over 0, 1, 2, 3: least squares slope (sum of (x - 1.5) y) / 5 = 0.3
    assert growth.exponent("late") == pytest.approx(0.3)
    with pytest.raises(
        ValueError, match="^name: expected one of square, line, late; got 'cube'"
    ):
        growth.exponent("cube")
    rows[0, 1:] = np.nan
    with pytest.raises(ValueError, match="^name: expected"):
        growth.exponent("square")


def test_refusals():
    with pytest.raises(ValueError, match="^systems: expected at least one"):
        solver_growth([], {"nnls": solve})
    with pytest.raises(ValueError, match="^systems: expected ascending"):
        solver_growth(SYSTEMS[::-1], {"nnls": solve})
