"""Time of impact of solids that move in straight lines, exactly.

Seen from B, A moves by v t with v = v_A - v_B. Two convex solids are apart along an
axis N by s + w t, w = N.v, and they overlap while they do so on all axes: from the
latest time at which one of them is entered to the earliest at which one is left
(swept separating axes; C. Ericson, *Real-Time Collision Detection*, sections 5.5.3,
5.5.5 and 5.5.8; syllabus row 12). Of two spheres it is a ray against a sphere.

The gap along a straight line is a convex function of time. Two solids that touch
therefore either go into one another at once, or never.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array
from course.overlap.convex.separating_axis import box_axes
from course.shapes import AABB, OBB, Capsule, HalfSpace, Shape, Sphere

EPS = float(np.finfo(float).eps)
#: Solids this near to each other touch, in units of the largest coordinate.
TOUCHING = 32 * EPS
#: Solids that touch slide if they approach by less than this times their speed.
SLIDING = 1e-12
#: Half spaces whose normals add up to less than this face each other.
OPPOSITE = 1e-12


def time_along_axes(
    separation: Array, rate: Array, speed: Array, horizon: Array, band: Array
) -> Array:
    """When two convex solids begin to overlap, by their shadows on all axes that count.

    t_in = max of -s/w over w < 0,  t_out = min of -s/w over w > 0; a hit where
    t_in <= t_out  (Ericson 5.5.8 has it for the three axes of upright boxes)

    Args:
        separation: s, (..., k) [m], how far A is apart from B along each axis at t = 0.
        rate: w, (..., k) [m/s].
        speed: |v|, (...) [m/s].
        horizon: (...) [s].
        band: the gap that counts as none, (...) [m].
    Returns:
        (...) [s]: 0 if they penetrate, or touch and approach; inf if they touch and do
        not, or do not meet within the horizon.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = -separation / rate
    entered = np.max(np.where(rate < 0, crossing, -np.inf), axis=-1)
    left = np.min(np.where(rate > 0, crossing, np.inf), axis=-1)
    never = np.any((rate == 0) & (separation > 0), axis=-1)
    meets = ~never & (entered <= left) & (left >= 0) & (entered <= horizon)
    near = separation >= -band[..., None]
    parts = np.any(near & (rate >= -SLIDING * speed[..., None]), axis=-1)
    gap = np.max(separation, axis=-1)
    touching = np.where(parts, np.inf, 0.0)
    apart = np.where(meets, entered, np.inf)
    return np.where(gap > band, apart, np.where(gap < -band, 0.0, touching))


def largest(*coordinates: Array) -> Array:
    """The largest finite coordinate, (...), of vectors (..., 3)."""
    sizes = [
        np.max(np.where(np.isinf(x), 0.0, np.abs(x)), axis=-1) for x in coordinates
    ]
    return np.asarray(np.max(np.broadcast_arrays(*sizes), axis=0))


def length(vector: Array) -> Array:
    """|x|, (...)."""
    return np.sqrt(np.einsum("...i,...i", vector, vector))


def swept_spheres(a: Sphere, b: Sphere, velocity: Array, horizon: Array) -> Array:
    """Time of impact of two spheres: a ray from m against a sphere of radius r about 0.

    |m + v t| = r with m = x_A - x_B and r = r_A + r_B, which passes 0 at h = |m x v|/|v|:
    t = (|m| - r)(|m| + r)/(-m.v + |v| sqrt((r - h)(r + h)))   (Ericson 5.3.2 and 5.5.5,
    its root written so that a small gap keeps its digits)

    Args:
        velocity: v of A as seen from B, (..., 3) [m/s].
        horizon: (...) [s].
    Returns:
        (...) [s]; spheres that graze meet.
    """
    m, r = a.center - b.center, a.radius + b.radius
    distance, speed, along = length(m), length(velocity), np.sum(m * velocity, axis=-1)
    far = largest(a.center, b.center)
    band = TOUCHING * np.maximum(far, r)
    gap = distance - r
    across = length(np.cross(m, velocity))
    root = np.sqrt(np.maximum((r * speed - across) * (r * speed + across), 0.0))
    toward = np.maximum(-along, 0.0) + root
    with np.errstate(divide="ignore", invalid="ignore"):
        time = gap * (distance + r) / toward
    meets = (along < 0) & (across <= r * speed) & (time <= horizon)
    slow = speed * (SLIDING * distance + TOUCHING * far)
    touching = np.where(along < -slow, 0.0, np.inf)
    apart = np.where(meets, time, np.inf)
    return np.where(gap > band, apart, np.where(gap < -band, 0.0, touching))


def swept_upright_boxes(a: AABB, b: AABB, velocity: Array, horizon: Array) -> Array:
    """Time of impact of two axis-aligned boxes by their slabs (Ericson 5.5.8).

    Along x, y and z, A is apart from B by l_A - u_B on one side and l_B - u_A on the other.

    Args:
        velocity: of A as seen from B, (..., 3) [m/s].
        horizon: (...) [s].
    """
    separation = [a.lower - b.upper, b.lower - a.upper]
    batch = np.broadcast_shapes(separation[0].shape, velocity.shape)
    rate = np.broadcast_to(velocity, batch)
    band = TOUCHING * largest(a.lower, a.upper, b.lower, b.upper)
    return time_along_axes(
        np.concatenate([np.broadcast_to(s, batch) for s in separation], axis=-1),
        np.concatenate([rate, -rate], axis=-1),
        length(velocity),
        horizon,
        band,
    )


def swept_boxes(a: OBB, b: OBB, velocity: Array, horizon: Array) -> Array:
    """Time of impact of two oriented boxes by their 15 axes, as one expression.

    Along an axis N the boxes are apart by +-N.(x_A - x_B) - sum_k (h_Ak |N.A_k| +
    h_Bk |N.B_k|)   (Ericson 4.4.1 and 5.5.3). ``swept_polytopes.box_times`` is the loop.

    Args:
        velocity: of A as seen from B, (..., 3) [m/s].
        horizon: (...) [s].
    """
    axes = box_axes(a.rotation, b.rotation)
    offset = np.einsum("...nk,...k->...n", axes, a.center - b.center)
    reach = np.abs(axes @ a.rotation) @ a.half_extents[..., None]
    reach = (reach + np.abs(axes @ b.rotation) @ b.half_extents[..., None])[..., 0]
    rate = np.einsum("...nk,...k->...n", axes, velocity)
    skipped = ~np.any(axes, axis=-1)
    both = np.stack([offset, -offset]) - np.where(skipped, np.inf, reach)
    return time_along_axes(
        np.concatenate(list(both), axis=-1),
        np.concatenate([rate, -rate], axis=-1),
        length(velocity),
        horizon,
        box_band(a, b),
    )


def box_band(a: OBB, b: OBB) -> Array:
    """The gap of two boxes that counts as none, (...) [m]."""
    return TOUCHING * largest(a.center, b.center, a.half_extents, b.half_extents)


def swept_to_half_space(
    a: Shape, b: HalfSpace, velocity: Array, horizon: Array
) -> Array:
    """Time of impact of a bounded shape and a half space n.x <= o.

    The least n.x of A is that of its support along -n, so s = n.support(-n) - o and
    w = n.v   (Ericson 5.5.1 and 5.5.2)

    Args:
        velocity: of A as seen from B, (..., 3) [m/s].
        horizon: (...) [s].
    """
    point = a.support(-b.normal)  # type: ignore[attr-defined]
    separation = np.sum(point * b.normal, axis=-1) - b.offset
    reach = np.maximum(largest(point), np.abs(b.offset))
    if isinstance(a, Sphere | Capsule):
        reach = np.maximum(reach, a.radius)
    return _along_one_axis(separation, b.normal, velocity, horizon, TOUCHING * reach)


def swept_half_spaces(
    a: HalfSpace, b: HalfSpace, velocity: Array, horizon: Array
) -> Array:
    """Time of impact of two half spaces: 0 unless they face each other.

    Then A is n.x >= -o_A, with n the normal of B, and s = -o_A - o_B.
    """
    facing = length(a.normal + b.normal) <= OPPOSITE
    band = TOUCHING * np.maximum(np.abs(a.offset), np.abs(b.offset))
    separation = -(a.offset + b.offset)
    time = _along_one_axis(separation, b.normal, velocity, horizon, band)
    return np.where(facing, time, 0.0)


def _along_one_axis(
    separation: Array, normal: Array, velocity: Array, horizon: Array, band: Array
) -> Array:
    rate = np.sum(normal * velocity, axis=-1)
    batch = np.broadcast_shapes(separation.shape, rate.shape)
    s = np.broadcast_to(separation, batch)[..., None]
    w = np.broadcast_to(rate, batch)[..., None]
    return time_along_axes(s, w, length(velocity), horizon, band)
