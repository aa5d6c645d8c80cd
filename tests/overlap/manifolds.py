"""Manifolds of two batches of shapes, as the doors put them together, and shapes to ask for."""

from dataclasses import fields

import numpy as np

from course import rotations
from course.overlap import Contacts
from course.overlap.convex.closest import closest_points
from course.overlap.manifold.points import contact_points
from course.shapes import OBB, ConvexHull
from course.shapes.rounded_polytopes import polytopes

TURNED = rotations.to_matrix(np.array([0.1, 0.5, -0.3, 0.8]) / np.sqrt(0.99))


def touching(a, b, *, margin=0.0, limit=None):
    """The contacts of a[k] with b[k], whose handles are 10 and 20."""
    p, q = polytopes(a), polytopes(b)
    each, zero = np.arange(len(p)), np.zeros(len(p), dtype=int)
    near = closest_points(p, q, each, each)
    found = contact_points(
        p, q, each, each, 0.5 * (near.point_a + near.point_b),
        near.normal, near.gap, margin=margin, limit=limit,
    )  # fmt: skip
    contacts = found.contacts(
        body_a=zero, body_b=zero + 1, handle_a=zero + 10, handle_b=zero + 20
    )
    # The loops' arrays are not checked when contacts are made of them: here they are.
    return Contacts(*(getattr(contacts, f.name) for f in fields(Contacts)))


def box(center, half, turn=0.0, base=None, away=(0.0, 0.0, 0.0)):
    """One box, turned about z, then all by a rotation (none if not given), then moved."""
    base = np.eye(3) if base is None else base
    about = rotations.to_matrix(
        rotations.from_rotation_vector(np.array([0.0, 0.0, turn]))
    )
    centre = base @ np.asarray(center, dtype=float) + away
    return OBB(centre[None], (base @ about)[None], np.asarray(half, dtype=float)[None])


def prism(polygon, low, high, base=None):
    """A hull with the polygon, (k, 2), below and above."""
    base = np.eye(3) if base is None else base
    ends = [np.column_stack([polygon, np.full(len(polygon), z)]) for z in (low, high)]
    return ConvexHull((np.concatenate(ends) @ base.T)[None])


def regular(corners, radius=1.0, turn=0.0):
    """The corners of a regular polygon, (k, 2)."""
    angle = turn + 2 * np.pi * np.arange(corners) / corners
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def polygon_area(point, normal):
    """The area of a polygon with these corners in order, (k, 3)."""
    arm = point - point[0]
    return 0.5 * abs(np.sum(np.cross(arm, np.roll(arm, -1, axis=0)) @ normal))
