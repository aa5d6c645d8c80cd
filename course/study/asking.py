"""What somebody's own function gives when it is asked for a motion: checked before it moves anything."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course.arrays import Array

#: Numbers beyond this have run away: nothing is asked from there on [m, m/s, ...].
RUN_AWAY = 1e6


class UnusableResult(ValueError):
    """A result that moves nothing; its words say what came in place of what."""


def asked(
    function: Callable[..., Any],
    shapes: Sequence[tuple[int, ...]],
    *given: Any,
    never: bool = False,
) -> tuple[Array, ...]:
    """A function's results as arrays of these shapes, from copies of its arguments.

    Args:
        function: somebody's own, or one of ``course.formulas``.
        shapes: of its results, in order; one shape for one result.
        given: its arguments.
        never: whether it may give inf: a time that does not come.
    Raises:
        UnusableResult: another number of results, another shape, no numbers, NaN or infinity.
    """
    with np.errstate(all="ignore"):
        got = function(*(_own(value) for value in given))
    results = (got,) if len(shapes) == 1 else got
    if got is None:
        raise UnusableResult("it returned nothing: is there a `return`?")
    if not isinstance(results, (tuple, list)) or len(results) != len(shapes):
        came = len(results) if isinstance(results, (tuple, list)) else "one"
        raise UnusableResult(f"it returned {came} in place of {len(shapes)} results")
    return tuple(_array(r, s, never) for r, s in zip(results, shapes, strict=True))


def one_number(function: Callable[..., Any], *given: Any) -> float:
    """A function's result that is a single number."""
    return float(asked(function, ((),), *given)[0])


def _own(value: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(_own(part) for part in value)
    return np.array(value) if isinstance(value, np.ndarray) else value


def _array(result: Any, shape: tuple[int, ...], never: bool) -> Array:
    try:
        array = np.asarray(result, dtype=float)
    except (TypeError, ValueError):
        kind = type(result).__name__
        raise UnusableResult(f"it returned no numbers, but {kind}") from None
    if shape == () and array.size == 1:
        array = array.reshape(())
    if array.shape != shape:
        wanted = f"shape {shape}" if shape else "one number"
        raise UnusableResult(f"it returned shape {array.shape} in place of {wanted}")
    if not np.all(np.isfinite(array) | (never & (array == np.inf))):
        what = "NaN" if np.any(np.isnan(array)) else "infinity"
        raise UnusableResult(f"it returned {what}")
    return array
