"""Array types and argument checks, in one place.

Every check takes the argument's name and value, returns a float64 array (or ints, where
stated) and raises ``ValueError`` in one form: ``name: expected ...; got ...``, with
``in entry 3`` where one entry of an array is at fault. Nothing is repaired, and the
input is never written to; the returned array may be the input itself.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike as ArrayLike
from numpy.typing import NDArray

Array = NDArray[np.float64]
IntArray = NDArray[np.intp]
BoolArray = NDArray[np.bool_]
T = TypeVar("T")

#: How far a unit vector, quaternion or rotation matrix may be from exact.
UNIT_TOLERANCE = 1e-9


def failure(
    name: str, expected: str, got: str, index: tuple[Any, ...] = ()
) -> ValueError:
    """The common form of a complaint about an argument; an index names the entry at
    fault.
    """
    where = [int(i) for i in index]
    entry = str(where[0]) if len(where) == 1 else str(tuple(where))
    place = f" in entry {entry}" if where else ""
    return ValueError(f"{name}: expected {expected}; got {got}{place}")


def written(value: Any) -> str:
    """An argument as one would type it: no NumPy types, at most 60 characters."""
    return _written(value)[:60]


def _written(value: Any) -> str:
    if isinstance(value, np.ndarray) and value.size > 60:
        return np.array2string(value, separator=", ", threshold=60)
    if isinstance(value, np.ndarray) and value.ndim:
        return f"array({_written(value.tolist())})"
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if type(value) is list and len(value) <= 60:
        return f"[{', '.join(map(_written, value))}]"
    if type(value) is tuple and 1 < len(value) <= 60:
        return f"({', '.join(map(_written, value))})"
    return repr(value)


def _require(
    name: str, good: Any, expected: str, value: NDArray[Any], what: str = ""
) -> None:
    """Raise for the first entry that is not good.

    The message shows that entry of ``value``; ``what`` says what it is.
    """
    if not np.all(good):
        index = tuple(np.argwhere(~np.asarray(good))[0])
        got = written(np.asarray(value)[index])
        raise failure(name, expected, f"{what} {got}".strip(), index)


def _real(name: str, value: ArrayLike, expected: str, infinite: bool) -> Array:
    try:
        raw = np.asarray(value)
        if raw.dtype.kind not in "fiu":
            raise TypeError
        array = raw.astype(np.float64, copy=False)
    except (TypeError, ValueError):
        raise failure(name, expected, written(value)) from None
    if infinite:
        _require(name, ~np.isnan(array), expected, array)
    else:
        _require(name, np.isfinite(array), f"finite {expected}", array)
    return array


def scalars(name: str, value: ArrayLike, *, infinite: bool = False) -> Array:
    """Real numbers of any shape; no NaN, and no infinity unless infinite is set."""
    return _real(name, value, "real numbers", infinite)


def scalar(name: str, value: ArrayLike, *, infinite: bool = False) -> float:
    """One real number, as a float."""
    array = _real(name, value, "one real number", infinite)
    if array.ndim:
        raise failure(name, "one real number", f"shape {array.shape}")
    return float(array)


def whole_number(name: str, value: Any, *, minimum: int = 0) -> int:
    """One whole number at or above minimum, as an int."""
    expected = f"a whole number of at least {minimum}"
    array = np.asarray(value)
    if array.ndim or array.dtype.kind not in "iu" or int(array) < minimum:
        raise failure(name, expected, written(value))
    return int(array)


def positive(name: str, value: ArrayLike, *, infinite: bool = False) -> Array:
    """Positive numbers; infinite=True where infinity has a meaning (a fixed body's
    mass).
    """
    array = _real(name, value, "positive numbers", infinite)
    _require(name, array > 0, "positive numbers", array)
    return array


def non_negative(name: str, value: ArrayLike, *, infinite: bool = False) -> Array:
    """Numbers of at least zero."""
    array = _real(name, value, "numbers at or above 0", infinite)
    _require(name, array >= 0, "numbers at or above 0", array)
    return array


def in_range(name: str, value: ArrayLike, lower: float, upper: float) -> Array:
    """Numbers between lower and upper, both included (a coefficient of restitution: 0
    to 1).
    """
    expected = f"numbers from {lower:g} to {upper:g}"
    array = _real(name, value, expected, False)
    _require(name, (array >= lower) & (array <= upper), expected, array)
    return array


def vectors(
    name: str, value: ArrayLike, *, size: int = 3, infinite: bool = False
) -> Array:
    """Vectors along the last axis, shape (..., size)."""
    expected = f"vectors of shape (..., {size})"
    array = _real(name, value, expected, infinite)
    if array.ndim == 0 or array.shape[-1] != size:
        raise failure(name, expected, f"shape {array.shape}")
    return array


def _unit(name: str, value: ArrayLike, size: int, kind: str) -> Array:
    expected = f"unit {kind} of shape (..., {size})"
    array = _real(name, value, expected, False)
    if array.ndim == 0 or array.shape[-1] != size:
        raise failure(name, expected, f"shape {array.shape}")
    length = np.sqrt(np.sum(array * array, axis=-1))
    _require(name, np.abs(length - 1) <= UNIT_TOLERANCE, expected, length, "length")
    return array


def unit_vectors(name: str, value: ArrayLike) -> Array:
    """Vectors of length 1, shape (..., 3)."""
    return _unit(name, value, 3, "vectors")


def unit_quaternions(name: str, value: ArrayLike) -> Array:
    """Quaternions of length 1, scalar last, shape (..., 4)."""
    return _unit(name, value, 4, "quaternions")


def matrices(name: str, value: ArrayLike, *, infinite: bool = False) -> Array:
    """Matrices on the last two axes, shape (..., 3, 3)."""
    expected = "matrices of shape (..., 3, 3)"
    array = _real(name, value, expected, infinite)
    if array.shape[-2:] != (3, 3):
        raise failure(name, expected, f"shape {array.shape}")
    return array


def rotations(name: str, value: ArrayLike) -> Array:
    """Rotation matrices, shape (..., 3, 3): R'R = 1 and det R = +1."""
    expected = "rotation matrices of shape (..., 3, 3)"
    array = matrices(name, value)
    # By components: of small matrices that is ten times quicker than @ and det.
    x, y, z = np.moveaxis(array, (-1, -2), (0, 1)).copy()  # columns, each (3, ...)
    error = np.abs([*(_dot(c, c) - 1 for c in (x, y, z)), _dot(x, y), _dot(y, z), _dot(z, x)])  # fmt: skip
    error = error.max(axis=0)
    _require(
        name, error <= UNIT_TOLERANCE, expected, error, "columns off orthonormal by"
    )
    cross = (x[i] * y[j] - x[j] * y[i] for i, j in ((1, 2), (2, 0), (0, 1)))
    handedness = _dot(tuple(cross), z)
    _require(name, handedness > 0, expected, handedness, "determinant")
    return array


def _dot(u: Sequence[Array], v: Sequence[Array]) -> Array:
    """u.v of vectors given as their three components."""
    return np.asarray(u[0] * v[0] + u[1] * v[1] + u[2] * v[2])


def inertias(name: str, value: ArrayLike) -> Array:
    """Inertia tensors: symmetric and positive definite, shape (..., 3, 3)."""
    expected = "symmetric positive definite matrices of shape (..., 3, 3)"
    array = matrices(name, value)
    asymmetry = np.abs(array - np.swapaxes(array, -1, -2)).max(axis=(-2, -1))
    size = np.abs(array).max(axis=(-2, -1))
    _require(name, asymmetry <= UNIT_TOLERANCE * size, expected, asymmetry, "asymmetry")
    least = graded_eigh(array)[0][..., 0]
    _require(name, least > 0, expected, least, "least eigenvalue")
    return array


def graded_eigh(matrix: Array) -> tuple[Array, Array]:
    """Eigenvalues, least first, and axes of symmetric matrices, (..., n, n), with the least as exact as their entries.

    LAPACK's rounding is relative to the largest eigenvalue, unless small
    entries come first: so the axes are sorted by the diagonal on the way.
    """
    order = np.argsort(np.diagonal(matrix, axis1=-2, axis2=-1), axis=-1)
    rows = np.take_along_axis(matrix, order[..., :, None], axis=-2)
    values, axes = np.linalg.eigh(np.take_along_axis(rows, order[..., None, :], -1))
    back = np.argsort(order, axis=-1)
    return values, np.take_along_axis(axes, back[..., :, None], axis=-2)


def indices(name: str, value: ArrayLike, count: int | None = None) -> IntArray:
    """Whole numbers from 0, below count where that is given."""
    expected = "whole numbers from 0"
    if count is not None:
        expected += f" to {count - 1}" if count else ", of which none exists here"
    array = np.asarray(value)
    if array.dtype.kind not in "iu" and array.size:
        raise failure(name, expected, written(value))
    array = array.astype(np.intp, copy=False)
    good = array >= 0 if count is None else (array >= 0) & (array < count)
    if not np.all(good):
        index = tuple(np.argwhere(~good)[0])
        raise failure(name, expected, str(int(array[index])), index)
    return array


def selection(name: str, which: ArrayLike | slice, count: int) -> IntArray:
    """The indices that ``which`` selects from count items, in its order, (k,).

    Args:
        name: what is indexed, for the messages.
        which: a slice, a mask (count,), an int or ints (k,); negative ints count
            from the end.
        count: how many items there are.
    Raises:
        ValueError: anything else, or a mask of another shape.
        IndexError: an index out of range.
    """
    if isinstance(which, slice):
        return np.arange(count)[which]
    index = np.atleast_1d(np.asarray(which))
    if index.dtype == bool:
        shaped(f"{name}[mask]", index, (count,))
        return np.flatnonzero(index)
    expected = "a mask, whole numbers or a slice"
    if index.size and index.dtype.kind not in "iu":
        raise failure(f"{name}[...]", expected, written(which))
    if index.ndim != 1:
        raise failure(f"{name}[...]", f"{expected}, shape (k,)", f"shape {index.shape}")
    index = index.astype(np.intp, copy=False)
    outside = (index < -count) | (index >= count)
    if np.any(outside):
        message = failure(
            f"{name}[...]", f"an index below {count}", str(index[outside][0])
        )
        raise IndexError(str(message))
    return index % count if count else index


def instances(name: str, value: Iterable[Any], kind: type[T]) -> list[T]:
    """At least one instance of a class, as a list."""
    parts = list(value)
    if not parts:
        raise failure(name, f"at least one {kind.__name__}", "none")
    for i, part in enumerate(parts):
        if not isinstance(part, kind):
            raise failure(f"{name}[{i}]", kind.__name__, type(part).__name__)
    return parts


def shaped(name: str, array: NDArray[Any], shape: Sequence[int]) -> None:
    """Refuse an array of any other shape."""
    if array.shape != tuple(shape):
        raise failure(name, f"shape {tuple(shape)}", f"shape {array.shape}")


def choice(name: str, value: Any, options: Sequence[str]) -> str:
    """One word from a fixed list."""
    if not isinstance(value, str) or value not in options:
        raise failure(name, "one of " + ", ".join(map(repr, options)), written(value))
    return value


def broadcast(**arguments: tuple[NDArray[Any], int]) -> tuple[int, ...]:
    """The common batch shape of arguments given as ``name=(array, core_axes)``.

    core_axes is how many last axes belong to one item: 0 scalar, 1 vector,
    2 matrix. The error names the first two arguments that do not fit, with
    their batch shapes.
    """
    known: list[tuple[str, tuple[int, ...]]] = []
    result: tuple[int, ...] = ()
    for name, (array, core) in arguments.items():
        batch = array.shape[: array.ndim - core]
        try:
            result = np.broadcast_shapes(result, batch)
        except ValueError:
            other = next(pair for pair in known if not _fit(pair[1], batch))
            expected = (
                f"a batch that broadcasts with {other[0]} of batch shape {other[1]}"
            )
            raise failure(name, expected, f"batch shape {batch}") from None
        known.append((name, batch))
    return result


def _fit(first: tuple[int, ...], second: tuple[int, ...]) -> bool:
    return all(
        a == b or 1 in (a, b)
        for a, b in zip(reversed(first), reversed(second), strict=False)
    )


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """The array itself if nobody can write to it, else a read-only copy."""
    if array.flags.owndata and not array.flags.writeable:
        return array
    copy = np.array(array)
    copy.flags.writeable = False
    return copy
