"""The world of colliders, apart from any simulation of bodies."""

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
    scalar,
    vectors,
    written,
)
from course.arrays import rotations as rotations_of
from course.detection.world.coherence import Memory, next_frame
from course.detection.world.counters import Counters
from course.detection.world.members import Members, made_members
from course.overlap import Contacts
from course.shapes import AABB, Shape


class CollisionWorld:
    """Holds and groups all colliders, and says where they touch.

    A collider is a shape that belongs to a body; a body may have many. ``contacts`` runs a
    broad phase over bounds, a middle one over coarse volumes and a narrow one over the
    shapes themselves, and reuses what it did a frame before; ``counters`` tells of it. Bad
    use is refused by name and leaves the world as it was.

    Source: Ericson, *Real-Time Collision Detection*, sections 2.4 and 7.1; syllabus row 14.

    Attributes:
        counters: what the phases of the last ``contacts`` did (``Counters``).
    """

    def __init__(self) -> None:
        self._members = Members.none()
        self._memory = Memory.blank()
        self._next = 0
        self.counters = Counters()

    def __len__(self) -> int:
        """How many colliders there are, a compound being one."""
        return int(np.count_nonzero(self._members.part == 0))

    @property
    def handles(self) -> IntArray:
        """The handles of all colliders that are here, growing."""
        return self._members.handle[self._members.part == 0]

    def add(
        self,
        shapes: Shape,
        *,
        body: ArrayLike,
        fixed: ArrayLike = False,
        group: ArrayLike = 1,
        mask: ArrayLike = -1,
    ) -> IntArray:
        """Take in colliders where they are, each with a handle that no other ever has.

        Two colliders may touch if they are of two bodies, not both fixed, and each is in a
        group that the other's mask has: group_A & mask_B and group_B & mask_A are not 0.

        Args:
            shapes: of any kind and batch (...); half spaces where something is endless.
            body: the bodies' numbers, ints that broadcast with the batch, as are the others.
            fixed: whether it is part of what never moves.
            group: one bit or more, above 0.
            mask: the groups it may touch; -1 is all of them.
        Returns:
            handles, (...) ints.
        Raises:
            TypeError: what is no shape.
            ValueError: bodies, groups or masks that do not fit; an endless box; coordinates
                beyond 1e50 m.
        """
        if not isinstance(shapes, Shape):
            raise TypeError(f"shapes: expected a shape; got {type(shapes).__name__}")
        if isinstance(shapes, AABB) and not shapes.is_finite:
            raise failure("shapes", "finite boxes, or half spaces", "one without end")
        columns = _columns(shapes.batch, body, fixed, group, mask)
        handle = self._next + np.arange(shapes.count)
        new = made_members(shapes.reshaped(shapes.count), handle, *columns)
        self._members = self._members.joined(new)
        self._memory = self._memory.joined(len(new))
        self._next += handle.size
        return handle.reshape(shapes.batch)

    def move(self, handles: ArrayLike, rotation: ArrayLike, translation: ArrayLike) -> None:  # fmt: skip
        """Put colliders where x' = R x + t, x as they were given to ``add``.

        So a shape that is given in its body's axes is moved by the body's own rotation and
        position, and no rounding adds up. A compound moves as one.

        Args:
            handles: (...) ints, each once.
            rotation: R, (..., 3, 3), broadcast with the handles.
            translation: t, (..., 3) [m]; what spins in ``first_hit`` turns about this place.
        Raises:
            ValueError: handles that are not here, or twice; NaN, infinity, what is no
                rotation, places beyond 1e50 m, batches that do not fit.
        """
        rows, which = self._members.rows_of(handles)
        turn, shift = _poses(np.shape(handles), rotation, translation)
        self._members.put(rows, turn[which], shift[which])
        self._memory = self._memory.touched(rows)

    def remove(self, handles: ArrayLike) -> None:
        """Take colliders out; their handles are never given again.

        Args:
            handles: (...) ints, each once.
        Raises:
            ValueError: handles that are not here, or twice.
        """
        rows, _ = self._members.rows_of(handles)
        keep = np.ones(len(self._members), dtype=bool)
        keep[rows] = False
        self._members, self._memory = self._members.kept(keep), self._memory.kept(keep)

    def contacts(self, *, margin: float = 0.0) -> Contacts:
        """Where colliders of different bodies touch, penetrate, or are within a margin of each other.

        The same as ``course.overlap.contacts`` of every pair that may touch, and, from frame to
        frame, the same as of a world that has just been filled.

        Args:
            margin: the greatest separation that counts [m].
        Returns:
            by body, in the order of the handles; A is the one with the lower handle.
            ``pair`` counts the pairs that touch; ``key`` is handle of A and of B, feature of A
            and of B.
        Raises:
            ValueError: a margin that is no number.
        """
        reach = scalar("margin", margin)
        self._memory, self.counters = next_frame(self._members, self._memory, reach)
        found = self._memory.found
        assert found.pair is not None
        pair = np.cumsum(np.diff(found.pair, prepend=-1) != 0) - 1
        return Contacts.unchecked(**{**vars(found), "pair": pair})


def _columns(
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


def _poses(
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
