"""Any two convex bounded shapes, as rounded polytopes: their nearest points and their contacts."""

from __future__ import annotations

import numpy as np

from course.arrays import IntArray
from course.overlap.closest import Closest, as_solids, closest_points
from course.overlap.contact_arrays import Contacts
from course.overlap.manifold.box_points import box_contact_points
from course.overlap.manifold.points import Manifolds, contact_points
from course.shapes import OBB, Shape, polytopes


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
    each = np.arange(len(near.normal))
    point = 0.5 * (near.point_a + near.point_b)
    solids = as_solids(polytopes(a)), as_solids(polytopes(b))
    found = contact_points(
        *solids, each, each, point, near.normal, near.gap, margin=margin, limit=limit
    )
    return _between_two(found, each.size)


def contacts_of_boxes(a: OBB, b: OBB, margin: float, limit: int | None) -> Contacts:
    """The same of k pairs of oriented boxes, with their nearest points in one loop."""
    return _between_two(box_contact_points(a, b, margin=margin, limit=limit), a.count)


def _between_two(found: Manifolds, count: int) -> Contacts:
    """Contacts of body 0 with body 1, of shapes without handles."""
    none = np.zeros(count, dtype=np.intp)
    return found.contacts(body_a=none, body_b=none + 1, handle_a=none, handle_b=none)
