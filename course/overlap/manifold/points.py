"""Contact points of pairs of rounded polytopes, in arrays that ``Contacts`` takes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.arrays import Array, ArrayLike, IntArray
from course.overlap.contact_arrays import FEATURES, Contacts
from course.overlap.convex.closest import as_solids
from course.shapes import Polytopes

#: Rows that are asked for at most at a time, if one pair does not need more.
ROWS = 1 << 20


@dataclass(frozen=True, eq=False)
class Manifolds:
    """c contact points of p pairs, pair by pair, each pair's in the order of its polygon.

    Attributes:
        pair: (c,) which of the pairs.
        feature_a, feature_b: (c,) which vertex, edge or face of A and of B: vertices are
            numbered first, then edges, then faces, as ``Polytopes`` has them.
        label: (c,) numbers of ``FEATURES``.
        numbers: (c, 15): point, normal, separation, e_A, e_B, and the curvature of each
            side: 1/r [1/m] all around, or across e where there is one.
    """

    pair: IntArray
    feature_a: IntArray
    feature_b: IntArray
    label: IntArray
    numbers: Array

    def contacts(
        self,
        *,
        body_a: ArrayLike,
        body_b: ArrayLike,
        handle_a: ArrayLike,
        handle_b: ArrayLike,
        pair: ArrayLike | None = None,
    ) -> Contacts:
        """The contacts, given the bodies and handles of each pair, (p,), and what to call the pairs."""
        which, numbers = self.pair, self.numbers
        crossing, curved = self.label == 2, self.label == 3
        optional: dict[str, Any] = {}
        if np.any(crossing):
            optional |= {"edge_a": numbers[:, 7:10].copy()}
            optional |= {"edge_b": numbers[:, 10:13].copy()}
        if np.any(curved):
            optional |= {"curvature_a": self._curvature(13, 7, curved)}
            optional |= {"curvature_b": self._curvature(14, 10, curved)}
        key = np.empty((which.size, 4), dtype=np.intp)
        key[:, 0], key[:, 1] = _each(handle_a, which), _each(handle_b, which)
        key[:, 2], key[:, 3] = self.feature_a, self.feature_b
        return Contacts.unchecked(
            body_a=_each(body_a, which),
            body_b=_each(body_b, which),
            point=numbers[:, :3].copy(),
            normal=numbers[:, 3:6].copy(),
            separation=numbers[:, 6].copy(),
            feature=np.array(FEATURES)[self.label],
            **optional,
            pair=which.copy() if pair is None else _each(pair, which),
            key=key,
        )

    def _curvature(self, curvature: int, edge: int, rows: NDArray[np.bool_]) -> Array:
        """K = (1 - N N' - e e')/r with the part of e at right angles to N; zero where not curved."""
        n, e = self.numbers[rows, 3:6], self.numbers[rows, edge : edge + 3]
        e = e - np.sum(e * n, axis=1, keepdims=True) * n
        length = np.linalg.norm(e, axis=1, keepdims=True)
        e = e / np.where(length > 0, length, 1.0)
        across = np.eye(3) - n[:, :, None] * n[:, None] - e[:, :, None] * e[:, None]
        tensor = np.zeros((len(rows), 3, 3))
        tensor[rows] = self.numbers[rows, curvature, None, None] * across
        return tensor


def contact_points(
    a: Polytopes,
    b: Polytopes,
    i: IntArray,
    j: IntArray,
    point: Array,
    normal: Array,
    gap: Array,
    *,
    margin: float = 0.0,
    limit: int | None = None,
) -> Manifolds:
    """The manifolds of p pairs of rounded polytopes whose gap is known.

    Args:
        a, b: the solids A and the solids B.
        i, j: (p,) which of a, which of b.
        point: (p, 3) halfway between the nearest points of both surfaces [m].
        normal: (p, 3) unit, out of B toward A, along which the gap was found.
        gap: (p,) [m]; pairs above the margin have no points.
        margin: greatest separation of a point [m]; the deepest of a pair stays anyhow.
        limit: at most so many points a pair (``thinning``); None keeps all.
    """
    from course.overlap.manifold.loops import manifolds
    from course.overlap.manifold.patches import desk

    found = np.column_stack([point, normal, gap])
    pairs = np.column_stack([i, j]).astype(np.intp, copy=False)
    room = desk(_largest_face(a), _largest_face(b))
    solids_a, solids_b = as_solids(a), as_solids(b)

    def fill(begin: int, names: IntArray, numbers: Array) -> tuple[int, int]:
        return manifolds(
            solids_a, solids_b, pairs, found, margin, limit or 0, begin, room, names,
            numbers,
        )  # fmt: skip

    return filled(fill, len(pairs), room.cut.shape[1])


def filled(
    fill: Callable[[int, IntArray, Array], tuple[int, int]], pairs: int, most: int
) -> Manifolds:
    """What a loop over pairs finds, a million rows at a time.

    Args:
        fill: from a pair on fills names (r, 8) and numbers (r, 15) as far as they go, and
            says which pair is next and how many rows are filled.
        pairs: how many there are.
        most: rows that a pair may need.
    """
    parts: list[tuple[IntArray, Array]] = []
    begin = 0
    while begin < pairs or not parts:
        rows = max(min(ROWS, most * (pairs - begin)), most)
        # What is not filled is never touched, so that it costs no memory.
        names, numbers = np.empty((rows, 8), dtype=np.intp), np.empty((rows, 15))
        begin, count = fill(begin, names, numbers)
        parts.append((names[:count], numbers[:count]))
    what, values = parts[0]
    if len(parts) > 1:
        what = np.concatenate([names for names, _ in parts])
        values = np.concatenate([numbers for _, numbers in parts])
    return Manifolds(what[:, 5], what[:, 6], what[:, 7], what[:, 0], values)


def _largest_face(solids: Polytopes) -> int:
    return int(np.diff(solids.loop_start).max(initial=2))


def _each(values: ArrayLike, which: IntArray) -> IntArray:
    return np.asarray(values, dtype=np.intp)[which]
