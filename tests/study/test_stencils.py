"""Difference quotients: the order they say, and a least error between truncation and rounding."""

import numpy as np
import pytest

from course.contact import separation_rate
from course.scenes import (
    bar_over_plank,
)
from course.study import (
    CENTRAL,
    FIVE_POINTS,
    FORWARD,
    SECOND,
    SECOND_FIVE,
    difference_errors,
)


@pytest.mark.parametrize(
    "stencil",
    [FORWARD, CENTRAL, FIVE_POINTS, SECOND, SECOND_FIVE],
    ids=lambda s: s.name,
)
def test_stencils_have_the_order_they_say(stencil):
    """On exp at 0, whose derivatives are all 1; halving a step that is large against rounding."""
    errors = [abs(stencil.difference(np.exp, 0.0, h) - 1) for h in (0.2, 0.1)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(stencil.order, abs=0.1)


def test_error_of_differences_is_a_v():
    pair, steps = bar_over_plank(), 10.0 ** np.arange(-12, -0.5, 0.5)
    exact = separation_rate(pair.at(0.1), pair.touching(pair.at(0.1)))[0]
    found = difference_errors(
        [(s, pair.gap) for s in (FORWARD, CENTRAL, FIVE_POINTS)], exact, steps, time=0.1
    )
    for name, largest in (
        ("one-sided", 1e-7),
        ("central", 1e-9),
        ("five points", 1e-11),
    ):
        step, error = found.best(name)
        assert error < largest and steps[0] < step < steps[-1]
        assert found.error[name][0] > 100 * error < found.error[name][-1]
    with pytest.raises(ValueError, match="name"):
        found.best("six points")
    with pytest.raises(ValueError, match="steps"):
        difference_errors([(FORWARD, pair.gap)], exact, [0.0])
