"""What one point of a manifold is: its own normal, its own separation, and which word says how they move.

The word decides d_ddot (``course.contact.gaps``), so each point is labelled by the two
features that meet in it, and not by what the whole manifold looks like:

=================  ==========  =====================================================
A's and B's        label       N and d
=================  ==========  =====================================================
vertex, face       "face_b"    N = n_B; d = (vertex - face) . n_B
face, vertex       "face_a"    N = -n_A; d = (vertex - face) . n_A
edge, edge         "edges"     N along e_A x e_B, on the side of the manifold's normal;
                               d from line to line along it
rounded, anything  "curved"    N from one core to the other (on a face: its normal);
                               d less the radii
vertex, vertex or  "curved"    N between them, if they are apart, each with a large
edge               "face_b"    curvature; touching, the manifold's normal, carried by B
=================  ==========  =====================================================

Two faces that lean against each other by 1e-6 thus give points with two or more normals.
One normal for all would be wrong in d by the leaning times the distance, and in d_ddot by
the leaning times the motion along the face.

Edges of two faces in contact cross *inside* the plane of contact. e_A x e_B is then the
common normal of the faces as nearly as these lean, divided by the sine of the angle between
the edges: exact for a sine of order 1, nonsense for nearly parallel edges, whose crossing
runs away when the bodies turn. So a crossing is "edges" only if that sine is above
``PARALLEL_SINE`` and its normal within ``OWN_ANGLE`` of the manifold's; else the point of
one body's edge is taken as a material point over the other's face. (The crossing of two
nearly parallel edges is hardly a corner of the polygon anyway.)

An edge or a vertex against something round is "curved": it is round itself, with a radius
``1 / SHARP`` of the pair's scale.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.manifold.patches import Patch, patch_room

#: The labels as numbers, in the order of ``course.overlap.FEATURES``.
FACE_B, FACE_A, EDGES, CURVED = 0, 1, 2, 3
#: What a feature is; for a feature's place in its patch see ``Pair``.
VERTEX, EDGE, FACE = 0, 1, 2
#: Sine below which two edges count as parallel, sharp and rounded ones.
PARALLEL_SINE = 1e-3
PARALLEL_ROUNDED = 1e-6
#: Cosine of the greatest angle between a crossing's normal and the manifold's (0.1 rad).
OWN_COSINE = math.cos(0.1)
#: Curvature of a sharp vertex or edge, in units of one over the scale of the pair.
SHARP = 1e9
#: How much of its radius of curvature a surface may be sunk, to be called curved.
DEEPEST = 0.999

#: Columns of a row of numbers.
POINT, NORMAL, SEPARATION, EDGE_A, EDGE_B, CURVATURE_A, CURVATURE_B, WIDTH = (
    0, 3, 6, 7, 10, 13, 14, 15)  # fmt: skip
#: Columns of a row of names: label, kind and place of A's feature and of B's.
LABEL, KIND_A, PLACE_A, KIND_B, PLACE_B = 0, 1, 2, 3, 4


class Pair(NamedTuple):
    """Two patches and what was found of their solids.

    count_a, count_b: corners of the patches. A feature's place is its corner's number in
    the patch, an edge's that of its first corner; 0 for the face itself.
    normal (3,): of the manifold; scale: size of the smaller solid; bias: what counts as one
    place; first: whose material point is taken where both would do, +1 for A or -1 for B.
    """

    a: Patch
    b: Patch
    count_a: int
    count_b: int
    radius_a: float
    radius_b: float
    normal: Array
    scale: float
    bias: float
    first: float


@compiled
def label(pair: Pair, names: IntArray, numbers: Array) -> None:
    """Fill a row of numbers, and the label in the row of names, from the features named in it.

    Points come from the pair's own origin.
    """
    kind_a, i, kind_b, j = names[KIND_A], names[PLACE_A], names[KIND_B], names[PLACE_B]
    numbers[EDGE_A:WIDTH] = 0.0
    if kind_b == FACE:  # and a vertex of A
        names[LABEL] = _on_face_of_b(pair, _corner(pair.a, i), numbers)
    elif kind_a == FACE:
        names[LABEL] = _on_face_of_a(pair, _corner(pair.b, j), numbers)
    elif kind_a == EDGE and kind_b == EDGE:
        names[LABEL] = _crossing(pair, i, j, numbers)
    else:
        names[LABEL] = _between(pair, kind_a, i, kind_b, j, numbers)


@compiled
def _on_face_of_b(pair: Pair, p: tuple[float, float, float], numbers: Array) -> int:
    """A point of A's core over the plane of B's face."""
    n, face = pair.b.normal, pair.b.corner
    d = (
        (p[0] - face[0, 0]) * n[0]
        + (p[1] - face[0, 1]) * n[1]
        + (p[2] - face[0, 2]) * n[2]
    )
    _set(pair, numbers, p, (n[0], n[1], n[2]), d)
    if pair.radius_a == 0.0:
        return FACE_B
    numbers[CURVATURE_A] = 1.0 / pair.radius_a
    return CURVED


@compiled
def _on_face_of_a(pair: Pair, q: tuple[float, float, float], numbers: Array) -> int:
    """A point of B's core over the plane of A's face."""
    n, face = pair.a.normal, pair.a.corner
    d = (
        (q[0] - face[0, 0]) * n[0]
        + (q[1] - face[0, 1]) * n[1]
        + (q[2] - face[0, 2]) * n[2]
    )
    p = (q[0] - d * n[0], q[1] - d * n[1], q[2] - d * n[2])
    _set(pair, numbers, p, (-n[0], -n[1], -n[2]), d)
    if pair.radius_b == 0.0:
        return FACE_A
    numbers[CURVATURE_B] = 1.0 / pair.radius_b
    return CURVED


@compiled
def _crossing(pair: Pair, i: int, j: int, numbers: Array) -> int:
    """Two edges: along e_A x e_B where that is a normal, else one's point over the other's face."""
    e, f = _direction(pair.a, pair.count_a, i), _direction(pair.b, pair.count_b, j)
    x = e[1] * f[2] - e[2] * f[1]
    y = e[2] * f[0] - e[0] * f[2]
    z = e[0] * f[1] - e[1] * f[0]
    sine, n = math.sqrt(x * x + y * y + z * z), pair.normal
    rounded = pair.radius_a > 0.0 or pair.radius_b > 0.0
    along = x * n[0] + y * n[1] + z * n[2]
    least = PARALLEL_ROUNDED if rounded else PARALLEL_SINE
    if sine <= least or abs(along) < OWN_COSINE * sine:
        return _material_crossing(pair, i, j, numbers)
    turn = math.copysign(1.0 / sine, along)
    own = (x * turn, y * turn, z * turn)
    p, q = pair.a.corner, pair.b.corner
    wx, wy, wz = q[j, 0] - p[i, 0], q[j, 1] - p[i, 1], q[j, 2] - p[i, 2]
    # The point of A's line in the plane of f and N: (w - s e) . (f x N) = 0.
    gx, gy, gz = (
        f[1] * own[2] - f[2] * own[1],
        f[2] * own[0] - f[0] * own[2],
        f[0] * own[1] - f[1] * own[0],
    )
    s = (wx * gx + wy * gy + wz * gz) / (e[0] * gx + e[1] * gy + e[2] * gz)
    d = -(wx * own[0] + wy * own[1] + wz * own[2])
    point = (p[i, 0] + s * e[0], p[i, 1] + s * e[1], p[i, 2] + s * e[2])
    _set(pair, numbers, point, own, d)
    for axis in range(3):
        numbers[EDGE_A + axis], numbers[EDGE_B + axis] = e[axis], f[axis]
    return _curved_or(EDGES, pair, numbers) if rounded else EDGES


@compiled
def _material_crossing(pair: Pair, i: int, j: int, numbers: Array) -> int:
    """Edges that cross at no angle to speak of: a point of one, over the other's face if it has one."""
    on_b = pair.count_b > 2 and (pair.first > 0 or pair.count_a < 3)
    n = pair.normal
    p, q = _over_each_other(pair, i, j)
    if on_b:
        _on_face_of_b(pair, p, numbers)
    elif pair.count_a > 2:
        _on_face_of_a(pair, q, numbers)
    else:
        d = (p[0] - q[0]) * n[0] + (p[1] - q[1]) * n[1] + (p[2] - q[2]) * n[2]
        _set(pair, numbers, p, (n[0], n[1], n[2]), d)
    numbers[EDGE_A:WIDTH] = 0.0
    return FACE_A if pair.count_a > 2 and not on_b else FACE_B


@compiled
def _between(
    pair: Pair, kind_a: int, i: int, kind_b: int, j: int, numbers: Array
) -> int:
    """Two vertices, or a vertex and an edge: along the line from one to the other."""
    if kind_a == VERTEX and kind_b == VERTEX:
        p, q = _corner(pair.a, i), _corner(pair.b, j)
    elif kind_a == VERTEX:
        p = _corner(pair.a, i)
        q = nearest_on_edge(pair.b, pair.count_b, j, p)
    else:
        q = _corner(pair.b, j)
        p = nearest_on_edge(pair.a, pair.count_a, i, q)
    x, y, z, n = p[0] - q[0], p[1] - q[1], p[2] - q[2], pair.normal
    length, along = math.sqrt(x * x + y * y + z * z), x * n[0] + y * n[1] + z * n[2]
    own = (n[0], n[1], n[2])
    if length > pair.bias and abs(along) >= OWN_COSINE * length:
        turn = math.copysign(1.0 / length, along)
        own, along = (x * turn, y * turn, z * turn), math.copysign(length, along)
    _set(pair, numbers, p, own, along)
    if kind_a == EDGE:
        _set_axis(pair.a, pair.count_a, i, numbers, EDGE_A)
    if kind_b == EDGE:
        _set_axis(pair.b, pair.count_b, j, numbers, EDGE_B)
    if pair.radius_a == 0.0 and pair.radius_b == 0.0 and along <= pair.bias:
        numbers[EDGE_A:WIDTH] = 0.0
        return FACE_B
    return _curved_or(FACE_B, pair, numbers)


@compiled
def _curved_or(other: int, pair: Pair, numbers: Array) -> int:
    """Set both curvatures; the other label where one surface is sunk as deep as it is round."""
    a, b, scale = pair.radius_a, pair.radius_b, pair.scale
    if a > 0.0:
        scale = min(scale, a)
    if b > 0.0:
        scale = min(scale, b)
    numbers[CURVATURE_A] = 1.0 / a if a > 0.0 else SHARP / scale
    numbers[CURVATURE_B] = 1.0 / b if b > 0.0 else SHARP / scale
    flatter = min(numbers[CURVATURE_A], numbers[CURVATURE_B])
    if -numbers[SEPARATION] * flatter < DEEPEST:
        return CURVED
    numbers[CURVATURE_A] = numbers[CURVATURE_B] = 0.0
    return other


@compiled
def _set(
    pair: Pair,
    numbers: Array,
    p: tuple[float, float, float],
    n: tuple[float, float, float],
    core: float,
) -> None:
    """Point halfway, N and d, from a point of A's core and how far B's core is from it along N."""
    d = core - pair.radius_a - pair.radius_b
    for axis in range(3):
        numbers[POINT + axis] = p[axis] - (pair.radius_a + 0.5 * d) * n[axis]
        numbers[NORMAL + axis] = n[axis]
    numbers[SEPARATION] = d


@compiled
def _set_axis(patch: Patch, count: int, i: int, numbers: Array, column: int) -> None:
    e = _direction(patch, count, i)
    for axis in range(3):
        numbers[column + axis] = e[axis]


@compiled
def _corner(patch: Patch, i: int) -> tuple[float, float, float]:
    return patch.corner[i, 0], patch.corner[i, 1], patch.corner[i, 2]


@compiled
def _direction(patch: Patch, count: int, i: int) -> tuple[float, float, float]:
    """The unit vector along the edge that leaves a corner; zero if it has no length."""
    k, corner = (i + 1) % count, patch.corner
    x = corner[k, 0] - corner[i, 0]
    y = corner[k, 1] - corner[i, 1]
    z = corner[k, 2] - corner[i, 2]
    length = math.sqrt(x * x + y * y + z * z)
    if length == 0.0:
        return 0.0, 0.0, 0.0
    return x / length, y / length, z / length


@compiled
def nearest_on_edge(
    patch: Patch, count: int, i: int, p: tuple[float, float, float]
) -> tuple[float, float, float]:
    k, corner = (i + 1) % count, patch.corner
    x, y, z = _corner(patch, i)
    ux, uy, uz = corner[k, 0] - x, corner[k, 1] - y, corner[k, 2] - z
    square = ux * ux + uy * uy + uz * uz
    if square == 0.0:
        return x, y, z
    t = ((p[0] - x) * ux + (p[1] - y) * uy + (p[2] - z) * uz) / square
    t = min(max(t, 0.0), 1.0)
    return x + t * ux, y + t * uy, z + t * uz


@compiled
def _over_each_other(
    pair: Pair, i: int, j: int
) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """The points of two edges that lie over each other, by where these cross in the plane."""
    k, m = (i + 1) % pair.count_a, (j + 1) % pair.count_b
    p, q = pair.a.flat, pair.b.flat
    ex, ey = p[k, 0] - p[i, 0], p[k, 1] - p[i, 1]
    fx, fy = q[m, 0] - q[j, 0], q[m, 1] - q[j, 1]
    wx, wy = q[j, 0] - p[i, 0], q[j, 1] - p[i, 1]
    cross = ex * fy - ey * fx
    s, t = 0.5, 0.5
    if cross != 0.0:
        s = min(max((wx * fy - wy * fx) / cross, 0.0), 1.0)
        t = min(max((wx * ey - wy * ex) / cross, 0.0), 1.0)
    a, b = pair.a.corner, pair.b.corner
    return (
        (
            a[i, 0] + s * (a[k, 0] - a[i, 0]),
            a[i, 1] + s * (a[k, 1] - a[i, 1]),
            a[i, 2] + s * (a[k, 2] - a[i, 2]),
        ),
        (
            b[j, 0] + t * (b[m, 0] - b[j, 0]),
            b[j, 1] + t * (b[m, 1] - b[j, 1]),
            b[j, 2] + t * (b[m, 2] - b[j, 2]),
        ),
    )


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    a, b = patch_room(4), patch_room(4)
    a.corner[:2] = [(-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)]
    b.corner[:2] = [(0.0, -1.0, 0.0), (0.0, 1.0, 0.0)]
    up = np.array([0.0, 0.0, 1.0])
    pair = Pair(a, b, 2, 2, 0.0, 0.0, up, 1.0, 1e-6, 1.0)
    label(pair, np.array([0, EDGE, 0, EDGE, 0], dtype=np.intp), np.zeros(WIDTH))
