"""Contact points of pairs of oriented boxes, the fast way."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray
from course.overlap.convex.closest import closest_points
from course.overlap.convex.separating_axis import as_kernels_take_it
from course.overlap.manifold.points import Manifolds, contact_points, filled
from course.shapes import OBB, polytopes

#: What goes through the loops at once when pairs are put back in order.
COLUMNS = ("pair", "feature_a", "feature_b", "label", "numbers")


def box_contact_points(
    a: OBB, b: OBB, *, margin: float = 0.0, limit: int | None = None
) -> Manifolds:
    """The manifolds of p pairs of boxes, a[k] with b[k]: those that ``contact_points`` finds.

    Boxes that overlap by more than rounding go through a loop of their own
    (``box_loops``); for the others, for those without thickness, and where
    that loop finds nothing, the nearest points are found first.

    Args:
        a, b: p boxes each.
        margin, limit: as in ``contact_points``.
    """
    from course.overlap.manifold.box_loops import box_manifolds
    from course.overlap.manifold.patches import desk

    solid = np.all(a.half_extents > 0, axis=1) & np.all(b.half_extents > 0, axis=1)
    if not np.all(solid):
        return _by_nearest_points(a, b, np.arange(a.count), margin, limit)
    center_a, axes_a, half_a = map(as_kernels_take_it, _arrays(a))
    center_b, axes_b, half_b = map(as_kernels_take_it, _arrays(b))
    left, room = np.zeros(a.count, dtype=np.bool_), desk(4, 4)

    def fill(begin: int, names: IntArray, numbers: Array) -> tuple[int, int]:
        return box_manifolds(
            center_a, axes_a, half_a, center_b, axes_b, half_b,
            margin, limit or 0, begin, room, names, numbers, left,
        )  # fmt: skip

    found = filled(fill, a.count, room.cut.shape[1])
    if not np.any(left):
        return found
    return _joined(found, _by_nearest_points(a, b, np.flatnonzero(left), margin, limit))


def _arrays(box: OBB) -> tuple[Array, Array, Array]:
    return box.center, box.rotation, box.half_extents


def _by_nearest_points(
    a: OBB, b: OBB, which: IntArray, margin: float, limit: int | None
) -> Manifolds:
    p, q, each = polytopes(a[which]), polytopes(b[which]), np.arange(which.size)
    near = closest_points(p, q, each, each)
    found = contact_points(
        p, q, each, each, 0.5 * (near.point_a + near.point_b),
        near.normal, near.gap, margin=margin, limit=limit,
    )  # fmt: skip
    return Manifolds(
        which[found.pair], found.feature_a, found.feature_b, found.label, found.numbers
    )


def _joined(one: Manifolds, other: Manifolds) -> Manifolds:
    """Both, pair by pair."""
    order = np.argsort(np.concatenate([one.pair, other.pair]), kind="stable")
    both = (
        np.concatenate([getattr(one, c), getattr(other, c)])[order] for c in COLUMNS
    )
    return Manifolds(*both)
