"""The contacts between bodies, as arrays."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, fields
from typing import Any, NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from course.arrays import (
    Array,
    IntArray,
    choice,
    failure,
    indices,
    instances,
    read_only,
    scalars,
    selection,
    shaped,
    unit_vectors,
    written,
)
from course.arrays import matrices as matrices_of
from course.arrays import vectors as vectors_of

#: What carries the normal: a face of B, a face of A, two crossing edges, or none of
#: these (curved surfaces).
FEATURES = ("face_b", "face_a", "edges", "curved")
#: What ``Contacts.concatenate`` keeps only if every part has it: no number says "none".
WHOLE = ("pair", "key")


class Side(NamedTuple):
    """One side of c contacts: bodies (c,), points (c, 3) [m], +1 for A or -1 for B."""

    body: IntArray
    point: Array
    sign: float


@dataclass(frozen=True, eq=False)
class Contacts:
    """c points at which body A and body B touch, or nearly do.

    The normal is a unit vector out of B toward A, and the separation is
    d = (p_A - p_B) . N: above 0 apart, 0 touching, below 0 penetrating
    (syllabus row 19). The point lies halfway, so p_A and p_B are
    ``point +- separation N / 2``.

    Args:
        body_a, body_b: (c,) ints, which bodies; never the same one twice.
        point: (c, 3) [m].
        normal: (c, 3) unit vectors out of B toward A.
        separation: (c,) [m].
        feature: (c,) words of ``FEATURES``; all "face_b" when nothing is said.
        edge_a, edge_b: (c, 3) directions of the two edges, read where the
            feature is "edges" and needed there.
        curvature_a, curvature_b: (c, 3, 3) symmetric curvature tensors
            [1/m], read where the feature is "curved" and needed there.
        pair: (c,) ints, which pair of a batch the contact belongs to.
        key: (c, 4) ints from 0: handle of A and of B, feature of A and of B (vertices
            are numbered first, then edges, then faces). A contact has the same key as
            long as the same features touch, so that a solver can start from the force
            it had a frame before.
    Raises:
        ValueError: another shape or kind, a body against itself, a feature without
            its data.
    """

    body_a: IntArray
    body_b: IntArray
    point: Array
    normal: Array
    separation: Array
    feature: NDArray[Any] | None = None
    edge_a: Array | None = None
    edge_b: Array | None = None
    curvature_a: Array | None = None
    curvature_b: Array | None = None
    pair: IntArray | None = None
    key: IntArray | None = None

    def __post_init__(self) -> None:
        body_a, body_b = indices("body_a", self.body_a), indices("body_b", self.body_b)
        if body_a.ndim != 1:
            raise failure("body_a", "shape (c,)", f"shape {body_a.shape}")
        count = body_a.size
        shaped("body_b", body_b, (count,))
        if np.any(body_a == body_b):
            index = int(np.argmax(body_a == body_b))
            raise failure(
                "body_b",
                "another body than body_a",
                f"body {body_b[index]} twice",
                (index,),
            )
        checked: dict[str, NDArray[Any]] = {
            "body_a": body_a,
            "body_b": body_b,
            "point": _table("point", vectors_of("point", self.point), (count, 3)),
            "normal": _table("normal", unit_vectors("normal", self.normal), (count, 3)),
            "separation": _table(
                "separation", scalars("separation", self.separation), (count,)
            ),
            "feature": _features(self.feature, count),
        }
        edges, curved = checked["feature"] == "edges", checked["feature"] == "curved"
        for side in "ab":
            checked[f"edge_{side}"] = _edges(
                f"edge_{side}", getattr(self, f"edge_{side}"), edges
            )
            checked[f"curvature_{side}"] = _curvatures(
                f"curvature_{side}", getattr(self, f"curvature_{side}"), curved
            )
        if self.pair is not None:
            checked["pair"] = _table("pair", indices("pair", self.pair), (count,))
        if self.key is not None:
            checked["key"] = _table("key", indices("key", self.key), (count, 4))
        for name, array in checked.items():
            object.__setattr__(self, name, None if array is None else read_only(array))

    @staticmethod
    def unchecked(**arrays: NDArray[Any] | None) -> Contacts:
        """Contacts of arrays that a compiled loop has just made: nothing is checked or copied.

        Args:
            arrays: the fields, of the right shape and type; what is not given is None.
                Nobody may write to them any more.
        """
        contacts = object.__new__(Contacts)
        for field in fields(Contacts):
            array = arrays.get(field.name)
            if array is not None:
                array.setflags(write=False)
            object.__setattr__(contacts, field.name, array)
        return contacts

    def __len__(self) -> int:
        return self.body_a.size

    def __getitem__(self, which: ArrayLike | slice) -> Contacts:
        """The contacts that a mask, indices or a slice select, in that order.

        An int gives a ``Contacts`` of one. All fields are copies, the optional
        ones included.
        """
        index = selection("contacts", which, len(self))
        picked = {
            name: None if field is None else field.take(index, axis=0)
            for name, field in vars(self).items()
        }
        return Contacts.unchecked(**picked)  # some of what is good

    def require_bodies(self, count: int) -> None:
        """Refuse contacts with a body that is not among the ``count`` there are.

        Raises:
            ValueError: names ``contacts.body_a`` or ``contacts.body_b``, the largest
                index that exists, and the first entry beyond it.
        """
        indices("contacts.body_a", self.body_a, count)
        indices("contacts.body_b", self.body_b, count)

    @property
    def sides(self) -> tuple[Side, Side]:
        """Both sides of all contacts, A then B: what a sum over bodies loops over.

        ``for body, point, sign in contacts.sides``: which bodies (c,), the material
        points p_A or p_B (c, 3) [m], and +1 or -1, as a force f or impulse >= 0
        pushes A along +N and B along -N.
        """
        return (
            Side(self.body_a, self.point_a, 1.0),
            Side(self.body_b, self.point_b, -1.0),
        )

    @property
    def point_a(self) -> Array:
        """p_A = point + separation N / 2, (c, 3) [m]."""
        return self.point + 0.5 * self.separation[:, None] * self.normal

    @property
    def point_b(self) -> Array:
        """p_B = point - separation N / 2, (c, 3) [m]."""
        return self.point - 0.5 * self.separation[:, None] * self.normal

    @staticmethod
    def concatenate(parts: Iterable[Contacts]) -> Contacts:
        """All contacts of all parts, in order.

        Edges and curvatures that a part does not have are filled with NaN
        (its features do not read them); ``pair`` and ``key`` are kept if every part has
        them.
        """
        parts = instances("parts", parts, Contacts)
        counts = [len(part) for part in parts]
        columns = {
            field.name: _joined(
                field.name, [getattr(part, field.name) for part in parts], counts
            )
            for field in fields(Contacts)
        }
        return Contacts.unchecked(**columns)  # of parts that are good


def _joined(
    name: str, column: Sequence[NDArray[Any] | None], counts: Sequence[int]
) -> Any:
    present = [array for array in column if array is not None]
    if not present or (name in WHOLE and len(present) < len(column)):
        return None
    core = present[0].shape[1:]
    return np.concatenate(
        [
            np.full((n, *core), np.nan) if array is None else array
            for array, n in zip(column, counts, strict=True)
        ]
    )


def _table(name: str, array: NDArray[Any], shape: tuple[int, ...]) -> NDArray[Any]:
    shaped(name, array, shape)
    return array


def _features(value: ArrayLike | None, count: int) -> NDArray[Any]:
    if value is None:
        return np.full(count, "face_b", dtype="<U6")
    feature = np.asarray(value)
    for word in (
        np.unique(feature) if feature.dtype.kind == "U" else feature.ravel().tolist()
    ):
        choice("feature", str(word) if isinstance(word, np.str_) else word, FEATURES)
    return _table("feature", feature.astype("<U6"), (count,))


def _needed(
    name: str, value: Any, rows: NDArray[np.bool_], core: tuple[int, ...]
) -> NDArray[Any] | None:
    """The array with zeros in the rows that are not read, ready to be checked."""
    if value is None:
        if np.any(rows):
            word = "edges" if name.startswith("edge") else "curved"
            raise failure(
                name,
                f"an array, as a feature is {word!r}",
                "None",
                (int(np.argmax(rows)),),
            )
        return None
    array = np.asarray(value)
    shaped(name, array, (rows.size, *core))
    return np.where(rows.reshape(-1, *[1] * len(core)), array, np.zeros(core))


def _edges(name: str, value: Any, rows: NDArray[np.bool_]) -> Any:
    read = _needed(name, value, rows, (3,))
    if read is None:
        return None
    flat = rows & ~np.any(vectors_of(name, read), axis=1)
    if np.any(flat):
        raise failure(
            name, "directions that are not zero", "length 0.0", (int(np.argmax(flat)),)
        )
    return np.asarray(value, dtype=np.float64)


def _curvatures(name: str, value: Any, rows: NDArray[np.bool_]) -> Any:
    read = _needed(name, value, rows, (3, 3))
    if read is None:
        return None
    tensor = matrices_of(name, read)
    skew = np.abs(tensor - np.swapaxes(tensor, -1, -2)).max(axis=(-2, -1), initial=0.0)
    bad = skew > 1e-9 * np.abs(tensor).max(axis=(-2, -1), initial=0.0)
    if np.any(bad):
        index = int(np.argmax(bad))
        raise failure(
            name, "symmetric tensors", f"asymmetry {written(skew[index])}", (index,)
        )
    return cast(Array, np.asarray(value, dtype=np.float64))
