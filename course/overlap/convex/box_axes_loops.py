"""The fifteen separating axes of two boxes in a loop, which ends at the first that parts them.

The readable form is ``separating_axis``.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.convex.separating_axis_loops import PARALLEL

#: What is said of two boxes.
APART, OVERLAPPING, UNSURE = 0, 1, 2


@compiled
def relative_pose(
    center_a: Array,
    axes_a: Array,
    center_b: Array,
    axes_b: Array,
    p: int,
    r: Array,
    t: Array,
) -> None:
    """B's axes and centre as A's axes see them: r = R_A' R_B, t = R_A' (x_B - x_A) of pair p."""
    x = center_b[p, 0] - center_a[p, 0]
    y = center_b[p, 1] - center_a[p, 1]
    z = center_b[p, 2] - center_a[p, 2]
    for i in range(3):
        u, v, w = axes_a[p, 0, i], axes_a[p, 1, i], axes_a[p, 2, i]
        t[i] = u * x + v * y + w * z
        for j in range(3):
            r[i, j] = u * axes_b[p, 0, j] + v * axes_b[p, 1, j] + w * axes_b[p, 2, j]


@compiled
def along_cross(half_a: Array, half_b: Array, p: int, r: Array, t: Array, i: int, j: int) -> float:  # fmt: skip
    """Separation along A's axis i times B's axis j, made a unit vector; -inf where these are parallel.

    For i = 0 that is (0, -r_2j, r_1j) in A's axes; nothing of r is taken to be
    orthonormal, so that it is right however short the product is.
    """
    k, m = (i + 1) % 3, (i + 2) % 3
    y, z = -r[m, j], r[k, j]
    length = math.sqrt(y * y + z * z)
    if length <= PARALLEL:
        return -math.inf
    y, z = y / length, z / length
    s = abs(t[k] * y + t[m] * z) - half_a[p, k] * abs(y) - half_a[p, m] * abs(z)
    for n in range(3):
        s -= half_b[p, n] * abs(r[k, n] * y + r[m, n] * z)
    return s


@compiled
def box_verdict(half_a: Array, half_b: Array, p: int, r: Array, t: Array, band: float) -> int:  # fmt: skip
    """APART, OVERLAPPING or UNSURE: whether the greatest of 15 separations is above, below or within +-band.

    Ericson 4.4.1, where |A_i x B_j . B_n| are entries of r. The nine products are left as long as
    they are: a sine is at most 1, so that what exceeds the band exceeds it all the more
    as a unit vector, and only what does not is worked out along a unit vector.
    """
    unsure = False
    for i in range(3):
        s = abs(t[i]) - half_a[p, i]
        s -= half_b[p, 0] * abs(r[i, 0]) + half_b[p, 1] * abs(r[i, 1]) + half_b[p, 2] * abs(r[i, 2])  # fmt: skip
        if s > band:
            return APART
        unsure |= s >= -band
    for j in range(3):
        s = abs(t[0] * r[0, j] + t[1] * r[1, j] + t[2] * r[2, j]) - half_b[p, j]
        s -= half_a[p, 0] * abs(r[0, j]) + half_a[p, 1] * abs(r[1, j]) + half_a[p, 2] * abs(r[2, j])  # fmt: skip
        if s > band:
            return APART
        unsure |= s >= -band
    for i in range(3):
        k, m = (i + 1) % 3, (i + 2) % 3
        for j in range(3):
            n, q = (j + 1) % 3, (j + 2) % 3
            s = abs(t[m] * r[k, j] - t[k] * r[m, j])
            s -= half_a[p, k] * abs(r[m, j]) + half_a[p, m] * abs(r[k, j])
            s -= half_b[p, n] * abs(r[i, q]) + half_b[p, q] * abs(r[i, n])
            if s > band:
                return APART
            if s >= -band:
                s = along_cross(half_a, half_b, p, r, t, i, j)
                if s > band:
                    return APART
                unsure |= s >= -band
    return UNSURE if unsure else OVERLAPPING


@compiled
def box_verdicts(
    center_a: Array,
    axes_a: Array,
    half_a: Array,
    center_b: Array,
    axes_b: Array,
    half_b: Array,
    relative_band: float,
    verdict: IntArray,
) -> None:
    """``box_verdict`` of every pair, written to verdict, (p,).

    Args:
        center_a, center_b, half_a, half_b: (p, 3) [m]; axes_a, axes_b: (p, 3, 3), columns.
        relative_band: what is too near zero to be told, in sizes of the pair.
    """
    r, t = np.empty((3, 3)), np.empty(3)
    for p in range(verdict.size):
        relative_pose(center_a, axes_a, center_b, axes_b, p, r, t)
        size = abs(t[0]) + abs(t[1]) + abs(t[2])
        for k in range(3):
            size += half_a[p, k] + half_b[p, k]
        verdict[p] = box_verdict(half_a, half_b, p, r, t, relative_band * size)


def warm() -> None:
    """Call the kernels once (``course.jit``); the doubtful ones are ``separating_axis``'s."""
    from course.overlap.convex.separating_axis import box_pairs_told

    box_pairs_told(*[np.zeros((1, 3)), np.eye(3)[None], np.ones((1, 3))] * 2)
