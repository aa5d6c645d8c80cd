"""The world of colliders, apart from any simulation of bodies."""

from __future__ import annotations

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    IntArray,
    broadcast,
    failure,
    non_negative,
    scalar,
    vectors,
    written,
)
from course.detection.world.arguments import (
    columns_of,
    of_bodies,
    poses_of,
    rays_of,
    shaped_as,
    vectors_of,
)
from course.detection.world.coherence import Memory, next_frame
from course.detection.world.counters import Counters
from course.detection.world.first_hits import FirstHit, first_of, flights_of
from course.detection.world.members import Members, made_members
from course.detection.world.queries import (
    Index,
    Nearest,
    RayHits,
    containing,
    hit_by_rays,
    met_by,
    nearest_to,
)
from course.overlap import Contacts
from course.shapes import AABB, Shape


class CollisionWorld:
    """Holds and groups all colliders, and says where they touch.

    A collider is a shape that belongs to a body; a body may have many. ``contacts`` runs a
    broad phase over bounds, a middle one over coarse volumes and a narrow one over the
    shapes themselves, and reuses what it did a frame before; ``counters`` tells of it. Bad
    use is refused by name and leaves the world as it was.

    Source: Ericson, *Real-Time Collision Detection*, sections 2.4 and 7.1; syllabus row 2.

    Attributes:
        counters: what the phases of the last ``contacts`` did (``Counters``).
    """

    def __init__(self) -> None:
        self._members = Members.none()
        self._memory = Memory.blank()
        self._next = 0
        self._index: dict[int, Index] = {}  # by mask, until anything changes
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
        columns = columns_of(shapes.batch, body, fixed, group, mask)
        handle = self._next + np.arange(shapes.count)
        new = made_members(shapes.reshaped(shapes.count), handle, *columns)
        self._members = self._members.joined(new)
        self._index.clear()
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
        turn, shift = poses_of(np.shape(handles), rotation, translation)
        self._members.put(rows, turn[which], shift[which])
        self._memory = self._memory.touched(rows)
        self._index.clear()

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
        self._index.clear()

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

    def first_hit(
        self,
        velocity: ArrayLike,
        *,
        spin: ArrayLike = (0.0, 0.0, 0.0),
        acceleration: ArrayLike = (0.0, 0.0, 0.0),
        horizon: float,
    ) -> FirstHit:
        """Which colliders meet first, if every body flies on for a while as it does now.

        x(t) = c + v t + a t^2/2 + exp(t omega x)(x - c), c being the place where ``move`` last
        put the body's colliders. Whom a body can meet is told by the box around its whole way;
        a body that comes to a stop and turns back within the horizon misses nothing.

        Args:
            velocity, spin, acceleration: v [m/s], omega [rad/s], a [m/s^2] of each body,
                (n, 3) for bodies 0 to n - 1, or (3,) for all; fixed ones rest.
            horizon: how long, at or above 0, finite [s].
        Returns:
            ``FirstHit``: time 0 where bodies penetrate, or touch and approach; inf if nothing
            meets.
        Raises:
            ValueError: fewer rows than bodies, numbers beyond 1e50, a horizon out of range, a
                half space that spins.
        """
        members = self._members
        end = float(non_negative("horizon", scalar("horizon", horizon)))
        count = int(members.body.max(initial=-1)) + 1
        given = (("velocity", velocity), ("spin", spin), ("acceleration", acceleration))
        motion = [of_bodies(name, value, count) for name, value in given]
        return first_of(members, flights_of(members, *motion), end)

    def ray(
        self, origin: ArrayLike, direction: ArrayLike, *, length: ArrayLike = np.inf, mask: int = -1
    ) -> RayHits:  # fmt: skip
        """What rays hit first; solids are closed, so that a ray in a face, or one that grazes, hits.

        Args:
            origin: (..., 3) [m].
            direction: (..., 3), not zero, of any length.
            length: how far, at or above 0, (...) [m].
            mask: the groups that are looked at; -1 is all.
        Returns:
            ``RayHits`` of the batch of all broadcast; a ray that starts inside says so.
        Raises:
            ValueError: a direction of length 0, arguments that do not fit or are out of range.
        """
        p, u, end, batch = rays_of(origin, direction, length)
        rays = vectors_of(p, batch), vectors_of(u, batch)
        found = hit_by_rays(
            self._asked(mask), *rays, np.broadcast_to(end, batch).ravel()
        )
        return RayHits(*(shaped_as(x, batch) for x in vars(found).values()))

    def containing(self, point: ArrayLike, *, mask: int = -1) -> IntArray:
        """Which colliders hold which points, their surface included.

        Args:
            point: (..., 3) [m].
        Returns:
            (m, 2) ints, the number of the point (in C order) and the handle, sorted.
        """
        p = vectors("point", point)
        return containing(self._asked(mask), vectors_of(p, p.shape[:-1]))

    def nearest(self, point: ArrayLike, *, mask: int = -1) -> Nearest:
        """The collider nearest to each point; inside, the one in which it is deepest.

        Args:
            point: (..., 3) [m].
        """
        p = vectors("point", point)
        found = nearest_to(self._asked(mask), vectors_of(p, p.shape[:-1]))
        return Nearest(*(shaped_as(x, p.shape[:-1]) for x in vars(found).values()))

    def sweep(
        self, shapes: Shape, velocity: ArrayLike, *, horizon: ArrayLike, mask: int = -1
    ) -> tuple[IntArray, Array]:
        """What shapes that are not in the world meet first, moving in straight lines past colliders at rest.

        Args:
            shapes: of any kind and batch (...).
            velocity: (..., 3) [m/s].
            horizon: at or above 0, finite, (...) [s].
        Returns:
            handle, (...), -1 for none; time as ``time_of_impact`` gives it, (...) [s].
        """
        v, end = vectors("velocity", velocity), non_negative("horizon", horizon)
        if not isinstance(shapes, Shape):
            raise TypeError(f"shapes: expected a shape; got {type(shapes).__name__}")
        own = np.empty(shapes.batch, dtype=bool)
        batch = broadcast(shapes=(own, 0), velocity=(v, 1), horizon=(end, 0))
        count = int(np.prod(batch, dtype=np.intp))
        moving = shapes.broadcast_to(batch).reshaped(count)
        ends = np.broadcast_to(end, batch).ravel()
        handle, time = met_by(self._asked(mask), moving, vectors_of(v, batch), ends)
        return handle.reshape(batch), time.reshape(batch)

    def _asked(self, mask: int) -> Index:
        """What queries look at, for one mask."""
        if isinstance(mask, bool) or not isinstance(mask, int | np.integer):
            raise failure("mask", "one whole number", written(mask))
        if mask not in self._index:
            self._index[int(mask)] = Index.of(self._members, int(mask))
        return self._index[int(mask)]
