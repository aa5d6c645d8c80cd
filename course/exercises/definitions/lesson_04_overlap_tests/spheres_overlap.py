"""The exercise ``spheres_overlap``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_04_overlap_tests.shared import (
    Given,
    center,
    gaps,
    length,
    place,
    radius,
)
from course.exercises.definitions.vectors import unit_vector
from course.exercises.slips import slip

_ARGUMENTS = (
    center("center_a", "A"),
    length("radius_a", "radius of A"),
    center("center_b", "B"),
    length("radius_b", "radius of B"),
)
_SQUARE, _REACH = "np.sum(apart * apart, axis=-1)", "(radius_a + radius_b) ** 2"


def _pair(*values: object) -> Given:
    return {
        v.name: np.asarray(x, float) for v, x in zip(_ARGUMENTS, values, strict=True)
    }


def _drawn(rng: np.random.Generator, shape: tuple[int, ...] = ()) -> Given:
    """Pairs whose gaps take turns above and below 0."""
    r_a, r_b, x_a = radius(rng, shape), radius(rng, shape), place(rng, shape)
    reach = np.abs(r_a + r_b + gaps(rng, shape))
    return _pair(x_a, r_a, x_a + reach[..., None] * unit_vector(rng, shape), r_b)


def _with_gap(rng: np.random.Generator, gap: float) -> Given:
    r_a, r_b, x_a = radius(rng), radius(rng), place(rng)
    return _pair(x_a, r_a, x_a + (r_a + r_b + gap) * unit_vector(rng), r_b)


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    x = place(rng)
    # A millionth of what they reach: np.isclose takes this for touching.
    apart = 9000.009 * unit_vector(np.random.default_rng(4))
    return [
        Case("3 and 1 m, centres 5 m apart", _pair([1.0, 2, 0], 3.0, [4.0, 6, 0], 1.0)),
        Case("3 and 2.5 m, the same centres", _pair([1.0, 2, 0], 3.0, [4.0, 6, 0], 2.5)),
        Case("apart, drawn", _with_gap(rng, 0.4)),
        Case("overlapping, drawn", _with_gap(rng, -0.1)),
        Case("two small ones", _pair(x, 0.2, x + 0.35 * unit_vector(rng), 0.2)),
        Case("two of 2 m, 2.5 m apart", _pair([1.0, 0, 2], 2.0, [2.5, 2, 2], 2.0)),
        Case("they touch", _pair([1.0, -2, 3], 2.0, [3.0, 1, 9], 5.0), "edge"),
        Case("the same centre", _pair(x, 0.4, x, 1.3), "edge"),
        Case("one lies deep in the other", _pair(x, 5.0, x + 2.0 * unit_vector(rng), 0.2), "edge"),
        Case("a point on a sphere", _pair([2.0, 3, 6], 0.0, [0.0, 0, 0], 7.0), "edge"),
        Case("5,000 and 4,000 m, 9 mm apart", _pair(x, 5e3, x + apart, 4e3), "edge"),
        Case("three pairs", _drawn(rng, (3,)), "batch"),
        Case("thirty pairs", _drawn(rng, (30,)), "batch"),
        Case("a 2 by 12 batch", _drawn(rng, (2, 12)), "batch"),
    ]  # fmt: skip


def _wrong(name: str, message: str, *edits: str) -> Mistake:
    return Mistake(name, slip(formulas.spheres_overlap, *edits), message)


SPHERES_OVERLAP = Exercise(
    name="spheres_overlap",
    rows=(9,),
    points=2,
    minutes=5,
    task="Return whether two spheres overlap; touching counts, and no square root is needed.",
    arguments=_ARGUMENTS,
    results=(Value("overlap", "(...)", "", "True where they overlap", dtype="bool"),),
    reference=formulas.spheres_overlap,
    cases=_cases,
    mistakes=(
        _wrong(
            "sum of squares",
            "You add the squares of the radii. First add the radii, then square: two spheres of 1 m reach 2 m "
            "together, and 1 + 1 is not 4.",
            _REACH,
            "radius_a**2 + radius_b**2",
        ),
        _wrong(
            "reach not squared",
            "On the left is a square, in m^2, on the right a length, in m. Square both, or none.",
            _REACH,
            "radius_a + radius_b",
        ),
        _wrong(
            "radius of B left out",
            "You ask whether the *centre* of B lies in A. B reaches beyond its centre.",
            _REACH,
            "radius_a**2",
        ),
        _wrong(
            "radius of A left out",
            "You ask whether the *centre* of A lies in B. A reaches beyond its centre.",
            _REACH,
            "radius_b**2",
        ),
        _wrong(
            "a centre in the other",
            "You ask whether the *centre* of one lies in the other. They meet before that, as soon as both radii "
            "together bridge the distance of the centres.",
            _REACH,
            "np.maximum(radius_a, radius_b) ** 2",
        ),
        _wrong(
            "difference of the radii",
            "With the difference of the radii you ask whether one lies wholly inside the other.",
            "radius_a + radius_b",
            "radius_a - radius_b",
        ),
        _wrong(
            "touching left out",
            "Right but for spheres that touch. Shapes are closed: equality counts.",
            "<=",
            "<",
        ),
        _wrong(
            "the other way round",
            "Your answer is reversed: it is True for pairs that are apart.",
            "<=",
            ">",
        ),
        _wrong(
            "turned",
            "The comparison is turned: they overlap where the distance is at *most* what they reach, <=.",
            "<=",
            ">=",
        ),
        _wrong(
            "a tolerance",
            "You call spheres of 5,000 and 4,000 m touching that are 9 mm apart. np.isclose and the like allow for a "
            "part of the numbers' own size; asked is <= alone.",
            _REACH,
            f"{_REACH} * (1 + 1e-5)",
        ),
        _wrong(
            "square of the sum",
            "You add the three differences and square their sum. (a + b)^2 is not a^2 + b^2: first square, then add.",
            _SQUARE,
            "np.sum(apart, axis=-1) ** 2",
        ),
        _wrong(
            "centres added",
            "You add the two centres. The way from one to the other is their difference.",
            "center_a - center_b",
            "center_a + center_b",
        ),
        _wrong(
            "along each axis",
            "You compare x, y and z one by one: that tests the cubes around the spheres. It takes the length of the "
            "whole way between the centres.",
            f"{_SQUARE} <= {_REACH}",
            f"np.all(apart * apart <= np.expand_dims({_REACH}, -1), axis=-1)",
        ),
        _wrong(
            "sum of the sizes",
            "You add the sizes of the three differences: that is the way around the corners. The squared distance is "
            "the sum of their squares.",
            _SQUARE,
            "np.sum(np.abs(apart), axis=-1) ** 2",
        ),
        _wrong(
            "x and y only",
            "The third coordinate is left out: spheres far above each other seem to overlap.",
            _SQUARE,
            "np.sum(apart[..., :2] ** 2, axis=-1)",
        ),
        _wrong(
            "centre of B from the origin",
            "You measure B's centre from the origin. What counts is its distance from A's centre.",
            "center_a - center_b",
            "center_b",
        ),
        _wrong(
            "one sum for the batch",
            "Right for one pair. In a batch you add up the squares of all pairs: sum over the last axis only.",
            ", axis=-1)",
            ")",
        ),
    ),
    hints=(
        "Two spheres touch when their centres are as far apart as both reach together. Two numbers that are not below "
        "0 are in the same order as their squares.",
        "The squared distance of the centres is the sum of the squares of the three differences, over the last axis. "
        "It is compared with the square of the sum of the radii.",
        "apart = center_a - ____\nreturn np.sum(apart * apart, axis=____) <= (____) ** 2",
    ),
)
