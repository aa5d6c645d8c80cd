"""The manifolds of many pairs, one after the other.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.manifold.clipping import Cut, cut_room
from course.overlap.manifold.labels import (
    FACE,
    KIND_A,
    PLACE_A,
    POINT,
    VERTEX,
    WIDTH,
    Pair,
)
from course.overlap.manifold.meeting import (
    SAME_DEPTH,
    flatten,
    manifold_normal,
    meet,
    preferred,
)
from course.overlap.manifold.patches import (
    BIAS,
    Patch,
    Solids,
    edge_between,
    height_and_size,
    patch_room,
    supporting_patch,
)
from course.overlap.manifold.thinning import thin

#: How much of the largest coordinate is taken for rounding of the input.
ROUNDING = 32 * 2.0**-52


@compiled
def manifolds(
    a: Solids,
    b: Solids,
    pairs: IntArray,
    found: Array,
    margin: float,
    limit: int,
    begin: int,
    spaces: tuple[Patch, Patch, Cut, Cut],
    names: IntArray,
    numbers: Array,
) -> tuple[int, int]:
    """The points of the pairs from ``begin`` on, as far as there is room for them.

    Args:
        pairs: (p, 2) which solid of a, which of b.
        found: (p, 7) of each pair the point halfway, the normal and the gap.
        margin, limit: as in ``contact_points``; limit 0 is none.
        spaces: room for the largest faces.
        names: (c, 8) rows: label, kinds and places (``labels``), then the pair and the
            features of A and B.
        numbers: (c, 15) rows (``labels``).
    Returns:
        The first pair that is not done, and how many rows were filled.
    """
    count, p = 0, begin
    origin, normal = np.empty(3), np.empty(3)
    order = np.empty(limit + 1, dtype=np.intp)
    most = len(spaces[2].place)
    while p < len(pairs) and count + most <= len(numbers):
        if found[p, 6] <= margin:
            count += _manifold(
                a, b, pairs, found, margin, limit, p, spaces, names[count:],
                numbers[count:], origin, normal, order,
            )  # fmt: skip
        p += 1
    return p, count


@compiled
def _manifold(
    a: Solids,
    b: Solids,
    pairs: IntArray,
    found: Array,
    margin: float,
    limit: int,
    p: int,
    spaces: tuple[Patch, Patch, Cut, Cut],
    names: IntArray,
    numbers: Array,
    origin: Array,
    normal: Array,
    order: IntArray,
) -> int:
    """The points of pair p, in the first rows."""
    i, j = pairs[p, 0], pairs[p, 1]
    patch_a, patch_b, cut, other = spaces
    origin[:] = found[p, :3]
    n = found[p, 3:6]
    top_a, size_a = height_and_size(a, i, origin, -n[0], -n[1], -n[2])
    top_b, size_b = height_and_size(b, j, origin, n[0], n[1], n[2])
    scale, noise = _scales(size_a + a.radius[i], size_b + b.radius[j], origin)
    bias = BIAS * scale + noise
    count_a, feature_a = supporting_patch(a, i, origin, -1.0, n, top_a, bias, patch_a)
    count_b, feature_b = supporting_patch(b, j, origin, 1.0, n, top_b, bias, patch_b)
    manifold_normal(patch_a, patch_b, count_a, count_b, n, normal)
    flatten(normal, patch_a, count_a, patch_b, count_b)
    pair = Pair(patch_a, patch_b, count_a, count_b, a.radius[i], b.radius[j], normal,
                scale, bias, preferred(normal))  # fmt: skip
    local = found[p].copy()
    local[:3] = 0.0
    count = meet(pair, local, names, numbers, margin, SAME_DEPTH * scale + noise,
                 cut, other)  # fmt: skip
    if limit:
        count = thin(names, numbers, count, limit, bias, order)
    for k in range(count):
        row = names[k]
        row[5] = p
        row[6] = _number(a, i, patch_a, count_a, feature_a, row[KIND_A], row[PLACE_A])
        row[7] = _number(b, j, patch_b, count_b, feature_b, row[KIND_A + 2], row[PLACE_A + 2])  # fmt: skip
        for axis in range(3):
            numbers[k, POINT + axis] += origin[axis]
    return count


@compiled
def _scales(size_a: float, size_b: float, origin: Array) -> tuple[float, float]:
    """The size of the smaller solid (of the other if it is a point), and the rounding of coordinates."""
    scale = min(size_a, size_b)
    if scale == 0.0:
        scale = max(size_a, size_b)
    reach = max(abs(origin[0]), abs(origin[1]), abs(origin[2])) + size_a + size_b
    return scale, ROUNDING * reach


@compiled
def _number(
    solids: Solids,
    solid: int,
    patch: Patch,
    count: int,
    feature: int,
    kind: int,
    place: int,
) -> int:
    """A feature's number in its solid: vertices first, then edges, then faces."""
    vertices = solids.vertex_start[solid + 1] - solids.vertex_start[solid]
    if kind == VERTEX:
        return patch.vertex[place]
    if kind == FACE:
        edges = solids.edge_start[solid + 1] - solids.edge_start[solid]
        return vertices + edges + feature
    if count == 2:
        return vertices + feature
    p, q = patch.vertex[place], patch.vertex[(place + 1) % count]
    return vertices + edge_between(solids, solid, p, q)


def spaces_for(corners_a: int, corners_b: int) -> tuple[Patch, Patch, Cut, Cut]:
    """Room for two faces of so many corners each, and for clipping one by the other."""
    a, b = max(corners_a, 2), max(corners_b, 2)
    return patch_room(a), patch_room(b), cut_room(2 * (a + b)), cut_room(2 * (a + b))


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    whole, none = np.array([0, 1], dtype=np.intp), np.zeros(2, dtype=np.intp)
    point = Solids(np.zeros((1, 3)), whole, np.ones(1), np.zeros((0, 3)), none,
                   none[:0], none[:1], np.zeros((0, 2), dtype=np.intp), none)  # fmt: skip
    rows = np.zeros((20, 8), dtype=np.intp), np.zeros((20, WIDTH))
    found = np.array([[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, -2.0]])
    pairs = np.zeros((1, 2), dtype=np.intp)
    manifolds(point, point, pairs, found, 0.0, 4, 0, spaces_for(1, 1), *rows)
