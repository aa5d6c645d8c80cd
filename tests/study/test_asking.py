"""What somebody's own function gives is looked at before it moves anything."""

from __future__ import annotations

import numpy as np
import pytest

from course.study.asking import UnusableResult, asked, one_number


def test_results_come_as_arrays_and_arguments_are_copies():
    given = np.ones(3)

    def spoils(x, inner):
        x += 1
        inner[0][0] = 7
        return [2, 0, 1], 5

    vector, number = asked(spoils, ((3,), ()), given, (given,))
    assert vector.tolist() == [2.0, 0.0, 1.0] and number == 5.0
    assert given.tolist() == [1.0, 1.0, 1.0]


@pytest.mark.parametrize(
    ("result", "said"),
    [
        (None, "it returned nothing: is there a `return`?"),
        (np.ones(2), "it returned shape (2,) in place of shape (3,)"),
        ("three", "it returned no numbers, but str"),
        ([1, np.nan, 0], "it returned NaN"),
        ([1, np.inf, 0], "it returned infinity"),
    ],
)
def test_what_cannot_be_used_is_said(result, said):
    with pytest.raises(UnusableResult) as caught:
        asked(lambda: result, ((3,),))
    assert str(caught.value) == said


def test_a_missing_result_and_one_number():
    with pytest.raises(UnusableResult, match="it returned 3 in place of 2 results"):
        asked(lambda: (1, 2, 3), ((), ()))
    assert one_number(lambda: np.array([[4.0]])) == 4.0


def test_a_time_may_be_never_and_nothing_else():
    assert asked(lambda: np.inf, [()], never=True)[0] == np.inf
    for bad, said in ((-np.inf, "infinity"), (np.nan, "NaN")):
        with pytest.raises(UnusableResult, match=f"it returned {said}"):
            asked(lambda bad=bad: [1.0, bad], [(2,)], never=True)
