"""The questions asked of any two shapes: do they overlap, how far apart are they, where do they touch.

Two batches of shapes broadcast. Each pair of kinds is served by its row of
``course.overlap.pairs``; shapes that come the other way round change places there, and
what is found is told the other way round. A compound is asked part by part.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    BoolArray,
    IntArray,
    failure,
    indices,
    scalar,
    whole_number,
)
from course.overlap.arguments import checked, convex_parts
from course.overlap.contact_arrays import Contacts
from course.overlap.convex.closest import Closest
from course.overlap.convex.convex_pairs import numbers
from course.overlap.fewer_points import fewer, no_points
from course.overlap.pairs import PairTest, served
from course.shapes import Shape

#: A part's features are numbered from its own number times this.
PART = 2**40


def overlaps(a: Shape, b: Shape) -> BoolArray:
    """Whether two shapes overlap; those that touch do (syllabus row 10).

    ``overlaps(a, b)`` is ``gap(a, b) <= 0``, to rounding.

    Args:
        a, b: shapes of any kinds, whose batches broadcast.
    Returns:
        bool (...), of the broadcast batch.
    Raises:
        TypeError: what is no shape.
        ValueError: batches that do not fit, coordinates beyond 1e50.
    """
    batch = checked(a, b)
    verdict = np.zeros(batch, dtype=bool)
    for _, _, first, second in convex_parts(a, b):
        test, first, second, _ = served(first, second)
        if test.overlaps is not None:
            verdict |= test.overlaps(first, second)
        else:
            verdict |= _gap(test, first, second) <= 0
    return verdict[()]


def gap(a: Shape, b: Shape) -> Array:
    """The signed gap of two shapes: their distance, or less the least translation that parts them.

    d = (p_A - p_B).N (syllabus row 19). Where a compound penetrates it is the gap of
    the two parts that are deepest in one another: to part the whole may take a longer
    way, never a shorter one. Two half spaces have a gap only where they face each
    other, else it is -inf.

    Args:
        a, b: shapes of any kinds, whose batches broadcast.
    Returns:
        (...) [m], of the broadcast batch; above 0 apart, 0 touching, below 0 overlapping.
    Raises:
        as ``overlaps``.
    """
    least = np.full(checked(a, b), np.inf)
    for _, _, first, second in convex_parts(a, b):
        test, first, second, _ = served(first, second)
        np.minimum(least, _gap(test, first, second), out=least)
    return least[()]


def nearest_points(a: Shape, b: Shape) -> Closest:
    """The gap of two shapes, its direction out of B toward A, and the nearest points (``Closest``).

    Args:
        a, b: shapes of any kinds, whose batches broadcast; of compounds the parts whose
            gap is least tell it.
    Raises:
        as ``overlaps``; ValueError for half spaces that have no gap.
    """
    batch = checked(a, b)
    best: Closest | None = None
    for _, _, first, second in convex_parts(a, b):
        test, first, second, swapped = served(first, second)
        found = test.closest(first, second)
        found = (found.swapped() if swapped else found).broadcast_to(batch)
        best = found if best is None else best.nearer(found)
    assert best is not None
    if np.any(np.isinf(best.gap)):
        raise failure("b", "half spaces that face each other", "two without a gap")
    return best


def contacts(
    a: Shape,
    b: Shape,
    *,
    margin: float = 0.0,
    body_a: ArrayLike = 0,
    body_b: ArrayLike = 1,
    limit: int | None = None,
) -> Contacts:
    """The points at which two shapes touch, penetrate, or are within a margin of each other.

    N out of B toward A, d = (p_A - p_B).N (syllabus row 19). Round shapes touch at one
    point; what lies flat on something at the corners of what the two have in common, each
    with its own N and d. The least d of a pair is its gap, but for 1e-6 of the size where
    several directions are as good as each other.

    Args:
        a, b: shapes of any kinds, whose batches broadcast; body A and body B.
        margin: the greatest separation that counts [m].
        body_a, body_b: the bodies' numbers, ints that broadcast with the batch.
        limit: at most so many points a pair, the deepest and those that span most.
    Returns:
        the contacts in the order of the pairs; ``pair`` counts these through the broadcast
        batch in C order.
    Raises:
        TypeError: what is no shape.
        ValueError: batches or bodies that do not fit, a body against itself, a margin that
            is no number, coordinates beyond 1e50.
    """
    batch = checked(a, b)
    reach = scalar("margin", margin)
    most = None if limit is None else whole_number("limit", limit, minimum=1)
    ids = _bodies(body_a, body_b, batch)
    found = [
        _of_parts(_contacts(first, second, batch, reach, most), i, j)
        for i, j, first, second in convex_parts(a, b)
    ]
    whole = found[0]
    if len(found) > 1:
        whole = Contacts.concatenate(found)
        assert whole.pair is not None
        whole = fewer(whole[np.argsort(whole.pair, kind="stable")], most)
    return _named(whole, ids)


def _gap(test: PairTest, a: Shape, b: Shape) -> Array:
    return test.gap(a, b) if test.gap is not None else test.closest(a, b).gap


def _contacts(
    a: Shape, b: Shape, batch: tuple[int, ...], margin: float, limit: int | None
) -> Contacts:
    """The contacts of two shapes without parts, of body 0 with body 1; ``pair`` counts the batch."""
    test, first, second, swapped = served(a, b)
    count = int(np.prod(batch, dtype=np.intp))
    if test.all_contacts is not None and count:
        a, b = (x.broadcast_to(batch).reshaped(count) for x in (first, second))
        return test.all_contacts(a, b, margin, limit)  # of one kind, never swapped
    closest = test.closest(first, second).broadcast_to(batch).flat()
    rows = np.flatnonzero((closest.gap <= margin) & (closest.gap > -np.inf))
    if not rows.size:
        return no_points()
    a, b = (
        shape.reshaped(-1)[numbers(shape, batch).ravel()[rows]]
        for shape in (first, second)
    )
    found = test.contacts(a, b, closest[rows], margin, limit)
    assert found.pair is not None
    found = _with(found, pair=rows[found.pair])
    return _swapped(found) if swapped else found


def _swapped(found: Contacts) -> Contacts:
    """The same contacts with the other body as A."""
    assert found.feature is not None and found.key is not None
    face_a, face_b = found.feature == "face_a", found.feature == "face_b"
    feature = np.where(face_a, "face_b", np.where(face_b, "face_a", found.feature))
    return _with(
        found,
        normal=-found.normal,
        feature=feature,
        edge_a=found.edge_b,
        edge_b=found.edge_a,
        curvature_a=found.curvature_b,
        curvature_b=found.curvature_a,
        key=found.key[:, [1, 0, 3, 2]],
    )


def _of_parts(found: Contacts, i: int, j: int) -> Contacts:
    """Contacts of part i of A and part j of B: the parts are said in the keys."""
    if i == j == 0:
        return found
    assert found.key is not None
    parts = np.array([0, 0, i * PART, j * PART], dtype=np.intp)
    return _with(found, key=found.key + parts)


def _bodies(
    body_a: ArrayLike, body_b: ArrayLike, batch: tuple[int, ...]
) -> tuple[IntArray, IntArray]:
    """The bodies of every pair of the batch, in C order."""
    found = []
    for name, body in ("body_a", body_a), ("body_b", body_b):
        ids = indices(name, body)
        try:
            found.append(np.broadcast_to(ids, batch).ravel())
        except ValueError:
            expected = f"ints that broadcast to the batch {batch}"
            raise failure(name, expected, f"shape {ids.shape}") from None
    return found[0], found[1]


def _named(found: Contacts, bodies: tuple[IntArray, IntArray]) -> Contacts:
    """The same contacts, between the bodies of their pairs."""
    body_a, body_b = (ids[found.pair] for ids in bodies)
    if np.any(same := body_a == body_b):
        index = int(np.argmax(same))
        got = f"body {body_b[index]} twice"
        raise failure("body_b", "another body than body_a", got, (index,))
    return _with(found, body_a=body_a, body_b=body_b)


def _with(found: Contacts, **changes: Any) -> Contacts:
    """The same contacts with some fields changed, which are known to be good."""
    return Contacts.unchecked(**{**vars(found), **changes})
