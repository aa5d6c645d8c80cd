"""Time of impact of shapes that turn, by conservative advancement.

x(t) = c + v t + exp(t omega x)(x - c), v and omega constant. ``follow`` is the algorithm
as it is told; ``advancement_loops`` takes longer steps, by what is known of each vertex.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.overlap.convex.closest import as_solids
from course.overlap.convex.convex_pairs import numbers
from course.overlap.convex.separating_axis import as_kernels_take_it
from course.overlap.moving.swept import OPPOSITE, TOUCHING, length
from course.overlap.moving.swept_polytopes import Measures, pair_measures
from course.shapes import HalfSpace, Polytopes, Shape, Sphere, polytopes

#: The tolerance where none is given, in extents of the smaller solid.
TOLERANCE = 1e-6
#: Solids in which no larger ball lies have no thickness, in extents of the smaller one.
FLAT = 1e-9


class Motion(NamedTuple):
    """How a shape moves.

    velocity: v, (..., 3) [m/s]; spin: omega in world axes, (..., 3) [rad/s]; pivot: c at
    t = 0, (..., 3) [m].
    """

    velocity: Array
    spin: Array
    pivot: Array

    @property
    def turns(self) -> BoolArray:
        """Whether it turns, (...)."""
        return np.asarray(np.any(self.spin != 0, axis=-1))


def follow(
    gap: Callable[[float], float],
    speed: float,
    horizon: float,
    tolerance: float,
    steps: int,
) -> float:
    """The first time at which a gap is no more than the tolerance, never past an impact.

    t' = t + d(t)/mu, where d falls no faster than mu   (B. Mirtich, *Impulse-based
    Dynamic Simulation of Rigid Body Systems*, 1996, section 2.3.2)

    Args:
        gap: d(t) [m].
        speed: mu > 0 [m/s].
        horizon: [s].
        tolerance: above 0 [m].
        steps: at most so many.
    Returns:
        [s]; inf if there is none up to the horizon, the time reached when the steps
        are used up.
    """
    t = 0.0
    for _ in range(steps):
        d = gap(t)
        if d <= tolerance:
            return t
        t += d / speed
        if t > horizon:
            return np.inf
    return t


def turning_time(
    a: Shape,
    b: Shape,
    motion_a: Motion,
    motion_b: Motion,
    horizon: Array,
    tolerance: Array | None,
    which: BoolArray,
) -> Array:
    """Time of impact of those pairs of a batch of two shapes without parts that are asked for.

    Args:
        horizon, tolerance: (...) [s, m].
        which: (...) the pairs that are asked for, of the whole batch.
    Returns:
        one time each, in C order (k,) [s].
    """
    if isinstance(a, HalfSpace):
        a, b, motion_a, motion_b = b, a, motion_b, motion_a
    i, j = numbers(a, which.shape)[which], numbers(b, which.shape)[which]
    move_a, move_b = _picked(motion_a, which), _picked(motion_b, which)
    end = np.broadcast_to(horizon, which.shape)[which]
    depth = None
    if tolerance is not None:
        depth = np.broadcast_to(tolerance, which.shape)[which]
    if isinstance(a, HalfSpace) and isinstance(b, HalfSpace):
        one, other = a.reshaped(a.count)[i], b.reshaped(b.count)[j]
        return _turning_planes(one, other, move_a, move_b, end, depth)
    plane = isinstance(b, HalfSpace)
    first, second = (
        polytopes(a),
        planes(b) if isinstance(b, HalfSpace) else polytopes(b),
    )
    return _times(first, second, i, j, move_a, move_b, end, depth, plane)


def _times(
    a: Polytopes,
    b: Polytopes,
    i: IntArray,
    j: IntArray,
    motion_a: Array,
    motion_b: Array,
    horizon: Array,
    tolerance: Array | None,
    plane: bool,
) -> Array:
    from course.overlap.moving.advancement_loops import motion_times
    from course.overlap.moving.moving_bodies import places_for

    measures = pair_measures(a, b, i, j)
    depth, radius = _depth(a, b, i, j, measures, horizon, tolerance, plane)
    slow = measures.slope * np.linalg.norm(motion_a[:, 0] - motion_b[:, 0], axis=1)
    for motion, solids, which in (motion_a, a, i), (motion_b, b, j):
        slow = slow + measures.slope * _swing(motion, solids, which)
    limits = np.stack([horizon, depth, measures.band, slow], axis=1)
    time = np.empty(i.size)
    take = as_kernels_take_it
    motion_times(
        as_solids(a), as_solids(b), take(i), take(j), take(motion_a), take(motion_b),
        take(radius), plane, take(limits), places_for(a, b), time,
    )  # fmt: skip
    return time


def _swing(motion: Array, solids: Polytopes, which: IntArray) -> Array:
    """How fast a spin moves what is farthest from the pivot, or more, (p,) [m/s]."""
    low = np.minimum.reduceat(solids.vertices, solids.vertex_start[:-1], axis=0)
    high = np.maximum.reduceat(solids.vertices, solids.vertex_start[:-1], axis=0)
    pivot = motion[:, 2]
    far = np.maximum(np.abs(low[which] - pivot), np.abs(high[which] - pivot))
    return np.asarray(length(motion[:, 1]) * length(far))


def _depth(
    a: Polytopes,
    b: Polytopes,
    i: IntArray,
    j: IntArray,
    measures: Measures,
    horizon: Array,
    tolerance: Array | None,
    plane: bool,
) -> tuple[Array, Array]:
    """How deep pairs are followed into each other, and the radius of both together, each (p,) [m].

    No deeper than half of what lies around their centres: else a thin pair would be
    through before it is deep enough. Two solids without thickness never penetrate:
    these are taken for thicker by the tolerance.
    """
    size = np.where(measures.size > 0, measures.size, 1.0)
    depth = TOLERANCE * size if tolerance is None else tolerance
    radius = a.radius[i] + b.radius[j]
    if not plane:
        thick = inscribed(a)[i] + inscribed(b)[j] + radius
        flat = thick <= FLAT * size
        radius = np.where(flat, radius + depth, radius)
        depth = np.where(flat, 0.5 * depth, np.minimum(depth, 0.5 * thick))
    return np.maximum(depth, 8 * measures.band), radius


def inscribed(solids: Polytopes) -> Array:
    """The radius of a ball inside each core, about the mean of its vertices, (m,) [m]; 0 of flat ones."""
    count = np.diff(solids.vertex_start)
    middle = np.add.reduceat(solids.vertices, solids.vertex_start[:-1], axis=0)
    middle /= count[:, None]
    faces = np.diff(solids.face_start)
    owner = np.repeat(np.arange(len(solids)), faces)
    inset = solids.offsets - np.sum(solids.normals * middle[owner], axis=1)
    least = np.full(len(solids), np.inf)
    np.minimum.at(least, owner, inset)
    return np.where(faces > 2, np.maximum(least, 0.0), 0.0)


def planes(shape: HalfSpace) -> Polytopes:
    """Half spaces as a point of their plane and its normal, which is what loops take of them."""
    flat = shape.reshaped(shape.count)
    each = np.arange(flat.count + 1)
    none = np.zeros(flat.count + 1, dtype=np.intp)
    pairs = np.empty((0, 2), dtype=np.intp)
    return Polytopes(
        flat.normal * flat.offset[:, None], each, np.zeros(flat.count),
        np.array(flat.normal), np.array(flat.offset), each.copy(),
        np.empty(0, dtype=np.intp), none, pairs, pairs.copy(), none.copy(),
    )  # fmt: skip


def _turning_planes(
    a: HalfSpace,
    b: HalfSpace,
    motion_a: Array,
    motion_b: Array,
    horizon: Array,
    tolerance: Array | None,
) -> Array:
    """Half spaces that turn, k pairs: planes that do not stay parallel meet at once, far away.

    Those that face each other and turn alike are as far apart as any point of one.
    """
    facing = length(a.normal + b.normal) <= OPPOSITE
    turn = motion_a[:, 1] - motion_b[:, 1]
    across = length(np.cross(turn, b.normal))
    alike = facing & (across <= TOUCHING * length(turn))
    point = polytopes(Sphere(a.normal * a.offset[:, None], np.zeros(a.count)))
    each = np.arange(a.count)
    follows = _times(
        point, planes(b), each, each, motion_a, motion_b, horizon, tolerance, True
    )
    return np.where(alike, follows, 0.0)


def _picked(motion: Motion, which: BoolArray) -> Array:
    """Velocity, spin and pivot of the pairs that are asked for, (k, 3, 3)."""
    wide: list[Any] = [np.broadcast_to(x, (*which.shape, 3))[which] for x in motion]
    return np.stack(wide, axis=1)
