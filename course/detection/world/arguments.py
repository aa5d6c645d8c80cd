"""What a world is told and asked with: checked, and brought to one row each."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    BoolArray,
    IntArray,
    broadcast,
    failure,
    indices,
    non_negative,
    vectors,
    written,
)
from course.arrays import rotations as rotations_of
from course.detection.world.members import LARGEST


def vectors_of(x: Array, batch: tuple[int, ...]) -> Array:
    """Vectors of a batch along one axis."""
    return np.broadcast_to(x, (*batch, 3)).reshape(-1, 3)


def shaped_as(x: Any, batch: tuple[int, ...]) -> Any:
    """Rows (n, ...) in the shape of their batch, (..., ...)."""
    return x.reshape((*batch, *x.shape[1:]))


def of_bodies(name: str, value: ArrayLike, count: int) -> Array:
    """A vector for each body, (count, 3)."""
    array = vectors(name, value)
    largest = np.max(np.abs(array), initial=0.0)
    if largest > LARGEST:
        raise failure(name, f"numbers up to {LARGEST:g}", written(largest))
    if array.ndim == 1:
        return np.broadcast_to(array, (count, 3))
    if array.ndim != 2 or len(array) < count:
        raise failure(name, f"shape (3,) or ({count}, 3), one row a body", f"shape {array.shape}")  # fmt: skip
    return array


def columns_of(
    batch: tuple[int, ...], body: ArrayLike, fixed: ArrayLike, group: ArrayLike, mask: ArrayLike
) -> tuple[IntArray, BoolArray, IntArray, IntArray]:  # fmt: skip
    """Body, fixed, group and mask of each of a batch, in C order."""
    still = np.asarray(fixed)
    if still.dtype != np.bool_:
        raise failure("fixed", "True or False", written(fixed))
    groups = indices("group", group)
    if np.any(groups == 0):
        index = tuple(np.argwhere(groups == 0)[0])
        raise failure("group", "at least one bit", "0", index)
    masks = np.asarray(mask)
    if masks.dtype.kind not in "iu":
        raise failure("mask", "whole numbers", written(mask))
    given = (("body", indices("body", body)), ("fixed", still), ("group", groups),
             ("mask", masks.astype(np.intp)))  # fmt: skip
    found: list[Any] = []
    for name, array in given:
        try:
            found.append(np.broadcast_to(array, batch).ravel())
        except ValueError:
            expected = f"what broadcasts to the batch {batch}"
            raise failure(name, expected, f"shape {array.shape}") from None
    return found[0], found[1], found[2], found[3]


def poses_of(
    batch: tuple[int, ...], rotation: ArrayLike, translation: ArrayLike
) -> tuple[Array, Array]:
    """Rotation and translation of each handle, (k, 3, 3) and (k, 3)."""
    turn, shift = rotations_of("rotation", rotation), vectors("translation", translation)  # fmt: skip
    own = np.empty(batch, dtype=bool)
    whole = broadcast(handles=(own, 0), rotation=(turn, 2), translation=(shift, 1))
    if whole != batch:
        raise failure("handles", f"as many as poses, {whole}", f"shape {batch}")
    turn = np.broadcast_to(turn, (*batch, 3, 3)).reshape(-1, 3, 3)
    return turn, np.broadcast_to(shift, (*batch, 3)).reshape(-1, 3)


def rays_of(
    origin: ArrayLike, direction: ArrayLike, length: ArrayLike
) -> tuple[Array, Array, Array, tuple[int, ...]]:
    """Origin and unit direction (..., 3), length (...), and the batch of all three."""
    p, d = vectors("origin", origin), vectors("direction", direction)
    end = non_negative("length", length, infinite=True)
    batch = broadcast(origin=(p, 1), direction=(d, 1), length=(end, 0))
    largest = np.abs(d).max(axis=-1, keepdims=True)
    if np.any(largest == 0):
        index = tuple(np.argwhere(largest[..., 0] == 0)[0])
        raise failure("direction", "vectors that are not zero", "length 0.0", index)
    u = d / largest
    return p, u / np.linalg.norm(u, axis=-1, keepdims=True), end, batch
