"""A rod by three formulas is the rod of the library; a wrong one is seen at the point that was hit."""

from __future__ import annotations

import numpy as np
import pytest

from course.study import rod_landing
from course.study.asked_rods import asked_rod


@pytest.mark.parametrize("case", [(0.0, 1.0, 1.0), (30.0, 0.5, -0.6), (60.0, 0.0, 0.3)])
def test_it_lands_as_the_library_has_it(case):
    mine, truth = asked_rod(*case), rod_landing(*case)
    for name in ("axis", "before", "after", "spin", "impulse", "felt", "kept"):
        np.testing.assert_allclose(
            getattr(mine, name), getattr(truth, name), atol=1e-12
        )


def test_without_spin_in_the_mass_it_leaves_faster_than_it_came():
    wrong = asked_rod(0.0, 1.0, 1.0, effective_mass=lambda m, *rest: 1 / m)
    assert wrong.impulse == pytest.approx(2.0)
    # The end: -1 + p (1/m + (l/2)^2/I) = -1 + 2 * 4.
    assert wrong.after[2, 2] == pytest.approx(7.0)
    assert wrong.kept > 1
