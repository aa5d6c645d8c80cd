"""Half spaces: against any bounded shape by its support, against each other only where they face each other."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from course.arrays import Array
from course.overlap.contact_arrays import Contacts
from course.overlap.convex.closest import Closest
from course.overlap.curved.curvature import of_sphere
from course.overlap.curved.curved_contacts import END, START, curved
from course.overlap.fewer_points import fewer, no_points
from course.shapes import Capsule, HalfSpace, Shape, Sphere, polytopes

#: Normals that add up to less than this are opposite to each other, but for rounding.
OPPOSITE = 1e-12
#: What differs by less is level: in sizes of the shape, and in its largest coordinate.
LEVEL, ROUNDING = 1e-9, 32 * 2.0**-52


class Bounded(Protocol):
    """A shape with a farthest point in every direction."""

    def support(self, direction: Array) -> Array:
        """The point farthest along a direction, (..., 3) [m]."""
        ...


def closest_to_half_space(a: Bounded, b: HalfSpace) -> Closest:
    """The nearest points of a bounded shape and a half space n.x <= o.

    p_A is the support of A along -n, N = n, d = n.p_A - o (C. Ericson, *Real-Time
    Collision Detection*, sections 5.2.2 and 5.2.3).
    """
    point = a.support(-b.normal)
    gap = np.einsum("...i,...i", point, b.normal) - b.offset
    return Closest(
        gap=gap,
        normal=np.broadcast_to(b.normal, point.shape),
        point_a=point,
        point_b=point - gap[..., None] * b.normal,
    )


def closest_half_spaces(a: HalfSpace, b: HalfSpace) -> Closest:
    """Two half spaces: the gap is -inf unless their normals are opposite.

    Planes that are not parallel meet, and no translation parts the half spaces; nor
    does one where the normals agree. Facing each other, A is n.x <= o_A and B is
    n.x >= -o_B, so d = -o_A - o_B.
    """
    facing = np.linalg.norm(a.normal + b.normal, axis=-1) <= OPPOSITE
    gap = np.where(facing, -(a.offset + b.offset), -np.inf)
    point = np.broadcast_to(b.offset[..., None] * b.normal, (*gap.shape, 3))
    way = np.where(facing, gap, 0.0)[..., None] * b.normal
    return Closest(gap, np.broadcast_to(b.normal, point.shape), point + way, point)


def contacts_of_sphere(
    a: Sphere, b: HalfSpace, near: Closest, margin: float, limit: int | None
) -> Contacts:
    """The contact of each of k pairs of a sphere and a half space."""
    none = np.zeros(len(near.normal), dtype=np.intp)
    tensors = of_sphere(a.radius, near.normal), np.zeros((none.size, 3, 3))
    return curved(near, tensors, (none, none))


def level_with(near: Closest, size: Array, margin: float) -> Array:
    """The height up to which points count, (k,) [m]: the margin, and in any case what is level with the lowest.

    Else of four legs on a floor those would be left out that rounding lifts.
    """
    largest = np.abs(near.point_a).max(axis=-1, initial=0.0)
    alike = near.gap + LEVEL * size + ROUNDING * largest
    return np.maximum(margin, alike)


def contacts_of_capsule(
    a: Capsule, b: HalfSpace, near: Closest, margin: float, limit: int | None
) -> Contacts:
    """The ends of capsules that are within the margin of their half spaces, as spheres.

    Of one that stands on an end, that one; of one that lies, both.
    """
    length = np.linalg.norm(a.end - a.start, axis=-1)
    level = level_with(near, length + a.radius, margin)
    found: list[Any] = []
    for feature, center in (START, a.start), (END, a.end):
        ball = Sphere(center, a.radius)
        below = closest_to_half_space(ball, b)
        other = (feature == START) | (length > 0)  # one that is a sphere has one end
        rows = np.flatnonzero((below.gap <= level) & other)
        some = contacts_of_sphere(ball[rows], b[rows], below[rows], margin, None)
        key = np.array(some.key)
        key[:, 2] = feature
        found.append(replace(some, pair=rows, key=key))
    both, pair = Contacts.concatenate(found), np.concatenate([c.pair for c in found])
    return fewer(both[np.argsort(pair, kind="stable")], limit)


def contacts_of_polytope(
    a: Shape, b: HalfSpace, near: Closest, margin: float, limit: int | None
) -> Contacts:
    """The vertices of boxes, k-DOPs and hulls that are within the margin of their half spaces."""
    solids = polytopes(a)
    pair = np.repeat(np.arange(len(solids)), np.diff(solids.vertex_start))
    normal = b.normal[pair]
    height = np.einsum("ki,ki->k", solids.vertices, normal) - b.offset[pair]
    far = np.linalg.norm(solids.vertices - near.point_a[pair], axis=-1)
    size = np.maximum.reduceat(far, solids.vertex_start[:-1])
    which = np.flatnonzero(height <= level_with(near, size, margin)[pair])
    pair, normal, height = pair[which], normal[which], height[which]
    none = np.zeros_like(pair)
    found = Contacts(
        body_a=none,
        body_b=none + 1,
        point=solids.vertices[which] - 0.5 * height[:, None] * normal,
        normal=normal,
        separation=height,
        feature=np.full(pair.size, "face_b"),
        pair=pair,
        key=np.stack([none, none, which - solids.vertex_start[pair], none], axis=1),
    )
    return fewer(found, limit)


def no_contacts(
    a: HalfSpace, b: HalfSpace, near: Closest, margin: float, limit: int | None
) -> Contacts:
    """None: what two half spaces have in common has no end."""
    return no_points()
