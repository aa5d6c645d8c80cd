"""Separating axes: two boxes do not overlap exactly if they are apart along one of 15 axes.

Two convex polytopes are apart if and only if they are apart along a face normal of one of
them or along the product of an edge of each; of two boxes these are 3 + 3 + 9 axes
(S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree: a hierarchical structure for rapid
interference detection", SIGGRAPH 1996; C. Ericson, *Real-Time Collision Detection*,
section 4.4.1). Where they overlap, the axis along which they do so least gives the least
translation that parts them.

Here as one expression over a batch; ``box_axes_loops`` stops at the first axis
along which a pair is apart.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, IntArray

#: Sine of the angle below which two edges are parallel; two of the other axes then stand for them.
PARALLEL = 1e-14
#: How near to touching two boxes are, in sizes of the pair, where their vertices decide: rotations are
#: exact to 1e-9 (``course.arrays.UNIT_TOLERANCE``).
BAND = 4e-9
#: What is said of pairs of boxes.
APART, OVERLAPPING, UNSURE = 0, 1, 2


def box_axes(axes_a: Array, axes_b: Array) -> Array:
    """The 15 axes: three of A, three of B, nine products A_i x B_j made unit vectors.

    Args:
        axes_a, axes_b: rotation matrices (..., 3, 3), columns the axes.
    Returns:
        (..., 15, 3); zero where A_i and B_j are parallel.
    """
    a, b = np.swapaxes(axes_a, -1, -2), np.swapaxes(axes_b, -1, -2)  # rows
    product = np.cross(a[..., :, None, :], b[..., None, :, :])
    sine = np.sqrt(np.sum(product**2, axis=-1, keepdims=True))
    crossed = np.where(sine > PARALLEL, product / np.maximum(sine, PARALLEL), 0.0)
    edges = crossed.reshape(*crossed.shape[:-3], 9, 3)
    rows = np.broadcast_shapes(a.shape, b.shape)
    faces = [np.broadcast_to(a, rows), np.broadcast_to(b, rows)]
    return np.concatenate([*faces, edges], axis=-2)


def box_separation(
    center_a: Array,
    axes_a: Array,
    half_a: Array,
    center_b: Array,
    axes_b: Array,
    half_b: Array,
) -> tuple[Array, Array]:
    """The greatest separation of two boxes along one of the 15 axes, and that axis out of B toward A.

    s(N) = |N.(x_A - x_B)| - sum_k h_Ak |N.A_k| - sum_k h_Bk |N.B_k|, N a unit vector.
    Above 0 the boxes are apart (by s or more); else -s is the least translation that
    parts them (Gottschalk et al. 1996).

    Args:
        center_a, center_b: (..., 3) [m].
        axes_a, axes_b: rotation matrices (..., 3, 3), columns the axes.
        half_a, half_b: half extents (..., 3) [m].
    Returns:
        s (...) [m] and N (..., 3).
    """
    axes = box_axes(axes_a, axes_b)
    offset = np.einsum("...nk,...k->...n", axes, center_a - center_b)
    radius_a = np.abs(axes @ axes_a) @ half_a[..., None]
    radius_b = np.abs(axes @ axes_b) @ half_b[..., None]
    separation = np.abs(offset) - (radius_a + radius_b)[..., 0]
    separation[~np.any(axes, axis=-1)] = -np.inf
    best = np.argmax(separation, axis=-1)[..., None]
    sign = np.where(np.take_along_axis(offset, best, axis=-1) < 0, -1.0, 1.0)
    normal = sign * np.take_along_axis(axes, best[..., None], axis=-2)[..., 0, :]
    return np.take_along_axis(separation, best, axis=-1)[..., 0], normal


def box_pairs_told(
    center_a: Array,
    axes_a: Array,
    half_a: Array,
    center_b: Array,
    axes_b: Array,
    half_b: Array,
) -> IntArray:
    """APART, OVERLAPPING or, too near touching to tell, UNSURE, for every pair of boxes.

    ``box_separation`` against -+BAND times the size of the pair, axis by axis in a loop.

    Args:
        as of ``box_separation``, with one leading axis, (p, ...).
    Returns:
        (p,).
    """
    from course.overlap.convex.box_axes_loops import box_verdicts

    verdict = np.empty(len(center_a), dtype=np.intp)
    given = (center_a, axes_a, half_a, center_b, axes_b, half_b)
    arguments: Any = [*map(as_kernels_take_it, given), BAND, verdict]
    box_verdicts(*arguments)
    return verdict


def as_kernels_take_it(array: Any) -> Any:
    """The array in C order and not to be written to: kernels are compiled for this one type."""
    view = np.ascontiguousarray(array).view()
    view.flags.writeable = False
    return view
