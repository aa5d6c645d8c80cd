"""Contact points of pairs of rounded polytopes, in arrays that ``Contacts`` takes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from course.arrays import Array, ArrayLike, IntArray
from course.overlap.contact_arrays import FEATURES, Contacts

if TYPE_CHECKING:
    from course.overlap.manifold.patches import Solids

#: Rows that are filled at a time; more where one pair needs more.
ROWS = 1 << 13


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
            optional |= {"edge_a": numbers[:, 7:10], "edge_b": numbers[:, 10:13]}
        if np.any(curved):
            optional |= {
                "curvature_a": self._curvature(13, 7, curved),
                "curvature_b": self._curvature(14, 10, curved),
            }
        columns = [np.asarray(handle_a)[which], np.asarray(handle_b)[which],
                   self.feature_a, self.feature_b]  # fmt: skip
        return Contacts(
            np.asarray(body_a)[which],
            np.asarray(body_b)[which],
            numbers[:, :3],
            numbers[:, 3:6],
            numbers[:, 6],
            np.array(FEATURES)[self.label],
            **optional,
            pair=which if pair is None else np.asarray(pair)[which],
            key=np.stack(columns, axis=1),
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
    a: Solids,
    b: Solids,
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
    rows = max(ROWS, room.cut.shape[1])
    names, numbers = np.empty((rows, 8), dtype=np.intp), np.empty((rows, 15))
    parts, begin = [], 0
    while begin < len(pairs) or not parts:
        begin, count = manifolds(
            a, b, pairs, found, margin, limit or 0, begin, room, names, numbers
        )
        parts.append((names[:count].copy(), numbers[:count].copy()))
    what = np.concatenate([part[0] for part in parts])
    return Manifolds(what[:, 5], what[:, 6], what[:, 7], what[:, 0],
                     np.concatenate([part[1] for part in parts]))  # fmt: skip


def _largest_face(solids: Solids) -> int:
    return int(np.diff(solids.loop_start).max(initial=2))
