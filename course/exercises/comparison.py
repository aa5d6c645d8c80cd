"""Does a result have the declared shape and type, and is it close enough to the
expected?
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course.exercises.definition import Value


@dataclass(frozen=True)
class Difference:
    """The first wrong element of one result: where it is, both values, how far apart.

    ``index`` is its place in the batch, ``entry`` that of the wrong number inside the
    element (a vector, a matrix). ``excess`` is the largest error in units of the
    tolerance, so above 1 is wrong; ``fault`` describes an answer that cannot be
    compared at all (shape, type, not finite).
    """

    result: str
    index: tuple[int, ...] = ()
    entry: tuple[int, ...] = ()
    expected: Any = None
    got: Any = None
    excess: float = 0.0
    fault: str = ""

    @property
    def wrong(self) -> bool:
        """Whether this result is wrong."""
        return bool(self.fault) or not self.excess <= 1.0


def compare(
    results: tuple[Value, ...],
    expected: tuple[np.ndarray, ...],
    got: tuple[np.ndarray, ...],
) -> Difference:
    """The worst difference over all results.

    The first one that cannot be compared, if any.
    """
    differences = [
        compare_one(r, e, g) for r, e, g in zip(results, expected, got, strict=True)
    ]
    faults = [d for d in differences if d.fault]
    return faults[0] if faults else max(differences, key=lambda d: d.excess)


def compare_one(result: Value, expected: np.ndarray, got: np.ndarray) -> Difference:
    """Compare one result with the expected one: shape first, then type, then values.

    The tolerance of a number is ``absolute + relative * scale``, where scale is the
    largest finite magnitude in its element (over the axes that the declared shape names
    after the batch).
    """
    fault = _shape_fault(result, expected, got) or _type_fault(result, got)
    if fault:
        return Difference(result.name, expected=expected, got=got, fault=fault)
    if result.dtype != "float":
        wrong = np.asarray(expected != got)
        return _worst(result, expected, got, np.where(wrong, np.inf, 0.0))
    lost = np.isfinite(expected) & ~np.isfinite(got)
    if lost.any():
        first = _worst(result, expected, got, np.where(lost, np.inf, 0.0))
        word = "NaN" if np.isnan(got[lost]).any() else "infinity"
        return replace(first, fault=f"{word} where a finite number is expected")
    with np.errstate(all="ignore"):
        magnitude = np.where(np.isfinite(expected), np.abs(expected), 0.0)
        own = tuple(range(-min(result.own_axes, expected.ndim), 0))
        scale = (
            magnitude.max(axis=own, keepdims=True, initial=0.0) if own else magnitude
        )
        excess = np.abs(got - expected) / (result.absolute + result.relative * scale)
    special = ~np.isfinite(expected)
    alike = (got == expected) | (np.isnan(got) & np.isnan(expected))
    return _worst(
        result, expected, got, np.where(special, np.where(alike, 0.0, np.inf), excess)
    )


def same(
    results: tuple[Value, ...],
    one: tuple[np.ndarray, ...],
    other: tuple[np.ndarray, ...],
) -> bool:
    """Whether two answers are the same, shapes included."""
    return not compare(results, one, other).wrong


def _shape_fault(result: Value, expected: np.ndarray, got: np.ndarray) -> str:
    if got.shape == expected.shape:
        return ""
    return f"shape {_shape(got.shape)} where {_shape(expected.shape)} is expected"


def _type_fault(result: Value, got: np.ndarray) -> str:
    allowed = {"float": "fiu", "int": "iu", "bool": "b", "str": "U"}[result.dtype]
    if got.dtype.kind in allowed:
        return ""
    if (
        result.dtype == "int"
        and got.dtype.kind == "f"
        and np.array_equal(got, np.round(got))
    ):
        return ""
    words = {
        "float": "numbers",
        "int": "whole numbers",
        "bool": "True or False",
        "str": "words",
    }
    came = {
        "b": "True or False",
        "c": "complex numbers",
        "U": "text",
        "i": "whole numbers",
        "u": "whole numbers",
    }
    return f"{came.get(got.dtype.kind, 'numbers')} where {words[result.dtype]} are expected"


def _shape(shape: tuple[int, ...]) -> str:
    return "() (a single number)" if shape == () else str(shape)


def _worst(
    result: Value, expected: np.ndarray, got: np.ndarray, excess: np.ndarray
) -> Difference:
    if excess.size == 0:
        return Difference(result.name, expected=expected, got=got)
    excess = np.where(np.isnan(excess), np.inf, excess)
    flat = (
        int(np.argmax(excess > 1.0)) if (excess > 1.0).any() else int(np.argmax(excess))
    )
    place = tuple(int(i) for i in np.unravel_index(flat, excess.shape))
    batch = max(excess.ndim - result.own_axes, 0)
    index, entry = place[:batch], place[batch:]
    return Difference(
        result.name, index, entry, expected[index], got[index], float(excess.max())
    )
