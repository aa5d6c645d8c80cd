"""Boxes that broad phases are tried on, and a judge that shares no line with them."""

import numpy as np

from course.shapes import AABB


def boxes_about(center, half):
    center = np.asarray(center, dtype=float)
    half = np.broadcast_to(np.asarray(half, dtype=float), center.shape)
    return AABB(center - half, center + half)


def judged(boxes):
    """The pairs, by the definition, one by one in plain Python."""
    lower, upper = boxes.lower.tolist(), boxes.upper.tolist()
    n = len(lower)
    return [
        [i, j]
        for i in range(n)
        for j in range(i + 1, n)
        if all(
            lower[i][k] <= upper[j][k] and lower[j][k] <= upper[i][k] for k in range(3)
        )
    ]


def uniform(n, rng, *, size=None):
    """Cubes with centres uniform in the unit cube; about two neighbours each."""
    side = n ** (-1 / 3) * 0.63 if size is None else size
    return boxes_about(rng.uniform(0, 1, (n, 3)), side / 2)


def clustered(n, rng):
    """Cubes in groups of some forty, each group as dense as the others."""
    groups = max(1, n // 40)
    center = rng.uniform(0, 100, (groups, 3))[rng.integers(groups, size=n)]
    return boxes_about(center + rng.normal(size=(n, 3)), 0.25)


def on_one_axis(n, rng):
    center = np.zeros((n, 3))
    center[:, 1] = rng.uniform(0, n, n)
    return boxes_about(center, rng.uniform(0.1, 1.5, (n, 3)))


def column_swept(n, rng):
    """Cubes stacked in a column along z, each touching the next exactly, and one beside each second."""
    center = np.zeros((n, 3))
    center[:, 2] = np.arange(n)
    center[1::2, 0] = 1.0
    return boxes_about(center, 0.5)


def mixed(n, rng):
    """Sizes from 1 to 1000."""
    size = 10 ** rng.uniform(0, 3, (n, 1)) * rng.uniform(0.5, 1, (n, 3))
    return boxes_about(rng.uniform(0, 3000, (n, 3)), size / 2)


def identical(n, rng):
    return boxes_about(np.tile(rng.normal(size=3), (n, 1)), 1.0)


def zero_size(n, rng):
    """Points of a coarse lattice: many coincide, and coincide with no others."""
    return boxes_about(rng.integers(0, 4, (n, 3)), 0.0)


def touching(n, rng):
    """Cubes of a lattice, which touch their neighbours at faces, edges and corners."""
    cell = rng.permutation(8 * n)[:n]
    side = round((8 * n) ** (1 / 3) / 2) + 1
    center = np.stack(np.unravel_index(cell % side**3, (side,) * 3), axis=1)
    return boxes_about(center, 0.5)


def one_large(n, rng):
    """Small cubes and one box around them all, one around half of them."""
    boxes = uniform(n, rng)
    lower, upper = boxes.lower.copy(), boxes.upper.copy()
    lower[n // 2], upper[n // 2] = -1.0, 2.0
    lower[n // 3], upper[n // 3] = -1.0, [0.5, 2.0, 2.0]
    return AABB(lower, upper)


def huge(n, rng):
    return boxes_about(rng.uniform(-1, 1, (n, 3)) * 8e307, 5e307)


def huge_and_tiny(n, rng):
    """Coordinates of every order of magnitude."""
    center = 10.0 ** rng.uniform(-300, 300, (n, 3)) * rng.choice([-1.0, 1.0], (n, 3))
    return boxes_about(center, 10.0 ** rng.uniform(-300, 300, (n, 3)))


def far_away(n, rng):
    """Near each other and far from the origin: coordinates with few digits left."""
    return boxes_about(1e15 + rng.integers(0, 12, (n, 3)), rng.integers(0, 2, (n, 3)))


def tiny(n, rng):
    return boxes_about(rng.uniform(0, 1e-308, (n, 3)), 1e-309)


def endless(n, rng):
    """Some boxes reach to infinity, as the bounds of half spaces do."""
    boxes = uniform(n, rng)
    lower, upper = boxes.lower.copy(), boxes.upper.copy()
    lower[rng.random((n, 3)) < 0.05] = -np.inf
    upper[rng.random((n, 3)) < 0.05] = np.inf
    return AABB(lower, upper)


SCENES = [
    uniform,
    clustered,
    on_one_axis,
    column_swept,
    mixed,
    identical,
    zero_size,
    touching,
    one_large,
    huge,
    huge_and_tiny,
    far_away,
    tiny,
    endless,
]
