"""The manifolds of many pairs of oriented boxes: separating axes, patches and points in one loop.

For boxes that surely overlap the 15 axes say how deep and along what (S. Gottschalk,
M. C. Lin, D. Manocha, "OBBTree", SIGGRAPH 1996; C. Ericson, *Real-Time Collision
Detection*, section 4.4.1), and the rest is as for all polytopes (``loops``). Pairs that are
nearly apart or apart by no more than the margin are left to those loops, which ask a
distance query.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.jit import compiled
from course.overlap.manifold.box_patches import box_number, box_patch
from course.overlap.manifold.labels import POINT, WIDTH, Pair
from course.overlap.manifold.loops import scales
from course.overlap.manifold.meeting import (
    SAME_DEPTH,
    UPPER,
    flatten,
    kept,
    meet,
    set_manifold_normal,
)
from course.overlap.manifold.patches import BIAS, A, B, Desk, desk
from course.overlap.manifold.thinning import thin

#: Boxes that overlap by less than this, in sizes of the pair, are left to the other loops.
SURE = 1e-8
#: Sine below which two edges are parallel; their product is no axis.
PARALLEL = 1e-9


@compiled
def box_manifolds(
    center_a: Array,
    axes_a: Array,
    half_a: Array,
    center_b: Array,
    axes_b: Array,
    half_b: Array,
    margin: float,
    limit: int,
    begin: int,
    room: Desk,
    names: IntArray,
    numbers: Array,
    left: BoolArray,
) -> tuple[int, int]:
    """The points of the pairs from ``begin`` on, as far as there is room for them.

    Args:
        center_a, half_a, center_b, half_b: (p, 3), half extents above 0;
            axes_a, axes_b: (p, 3, 3), columns.
        margin, limit, begin, room, names, numbers: as in ``manifolds``.
        left: (p,), set where a pair is left to the other loops.
    Returns:
        The first pair that is not done, and how many rows were filled.
    """
    count, p = 0, begin
    origin, normal, r, t = np.empty(3), np.empty(3), np.empty((3, 3)), np.empty(3)
    order = np.empty(limit, dtype=np.intp)
    corner, vertex, normals, cut, leaving, what = room
    while p < len(left) and count + cut.shape[1] <= len(numbers):
        for k in range(3):
            origin[k] = 0.5 * (center_a[p, k] + center_b[p, k])
        size_a, size_b = 2.0 * length(half_a, p), 2.0 * length(half_b, p)
        scale, noise = scales(size_a, size_b, origin)
        bias, sure = BIAS * scale + noise, SURE * (size_a + size_b) + noise
        s = axis_of_boxes(center_a, axes_a, half_a, center_b, axes_b, half_b, p, bias,
                          max(margin, sure), r, t, normal)  # fmt: skip
        left[p] = -sure < s <= max(margin, sure)
        if s <= -sure:
            count_a, feature_a = box_patch(center_a, axes_a, half_a, p, A, origin, normal,
                                           corner, vertex, normals)  # fmt: skip
            count_b, feature_b = box_patch(center_b, axes_b, half_b, p, B, origin, normal,
                                           corner, vertex, normals)  # fmt: skip
            first = set_manifold_normal(normals, count_a, count_b, normal)
            pair = Pair(count_a, count_b, 0.0, 0.0, scale, bias, first)
            flatten(corner, normals, count_a, count_b)
            more = meet(
                pair, corner, normals, cut, leaving, what, names, numbers, count
            )
            more = kept(names, numbers, count, more, margin, SAME_DEPTH * scale + noise)
            if limit:
                more = thin(names, numbers, count, more, limit, bias, order)
            for k in range(count, count + more):
                names[k, 5] = p
                names[k, 6] = box_number(names[k, 1], names[k, 2], count_a, feature_a, A, vertex)  # fmt: skip
                names[k, 7] = box_number(names[k, 3], names[k, 4], count_b, feature_b, B, vertex)  # fmt: skip
                for axis in range(3):
                    numbers[k, POINT + axis] += origin[axis]
            left[p] = more == 0
            count += more
        p += 1
    return p, count


@compiled
def axis_of_boxes(
    center_a: Array,
    axes_a: Array,
    half_a: Array,
    center_b: Array,
    axes_b: Array,
    half_b: Array,
    p: int,
    bias: float,
    enough: float,
    r: Array,
    t: Array,
    normal: Array,
) -> float:
    """The greatest separation along the 15 axes, or one above ``enough``; N out of B toward A is written.

    Where the normal of a face is as good as any but for ``bias`` it is taken (``references``).

    Args:
        r, t: (3, 3), (3,), room for R_A' R_B and R_A' (x_A - x_B).
    """
    x = center_a[p, 0] - center_b[p, 0]
    y = center_a[p, 1] - center_b[p, 1]
    z = center_a[p, 2] - center_b[p, 2]
    best = -math.inf
    for i in range(3):
        u, v, w = axes_a[p, 0, i], axes_a[p, 1, i], axes_a[p, 2, i]
        t[i] = u * x + v * y + w * z
        s = abs(t[i]) - half_a[p, i]
        for j in range(3):
            r[i, j] = u * axes_b[p, 0, j] + v * axes_b[p, 1, j] + w * axes_b[p, 2, j]
            s -= half_b[p, j] * abs(r[i, j])
        best = max(best, s)
        if s > enough:
            return s
    for j in range(3):
        s = abs(t[0] * r[0, j] + t[1] * r[1, j] + t[2] * r[2, j]) - half_b[p, j]
        for i in range(3):
            s -= half_a[p, i] * abs(r[i, j])
        best = max(best, s)
        if s > enough:
            return s
    faces, edge_a, edge_b = best, -1, -1
    for i in range(3):
        k, m = (i + 1) % 3, (i + 2) % 3
        for j in range(3):
            n, q = (j + 1) % 3, (j + 2) % 3
            s = abs(t[m] * r[k, j] - t[k] * r[m, j])
            s -= half_a[p, k] * abs(r[m, j]) + half_a[p, m] * abs(r[k, j])
            s -= half_b[p, n] * abs(r[i, q]) + half_b[p, q] * abs(r[i, n])
            sine = r[k, j] * r[k, j] + r[m, j] * r[m, j]
            # s/sin > best only if s > best sin: without a root for most of them
            if s > 0.0 or s * s < best * best * sine:
                sine = math.sqrt(sine)
                if sine > PARALLEL and s / sine > best:
                    best, edge_a, edge_b = s / sine, i, j
                    if best > enough:
                        return best
    if faces >= best - bias:
        face_axis(axes_a, half_a, axes_b, half_b, p, r, t, best - bias, normal)
    else:
        edge_axis(axes_a, axes_b, p, edge_a, edge_b, normal)
    if normal[0] * x + normal[1] * y + normal[2] * z < 0.0:
        normal[0], normal[1], normal[2] = -normal[0], -normal[1], -normal[2]
    return best


@compiled
def face_axis(
    axes_a: Array,
    half_a: Array,
    axes_b: Array,
    half_b: Array,
    p: int,
    r: Array,
    t: Array,
    least: float,
    normal: Array,
) -> None:
    """Of the face normals with a separation of at least so much the one that is most along ``UPPER``, either way."""
    most = -1.0
    for k in range(6):
        i = k % 3
        axes = axes_a if k < 3 else axes_b
        up = abs(UPPER[0] * axes[p, 0, i] + UPPER[1] * axes[p, 1, i] + UPPER[2] * axes[p, 2, i])  # fmt: skip
        if up <= most:
            continue
        if k < 3:
            s = abs(t[i]) - half_a[p, i]
            for j in range(3):
                s -= half_b[p, j] * abs(r[i, j])
        else:
            s = abs(t[0] * r[0, i] + t[1] * r[1, i] + t[2] * r[2, i]) - half_b[p, i]
            for j in range(3):
                s -= half_a[p, j] * abs(r[j, i])
        if s >= least:
            most = up
            for axis in range(3):
                normal[axis] = axes[p, axis, i]


@compiled
def edge_axis(
    axes_a: Array, axes_b: Array, p: int, i: int, j: int, normal: Array
) -> None:
    """A's axis i times B's axis j, made a unit vector."""
    for k in range(3):
        m, n = (k + 1) % 3, (k + 2) % 3
        normal[k] = axes_a[p, m, i] * axes_b[p, n, j] - axes_a[p, n, i] * axes_b[p, m, j]  # fmt: skip
    size = math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
    for k in range(3):
        normal[k] /= size


@compiled
def length(vectors: Array, p: int) -> float:
    """|v_p|"""
    return math.sqrt(vectors[p, 0] ** 2 + vectors[p, 1] ** 2 + vectors[p, 2] ** 2)


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    low, high = np.zeros((1, 3)), np.array([[0.0, 0.0, 1.5]])
    still = np.eye(3)[None], np.ones((1, 3))
    for array in (low, high, *still):
        array.setflags(write=False)
    rows = np.zeros((20, 8), dtype=np.intp), np.zeros((20, WIDTH))
    left = np.zeros(1, dtype=np.bool_)
    box_manifolds(high, *still, low, *still, 0.0, 4, 0, desk(4, 4), *rows, left)
