"""Argument checks: what passes, what is refused, and in which words."""

import re

import numpy as np
import pytest

from course import arrays


def refused(text, check, *args, **kwargs):
    with pytest.raises(ValueError, match="^" + re.escape(text) + "$"):
        check(*args, **kwargs)


def test_one_form_of_error_names_argument_expectation_and_what_came():
    normals = np.tile([0.0, 0.0, 1.0], (4, 1))
    normals[3] = [0, 2, 0]
    refused(
        "normal: expected unit vectors of shape (..., 3); got length 2.0 in entry 3",
        arrays.unit_vectors,
        "normal",
        normals,
    )
    refused(
        "normal: expected unit vectors of shape (..., 3); got length 2.0",
        arrays.unit_vectors,
        "normal",
        [0, 2, 0],
    )


@pytest.mark.parametrize(
    "check, value",
    [
        (arrays.scalars, [1.0, np.nan]),
        (arrays.scalars, np.inf),
        (arrays.scalars, "one"),
        (arrays.scalars, None),
        (arrays.scalars, True),
        (arrays.scalars, 1j),
        (arrays.scalars, [[1, 2], [3]]),
        (arrays.scalar, [1.0]),
        (arrays.positive, [1.0, 0.0]),
        (arrays.positive, np.inf),
        (arrays.non_negative, -1e-300),
        (arrays.vectors, [1.0, 2.0]),
        (arrays.vectors, 3.0),
        (arrays.vectors, [0.0, np.nan, 0.0]),
        (arrays.unit_vectors, [0.0, 0.0, 0.0]),
        (arrays.unit_vectors, [0.0, 0.0, 1 + 1e-8]),
        (arrays.unit_quaternions, [0.0, 0.0, 1.0]),
        (arrays.unit_quaternions, [0.0, 0.0, 0.0, 0.9]),
        (arrays.matrices, np.eye(2)),
        (arrays.rotations, 2 * np.eye(3)),
        (arrays.rotations, np.diag([1.0, 1.0, -1.0])),
        (arrays.inertias, np.diag([1.0, 1.0, 0.0])),
        (arrays.inertias, np.eye(3) + np.eye(3, k=1)),
        (arrays.indices, [0, -1]),
        (arrays.indices, [0.0, 1.0]),
        (arrays.whole_number, 2.0),
        (arrays.whole_number, -1),
        (arrays.whole_number, [1]),
    ],
)
def test_refuses(check, value):
    with pytest.raises(ValueError, match=r"^thing: expected .*; got "):
        check("thing", value)


def test_range_count_and_choice_say_what_they_allow():
    refused(
        "restitution: expected numbers from 0 to 1; got 1.5 in entry 1",
        arrays.in_range,
        "restitution",
        [0.0, 1.5],
        0,
        1,
    )
    refused(
        "body: expected whole numbers from 0 to 2; got 3 in entry 0",
        arrays.indices,
        "body",
        [3],
        3,
    )
    refused(
        "body: expected whole numbers from 0, of which none exists here; got 0 in entry 0",
        arrays.indices,
        "body",
        [0],
        0,
    )
    refused(
        "law: expected one of 'a', 'b'; got 'c'", arrays.choice, "law", "c", ("a", "b")
    )
    assert arrays.choice("law", "b", ("a", "b")) == "b"


def test_infinity_passes_only_where_it_is_meant():
    assert arrays.positive("mass", [1.0, np.inf], infinite=True)[1] == np.inf
    with pytest.raises(ValueError, match="mass: expected positive numbers; got -inf"):
        arrays.positive("mass", [1.0, -np.inf], infinite=True)
    with pytest.raises(ValueError, match="got nan"):
        arrays.positive("mass", np.nan, infinite=True)


def test_whole_numbers_become_float64_and_float64_is_not_copied():
    assert arrays.vectors("v", [1, 2, 3]).dtype == np.float64
    value = np.zeros((2, 3))
    assert arrays.vectors("v", value) is value
    assert arrays.indices("i", []).dtype == np.intp


def test_broadcast_names_both_shapes():
    v, m = np.zeros((3, 3)), np.zeros(4)
    assert arrays.broadcast(velocity=(v, 1), mass=(np.zeros((5, 1)), 0)) == (5, 3)
    refused(
        "mass: expected a batch that broadcasts with velocity of batch shape (3,); got batch shape (4,)",
        arrays.broadcast,
        velocity=(v, 1),
        mass=(m, 0),
    )


def test_read_only_copies_what_others_can_write():
    mine = np.zeros(3)
    kept = arrays.read_only(mine)
    mine[0] = 1
    assert kept[0] == 0 and not kept.flags.writeable
    assert arrays.read_only(kept) is kept
    view = kept[:2]
    assert arrays.read_only(view) is not view


@pytest.mark.parametrize(
    "value,text",
    [
        (np.float64(-1.0), "-1.0"),
        (np.int64(3), "3"),
        ([np.float64(1), (np.bool_(True), "a")], "[1.0, (True, 'a')]"),
        (np.array([1, 2]), "array([1, 2])"),
        (np.str_("x"), "'x'"),
        (None, "None"),
    ],
)
@pytest.mark.slow
def test_what_came_is_written_without_types(value, text):
    assert arrays.written(value) == text
    assert len(arrays.written([value] * 10**4)) <= 60


@pytest.mark.parametrize(
    "call,text",
    [
        (lambda: arrays.whole_number("k", np.float64(2)), "k: expected a whole number of at least 0; got 2.0"),
        (lambda: arrays.positive("m", np.float64(-1)), "m: expected positive numbers; got -1.0"),
        (lambda: arrays.positive("m", [1.0, -1.0]), "m: expected positive numbers; got -1.0 in entry 1"),
        (lambda: arrays.vectors("x", [[0, 0, 0], [0, np.inf, 0]]),
         "x: expected finite vectors of shape (..., 3); got inf in entry (1, 1)"),
    ],
)  # fmt: skip
def test_complaints_in_plain_words(call, text):
    with pytest.raises(ValueError, match=f"^{re.escape(text)}$"):
        call()
