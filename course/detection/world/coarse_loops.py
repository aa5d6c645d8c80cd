"""Whether boxes around two shapes are further apart than a distance, by their 15 axes.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array, BoolArray, IntArray
from course.jit import compiled

#: Sine of the angle below which two edges are parallel and their product tells nothing.
PARALLEL = 1e-6


@compiled
def boxes_apart(
    center: Array, axes: Array, half: Array, pairs: IntArray, reach: Array, found: BoolArray
) -> None:  # fmt: skip
    """found[k] = whether boxes pairs[k] are apart by more than reach[k] along one of the 15 axes.

    Seen in the axes of A, with C = A'B and t = A'(x_B - x_A): apart along N where
    |N.t| - sum_k (h_Ak |N.A_k| + h_Bk |N.B_k|) > reach |N|, N among A_k, B_l, A_k x B_l.

    Source: S. Gottschalk, M. C. Lin, D. Manocha, "OBBTree", SIGGRAPH 1996.

    Args:
        center (n, 3) [m], axes (n, 3, 3), half (n, 3) [m]: boxes.
        pairs: (m, 2).
        reach: (m,) [m], at or above 0.
        found: (m,), is written.
    """
    c, size, t = np.empty((3, 3)), np.empty((3, 3)), np.empty(3)
    for k in range(pairs.shape[0]):
        i, j = pairs[k]
        for a in range(3):
            t[a] = 0.0
            for x in range(3):
                t[a] += axes[i, x, a] * (center[j, x] - center[i, x])
            for b in range(3):
                c[a, b] = 0.0
                for x in range(3):
                    c[a, b] += axes[i, x, a] * axes[j, x, b]
                size[a, b] = abs(c[a, b])
        found[k] = by_faces(t, c, size, half[i], half[j], reach[k]) or by_edges(
            t, c, size, half[i], half[j], reach[k]
        )


@compiled
def by_faces(t: Array, c: Array, size: Array, e: Array, f: Array, reach: float) -> bool:  # fmt: skip
    """Along an axis of either box."""
    for a in range(3):
        far = f[0] * size[a, 0] + f[1] * size[a, 1] + f[2] * size[a, 2]
        if abs(t[a]) > e[a] + far + reach:
            return True
    for b in range(3):
        far = e[0] * size[0, b] + e[1] * size[1, b] + e[2] * size[2, b]
        along = t[0] * c[0, b] + t[1] * c[1, b] + t[2] * c[2, b]
        if abs(along) > f[b] + far + reach:
            return True
    return False


@compiled
def by_edges(t: Array, c: Array, size: Array, e: Array, f: Array, reach: float) -> bool:  # fmt: skip
    """Along the product of an edge of each."""
    for a in range(3):
        p, q = (a + 1) % 3, (a + 2) % 3
        for b in range(3):
            sine = math.sqrt(c[p, b] ** 2 + c[q, b] ** 2)
            if sine < PARALLEL:
                continue
            r, s = (b + 1) % 3, (b + 2) % 3
            far = e[p] * size[q, b] + e[q] * size[p, b]
            far += f[r] * size[a, s] + f[s] * size[a, r]
            along = t[q] * c[p, b] - t[p] * c[q, b]
            if abs(along) > far + reach * sine:
                return True
    return False


def warm() -> None:
    """Call the kernel once (``course.jit``)."""
    axes = np.stack([np.eye(3), np.eye(3)[[1, 2, 0]]])
    pair, reach, found = np.array([[0, 1]]), np.zeros(1), np.zeros(1, dtype=bool)
    boxes_apart(np.zeros((2, 3)), axes, np.ones((2, 3)), pair, reach, found)
