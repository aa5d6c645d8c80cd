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
from course.overlap.manifold.patches import MANIFOLD, A, B, desk

#: The labels as numbers, in the order of ``course.overlap.FEATURES``.
FACE_B, FACE_A, EDGES, CURVED = 0, 1, 2, 3
#: What a feature is. Its place in its patch: a vertex's corner, an edge's first corner.
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

#: Columns of the table of numbers: point, N, d, directions of edges, curvatures.
POINT, NORMAL, SEPARATION, EDGE_A, EDGE_B, CURVATURE_A, CURVATURE_B, WIDTH = (
    0, 3, 6, 7, 10, 13, 14, 15)  # fmt: skip
#: Columns of the table of names: label, kind and place of A's feature and of B's.
LABEL, KIND_A, PLACE_A, KIND_B, PLACE_B = 0, 1, 2, 3, 4


class Pair(NamedTuple):
    """Two patches in numbers: corners, radii of the solids, and what decides.

    scale: size of the smaller solid [m]; bias: what counts as one place [m]; first: the
    side whose material points are taken where both would do.
    """

    count_a: int
    count_b: int
    radius_a: float
    radius_b: float
    scale: float
    bias: float
    first: int


@compiled
def label(
    pair: Pair, corner: Array, normal: Array, names: IntArray, numbers: Array, k: int
) -> None:
    """Fill row k of numbers, and the label in row k of names, from the features named there.

    Args:
        corner, normal: of the ``Desk``; points are counted from the pair's own origin.
    """
    kind_a, i, kind_b, j = names[k, 1], names[k, 2], names[k, 3], names[k, 4]
    for column in range(EDGE_A, WIDTH):
        numbers[k, column] = 0.0
    if kind_b == FACE:  # and a vertex of A
        p = at(corner, A, i)
        names[k, LABEL] = on_face_of_b(pair, corner, normal, p, numbers, k)
    elif kind_a == FACE:
        p = at(corner, B, j)
        names[k, LABEL] = on_face_of_a(pair, corner, normal, p, numbers, k)
    elif kind_a == EDGE and kind_b == EDGE:
        names[k, LABEL] = crossing(pair, corner, normal, i, j, numbers, k)
    else:
        names[k, LABEL] = between(
            pair, corner, normal, i, j, kind_a == EDGE, kind_b == EDGE, numbers, k
        )


@compiled
def on_face_of_b(
    pair: Pair,
    corner: Array,
    normal: Array,
    p: tuple[float, float, float],
    numbers: Array,
    k: int,
) -> int:
    """A point of A's core over the plane of B's face."""
    n = row(normal, B)
    d = along(p, at(corner, B, 0), n)
    fill(pair, p, n, d, numbers, k)
    if pair.radius_a == 0.0:
        return FACE_B
    numbers[k, CURVATURE_A] = 1.0 / pair.radius_a
    return CURVED


@compiled
def on_face_of_a(
    pair: Pair,
    corner: Array,
    normal: Array,
    q: tuple[float, float, float],
    numbers: Array,
    k: int,
) -> int:
    """A point of B's core over the plane of A's face."""
    x, y, z = row(normal, A)
    d = along(q, at(corner, A, 0), (x, y, z))
    p = (q[0] - d * x, q[1] - d * y, q[2] - d * z)
    fill(pair, p, (-x, -y, -z), d, numbers, k)
    if pair.radius_b == 0.0:
        return FACE_A
    numbers[k, CURVATURE_B] = 1.0 / pair.radius_b
    return CURVED


@compiled
def crossing(
    pair: Pair, corner: Array, normal: Array, i: int, j: int, numbers: Array, k: int
) -> int:
    """Two edges: along e_A x e_B where that is a normal, else one's point over the other's face."""
    e = along_edge(corner, A, i, pair.count_a)
    f = along_edge(corner, B, j, pair.count_b)
    x, y, z = cross(e, f)
    sine = math.sqrt(x * x + y * y + z * z)  # times both lengths
    upward = x * normal[MANIFOLD, 0] + y * normal[MANIFOLD, 1] + z * normal[MANIFOLD, 2]
    rounded = pair.radius_a > 0.0 or pair.radius_b > 0.0
    least = PARALLEL_ROUNDED if rounded else PARALLEL_SINE
    if (
        sine <= least * math.sqrt(square(e) * square(f))
        or abs(upward) < OWN_COSINE * sine
    ):
        return material_crossing(pair, corner, normal, i, j, numbers, k)
    turn = math.copysign(1.0 / sine, upward)
    own = (x * turn, y * turn, z * turn)
    p, q = at(corner, A, i), at(corner, B, j)
    # The point of A's line in the plane of f and N: (q - p - s e) . (f x N) = 0.
    across = cross(f, own)
    s = along(q, p, across) / (e[0] * across[0] + e[1] * across[1] + e[2] * across[2])
    on_a = (p[0] + s * e[0], p[1] + s * e[1], p[2] + s * e[2])
    fill(pair, on_a, own, along(p, q, own), numbers, k)
    for axis in range(3):
        numbers[k, EDGE_A + axis], numbers[k, EDGE_B + axis] = e[axis], f[axis]
    return curved_or(EDGES, pair, numbers, k) if rounded else EDGES


@compiled
def material_crossing(
    pair: Pair, corner: Array, normal: Array, i: int, j: int, numbers: Array, k: int
) -> int:
    """Edges that cross at no angle to speak of: a point of one, over the other's face if it has one."""
    faces = pair.count_a > 2 and pair.count_b > 2
    on_b = pair.first == A if faces else pair.count_b > 2
    p = over_other_edge(corner, A, i, pair.count_a, j, pair.count_b)
    q = over_other_edge(corner, B, j, pair.count_b, i, pair.count_a)
    if on_b:
        on_face_of_b(pair, corner, normal, p, numbers, k)
    elif pair.count_a > 2:
        on_face_of_a(pair, corner, normal, q, numbers, k)
    else:
        n = row(normal, MANIFOLD)
        fill(pair, p, n, along(p, q, n), numbers, k)
    numbers[k, CURVATURE_A] = numbers[k, CURVATURE_B] = 0.0
    return FACE_A if pair.count_a > 2 and not on_b else FACE_B


@compiled
def between(
    pair: Pair,
    corner: Array,
    normal: Array,
    i: int,
    j: int,
    edge_a: bool,
    edge_b: bool,
    numbers: Array,
    k: int,
) -> int:
    """Two vertices, or a vertex and an edge: along the line from one to the other."""
    p, q = at(corner, A, i), at(corner, B, j)
    if edge_a:
        p = nearest_on_edge(corner, A, i, pair.count_a, q)
    if edge_b:
        q = nearest_on_edge(corner, B, j, pair.count_b, p)
    own = row(normal, MANIFOLD)
    core = along(p, q, own)
    x, y, z = p[0] - q[0], p[1] - q[1], p[2] - q[2]
    length = math.sqrt(x * x + y * y + z * z)
    if length > pair.bias and abs(core) >= OWN_COSINE * length:
        core = math.copysign(length, core)
        own = (x / core, y / core, z / core)
    fill(pair, p, own, core, numbers, k)
    if pair.radius_a == 0.0 and pair.radius_b == 0.0 and core <= pair.bias:
        return FACE_B
    if edge_a:
        e = along_edge(corner, A, i, pair.count_a)
        numbers[k, 7], numbers[k, 8], numbers[k, 9] = e
    if edge_b:
        e = along_edge(corner, B, j, pair.count_b)
        numbers[k, 10], numbers[k, 11], numbers[k, 12] = e
    return curved_or(FACE_B, pair, numbers, k)


@compiled
def curved_or(other: int, pair: Pair, numbers: Array, k: int) -> int:
    """Set both curvatures; the other label where one surface is sunk as deep as it is round."""
    a, b, scale = pair.radius_a, pair.radius_b, pair.scale
    if a > 0.0:
        scale = min(scale, a)
    if b > 0.0:
        scale = min(scale, b)
    of_a = 1.0 / a if a > 0.0 else SHARP / scale
    of_b = 1.0 / b if b > 0.0 else SHARP / scale
    # The flatter one has to be outside (``course.contact.curved``); which one that is, is
    # not told by these numbers where one is round all about and the other across only.
    flatter, rounder = min(of_a, of_b), max(of_a, of_b)
    if -numbers[k, SEPARATION] * (rounder if rounder <= 2.0 * flatter else flatter) >= DEEPEST:  # fmt: skip
        return other
    numbers[k, CURVATURE_A], numbers[k, CURVATURE_B] = of_a, of_b
    return CURVED


@compiled
def fill(
    pair: Pair,
    p: tuple[float, float, float],
    n: tuple[float, float, float],
    core: float,
    numbers: Array,
    k: int,
) -> None:
    """Point halfway, N and d, from a point of A's core and how far B's core is from it along N."""
    d = core - pair.radius_a - pair.radius_b
    down = pair.radius_a + 0.5 * d
    for axis in range(3):
        numbers[k, POINT + axis] = p[axis] - down * n[axis]
        numbers[k, NORMAL + axis] = n[axis]
    numbers[k, SEPARATION] = d


@compiled
def at(corner: Array, side: int, i: int) -> tuple[float, float, float]:
    """A corner."""
    return corner[side, i, 0], corner[side, i, 1], corner[side, i, 2]


@compiled
def row(normal: Array, which: int) -> tuple[float, float, float]:
    """A normal."""
    return normal[which, 0], normal[which, 1], normal[which, 2]


@compiled
def along(
    p: tuple[float, float, float],
    q: tuple[float, float, float],
    n: tuple[float, float, float],
) -> float:
    """(p - q) . n"""
    return (p[0] - q[0]) * n[0] + (p[1] - q[1]) * n[1] + (p[2] - q[2]) * n[2]


@compiled
def cross(
    e: tuple[float, float, float], f: tuple[float, float, float]
) -> tuple[float, float, float]:
    """e x f"""
    return (
        e[1] * f[2] - e[2] * f[1],
        e[2] * f[0] - e[0] * f[2],
        e[0] * f[1] - e[1] * f[0],
    )


@compiled
def square(e: tuple[float, float, float]) -> float:
    """e . e"""
    return e[0] * e[0] + e[1] * e[1] + e[2] * e[2]


@compiled
def along_edge(
    corner: Array, side: int, i: int, count: int
) -> tuple[float, float, float]:
    """The edge that leaves a corner, as long as it is."""
    k = i + 1 if i + 1 < count else 0
    return (
        corner[side, k, 0] - corner[side, i, 0],
        corner[side, k, 1] - corner[side, i, 1],
        corner[side, k, 2] - corner[side, i, 2],
    )


@compiled
def nearest_on_edge(
    corner: Array, side: int, i: int, count: int, p: tuple[float, float, float]
) -> tuple[float, float, float]:
    """The point of the edge that leaves a corner nearest to p."""
    k = i + 1 if i + 1 < count else 0
    x, y, z = at(corner, side, i)
    ux, uy, uz = corner[side, k, 0] - x, corner[side, k, 1] - y, corner[side, k, 2] - z
    length = ux * ux + uy * uy + uz * uz
    if length == 0.0:
        return x, y, z
    t = ((p[0] - x) * ux + (p[1] - y) * uy + (p[2] - z) * uz) / length
    t = min(max(t, 0.0), 1.0)
    return x + t * ux, y + t * uy, z + t * uz


@compiled
def over_other_edge(
    corner: Array, side: int, i: int, count: int, j: int, others: int
) -> tuple[float, float, float]:
    """The point of one side's edge that lies over the other's, by where these cross in the plane."""
    k, m = i + 1 if i + 1 < count else 0, j + 1 if j + 1 < others else 0
    other = 1 - side
    ex = corner[side, k, 3] - corner[side, i, 3]
    ey = corner[side, k, 4] - corner[side, i, 4]
    fx = corner[other, m, 3] - corner[other, j, 3]
    fy = corner[other, m, 4] - corner[other, j, 4]
    wx = corner[other, j, 3] - corner[side, i, 3]
    wy = corner[other, j, 4] - corner[side, i, 4]
    sine, s = ex * fy - ey * fx, 0.5
    if sine != 0.0:
        s = min(max((wx * fy - wy * fx) / sine, 0.0), 1.0)
    p, q = at(corner, side, i), at(corner, side, k)
    return (
        p[0] + s * (q[0] - p[0]),
        p[1] + s * (q[1] - p[1]),
        p[2] + s * (q[2] - p[2]),
    )


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    room = desk(2, 2)
    room.corner[0, :2, 0], room.corner[1, :2, 1] = (-1.0, 1.0), (-1.0, 1.0)
    room.normal[MANIFOLD, 2] = 1.0
    names = np.array([[0, EDGE, 0, EDGE, 0, 0, 0, 0]], dtype=np.intp)
    pair = Pair(2, 2, 0.0, 0.0, 1.0, 1e-6, A)
    label(pair, room.corner, room.normal, names, np.zeros((1, WIDTH)), 0)
