"""Where a ray enters a shape, kind by kind.

A ray is all p + t u with t >= 0, u a unit vector. Of k rays and k shapes each function says at
which t each ray enters its shape (inf if never), the outward normal there, and whether it
starts inside: then t is 0 and the normal (0, 0, 0), for no surface is entered. Solids are
closed: a ray that lies in a face, or grazes, hits.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from course.arrays import Array, BoolArray
from course.overlap import time_of_impact
from course.shapes import (
    AABB,
    KDOP,
    OBB,
    Capsule,
    ConvexHull,
    HalfSpace,
    Sphere,
    polytopes,
)


class Entered(NamedTuple):
    """Distance (k,) [m], normal (k, 3), whether it starts inside (k,)."""

    distance: Array
    normal: Array
    inside: BoolArray


def enters(shape: Any, p: Array, u: Array) -> Entered:
    """Where rays enter shapes of any kind without parts.

    Args:
        shape: batch (k,).
        p, u: (k, 3) [m], and unit vectors.
    """
    found = BY_KIND[shape.kind](shape, p, u)
    distance = np.where(found.inside, 0.0, found.distance)
    none = found.inside | np.isinf(distance)
    return Entered(distance, np.where(none[:, None], 0.0, found.normal), found.inside)


def enters_sphere(shape: Sphere, p: Array, u: Array) -> Entered:
    """|m + t u| = r with m = p - c, passed at h = |m x u|: t = (|m| - r)(|m| + r)/(-m.u + sqrt((r - h)(r + h))).

    Source: Ericson, *Real-Time Collision Detection*, section 5.3.2, its root written so that
    a short way keeps its digits.
    """
    m = p - shape.center
    t = _into_circle(m, u, shape.radius, _norm(np.cross(m, u)))
    out = m + np.where(np.isfinite(t), t, 0.0)[:, None] * u
    return Entered(t, _unit(out), _norm(m) <= shape.radius)


def enters_capsule(shape: Capsule, p: Array, u: Array) -> Entered:
    """The first of the ball at either end and the cylinder between them.

    Seen along the axis a the cylinder is a circle: m - a (a.m) moves by u - a (a.u)
    (Ericson, section 5.3.7).
    """
    axis = shape.end - shape.start
    length = _norm(axis)
    a = _unit(axis)
    m = p - shape.start
    flat, way = (x - a * _dot(a, x)[:, None] for x in (m, u))
    side = _into_circle(flat, way, shape.radius, _norm(np.cross(flat, way)))
    at = _dot(a, m) + np.where(np.isfinite(side), side, 0.0) * _dot(a, u)
    side = np.where((at >= 0) & (at <= length), side, np.inf)
    balls = [Sphere(x, shape.radius) for x in (shape.start, shape.end)]
    ends = [enters_sphere(ball, p, u).distance for ball in balls]
    t = np.minimum(side, np.minimum(*ends))
    spot = m + np.where(np.isfinite(t), t, 0.0)[:, None] * u
    core = a * np.clip(_dot(a, spot), 0.0, length)[:, None]
    near = a * np.clip(_dot(a, m), 0.0, length)[:, None]
    return Entered(t, _unit(spot - core), _norm(m - near) <= shape.radius)


def _into_circle(m: Array, way: Array, radius: Array, across: Array) -> Array:
    """t of |m + t w| = r from outside, given |m x w|; inf where it misses, or starts inside."""
    speed, along, far = _norm(way), _dot(m, way), _norm(m)
    room = (radius * speed - across) * (radius * speed + across)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (far - radius) * (far + radius) / (-along + np.sqrt(np.maximum(room, 0.0)))
    return np.where((along < 0) & (room >= 0) & (far > radius), t, np.inf)


def enters_planes(outside: Array, rate: Array, normal: Array) -> Entered:
    """Where rays enter what lies behind f planes each: after all of those that it enters, before any it leaves.

    t_in = max of -s/w over w < 0,  t_out = min of -s/w over w > 0; where w = 0 the ray must
    not be outside   (Ericson, section 5.3.8)

    Args:
        outside: s = n.p - o, (k, f) [m].
        rate: w = n.u, (k, f).
        normal: n, (k, f, 3).
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = -outside / rate
    entering = np.where(rate < 0, crossing, -np.inf)
    last = np.argmax(entering, axis=1)[:, None]
    t = np.take_along_axis(entering, last, axis=1)[:, 0]
    left = np.min(np.where(rate > 0, crossing, np.inf), axis=1)
    beside = np.any((rate == 0) & (outside > 0), axis=1)
    hits = ~beside & (t <= left) & (t >= 0)
    at = np.take_along_axis(normal, last[..., None], axis=1)[:, 0]
    return Entered(np.where(hits, t, np.inf), at, np.all(outside <= 0, axis=1))


def enters_aabb(shape: AABB, p: Array, u: Array) -> Entered:
    """Three slabs: the six planes x <= u and -x <= -l (Ericson, section 5.3.3)."""
    outside = np.concatenate([p - shape.upper, shape.lower - p], axis=1)
    normal = np.broadcast_to(np.concatenate([np.eye(3), -np.eye(3)]), (len(p), 6, 3))
    return enters_planes(outside, np.concatenate([u, -u], axis=1), normal)


def enters_obb(shape: OBB, p: Array, u: Array) -> Entered:
    """The slabs of an upright box, in its own axes."""
    axes = np.swapaxes(shape.rotation, -1, -2)
    own, way = ((axes @ x[..., None])[..., 0] for x in (p - shape.center, u))
    e = shape.half_extents
    outside = np.concatenate([own - e, -own - e], axis=1)
    normal = np.concatenate([axes, -axes], axis=1)
    return enters_planes(outside, np.concatenate([way, -way], axis=1), normal)


def enters_kdop(shape: KDOP, p: Array, u: Array) -> Entered:
    """Its slabs."""
    normal, offset = shape.planes()
    return enters_planes(_each(normal, p) - offset, _each(normal, u), normal)


def enters_half_space(shape: HalfSpace, p: Array, u: Array) -> Entered:
    """One plane."""
    normal = shape.normal[:, None]
    return enters_planes(_each(normal, p) - shape.offset[:, None], _each(normal, u), normal)  # fmt: skip


def enters_hull(shape: ConvexHull, p: Array, u: Array) -> Entered:
    """The planes of its faces; of a flat one, which has no inside, when a point that flies along the ray meets it."""
    solids = polytopes(shape)
    count = np.diff(solids.face_start)
    most = np.arange(max(1, count.max(initial=1)))
    face = solids.face_start[:-1, None] + np.minimum(most, count[:, None] - 1)
    full = count > 2
    distance, normal = np.full(len(p), np.inf), -u.copy()
    inside = np.zeros(len(p), dtype=bool)
    if np.any(full):
        n, face = solids.normals[face[full]], face[full]
        height = _each(n, p[full]) - solids.offsets[face]
        found = enters_planes(height, _each(n, u[full]), n)
        distance[full], normal[full], inside[full] = found
    flat = np.flatnonzero(~full)
    if flat.size:
        point = Sphere(p[flat], np.zeros(flat.size))
        time = time_of_impact(point, shape[flat], u[flat], np.zeros(3), horizon=np.inf)
        distance[flat] = time
        some = flat[count[flat] == 2]
        n = solids.normals[solids.face_start[some]]
        normal[some] = np.where(_dot(n, u[some])[:, None] > 0, -n, n)
    return Entered(distance, normal, inside)


BY_KIND: dict[str, Callable[[Any, Array, Array], Entered]] = {
    "sphere": enters_sphere,
    "capsule": enters_capsule,
    "aabb": enters_aabb,
    "obb": enters_obb,
    "kdop": enters_kdop,
    "convex_hull": enters_hull,
    "half_space": enters_half_space,
}


def _each(normal: Array, x: Array) -> Array:
    """n.x of f planes each, (k, f, 3) and (k, 3) to (k, f)."""
    return np.asarray(np.einsum("kfi,ki->kf", normal, x))


def _dot(a: Array, b: Array) -> Array:
    return np.asarray(np.einsum("ki,ki->k", a, b))


def _norm(x: Array) -> Array:
    return np.sqrt(_dot(x, x))


def _unit(x: Array) -> Array:
    """x/|x|; 0 of 0."""
    length = _norm(x)[:, None]
    return np.asarray(x / np.where(length > 0, length, 1.0))
