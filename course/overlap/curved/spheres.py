"""Spheres against one another: verdict, gap, nearest points; the contacts of many, with the curvature of both sides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    BoolArray,
    broadcast,
    failure,
    non_negative,
    positive,
    scalars,
    vectors,
)
from course.overlap.contact_arrays import Contacts
from course.overlap.convex.closest import Closest
from course.overlap.directions import UP, directed
from course.shapes import Sphere


def spheres_overlap(
    center_a: ArrayLike, radius_a: ArrayLike, center_b: ArrayLike, radius_b: ArrayLike
) -> BoolArray:
    """Whether two spheres overlap, without a square root.

    |x_A - x_B|^2 <= (r_A + r_B)^2 (C. Ericson, *Real-Time Collision Detection*, section
    4.3.1; syllabus row 9). Closed spheres: those that touch overlap.

    Args:
        center_a, center_b: (..., 3) [m].
        radius_a, radius_b: at or above 0, (...) [m]; 0 is a point.
    Returns:
        bool (...).
    """
    x_a, x_b = vectors("center_a", center_a), vectors("center_b", center_b)
    r_a, r_b = non_negative("radius_a", radius_a), non_negative("radius_b", radius_b)
    broadcast(
        center_a=(x_a, 1), radius_a=(r_a, 0), center_b=(x_b, 1), radius_b=(r_b, 0)
    )
    return _squares_overlap(x_a - x_b, r_a + r_b)


def _squares_overlap(apart: Array, reach: Array) -> BoolArray:
    return np.asarray(np.einsum("...i,...i", apart, apart) <= reach * reach)


def two_spheres_overlap(a: Sphere, b: Sphere) -> BoolArray:
    """Whether two spheres overlap, (...)."""
    return _squares_overlap(a.center - b.center, a.radius + b.radius)


def two_spheres_gap(a: Sphere, b: Sphere) -> Array:
    """d = |x_A - x_B| - r_A - r_B, (...) [m]."""
    apart = a.center - b.center
    distance = np.sqrt(np.einsum("...i,...i", apart, apart))
    return np.asarray(distance - (a.radius + b.radius))


def closest_spheres(a: Sphere, b: Sphere) -> Closest:
    """The nearest points of two spheres: N along x_A - x_B, upward where both have one centre.

    d = |x_A - x_B| - r_A - r_B,  p_A = x_A - r_A N,  p_B = x_B + r_B N
    (Ericson, section 4.3.1)
    """
    distance, normal = directed(a.center - b.center, UP)
    return Closest(
        gap=distance - (a.radius + b.radius),
        normal=normal,
        point_a=a.center - a.radius[..., None] * normal,
        point_b=b.center + b.radius[..., None] * normal,
    )


def sphere_contacts(
    center: ArrayLike, radius: ArrayLike, *, margin: float = 1e-9
) -> Contacts:
    """All pairs of spheres within a margin, i < j, body A the one with the lower number.

    d = |x_A - x_B| - r_A - r_B, N along x_A - x_B (C. Ericson, *Real-Time Collision
    Detection*, section 4.3.1); the curvature of each side is (1 - N N')/r.

    Args:
        center: (n, 3) [m].
        radius: one or (n,) [m].
        margin: greatest separation that counts as touching [m].
    Raises:
        ValueError: two centres in one place, a radius that is not positive.
    """
    from scipy.spatial import cKDTree

    x = vectors("center", center)
    r = np.broadcast_to(positive("radius", radius), x.shape[:1])
    reach = (2 * r.max(initial=0.0) + margin) * (1 + 1e-9)
    pairs = cKDTree(x).query_pairs(reach, output_type="ndarray").reshape(-1, 2)
    a, b = pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))].T
    apart = x[a] - x[b]
    distance = np.sqrt(np.sum(apart**2, axis=-1))
    gap = distance - r[a] - r[b]
    near = gap <= margin
    a, b, apart, distance, gap = (v[near] for v in (a, b, apart, distance, gap))
    if np.any(distance == 0):
        raise failure("center", "centres apart from each other", "two equal ones")
    normal = apart / distance[:, None]
    tangent = np.eye(3) - normal[:, :, None] * normal[:, None, :]
    return Contacts(
        body_a=a,
        body_b=b,
        point=x[a] - (r[a] + 0.5 * gap)[:, None] * normal,
        normal=normal,
        separation=gap,
        feature=np.full(a.size, "curved"),
        curvature_a=tangent / r[a, None, None],
        curvature_b=tangent / r[b, None, None],
    )


def sphere_plane_contacts(
    center: ArrayLike,
    radius: ArrayLike,
    normal: ArrayLike,
    offset: ArrayLike,
    *,
    margin: float = 1e-9,
    body_b: int | None = None,
) -> Contacts:
    """Spheres on half spaces that are solid where normal.x <= offset, plane by plane.

    d = normal.x - offset - r (C. Ericson, *Real-Time Collision Detection*, section
    5.2.2). The spheres are bodies A, all planes belong to one body B.

    Args:
        center: (n, 3) [m].
        radius: one or (n,) [m].
        normal: (p, 3) unit vectors out of the solids.
        offset: (p,) [m].
        margin: greatest separation that counts as touching [m].
        body_b: the body of the planes; n, the one after the spheres, if not given.
    """
    x = vectors("center", center)
    r = np.broadcast_to(positive("radius", radius), x.shape[:1])
    out, level = vectors("normal", normal), scalars("offset", offset)
    height = out @ x.T - level[:, None] - r
    plane, sphere = np.nonzero(height <= margin)
    gap, n = height[plane, sphere], out[plane]
    tangent = np.eye(3) - n[:, :, None] * n[:, None, :]
    return Contacts(
        body_a=sphere,
        body_b=np.full(sphere.size, len(x) if body_b is None else body_b),
        point=x[sphere] - (r[sphere] + 0.5 * gap)[:, None] * n,
        normal=n,
        separation=gap,
        feature=np.full(sphere.size, "curved"),
        curvature_a=tangent / r[sphere, None, None],
        curvature_b=np.zeros((sphere.size, 3, 3)),
    )


@dataclass(frozen=True, eq=False)
class Spheres:
    """Spheres about the centres of mass of the first bodies, with planes of one more body.

    Args:
        radius: (n,) [m].
        normal, offset: of the planes, (p, 3) and (p,) [m]; none if not given.
        margin: greatest separation that counts as touching [m].
    """

    radius: Array
    normal: Array | None = None
    offset: Array | None = None
    margin: float = 1e-9

    def contacts(self, position: Array, rotation: Array) -> Contacts:
        """Their contacts when the bodies lie like this, (n, 3) and (n, 3, 3)."""
        x = position[: len(self.radius)]
        found = [sphere_contacts(x, self.radius, margin=self.margin)]
        if self.normal is not None and self.offset is not None:
            planes = self.normal, self.offset
            more = sphere_plane_contacts(x, self.radius, *planes, margin=self.margin)
            found.append(more)
        return Contacts.concatenate(found)
