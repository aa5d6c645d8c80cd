"""Boxes: upright ones against each other, and any box against a sphere."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike, BoolArray, broadcast, non_negative, vectors
from course.overlap.convex.closest import Closest
from course.overlap.directions import directed
from course.shapes import AABB, OBB, Sphere


def boxes_overlap(
    lower_a: ArrayLike, upper_a: ArrayLike, lower_b: ArrayLike, upper_b: ArrayLike
) -> BoolArray:
    """Whether two axis-aligned boxes overlap: their shadows do on all three axes.

    l_A <= u_B and l_B <= u_A in x, y and z   (C. Ericson, *Real-Time Collision
    Detection*, section 4.2.1; syllabus row 11)

    Args:
        lower_a, upper_a, lower_b, upper_b: (..., 3) [m]; infinite where a box has no end.
    Returns:
        bool (...).
    """
    l_a = vectors("lower_a", lower_a, infinite=True)
    u_a = vectors("upper_a", upper_a, infinite=True)
    l_b = vectors("lower_b", lower_b, infinite=True)
    u_b = vectors("upper_b", upper_b, infinite=True)
    broadcast(lower_a=(l_a, 1), upper_a=(u_a, 1), lower_b=(l_b, 1), upper_b=(u_b, 1))
    return upright_boxes_overlap(AABB(l_a, u_a), AABB(l_b, u_b))


def upright_boxes_overlap(a: AABB, b: AABB) -> BoolArray:
    """Whether two axis-aligned boxes overlap, (...)."""
    return np.asarray(np.all((a.lower <= b.upper) & (b.lower <= a.upper), axis=-1))


def closest_upright_boxes(a: AABB, b: AABB) -> Closest:
    """The nearest points of two axis-aligned boxes, or the least translation that parts them.

    On each axis the gap is the larger of l_A - u_B (A beyond B, N = +) and l_B - u_A
    (N = -). Apart, d is the length of the vector of the gaps above 0 (Ericson, section
    5.1.3, of two boxes instead of a box and a point); overlapping, every gap is at or
    below 0 and the largest is d. On the other axes both points lie in the middle of
    what the boxes have in common.
    """
    after, before = a.lower - b.upper, b.lower - a.upper
    side = np.where(after >= before, 1.0, -1.0)
    gaps = np.maximum(after, before)
    axis = np.argmax(gaps, axis=-1)
    least = side * np.eye(3)[axis]
    distance, normal = directed(side * np.maximum(gaps, 0.0), least)
    gap = np.where(distance > 0, distance, np.max(gaps, axis=-1))
    low, high = np.maximum(a.lower, b.lower), np.minimum(a.upper, b.upper)
    middle = low + 0.5 * (high - low)
    facing = normal != 0
    return Closest(
        gap=gap,
        normal=normal,
        point_a=np.where(facing, np.where(side > 0, a.lower, a.upper), middle),
        point_b=np.where(facing, np.where(side > 0, b.upper, b.lower), middle),
    )


def sphere_box_gap(
    center: ArrayLike, radius: ArrayLike, lower: ArrayLike, upper: ArrayLike
) -> Array:
    """Signed gap of a sphere and an axis-aligned box, also with the centre inside.

    Outside d = |x - clamp(x, l, u)| - r (Ericson, sections 5.1.3 and 5.2.5); inside
    d = -(inset + r), the inset being the way to the nearest face.

    Args:
        center: x, (..., 3) [m].
        radius: r, (...) [m].
        lower, upper: l and u, (..., 3) [m].
    Returns:
        (...) [m]; below 0 they overlap.
    """
    x, r = vectors("center", center), non_negative("radius", radius)
    l, u = vectors("lower", lower), vectors("upper", upper)  # noqa: E741
    broadcast(center=(x, 1), radius=(r, 0), lower=(l, 1), upper=(u, 1))
    return closest_sphere_upright_box(Sphere(x, r), AABB(l, u)).gap


def to_box(x: Array, lower: Array, upper: Array) -> tuple[Array, Array, Array]:
    """Signed distance of a point to a box, the unit vector out of the box, the nearest point of its surface.

    Inside, the nearest face's; (...), (..., 3) and (..., 3).
    """
    nearest = np.clip(x, lower, upper)
    below, above = x - lower, upper - x
    inset = np.minimum(below, above)
    face = np.eye(3)[np.argmin(inset, axis=-1)]
    outward = np.where(above <= below, 1.0, -1.0) * face
    distance, normal = directed(x - nearest, outward)
    inside = distance == 0
    surface = np.where(face > 0, np.where(above <= below, upper, lower), nearest)
    return (
        np.where(inside, -np.min(inset, axis=-1), distance),
        normal,
        np.where(inside[..., None], surface, nearest),
    )


def closest_sphere_upright_box(a: Sphere, b: AABB) -> Closest:
    """The nearest points of a sphere and an axis-aligned box."""
    distance, normal, surface = to_box(a.center, b.lower, b.upper)
    return Closest(
        gap=distance - a.radius,
        normal=normal,
        point_a=a.center - a.radius[..., None] * normal,
        point_b=surface,
    )


def closest_sphere_box(a: Sphere, b: OBB) -> Closest:
    """The nearest points of a sphere and an oriented box: those of an upright one, in the box's own axes.

    x' = R'(x - c), lower and upper -e and e (Ericson, sections 5.1.4 and 5.2.6).
    """
    own = np.einsum("...ji,...j", b.rotation, a.center - b.center)
    distance, normal, surface = to_box(own, -b.half_extents, b.half_extents)
    normal = np.einsum("...ij,...j", b.rotation, normal)
    return Closest(
        gap=distance - a.radius,
        normal=normal,
        point_a=a.center - a.radius[..., None] * normal,
        point_b=b.center + np.einsum("...ij,...j", b.rotation, surface),
    )
