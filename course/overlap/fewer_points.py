"""At most so many contacts a pair, of points that are in no order: vertices on a plane, contacts of several parts.

(What one face has in common with another is a polygon, of which
``course.overlap.manifold.thinning`` keeps the most area.)
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray
from course.overlap.contact_arrays import Contacts

#: Lengths that differ by less, relative to the largest, are alike: the first is taken.
ALIKE = 1e-6


def no_points() -> Contacts:
    """Contacts of which there are none."""
    none = np.empty(0, dtype=np.intp)
    return Contacts(
        none,
        none,
        np.empty((0, 3)),
        np.empty((0, 3)),
        np.empty(0),
        pair=none,
        key=np.empty((0, 4), dtype=np.intp),
    )


def fewer(found: Contacts, limit: int | None) -> Contacts:
    """The contacts with at most ``limit`` of each pair: the deepest, then always the one farthest from those kept.

    (T. F. Gonzalez, "Clustering to minimize the maximum intercluster distance",
    Theoretical Computer Science 38, 1985.)

    Args:
        found: contacts whose ``pair`` never falls.
        limit: at least 1; None keeps all.
    """
    if limit is None or found.pair is None or not len(found):
        return found
    begin = np.flatnonzero(np.diff(found.pair, prepend=-1))
    end = np.append(begin[1:], len(found))
    if np.all(end - begin <= limit):
        return found
    kept = [
        np.arange(i, j) if j - i <= limit else i + spread(found.point[i:j], found.separation[i:j], limit)
        for i, j in zip(begin, end, strict=True)
    ]  # fmt: skip
    return found[np.concatenate(kept)]


def spread(point: Array, separation: Array, limit: int) -> IntArray:
    """Which of n points to keep, in their order.

    Args:
        point: (n, 3) [m].
        separation: (n,) [m].
        limit: how many, at most n.
    """
    size = np.abs(point - point[0]).max()
    chosen = [int(np.argmax(separation <= separation.min() + ALIKE * size))]
    away = np.full(len(point), np.inf)
    while len(chosen) < limit:
        way = point - point[chosen[-1]]
        away = np.minimum(away, np.einsum("ki,ki->k", way, way))
        away[chosen] = -1.0
        chosen.append(int(np.argmax(away >= away.max() * (1 - ALIKE))))
    return np.sort(np.array(chosen))
