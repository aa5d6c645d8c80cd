"""Any two convex bounded shapes, as rounded polytopes: their nearest points and their contacts."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import IntArray
from course.overlap.closest import Closest, closest_points
from course.overlap.contact_arrays import Contacts
from course.overlap.separating_axis import as_kernels_take_it
from course.shapes import Polytopes, Shape, polytopes


def closest_convex(a: Shape, b: Shape) -> Closest:
    """The nearest points of two batches of convex bounded shapes, in their broadcast batch."""
    batch = np.broadcast_shapes(a.batch, b.batch)
    if 0 in batch:
        return Closest(np.empty(batch), *np.empty((3, *batch, 3)))
    return closest_points(
        polytopes(a), polytopes(b), numbers(a, batch), numbers(b, batch)
    )


def numbers(shape: Shape, batch: tuple[int, ...]) -> IntArray:
    """Which shape of its own batch, counted in C order, stands at each place of a broadcast one."""
    own = np.arange(shape.count).reshape(shape.batch)
    return np.broadcast_to(own, batch)


def contacts_convex(
    a: Shape, b: Shape, near: Closest, margin: float, limit: int | None
) -> Contacts:
    """The contacts of k pairs of convex bounded shapes: the corners of what lies against what."""
    from course.overlap.manifold.points import contact_points

    count = len(near.normal)
    each, body = np.arange(count), np.zeros(count, dtype=np.intp)
    point = 0.5 * (near.point_a + near.point_b)
    solids = _solids(polytopes(a)), _solids(polytopes(b))
    found = contact_points(
        *solids, each, each, point, near.normal, near.gap, margin=margin, limit=limit
    )
    return found.contacts(body_a=body, body_b=body + 1, handle_a=body, handle_b=body)


def _solids(solids: Polytopes) -> Any:
    """The arrays of polytopes as the loops over manifolds take them."""
    from course.overlap.manifold.patches import Solids

    return Solids(*(as_kernels_take_it(getattr(solids, f)) for f in Solids._fields))
