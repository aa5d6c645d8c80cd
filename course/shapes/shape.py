"""What all kinds of shapes share: a batch, its indexing, and how arrays are kept."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    failure,
    instances,
    read_only,
    rotations,
    vectors,
)


class Shape:
    """A batch of shapes of one kind, as arrays over leading axes that nobody writes to.

    Attributes:
        kind: the kind's name.
        core_axes: how many last axes of each array belong to one shape, by name.
    """

    kind: ClassVar[str]
    core_axes: ClassVar[dict[str, int]]

    @property
    def batch(self) -> tuple[int, ...]:
        """The shape of the batch, () for one shape."""
        name, core = next(iter(self.core_axes.items()))
        array = getattr(self, name)
        return tuple(array.shape[: array.ndim - core])

    @property
    def count(self) -> int:
        """How many shapes the batch holds."""
        return int(np.prod(self.batch, dtype=np.intp))

    def __getitem__(self, index: Any) -> Self:
        """The shapes that an index of the batch axes selects, as NumPy would."""
        where = index if isinstance(index, tuple) else (index,)
        return self._each(lambda array, core: array[(*where, *[slice(None)] * core)])

    def reshaped(self, *batch: int) -> Self:
        """The same shapes, in the same order, under another batch shape."""

        def reshape(array: NDArray[Any], core: int) -> NDArray[Any]:
            return array.reshape((*batch, *array.shape[array.ndim - core :]))

        return self._each(reshape)

    def broadcast_to(self, batch: tuple[int, ...]) -> Self:
        """The shapes repeated along new or single batch axes; nothing is copied."""
        try:
            np.broadcast_to(np.empty(self.batch, dtype=bool), batch)
        except ValueError:
            expected = f"a batch that broadcasts to {batch}"
            raise failure(self.kind, expected, f"batch shape {self.batch}") from None

        def repeat(array: NDArray[Any], core: int) -> NDArray[Any]:
            return np.broadcast_to(array, (*batch, *array.shape[array.ndim - core :]))

        return self._each(repeat)

    @classmethod
    def concatenate(cls, parts: Iterable[Self]) -> Self:
        """All shapes of all parts, in order; each part has one batch axis."""
        given = one_axis(cls, parts)
        return cls._made(
            **{
                name: np.concatenate([getattr(part, name) for part in given])
                for name in cls.core_axes
            }
        )

    @classmethod
    def unchecked(cls, **arrays: NDArray[Any]) -> Self:
        """Shapes of arrays that are known to be good, of one batch: nothing is checked or copied.

        Args:
            arrays: one for each name in ``core_axes``. Nobody may write to them any more.
        """
        return cls._made(**arrays)

    def _each(self, change: Callable[[NDArray[Any], int], NDArray[Any]]) -> Self:
        """The same kind, each array (given with its core axes) changed."""
        return self._made(
            **{
                name: change(getattr(self, name), core)
                for name, core in self.core_axes.items()
            }
        )

    @classmethod
    def _made(cls, **arrays: NDArray[Any]) -> Self:
        """Shapes from arrays that are known to be good and are nobody else's."""
        made = object.__new__(cls)
        for name, array in arrays.items():
            kept = np.asarray(array)
            kept.setflags(write=False)
            object.__setattr__(made, name, kept)
        return made

    def _keep(self, **arrays: NDArray[Any]) -> None:
        """Store checked arrays, of one batch shape, so that nobody can write to them."""
        core = self.core_axes
        batch = broadcast(**{name: (a, core[name]) for name, a in arrays.items()})
        for name, array in arrays.items():
            shape = (*batch, *array.shape[array.ndim - core[name] :])
            object.__setattr__(self, name, np.broadcast_to(read_only(array), shape))


def lazy(batch: tuple[int, ...], make: Callable[[int], Any]) -> NDArray[Any]:
    """An array (...) of objects, one a shape, made from the shape's flat index."""
    made = np.empty(int(np.prod(batch, dtype=np.intp)), dtype=object)
    made[:] = [make(i) for i in range(made.size)]
    made.setflags(write=False)
    return made.reshape(batch)


def unturned(batch: tuple[int, ...]) -> Array:
    """The identity for each shape of a batch, (..., 3, 3)."""
    return np.broadcast_to(np.eye(3), (*batch, 3, 3))


def one_axis(kind: type[Any], parts: Iterable[Any]) -> list[Any]:
    """Parts of a kind, each a batch of one axis, as a list."""
    given = instances("parts", parts, kind)
    for i, part in enumerate(given):
        if len(part.batch) != 1:
            expected = "shapes with one batch axis"
            raise failure(f"parts[{i}]", expected, f"batch shape {part.batch}")
    return given


def pose(
    shape: Shape, rotation: ArrayLike, translation: ArrayLike
) -> tuple[Array, Array, tuple[int, ...]]:
    """Checked rotation (..., 3, 3) and translation (..., 3), and the batch they make."""
    turn, shift = rotations("rotation", rotation), vectors("translation", translation)
    own = np.empty(shape.batch, dtype=bool)
    batch = broadcast(
        **{shape.kind: (own, 0)}, rotation=(turn, 2), translation=(shift, 1)
    )
    return turn, shift, batch


def turned(rotation: Array, vector: Array) -> Array:
    """R x, (..., 3, 3) and (..., 3) broadcast."""
    product: Array = (rotation @ vector[..., None])[..., 0]
    return product


def directions(shape: Shape, direction: ArrayLike) -> tuple[Array, tuple[int, ...]]:
    """Checked directions, scaled so that their largest entry is 1, and the batch."""
    d = vectors("direction", direction)
    own = np.empty(shape.batch, dtype=bool)
    batch = broadcast(**{shape.kind: (own, 0)}, direction=(d, 1))
    largest = np.abs(d).max(axis=-1, keepdims=True)
    if np.any(largest == 0):
        index = tuple(np.argwhere(largest[..., 0] == 0)[0])
        expected = "vectors that are not zero"
        raise failure("direction", expected, "length 0.0", index)
    return d / largest, batch


def farthest(points: Array, direction: Array) -> Array:
    """The point of each set that lies farthest along a direction: argmax of x.d.

    Measured from the first point, so that sets far from the origin lose nothing.

    Args:
        points: (..., n, 3).
        direction: (..., 3), not zero; broadcast with the sets.
    Returns:
        (..., 3), the first of the farthest where several are.
    """
    along = ((points - points[..., :1, :]) @ direction[..., None])[..., 0]
    best = np.argmax(along, axis=-1)[..., None, None]
    wide = np.broadcast_to(points, (*best.shape[:-2], *points.shape[-2:]))
    return np.take_along_axis(wide, best, axis=-2)[..., 0, :]
