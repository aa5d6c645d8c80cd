"""Any two convex bounded shapes, as rounded polytopes: their nearest points and their contacts."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray
from course.overlap.contact_arrays import Contacts
from course.overlap.convex.closest import Closest, as_solids, closest_points
from course.overlap.convex.separating_axis import as_kernels_take_it
from course.overlap.manifold.box_points import box_contact_points
from course.overlap.manifold.points import Manifolds, contact_points
from course.shapes import OBB, Shape, cores, polytopes


def closest_convex(a: Shape, b: Shape) -> Closest:
    """The nearest points of two batches of convex bounded shapes, in their broadcast batch.

    First those that GJK and EPA are sure of by their points alone; faces and edges are
    found for the others only.
    """
    from course.overlap.convex.closest_loops import pairs_by_points

    batch = np.broadcast_shapes(a.batch, b.batch)
    if 0 in batch:
        return Closest(np.empty(batch), *np.empty((3, *batch, 3)))
    i, j = (as_kernels_take_it(numbers(s, batch).ravel()) for s in (a, b))
    gap, apart = np.empty(i.size), np.empty((3, i.size, 3))
    pairs_by_points(*_points(a), *_points(b), i, j, gap, *apart)
    left = np.flatnonzero(np.isnan(gap))
    if left.size:
        (some_a, p), (some_b, q) = _some(a, i[left]), _some(b, j[left])
        found = closest_points(polytopes(some_a), polytopes(some_b), p, q)
        gap[left] = found.gap
        apart[:, left] = found.normal, found.point_a, found.point_b
    return Closest(gap.reshape(batch), *apart.reshape(3, *batch, 3))


def _points(shape: Shape) -> tuple[Array, IntArray, Array]:
    """Points whose hull each solid's core is, (m n, 3), where those of each begin, its radius."""
    points, radius = cores(shape)
    start = np.arange(len(points) + 1) * points.shape[1]
    return as_kernels_take_it(points.reshape(-1, 3)), as_kernels_take_it(start), as_kernels_take_it(radius)  # fmt: skip


def _some(shape: Shape, which: IntArray) -> tuple[Shape, IntArray]:
    """Each of the shapes once, and where it stands for every one of ``which``."""
    once, place = np.unique(which, return_inverse=True)
    return shape.reshaped(shape.count)[once], place


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
