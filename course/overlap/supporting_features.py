"""The corner, edge or face of a polytope that is farthest along a direction.

A kernel module (``course.jit``): import it where it is called.

That is the feature on which a contact with this normal lies (G. van den Bergen,
*Collision Detection in Interactive 3D Environments*, section 2.3).
"""

from __future__ import annotations

from course.arrays import Array, IntArray
from course.jit import compiled
from course.overlap.triples import (
    Triple,
    cross,
    dot,
    length,
    minus,
    row,
    scaled,
)

#: Lengths below this times the size are none.
SMALL = 1e-9
#: What a point is on: nothing (there is no contact), a corner, an edge, a face.
NONE, CORNER, EDGE, FACE = 0, 1, 2, 3
#: Vertices, where each solid's begin, normals, where each solid's begin, loops, where each
#: face's begin, edges, where each solid's begin (``course.shapes.Polytopes``).
Solids = tuple[
    Array, IntArray, Array, IntArray, IntArray, IntArray, IntArray, IntArray
]


@compiled
def supporting(
    vertices: Array, begin: int, end: int, direction: Triple
) -> tuple[int, int, int]:
    """Which feature of a polytope is farthest along a unit direction: (kind, vertex, another vertex of it)."""
    first = row(vertices, begin)
    best, most, size = begin, 0.0, 0.0
    for k in range(begin, end):
        x = minus(row(vertices, k), first)
        size = max(size, length(x))
        if dot(x, direction) > most:
            best, most = k, dot(x, direction)
    top = row(vertices, best)
    other, farthest = best, 0.0
    for k in range(begin, end):
        x = minus(row(vertices, k), top)
        if dot(x, direction) >= -SMALL * size and length(x) > farthest:
            other, farthest = k, length(x)
    if farthest <= SMALL * size:
        return CORNER, best, best
    way = scaled(1.0 / farthest, minus(row(vertices, other), top))
    for k in range(begin, end):
        x = minus(row(vertices, k), top)
        if dot(x, direction) >= -SMALL * size and length(cross(x, way)) > SMALL * size:
            return FACE, best, other
    return EDGE, best, other


@compiled
def best_face(
    normals: Array, begin: int, end: int, direction: Triple
) -> tuple[int, float]:
    """The face whose normal is most along a direction, and by how much; -1 where there is none."""
    best, most = -1, -2.0
    for f in range(begin, end):
        if dot(row(normals, f), direction) > most:
            best, most = f, dot(row(normals, f), direction)
    return best, most


@compiled
def edge_between(edges: IntArray, begin: int, end: int, i: int, j: int) -> int:
    """The edge with these two ends, -1 where there is none."""
    for e in range(begin, end):
        if (edges[e, 0] == i and edges[e, 1] == j) or (
            edges[e, 0] == j and edges[e, 1] == i
        ):
            return e
    return -1


@compiled
def supporting_features(
    solids: Solids, solid: IntArray, direction: Array, kind: IntArray, number: IntArray, axis: Array
) -> None:
    """Fill kind, number (k,) and, of edges, axis (k, 3): what of each solid is farthest along a direction."""
    vertices, vertex_start, normals, face_start, _, _, edges, edge_start = solids
    for k in range(len(direction)):
        i, n = solid[k], row(direction, k)
        what, first, other = supporting(vertices, vertex_start[i], vertex_start[i + 1], n)
        kind[k], number[k] = what, first
        if what == FACE:
            number[k] = best_face(normals, face_start[i], face_start[i + 1], n)[0]
        elif what == EDGE:
            number[k] = edge_between(edges, edge_start[i], edge_start[i + 1], first, other)
            way = minus(row(vertices, other), row(vertices, first))
            for c in range(3):
                axis[k, c] = way[c]


def warm() -> None:
    """Compile the kernels."""
    from course.overlap.curved_contacts import warm as compile_all

    compile_all()
