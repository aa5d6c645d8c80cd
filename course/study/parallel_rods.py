"""Rods that lie side by side, turned a little: how near the feet of two lines say they are."""

from __future__ import annotations

import numpy as np

from course.arrays import Array

#: How far apart they lie [m].
APART = 0.5
#: The angle at which the share of the way has no digit left: its square is a rounding [rad].
LOST_BELOW = float(np.sqrt(0.5 * np.finfo(float).eps))


def rods_side_by_side(
    angle: float, count: int = 2000, *, seed: int = 4
) -> tuple[Array, Array, Array, Array]:
    """Rods of 1 m, the second half a metre beside the first, turned by an angle [rad]: ends of A and of B, (n, 3)."""
    rng = np.random.default_rng(seed)
    a, u, x = rng.normal(size=(3, count, 3))
    u /= np.linalg.norm(u, axis=-1, keepdims=True)
    across = np.cross(u, x)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    v = u + angle * np.cross(across, u)
    foot = rng.uniform(0.2, 0.8, (2, count, 1))
    start = a + foot[0] * u + APART * across - foot[1] * v
    return a, a + u, start, start + v


def feet_apart(start_a: Array, end_a: Array, start_b: Array, end_b: Array) -> Array:
    """The distance of the feet of the line across both, each limited to its rod, (...) [m].

    s = (w x v).n / n.n and t = (w x u).n / n.n, n = u x v. It is the distance of the rods
    where both feet are inside, and where n has digits left.
    """
    u, v, w = end_a - start_a, end_b - start_b, start_b - start_a
    n = np.cross(u, v)
    square = np.maximum(np.sum(n * n, axis=-1, keepdims=True), 1e-300)
    s = np.sum(np.cross(w, v) * n, axis=-1, keepdims=True) / square
    t = np.sum(np.cross(w, u) * n, axis=-1, keepdims=True) / square
    between = np.clip(s, 0.0, 1.0) * u - w - np.clip(t, 0.0, 1.0) * v
    return np.asarray(np.linalg.norm(between, axis=-1))
