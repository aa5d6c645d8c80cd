"""Verdicts on many pairs of spheres: bytes, seconds and wrong verdicts of each way to store and to ask."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from course import formulas
from course.arrays import Array, BoolArray
from course.study.engines import installed_sphere_engines
from course.study.far_places import DTYPES, SpherePairs, seen_from_a, stored
from course.study.precision import Method, Problem, WorkPrecision, work_precision

#: Numbers that a test reads of each pair: two centres and radii; one way and the sum of the radii.
AS_STORED, FROM_A = 8, 4
SIZES = (2, 4, 8)


def with_root(
    center_a: Array, radius_a: Array, center_b: Array, radius_b: Array
) -> BoolArray:
    """``spheres_overlap`` with the root that it can do without."""
    apart = center_a - center_b
    distance = np.sqrt(np.sum(apart * apart, axis=-1))
    return np.asarray(distance <= radius_a + radius_b)


def sphere_verdict_bytes(pairs: SpherePairs) -> WorkPrecision:
    """Wrong verdicts against the bytes that a test reads: places as they are, and seen from A first."""
    return work_precision(
        _problem(pairs),
        [
            Method("places as they are", _asking(pairs, AS_STORED), SIZES, "bytes"),
            Method("seen from A first", _asking(seen_from_a(pairs), FROM_A), SIZES, "bytes"),
        ],
        count_unit="bytes read a pair",
    )  # fmt: skip


def sphere_verdict_seconds(pairs: SpherePairs, *, peers: bool = True) -> WorkPrecision:
    """Wrong verdicts against seconds: with and without the root, seen from A first, and libraries.

    To see places from A is part of what is timed; to have them in 4 or 8 bytes is not.
    """
    x = pairs.arguments
    methods = [
        Method("without the root", _asking(pairs, AS_STORED), (4, 8), "bytes"),
        Method("with the root", _asking(pairs, AS_STORED, with_root), (4, 8), "bytes"),
        Method("seen from A first", _subtracting(pairs), (2, 4), "bytes"),
    ]
    for name, asked in installed_sphere_engines().items() if peers else ():
        methods.append(Method(name, lambda _, asked=asked: (asked(*x), 0), (8,)))  # type: ignore[misc]
    return work_precision(_problem(pairs), methods, count_unit="bytes read a pair")


def _problem(pairs: SpherePairs) -> Problem:
    return Problem(
        f"{len(pairs):,} pairs of spheres",
        lambda said: float(np.mean(said != pairs.overlap)),
        "share of wrong verdicts", "the gap with which each pair was drawn",
    )  # fmt: skip


def _asking(
    pairs: SpherePairs,
    numbers: int,
    verdict: Callable[..., BoolArray] = formulas.spheres_overlap,
) -> Callable[[float], tuple[BoolArray, int]]:
    ready = {size: stored(pairs, size).arguments for size in SIZES}

    def asked(size: float) -> tuple[BoolArray, int]:
        # What has no number in 2 bytes is infinity, and infinity less infinity is none.
        with np.errstate(all="ignore"):
            return verdict(*ready[int(size)]), numbers * int(size)

    return asked


def _subtracting(pairs: SpherePairs) -> Callable[[float], tuple[BoolArray, int]]:
    x_a, r_a, x_b, r_b = pairs.arguments
    reach = {size: (r_a + r_b).astype(DTYPES[size]) for size in SIZES}

    def asked(size: float) -> tuple[BoolArray, int]:
        r = reach[int(size)]
        apart = (x_a - x_b).astype(r.dtype)
        said = np.sum(apart * apart, axis=-1) <= r * r
        return np.asarray(said), FROM_A * int(size)

    return asked
