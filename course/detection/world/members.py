"""Who is in a world: one row for every convex part, in the order of the handles.

Handles count up from 0 and are never given twice. A compound has one handle and as many
rows as parts. Rows move up when others are removed; handles stay.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray, IntArray, failure, indices, written
from course.detection.world.shelves import (
    Shelf,
    Sort,
    bounds_array,
    coarse_boxes,
    convex_parts,
    sort_of,
)
from course.shapes import OBB, cores

#: Coordinates may be as large as this, as ``course.overlap`` takes them [m].
LARGEST = 1e50
#: What rounding may do to bounds: in sizes of the shape, and in its largest coordinate.
LEVEL, ROUNDING = 1e-9, 32 * 2.0**-52
#: Half spaces stand in boxes without end.
PLANE = "half_space"


@dataclass(eq=False)
class Members:
    """The rows of a world, n of them; ``sorts`` and ``shelves`` hold their shapes.

    Attributes:
        handle, part, body, group, mask: (n,) ints; fixed: (n,) bools.
        shelf, place: (n,) ints, where the row's shape stands.
        turned: (n,) bools, whether it is what moving makes of it, or still as it was given.
        pivot: (n, 3) [m], the translation it was last moved by.
        box: (n, 6) [m], l and u of its bounds.
        radius: (n,) [m], of a sphere about the middle of its coarse box.
        slack: (n,) [m], how far beyond its bounds rounding may put it.
        coarse: a shelf of n OBBs around the rows.
    """

    handle: IntArray
    part: IntArray
    body: IntArray
    fixed: BoolArray
    group: IntArray
    mask: IntArray
    shelf: IntArray
    place: IntArray
    turned: BoolArray
    pivot: Array
    box: Array
    radius: Array
    slack: Array
    coarse: Shelf
    sorts: list[Sort] = field(default_factory=list)
    shelves: list[Shelf] = field(default_factory=list)

    def __len__(self) -> int:
        return self.handle.size

    @classmethod
    def none(cls) -> Members:
        """Nobody."""
        empty: dict[str, Any] = {
            name: np.zeros(0, dtype=np.intp) for name in ROWS[:7]
        } | {name: np.zeros(0) for name in ("radius", "slack")}
        empty |= {name: np.zeros(0, dtype=bool) for name in ("fixed", "turned")}
        boxes = OBB(np.zeros((0, 3)), np.zeros((0, 3, 3)), np.zeros((0, 3)))
        return cls(
            **empty, pivot=np.zeros((0, 3)), box=np.zeros((0, 6)), coarse=Shelf.of(boxes)
        )  # fmt: skip

    @property
    def is_plane(self) -> BoolArray:
        """Which rows are half spaces, (n,)."""
        planes = [i for i, (kind, _) in enumerate(self.sorts) if kind == PLANE]
        return np.isin(self.shelf, planes)

    @property
    def sort_number(self) -> IntArray:
        """(n,) equal where two rows' shapes can be asked together: their shelf, and whether turned."""
        return 2 * self.shelf + self.turned

    def shapes(self, sort_number: int, rows: IntArray) -> Any:
        """The shapes of rows of one sort number where they are now."""
        shelf, turned = self.shelves[sort_number // 2], sort_number % 2
        place = self.place[rows]
        return shelf.standing(place) if turned else shelf.given[place]

    def rows_of(self, handles: Any) -> tuple[IntArray, IntArray]:
        """The rows of handles, and which of the handles (counted in C order) each belongs to.

        Raises:
            ValueError: a handle that is not here, or that comes twice.
        """
        asked = indices("handles", handles)
        flat = asked.ravel()
        begin = np.searchsorted(self.handle, flat, "left")
        count = np.searchsorted(self.handle, flat, "right") - begin
        for good, expected in (
            (count > 0, "handles of colliders that are in this world"),
            (first_ones(flat), "each handle once"),
        ):
            if not np.all(good):
                where = int(np.argmin(good))
                index = tuple(np.unravel_index(where, asked.shape))
                raise failure("handles", expected, str(flat[where]), index)
        which = np.repeat(np.arange(flat.size), count)
        within = np.arange(which.size) - np.repeat(np.cumsum(count) - count, count)
        return begin[which] + within, which

    def joined(self, more: Members) -> Members:
        """These and others behind them, whose handles are all greater."""
        rows = {n: np.concatenate([getattr(self, n), getattr(more, n)]) for n in ROWS}
        sorts, shelves = list(self.sorts), list(self.shelves)
        for number, (sort, shelf) in enumerate(
            zip(more.sorts, more.shelves, strict=True)
        ):
            mine = slice(len(self), None)
            new = more.shelf == number
            if sort not in sorts:
                sorts.append(sort)
                shelves.append(shelf)
            else:
                at = sorts.index(sort)
                rows["place"][mine][new] += shelves[at].given.count
                shelves[at] = shelves[at].joined(shelf)
            rows["shelf"][mine][new] = sorts.index(sort)
        return Members(
            **rows, coarse=self.coarse.joined(more.coarse), sorts=sorts, shelves=shelves
        )

    def kept(self, keep: BoolArray) -> Members:
        """The rows of a mask (n,), whose shapes move together on their shelves."""
        place, shelves = np.array(self.place), list(self.shelves)
        for number, shelf in enumerate(shelves):
            here = self.shelf == number
            stay = np.zeros(shelf.given.count, dtype=bool)
            stay[self.place[here & keep]] = True
            if not np.all(stay):
                place[here] = (np.cumsum(stay) - 1)[self.place[here]]
                shelves[number] = shelf.kept(stay)
        rows = {n: getattr(self, n)[keep] for n in ROWS} | {"place": place[keep]}
        coarse = self.coarse.kept(keep)
        return Members(**rows, coarse=coarse, sorts=self.sorts, shelves=shelves)

    def in_order(self) -> Members:
        """The same rows by handle, then part."""
        order = np.lexsort((self.part, self.handle))
        rows = {n: getattr(self, n)[order] for n in ROWS}
        coarse = self.coarse.kept(order)
        return Members(**rows, coarse=coarse, sorts=self.sorts, shelves=self.shelves)

    def put(self, rows: IntArray, rotation: Array, translation: Array) -> None:
        """Move rows to R x + t, x as they were given; all of it is worked out before any is written.

        Raises:
            ValueError: a place beyond 1e50 m.
        """
        written_later = []
        for number in np.unique(self.shelf[rows]):
            some = np.flatnonzero(self.shelf[rows] == number)
            shelf, place = self.shelves[number], self.place[rows[some]]
            moved = shelf.given[place].moved(rotation[some], translation[some])
            box = bounds_array(moved)
            require_near("translation", moved, box)
            written_later.append((rows[some], shelf, place, moved, box))
        coarse = self.coarse.given[rows].moved(rotation, translation)
        for some, shelf, place, moved, box in written_later:
            shelf.put(place, moved)
            self.box[some] = box
            self.slack[some] = slack_of(box, self.radius[some])
        self.coarse.put(rows, coarse)
        self.turned[rows], self.pivot[rows] = True, translation


#: The fields with a row each.
ROWS = ("handle", "part", "body", "group", "mask", "shelf", "place", "fixed", "turned",
        "pivot", "box", "radius", "slack")  # fmt: skip


def made_members(
    shapes: Any, handle: IntArray, body: IntArray, fixed: BoolArray, group: IntArray, mask: IntArray
) -> Members:  # fmt: skip
    """The rows of shapes of batch (k,), each attribute (k,).

    Raises:
        ValueError: shapes that reach beyond 1e50 m.
    """
    found = Members.none()
    for number, part in enumerate(convex_parts(shapes)):
        box = bounds_array(part)
        require_near("shapes", part, box)
        coarse = OBB.unchecked(**dict(zip(OBB.core_axes, coarse_boxes(part), strict=True)))  # fmt: skip
        count, radius = part.count, radii(part, coarse.center)
        rows = Members(
            handle=handle, part=np.full(count, number), body=body, fixed=fixed,
            group=group, mask=mask, shelf=np.zeros(count, dtype=np.intp),
            place=np.arange(count), turned=np.full(count, part.kind != "aabb"),
            pivot=np.zeros((count, 3)), box=box, radius=radius, slack=slack_of(box, radius),
            coarse=Shelf.of(coarse), sorts=[sort_of(part)], shelves=[Shelf.of(part)],
        )  # fmt: skip
        found = found.joined(rows)
    return found.in_order()


def radii(shape: Any, middle: Array) -> Array:
    """The least r for which a sphere about the middle (k, 3) holds each shape of batch (k,); 0 of planes."""
    if shape.kind == PLANE:
        return np.zeros(shape.count)
    points, radius = cores(shape)
    return np.linalg.norm(points - middle[:, None], axis=-1).max(axis=1) + radius


def slack_of(box: Array, radius: Array) -> Array:
    """How far beyond its bounds (k, 6) rounding may put a shape, (k,) [m]; 0 of half spaces."""
    largest = np.where(np.isfinite(box), np.abs(box), 0.0).max(axis=-1)
    return np.asarray(LEVEL * radius + ROUNDING * largest)


def first_ones(values: IntArray) -> BoolArray:
    """Which of some numbers (k,) have not come before."""
    first = np.zeros(values.size, dtype=bool)
    first[np.unique(values, return_index=True)[1]] = True
    return first


def require_near(name: str, shape: Any, box: Array) -> None:
    """Refuse shapes of bounds (k, 6), and half spaces by their offset, that overlap could not be asked about."""
    plane = shape.kind == PLANE
    largest = np.abs(shape.offset) if plane else np.abs(box).max(axis=1)
    far = ~(largest <= LARGEST)
    if np.any(far):
        where = int(np.argmax(far))
        got = written(largest[where])
        raise failure(name, f"coordinates up to {LARGEST:g}", got, (where,))


def permitted(members: Members, pairs: IntArray) -> BoolArray:
    """Which pairs of rows (m, 2) may touch: two bodies, not both fixed, each in a group that the other's mask has."""
    i, j = pairs.T
    group, mask = members.group, members.mask
    return (
        (members.body[i] != members.body[j])
        & ~(members.fixed[i] & members.fixed[j])
        & ((group[i] & mask[j]) != 0)
        & ((group[j] & mask[i]) != 0)
    )
