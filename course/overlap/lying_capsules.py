"""Where a capsule lies along a face, an edge or another capsule: the two ends of the stretch they share.

A kernel module (``course.jit``): import it where it is called.

The stretch is the part of the capsule's segment above the face (clipped by the planes
through the face's sides, as Cyrus and Beck do: C. Ericson, *Real-Time Collision
Detection*, section 5.3.8) or beside the other segment (clipped by the planes through its
ends).
"""

from __future__ import annotations

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.segments import nearest
from course.overlap.supporting_features import (
    CORNER,
    EDGE,
    FACE,
    SMALL,
    Solids,
    best_face,
    edge_between,
)
from course.overlap.triples import (
    Triple,
    along,
    cross,
    dot,
    length,
    minus,
    row,
    scaled,
)

#: Sine of the angle between capsule and face, or edge, below which it lies along it.
ALONG_FACE, ALONG_EDGE = 0.05, 0.01
#: The nearest point is on an edge if it is nearer to it than this times the lengths.
NEAR = 1e-7
#: What is found of the two ends of k stretches: s along the capsule, what B's point is on
#: and the number of that, (k, 2); B's point and the normal, (k, 2, 3); the distance of the
#: capsule's segment, (k, 2); the direction of B's edge, (k, 2, 3).
Found = tuple[Array, IntArray, IntArray, Array, Array, Array, Array]


@compiled
def clipped(
    low: float, high: float, height: float, rate: float
) -> tuple[float, float, int]:
    """The part of low <= s <= high with height + s rate >= 0, and which end that cut: -1 low, 1 high, 0 none."""
    if rate > 0.0 and -height > low * rate:
        return -height / rate, high, -1
    if rate < 0.0 and height < -high * rate:
        return low, height / -rate, 1
    if rate == 0.0 and height < 0.0:
        return 1.0, 0.0, 0
    return low, high, 0


@compiled
def beside(u: Triple, w: Triple, v: Triple) -> tuple[float, float]:
    """The part of 0 <= s <= 1 in which s u is beside the segment w + t v; low > high where none is."""
    square = dot(v, v)
    low, high, _ = clipped(0.0, 1.0, -dot(w, v), dot(u, v))
    low, high, _ = clipped(low, high, square + dot(w, v), -dot(u, v))
    return low, high


@compiled
def seen_from(
    u: Triple, w: Triple, v: Triple, s: float, normal: Triple
) -> tuple[float, float, Triple]:
    """(t, distance, direction) of the segment w + t v as seen from s u; along the normal where it is not on its side."""
    x = scaled(s, u)
    t = nearest(x, w, v)
    apart = minus(x, along(w, t, v))
    distance, height = length(apart), dot(apart, normal)
    if height > 0.5 * distance and height > SMALL * (length(u) + length(v)):
        return t, distance, scaled(1.0 / distance, apart)
    return t, height, normal


@compiled
def lie_along(u: Triple, v: Triple, normal: Triple) -> bool:
    """Whether two segments are nearly parallel, and nearly at right angles to the normal."""
    size_u, size_v = length(u), length(v)
    if size_u == 0.0 or size_v == 0.0:
        return False
    return (
        length(cross(u, v)) <= ALONG_EDGE * size_u * size_v
        and abs(dot(u, normal)) <= ALONG_EDGE * size_u
        and abs(dot(v, normal)) <= ALONG_EDGE * size_v
    )


@compiled
def ends_beside(
    p: Triple, u: Triple, q: Triple, v: Triple, normal: Triple, k: int, found: Found
) -> None:
    """Enter the ends of the stretch that p + s u and q + t v share in row k."""
    s, kind, number, place, direction, distance, axis = found
    low, high = beside(u, minus(q, p), v)
    if not low < high:
        return
    for end in range(2):
        s[k, end] = low if end == 0 else high
        t, distance[k, end], n = seen_from(u, minus(q, p), v, s[k, end], normal)
        kind[k, end] = EDGE if SMALL < t < 1.0 - SMALL else CORNER
        number[k, end] = 0 if t <= SMALL else 1
        y = along(q, t, v)
        for i in range(3):
            place[k, end, i], direction[k, end, i], axis[k, end, i] = y[i], n[i], v[i]


@compiled
def stretches_beside(
    start_a: Array, end_a: Array, start_b: Array, end_b: Array, normal: Array, found: Found
) -> None:
    """Fill the ends of the stretches that capsules A and B of each row share, where they lie along each other."""
    for k in range(len(normal)):
        p, q, n = row(start_a, k), row(start_b, k), row(normal, k)
        u, v = minus(row(end_a, k), p), minus(row(end_b, k), q)
        if lie_along(u, v, n):
            ends_beside(p, u, q, v, n, k, found)


@compiled
def ends_on_face(
    p: Triple, u: Triple, solids: Solids, solid: int, face: int, k: int, found: Found
) -> None:
    """Enter the ends of the part of p + s u that is above a face in row k."""
    vertices, _, normals, _, loop, loop_start, edges, edge_start = solids
    s, kind, number, place, direction, distance, axis = found
    n, begin, end = row(normals, face), loop_start[face], loop_start[face + 1]
    low, high = 0.0, 1.0
    cuts = (-1, -1)  # the sides, counted along the loop, that cut it
    for c in range(begin, end):
        here = row(vertices, loop[c])
        way = minus(row(vertices, loop[c + 1 if c + 1 < end else begin]), here)
        inward = cross(n, way)
        low, high, cut = clipped(low, high, dot(minus(p, here), inward), dot(u, inward))
        if cut != 0:
            cuts = (c, cuts[1]) if cut < 0 else (cuts[0], c)
    if not low < high:
        return
    base = row(vertices, loop[begin])
    for side in range(2):
        s[k, side] = low if side == 0 else high
        distance[k, side] = dot(along(minus(p, base), s[k, side], u), n)
        y = along(along(p, s[k, side], u), -distance[k, side], n)
        kind[k, side], number[k, side], c = FACE, face, cuts[side]
        if c >= 0:
            i, j = loop[c], loop[c + 1 if c + 1 < end else begin]
            kind[k, side] = EDGE
            number[k, side] = edge_between(
                edges, edge_start[solid], edge_start[solid + 1], i, j
            )
            way = minus(row(vertices, j), row(vertices, i))
            axis[k, side, 0], axis[k, side, 1], axis[k, side, 2] = way
        for i in range(3):
            place[k, side, i], direction[k, side, i] = y[i], n[i]


@compiled
def ends_on_edge(
    p: Triple,
    u: Triple,
    solids: Solids,
    solid: int,
    normal: Triple,
    point: Triple,
    k: int,
    found: Found,
) -> None:
    """Enter the ends of the stretch that p + s u shares with an edge through the nearest point, if one lies along it."""
    vertices, edges, edge_start = solids[0], solids[6], solids[7]
    for e in range(edge_start[solid], edge_start[solid + 1]):
        q = row(vertices, edges[e, 0])
        v = minus(row(vertices, edges[e, 1]), q)
        if not lie_along(u, v, normal):
            continue
        t = nearest(point, q, v)
        if length(minus(along(q, t, v), point)) > NEAR * (length(u) + length(v)):
            continue
        ends_beside(p, u, q, v, normal, k, found)
        for side in range(2):
            if found[1][k, side] == EDGE:
                found[2][k, side] = e
            elif found[1][k, side] == CORNER:
                found[2][k, side] = edges[e, found[2][k, side]]
        return


@compiled
def stretches_on_polytopes(
    start: Array,
    end: Array,
    solids: Solids,
    solid: IntArray,
    normal: Array,
    point: Array,
    found: Found,
) -> None:
    """Fill the ends of the stretches along which capsules lie on a face or an edge of their polytopes.

    Args:
        start, end: of the capsules' segments, (k, 3).
        solids: the polytopes.
        solid: which one, (k,).
        normal: out of the polytope, toward the capsule, (k, 3).
        point: the polytope's nearest point, (k, 3).
        found: filled.
    """
    normals, face_start = solids[2], solids[3]
    for k in range(len(normal)):
        i, p, n = solid[k], row(start, k), row(normal, k)
        u = minus(row(end, k), p)
        face, most = best_face(normals, face_start[i], face_start[i + 1], n)
        flat = face >= 0 and most >= 1.0 - 0.5 * ALONG_FACE**2
        if flat and abs(dot(u, row(normals, face))) <= ALONG_FACE * length(u):
            ends_on_face(p, u, solids, i, face, k, found)
        else:
            ends_on_edge(p, u, solids, i, n, row(point, k), k, found)


def warm() -> None:
    """Compile the kernels."""
    from course.overlap.curved_contacts import warm as compile_all

    compile_all()
