"""Numbers as text: the same on every processor, whichever way the last bit fell."""

import numpy as np
import pytest

from course.workbook import show


def neighbours(value):
    """A value and what another processor may make of it: a few units in the last place to either side."""
    values = [value]
    for direction in (-np.inf, np.inf):
        near = value
        for _ in range(4):
            near = np.nextafter(near, direction)
            values.append(near)
    return values


@pytest.mark.parametrize(
    "value",
    (0.125, 0.375, 2.5, 0.5, 1.0, 0.3, 1e3, 99.5, 12.5, 1e-3, 1e-4, 1e7, 3.5e8, -0.125),
)
@pytest.mark.parametrize("digits", (1, 2, 3, 6))
def test_a_number_on_the_edge_of_rounding_shows_one_way(value, digits):
    assert len({show(v, digits) for v in neighbours(value)}) == 1
    assert len({show(np.array([v, value / 3]), digits) for v in neighbours(value)}) == 1


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (0.0, 3, "below 1e-12"),
        (-0.0, 3, "below 1e-12"),
        (-3e-13, 3, "below 1e-12"),
        (0, 3, "0"),
        (1234567, 3, "1234567"),
        (True, 3, "True"),
        (1 / 3, 3, "0.333"),
        (-2 / 3, 2, "-0.67"),
        (1e300, 4, "1e+300"),
        (123456789.0, 4, "1.235e+08"),
        (np.nan, 3, "nan"),
        (-np.inf, 3, "-inf"),
        (np.float32(0.5), 3, "0.5"),
        ([1, 2, 3], 2, "[1, 2, 3]"),
        ([1.0, 1 / 3], 3, "[1.  , 0.33]"),
        ([-1e-13, 1.0], 3, "[0., 1.]"),
        ([-1e-4, 1.0], 3, "[0., 1.]"),
        ([1e-13, -1e-14], 3, "[0., 0.]"),
        ([np.nan, np.inf, 1.23456], 3, "[ nan,  inf, 1.23]"),
        ([123456789.0, 1e5], 4, "[1.235e+08, 1.000e+05]"),
        ([1.7e308, -1.7e308], 2, "[ 1.7e+308, -1.7e+308]"),
        ([1.234e-9, 0.0], 3, "[1.23e-09, 0.00e+00]"),
        ([], 3, "[]"),
        (np.full((2, 2), 0.25), 1, "[[0.2, 0.2],\n [0.2, 0.2]]"),
    ],
)
def test_numbers_as_text(value, digits, text):
    assert show(value, digits) == text
    assert repr(show(value, digits)) == text


@pytest.mark.parametrize(
    ("value", "noise", "text"),
    [
        (-4.27e-9, 1e-4, "below 0.0001"),
        (4.27e-9, 1e-6, "below 1e-06"),
        (2.4e-4, 1e-4, "0.0002"),
        (-3e-6, 1e-6, "-3e-06"),
        ([2e-7, -0.5], 1e-6, "[ 0. , -0.5]"),
    ],
)
def test_a_bound_that_holds_is_shown_and_a_number_that_breaks_it(value, noise, text):
    assert show(value, 1, noise=noise) == text


@pytest.mark.parametrize("digits", (0, 16, 2.0, True, "3"))
def test_digits_are_a_whole_number(digits):
    with pytest.raises(ValueError, match="digits: expected"):
        show(1.0, digits)


@pytest.mark.parametrize("value", (1j, "a", None, [1, "a"]))
def test_only_numbers_are_shown(value):
    with pytest.raises(ValueError, match="value: expected"):
        show(value, 3)
