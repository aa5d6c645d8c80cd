"""Any two convex bounded shapes, as rounded polytopes: their nearest points and their contacts."""

from __future__ import annotations

import numpy as np

from course.arrays import IntArray
from course.overlap.closest import Closest, closest_points
from course.overlap.contact_arrays import Contacts
from course.shapes import Shape, polytopes


def closest_convex(a: Shape, b: Shape) -> Closest:
    """The nearest points of two batches of convex bounded shapes, in their broadcast batch."""
    batch = np.broadcast_shapes(a.batch, b.batch)
    return closest_points(
        polytopes(a), polytopes(b), numbers(a, batch), numbers(b, batch)
    )


def numbers(shape: Shape, batch: tuple[int, ...]) -> IntArray:
    """Which shape of its own batch, counted in C order, stands at each place of a broadcast one."""
    own = np.arange(shape.count).reshape(shape.batch)
    return np.broadcast_to(own, batch)


def contacts_convex(a: Shape, b: Shape, near: Closest, margin: float) -> Contacts:
    """The contacts of k pairs of convex bounded shapes: the corners of what lies against what."""
    raise NotImplementedError
