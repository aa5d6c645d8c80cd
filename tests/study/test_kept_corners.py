"""What a limit of contacts leaves of a face, against enumeration of all choices of corners."""

from itertools import combinations

import numpy as np
import pytest
from lesson_text import rounds_to, said

from course.study import kept_support, largest_share


def spanned(sides, chosen):
    angle = 2 * np.pi * np.array(chosen) / sides
    x, y = np.cos(angle), np.sin(angle)
    return 0.5 * np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))


@pytest.mark.parametrize("sides", range(3, 11))
def test_no_choice_of_corners_spans_more(sides):
    whole = spanned(sides, range(sides))
    for kept in range(3, sides + 1):
        best = max(spanned(sides, c) for c in combinations(range(sides), kept))
        found = largest_share(sides, [kept])[0]
        assert found == pytest.approx(best / whole, rel=1e-12)
        assert kept_support(sides, [kept])[0] <= found + 1e-12


def test_all_corners_are_kept_without_a_limit_that_binds():
    assert kept_support(8, [8, 9, 16]) == pytest.approx(1.0)


def test_an_octagon_with_four_corners_as_the_lesson_says():
    sentence = (
        "of an octagon span # percent of it, the square in it, $\\sqrt{1/2}$; "
        "of sixteen sides #"
    )
    eight, sixteen = said("05-more", sentence)
    assert rounds_to(100 * kept_support(8, [4])[0], eight)
    assert rounds_to(100 * kept_support(16, [4])[0], sixteen)
    assert kept_support(8, [4])[0] == pytest.approx(np.sqrt(0.5))


def test_with_three_the_farthest_corner_is_not_the_best_choice():
    """What the lesson says of its way of choosing; with four of eight it is."""
    assert kept_support(8, [3])[0] < 0.9 * largest_share(8, [3])[0]
    assert kept_support(8, [4])[0] == pytest.approx(largest_share(8, [4])[0])
