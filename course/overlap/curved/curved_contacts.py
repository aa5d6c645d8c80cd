"""The one contact of a sphere with a sphere or a capsule, and its curvature on both sides."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.overlap.contact_arrays import Contacts
from course.overlap.convex.closest import Closest
from course.overlap.curved.capsules import parameter
from course.overlap.curved.curvature import of_capsule, of_sphere
from course.shapes import Capsule, Sphere

#: Parts of a capsule's segment below this are none.
SMALL = 1e-9
#: The features of a capsule, as they are numbered in keys: its ends, and its side.
START, END, SIDE = 0, 1, 2
#: How much of its radius of curvature a surface may be sunk, to be called curved.
DEEPEST = 0.999


def curved(
    near: Closest,
    curvature: tuple[Array, Array],
    features: tuple[IntArray, IntArray],
) -> Contacts:
    """k contacts of body 0 with body 1: "curved", unless one surface is sunk as deep as it is round.

    How the point then moves over both is no question any more, and the normal counts as
    carried by B, as in ``course.overlap.manifold``.

    Args:
        near: the points, (k, ...).
        curvature: tensors of A and B, (k, 3, 3) [1/m].
        features: what of A and B touches, (k,).
    """
    rows = np.arange(len(near.normal))
    none = np.zeros_like(rows)
    sunk = -near.gap * flatter(*curvature) >= DEEPEST
    return Contacts.unchecked(
        body_a=none,
        body_b=none + 1,
        point=near.point_b + 0.5 * near.gap[:, None] * near.normal,
        normal=near.normal,
        separation=near.gap,
        feature=np.where(sunk, "face_b", "curved"),
        curvature_a=curvature[0],
        curvature_b=curvature[1],
        pair=rows,
        key=np.stack([none, none, *features], axis=1),
    )


def flatter(curvature_a: Array, curvature_b: Array) -> Array:
    """The greatest curvature of the flatter side of each contact, (k,) [1/m]."""
    a, b = (np.abs(k).max(axis=(-2, -1)) for k in (curvature_a, curvature_b))
    return np.minimum(a, b)


def contacts_of_spheres(
    a: Sphere, b: Sphere, near: Closest, margin: float, limit: int | None
) -> Contacts:
    """The contact of each of k pairs of spheres, at their nearest points."""
    tensors = of_sphere(a.radius, near.normal), of_sphere(b.radius, near.normal)
    none = np.zeros(len(near.normal), dtype=np.intp)
    return curved(near, tensors, (none, none))


def contacts_of_sphere_capsule(
    a: Sphere, b: Capsule, near: Closest, margin: float, limit: int | None
) -> Contacts:
    """The contact of each of k pairs of a sphere and a capsule, at their nearest points."""
    way = b.end - b.start
    t = parameter(a.center - b.start, way)
    feature, at_end = on_capsule(t)
    tensors = (
        of_sphere(a.radius, near.normal),
        of_capsule(b.radius, way, near.normal, at_end),
    )
    return curved(near, tensors, (np.zeros_like(feature), feature))


def on_capsule(t: Array) -> tuple[IntArray, BoolArray]:
    """The feature at a part t of the segment, and whether it is an end."""
    feature = np.where(t <= SMALL, START, np.where(t >= 1 - SMALL, END, SIDE))
    return feature, feature != SIDE
