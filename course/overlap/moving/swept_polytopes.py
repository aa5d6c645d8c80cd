"""Time of impact of boxes, polytopes and rounded polytopes in straight motion, pair by pair in compiled loops.

Boxes and polytopes by swept separating axes (``swept_loops``). Where a ball is rolled
around one of the two, as around a capsule's segment, it is a ray against their Minkowski
difference, cast by the gap at its points (``advancement_loops``).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from course.arrays import Array, IntArray
from course.overlap.convex.closest import as_solids
from course.overlap.convex.convex_pairs import numbers
from course.overlap.convex.separating_axis import as_kernels_take_it
from course.overlap.moving import swept
from course.shapes import AABB, OBB, Polytopes, Shape, polytopes


def swept_boxes(a: AABB | OBB, b: OBB, velocity: Array, horizon: Array) -> Array:
    """``swept.swept_boxes``, pair by pair; A may be axis-aligned.

    Args:
        velocity: of A as seen from B, (..., 3) [m/s].
        horizon: (...) [s].
    """
    from course.overlap.moving.swept_loops import box_times

    first = a if isinstance(a, OBB) else a.moved(np.eye(3), np.zeros(3))
    batch = batch_of(a, b, velocity, horizon)
    given: list[Any] = []
    for box in first, b:
        given += [
            rows(box.center, 1, batch),
            rows(box.rotation, 2, batch),
            rows(box.half_extents, 1, batch),
        ]
    given += [rows(velocity, 1, batch), rows(horizon, 0, batch)]
    given += [rows(swept.box_band(first, b), 0, batch)]
    time = np.empty(int(np.prod(batch)))
    box_times(*[*given, time])
    return time.reshape(batch)


def swept_convex(a: Shape, b: Shape, velocity: Array, horizon: Array) -> Array:
    """Time of impact of any two convex bounded shapes.

    Args:
        velocity: of A as seen from B, (..., 3) [m/s].
        horizon: (...) [s].
    """
    batch = batch_of(a, b, velocity, horizon)
    first, second = polytopes(a), polytopes(b)
    i, j = numbers(a, batch).ravel(), numbers(b, batch).ravel()
    v, end = rows(velocity, 1, batch), rows(horizon, 0, batch)
    measures = pair_measures(first, second, i, j)
    slow = np.sqrt(np.einsum("pi,pi->p", v, v)) * measures.slope
    time = np.empty(i.size)
    balls = first.radius[i] + second.radius[j] > 0
    for which, kernel in (balls, _ray_times), (~balls, _polytope_times):
        k = np.flatnonzero(which)
        if k.size:
            given = (i[k], j[k], v[k], end[k], measures.band[k], slow[k])
            time[k] = kernel(first, second, *map(as_kernels_take_it, given))
    return time.reshape(batch)


def _polytope_times(
    a: Polytopes, b: Polytopes, i: Any, j: Any, v: Any, end: Any, band: Any, slow: Any
) -> Array:
    from course.overlap.moving.swept_loops import polytope_times

    time = np.empty(i.size)
    polytope_times(as_solids(a), as_solids(b), i, j, v, end, band, slow, time)
    return time


def _ray_times(
    a: Polytopes, b: Polytopes, i: Any, j: Any, v: Any, end: Any, band: Any, slow: Any
) -> Array:
    from course.overlap.moving.advancement_loops import motion_times
    from course.overlap.moving.moving_bodies import places_for

    none = np.zeros_like(v)
    starts = a.vertices[a.vertex_start[i]], b.vertices[b.vertex_start[j]]
    motion_a = as_kernels_take_it(np.stack([v, none, starts[0]], axis=1))
    motion_b = as_kernels_take_it(np.stack([none, none, starts[1]], axis=1))
    radius, time = a.radius[i] + b.radius[j], np.empty(i.size)
    limits = np.stack([end, np.zeros_like(end), band, slow], axis=1)
    motion_times(
        as_solids(a), as_solids(b), i, j, motion_a, motion_b,
        as_kernels_take_it(radius), False, as_kernels_take_it(limits), places_for(a, b), time,
    )  # fmt: skip
    return time


class Measures(NamedTuple):
    """What rounding depends on, a pair each, (p,)."""

    #: The gap that counts as none [m].
    band: Array
    #: The part of the speed that counts as none.
    slope: Array
    #: The extent of the smaller solid, of the larger where that is a point [m].
    size: Array


def pair_measures(a: Polytopes, b: Polytopes, i: IntArray, j: IntArray) -> Measures:
    """The measures of pairs of solids (i, j)."""
    (far_a, size_a), (far_b, size_b) = solid_measures(a), solid_measures(b)
    far = np.maximum(far_a[i], far_b[j])
    smaller = np.minimum(size_a[i], size_b[j])
    size = np.where(smaller > 0, smaller, np.maximum(size_a[i], size_b[j]))
    # A face of a small solid far from the origin is as rough as its corners' rounding.
    rough = np.divide(4 * swept.EPS * far, size, out=np.zeros_like(far), where=size > 0)
    return Measures(swept.TOUCHING * far, swept.SLIDING + rough, size)


def solid_measures(solids: Polytopes) -> tuple[Array, Array]:
    """The largest coordinate and the greatest extent along an axis, each (m,) [m]."""
    start = solids.vertex_start[:-1]
    low = np.minimum.reduceat(solids.vertices, start, axis=0)
    high = np.maximum.reduceat(solids.vertices, start, axis=0)
    far = np.maximum(np.abs(low), np.abs(high)).max(axis=1) + solids.radius
    return far, (high - low).max(axis=1) + 2 * solids.radius


def batch_of(a: Shape, b: Shape, velocity: Array, horizon: Array) -> tuple[int, ...]:
    """The batch of a question broadcast."""
    return np.broadcast_shapes(a.batch, b.batch, velocity.shape[:-1], horizon.shape)


def rows(array: Array, core: int, batch: tuple[int, ...]) -> Any:
    """An array with ``core`` last axes broadcast to a batch, a row a pair."""
    last = array.shape[array.ndim - core :]
    wide = np.broadcast_to(array, (*batch, *last))
    return as_kernels_take_it(wide.reshape(-1, *last))
