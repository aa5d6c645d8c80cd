"""The phases of a frame, each a function of who is there: broad, boxes, spheres, oriented boxes, axes, narrow.

Every phase gives away only pairs that are certainly further apart than the margin: what it
leaves over is the next one's, and the last one decides. So a wider box or an older axis never
changes a contact.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.detection.choosing import broad_phase
from course.detection.hierarchy import BVH
from course.detection.world.members import ROUNDING, Members
from course.overlap import Contacts, contacts, nearest_points
from course.shapes import AABB

#: A compound's parts number their features from their own number times this, as ``course.overlap`` does.
PART = 2**40
#: Where more than this part of the boxes ask for partners, all pairs are found anew.
MANY = 0.1


def partners(
    members: Members, wide: Array, asking: BoolArray, margin: float
) -> IntArray:
    """Broad phase: the pairs of rows, one of them asking, whose wide boxes meet, (m, 2), i < j, in no order.

    Where most ask, as in a first frame, it is any broad phase over all boxes; where few do, a
    small tree of these is asked by all others. A half space is asked itself.

    Args:
        wide: (n, 6) [m], l and u, half a margin wider or more.
        asking: (n,).
        margin: the other half is added where a half space is asked [m].
    """
    plane = members.is_plane
    solid = np.flatnonzero(~plane)
    some = np.flatnonzero(asking & ~plane)
    boxes = AABB(wide[solid, :3], wide[solid, 3:])
    if some.size > MANY * solid.size:
        pairs = solid[broad_phase(boxes)]
        pairs = pairs[asking[pairs].any(axis=1)]
    elif some.size:
        tree = BVH.build(AABB(wide[some, :3], wide[some, 3:]), method="morton")
        q, e = tree.query(boxes).T
        pairs = np.column_stack([solid[q], some[e]])
        once = (pairs[:, 0] < pairs[:, 1]) | ~asking[pairs[:, 0]]
        pairs = pairs[once & (pairs[:, 0] != pairs[:, 1])]
    else:
        pairs = np.empty((0, 2), dtype=np.intp)
    reached = [pairs]
    for row in np.flatnonzero(plane):
        asked = solid if asking[row] else some
        rows = np.full(asked.size, row)
        near = asked[below(members, wide[asked], rows, 0.5 * max(margin, 0.0))]
        reached.append(np.column_stack([np.full(near.size, row), near]))
    return np.sort(np.concatenate(reached), axis=1)


def below(members: Members, box: Array, plane: IntArray, reach: float) -> BoolArray:
    """Which boxes (k, 6) come within a distance of a half space each: n.c - sum |n_i| e_i - o <= reach.

    Source: Ericson, *Real-Time Collision Detection*, section 5.2.3.
    """
    number = members.sort_number[plane[:1]]
    if not number.size:
        return np.zeros(0, dtype=bool)
    sort = members.shelf[plane[0]] * 2 + 1
    solid = members.shapes(int(sort), plane)
    with np.errstate(invalid="ignore"):
        middle, half = 0.5 * (box[:, :3] + box[:, 3:]), 0.5 * (box[:, 3:] - box[:, :3])
        low = np.sum(solid.normal * middle - np.abs(solid.normal) * half, axis=-1)
    rounding = ROUNDING * (np.abs(solid.offset) + np.abs(box).max(axis=1))
    return ~(low - solid.offset > reach + rounding)  # of an endless box it is NaN


def by_boxes(members: Members, pairs: IntArray, margin: float) -> BoolArray:
    """Which pairs' own boxes, each half a margin wider, meet; (m,)."""
    i, j = pairs.T
    more = 0.5 * max(margin, 0.0) + members.slack
    low, high = members.box[:, :3] - more[:, None], members.box[:, 3:] + more[:, None]
    meet = np.all((low[i] <= high[j]) & (low[j] <= high[i]), axis=1)
    plane = members.is_plane
    for k, other in ((i, j), (j, i)):
        some = np.flatnonzero(plane[k])
        box = np.concatenate([low[other[some]], high[other[some]]], axis=1)
        meet[some] &= below(members, box, k[some], 0.5 * max(margin, 0.0))
    return meet


def by_spheres(members: Members, pairs: IntArray, margin: float) -> BoolArray:
    """Which pairs' bounding spheres come within the margin: |c_i - c_j| <= r_i + r_j + margin; (m,)."""
    i, j = pairs.T
    center = members.coarse.now["center"]
    away = center[i] - center[j]
    reach = members.radius[i] + members.radius[j] + _reach(members, pairs, margin)
    return np.asarray(np.einsum("ki,ki->k", away, away) <= reach**2)


def by_oriented_boxes(members: Members, pairs: IntArray, margin: float) -> BoolArray:
    """Which pairs' boxes along their own axes come within the margin; (m,)."""
    from course.detection.world.coarse_loops import boxes_apart

    boxes = members.coarse.now
    apart = np.empty(len(pairs), dtype=bool)
    reach = _reach(members, pairs, margin)
    boxes_apart(boxes["center"], boxes["rotation"], boxes["half_extents"], pairs, reach, apart)  # fmt: skip
    return ~apart


def by_axes(members: Members, pairs: IntArray, axis: Array, margin: float) -> BoolArray:
    """Which pairs are no longer further apart than the margin along an axis N each (m, 3), out of j toward i; (m,).

    Apart by s = min over A of N.x - max over B of N.x, by the support of either (G. van den
    Bergen, *Collision Detection in Interactive 3D Environments*, section 4.3.2: separating
    axes are likely to separate in the next frame).
    """
    apart = np.empty(len(pairs))
    for _, some, a, b in alike(members, pairs):
        normal = axis[some]
        way = a.support(-normal) - b.support(normal)
        apart[some] = np.sum(normal * way, axis=-1)
    return apart <= _reach(members, pairs, margin)


def narrow(members: Members, pairs: IntArray, margin: float) -> tuple[Contacts, int]:
    """Narrow phase: the contacts of pairs of rows, ``pair`` counting these and growing, and how many calls it took.

    Bodies and handles are those of the rows; body A is the one with the lower handle.
    """
    parts: list[Contacts] = []
    calls = 0
    for _, some, a, b in alike(members, pairs):
        i, j = pairs[some].T
        bodies = members.body[i], members.body[j]
        found = contacts(a, b, margin=margin, body_a=bodies[0], body_b=bodies[1])
        calls += 1
        if not len(found):
            continue
        assert found.pair is not None and found.key is not None
        key = np.array(found.key)
        for side, row in enumerate((i[found.pair], j[found.pair])):
            key[:, side] = members.handle[row]
            key[:, 2 + side] += PART * members.part[row]
        changed = {"key": key, "pair": some[found.pair]}
        parts.append(Contacts.unchecked(**{**vars(found), **changed}))
    return by_pair(parts), calls


def axes_between(members: Members, pairs: IntArray, margin: float) -> Array:
    """The axis along which pairs are further apart than the margin, (m, 3); NaN where they are not."""
    axis = np.full((len(pairs), 3), np.nan)
    reach = _reach(members, pairs, margin)
    for _, some, a, b in alike(members, pairs):
        found = nearest_points(a, b)
        apart = found.gap > reach[some]
        axis[some[apart]] = found.normal[apart]
    return axis


def alike(
    members: Members, pairs: IntArray
) -> Iterator[tuple[int, IntArray, Any, Any]]:
    """The pairs (m, 2) by their two kinds: a number for these, which pairs, and their shapes where they are."""
    sort = members.sort_number
    first, second = sort[pairs[:, 0]], sort[pairs[:, 1]]
    code = first * (int(sort.max(initial=0)) + 1) + second
    order = np.argsort(code, kind="stable")
    for some in np.split(order, np.flatnonzero(np.diff(code[order])) + 1):
        if some.size:
            k = some[0]
            a = members.shapes(int(first[k]), pairs[some, 0])
            b = members.shapes(int(second[k]), pairs[some, 1])
            yield int(code[k]), some, a, b


def by_pair(parts: list[Contacts]) -> Contacts:
    """All contacts of some parts in the order of their ``pair``; those of pair -1 are left out.

    Copied once, whatever is left out: contacts are most of what a frame has to carry.
    """
    whole = Contacts.concatenate([*parts, none_found()])
    assert whole.pair is not None
    stay = np.flatnonzero(whole.pair >= 0)
    pair = whole.pair[stay]
    if np.any(pair[1:] < pair[:-1]):
        return whole[stay[np.argsort(pair, kind="stable")]]
    return whole if stay.size == len(whole) else whole[stay]


def none_found() -> Contacts:
    """Contacts of which there are none, with pairs and keys."""
    none = np.empty(0, dtype=np.intp)
    key = np.empty((0, 4), dtype=np.intp)
    empty = np.empty((0, 3))
    return Contacts(none, none, empty, empty, np.empty(0), pair=none, key=key)


def _reach(members: Members, pairs: IntArray, margin: float) -> Array:
    """The margin of each pair, and what rounding may do."""
    i, j = pairs.T
    return max(margin, 0.0) + members.slack[i] + members.slack[j]
