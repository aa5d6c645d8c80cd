"""What a world remembers from frame to frame: wide boxes, pairs of these, separating axes, contacts.

A box is wider than its shape by a part of its size, so that a shape may move a little before
it asks for partners again; the pairs of wide boxes are kept. A pair of which neither has
moved keeps its contacts; one that had none, and moves, is first tried along the axis that
separated it last.

Source: D. Baraff, *Dynamic Simulation of Non-Penetrating Rigid Bodies*, Cornell 1992
(witness axes); G. van den Bergen, *Collision Detection in Interactive 3D Environments*,
sections 4.3.2 and 5.3.2.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.detection.world import phases
from course.detection.world.counters import Counters, Phase
from course.detection.world.members import Members, permitted
from course.overlap import Contacts

#: How much wider a wide box is on either side, in widths of its shape.
WIDER = 0.1


@dataclass(frozen=True, eq=False)
class Memory:
    """The last frame of n rows.

    Attributes:
        wide: (n, 6) [m]; NaN for rows that are new.
        moved: (n,) whether a row has moved since.
        pairs: (m, 2) rows, i < j, sorted: those whose wide boxes meet and that may touch.
        axis: (m, 3) along which a pair was apart, out of j toward i; NaN where there is none.
        found: its contacts, ``pair`` counting the pairs; -1 of pairs that are kept no more.
        margin: that of the frame [m]; NaN before the first.
    """

    wide: Array
    moved: BoolArray
    pairs: IntArray
    axis: Array
    found: Contacts
    margin: float

    @classmethod
    def blank(cls) -> Memory:
        """That of an empty world."""
        none = np.empty((0, 2), dtype=np.intp)
        return cls(np.empty((0, 6)), np.empty(0, dtype=bool), none, np.empty((0, 3)),
                   phases.none_found(), np.nan)  # fmt: skip

    def joined(self, count: int) -> Memory:
        """With so many new rows behind the others."""
        wide = np.concatenate([self.wide, np.full((count, 6), np.nan)])
        moved = np.concatenate([self.moved, np.ones(count, dtype=bool)])
        return replace(self, wide=wide, moved=moved)

    def kept(self, keep: BoolArray) -> Memory:
        """Without the rows that a mask (n,) leaves out."""
        number = np.cumsum(keep) - 1
        whole = self.with_pairs(all_of(keep[self.pairs]))
        return replace(
            whole, wide=self.wide[keep], moved=self.moved[keep], pairs=number[whole.pairs]
        )  # fmt: skip

    def with_pairs(self, stay: BoolArray) -> Memory:
        """Without the pairs that a mask (m,) leaves out, and their contacts."""
        if np.all(stay):
            return self
        found = renumbered(self.found, np.where(stay, np.cumsum(stay) - 1, -1))
        return replace(self, pairs=self.pairs[stay], axis=self.axis[stay], found=found)

    def touched(self, rows: IntArray) -> Memory:
        """With some rows moved."""
        moved = np.array(self.moved)
        moved[rows] = True
        return replace(self, moved=moved)


def all_of(both: BoolArray) -> BoolArray:
    """Whether both rows of each pair are so, (m, 2) to (m,)."""
    return both[:, 0] & both[:, 1]


def renumbered(found: Contacts, number: IntArray) -> Contacts:
    """Contacts whose ``pair`` p is number[p] from now on; -1 stays -1."""
    assert found.pair is not None
    pair = np.where(found.pair < 0, -1, np.append(number, -1)[found.pair])
    return Contacts.unchecked(**{**vars(found), "pair": pair})


def next_frame(members: Members, last: Memory, margin: float) -> tuple[Memory, Counters]:  # fmt: skip
    """The memory of a frame, its contacts among it, and what its phases did.

    Args:
        members: who is where.
        last: the memory of the last frame, with what was added, moved and removed since.
        margin: the greatest separation that counts [m].
    """
    paired, fresh, broad = _paired(members, last, margin)
    changed = fresh | ~all_of(~paired.moved[paired.pairs])
    if margin != last.margin:
        changed[:] = True
    active = np.flatnonzero(changed)
    axis = np.array(paired.axis)
    found, counters = _tested(members, paired.pairs, active, axis, margin)
    still = np.where(changed, -1, np.arange(changed.size))
    both = phases.by_pair([renumbered(paired.found, still), found])
    memory = replace(
        paired, axis=axis, found=both, margin=margin, moved=np.zeros_like(paired.moved)
    )
    return memory, replace(
        counters, broad=broad, pairs=len(axis), contacts=len(both),
        boxes=replace(counters.boxes, saved=changed.size - active.size),
    )  # fmt: skip


def _paired(
    members: Members, last: Memory, margin: float
) -> tuple[Memory, BoolArray, Phase]:
    """The memory with the pairs of this frame's wide boxes, which of these are new, and the broad phase's count."""
    asking = _leaving(members, last, margin)
    asked = int(np.count_nonzero(asking))
    stays = Phase(asked, 0, asking.size - asked)
    if not asked:
        return last, np.zeros(len(last.pairs), dtype=bool), stays
    wide = np.array(last.wide)
    rows = np.flatnonzero(asking)
    wide[rows] = _wide(members, rows, margin)
    known = last.with_pairs(all_of(~asking[last.pairs]))
    new = phases.partners(members, wide, asking, margin)
    allowed = new[permitted(members, new)]
    pairs = np.concatenate([known.pairs, allowed])
    order = np.argsort(pairs[:, 0] * len(members) + pairs[:, 1], kind="stable")
    place = np.empty(order.size, dtype=np.intp)
    place[order] = np.arange(order.size)
    axis = np.concatenate([known.axis, np.full((len(allowed), 3), np.nan)])
    memory = replace(
        known, wide=wide, pairs=pairs[order], axis=axis[order],
        found=renumbered(known.found, place),
    )  # fmt: skip
    fresh = order >= len(known.pairs)
    return memory, fresh, replace(stays, dismissed=len(new) - len(allowed))


def _leaving(members: Members, last: Memory, margin: float) -> BoolArray:
    """Which rows are not inside their wide boxes any more, or never were.

    Half spaces have none: they ask when they have moved, or the margin is another.
    """
    rows = np.flatnonzero(last.moved) if margin == last.margin else np.arange(len(members))  # fmt: skip
    plane = members.is_plane
    need = _needed(members, rows, margin)
    inside = (last.wide[rows, :3] <= need[:, :3]) & (need[:, 3:] <= last.wide[rows, 3:])
    asking = np.zeros(len(members), dtype=bool)
    asking[rows] = ~inside.all(axis=1) | (
        plane[rows] & (last.moved[rows] | (margin != last.margin))
    )
    return asking


def _needed(members: Members, rows: IntArray, margin: float) -> Array:
    """The bounds of rows, half a margin and what rounding may do wider."""
    more = (0.5 * max(margin, 0.0) + members.slack[rows])[:, None]
    box = members.box[rows]
    return np.concatenate([box[:, :3] - more, box[:, 3:] + more], axis=1)


def _wide(members: Members, rows: IntArray, margin: float) -> Array:
    """Wide boxes of rows."""
    box = members.box[rows]
    need = _needed(members, rows, margin)
    more = WIDER * (box[:, 3:] - box[:, :3]).max(axis=1, keepdims=True)
    return np.concatenate([need[:, :3] - more, need[:, 3:] + more], axis=1)


def _tested(
    members: Members, pairs: IntArray, active: IntArray, axis: Array, margin: float
) -> tuple[Contacts, Counters]:
    """The contacts of the active pairs, ``pair`` counting all pairs; axes of pairs that are apart are written."""
    meet = active[phases.by_boxes(members, pairs[active], margin)]
    boxes = Phase(active.size, active.size - meet.size)
    with_plane = members.is_plane[pairs[meet]].any(axis=1)
    plane, solid = meet[with_plane], meet[~with_plane]
    near = solid[phases.by_spheres(members, pairs[solid], margin)]
    close = near[phases.by_oriented_boxes(members, pairs[near], margin)]
    has_axis = np.isfinite(axis[close, 0])
    tried = close[has_axis]
    joined = phases.by_axes(members, pairs[tried], axis[tried], margin)
    last = np.sort(np.concatenate([close[~has_axis], tried[joined], plane]))
    found, calls = phases.narrow(members, pairs[last], margin)
    assert found.pair is not None
    touching = np.zeros(last.size, dtype=bool)
    touching[found.pair] = True
    axis[last] = np.nan
    apart = last[~touching]
    apart = apart[~members.is_plane[pairs[apart]].any(axis=1)]
    axis[apart] = phases.axes_between(members, pairs[apart], margin)
    return renumbered(found, last), Counters(
        boxes=boxes,
        spheres=Phase(solid.size, solid.size - near.size),
        oriented=Phase(near.size, near.size - close.size),
        axes=Phase(tried.size, tried.size - int(np.count_nonzero(joined))),
        narrow=Phase(last.size, last.size - int(np.count_nonzero(touching))),
        calls=calls,
    )
