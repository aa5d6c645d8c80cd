"""The separation of two features of polytopes in closed form, whichever they are."""

import numpy as np


def feature(solids, number, solid=0):
    """A feature of a solid by its number in a contact's key: its kind and its points, (k, 3)."""
    first, begin = solids.vertex_start[solid], solids.edge_start[solid]
    vertices = solids.vertex_start[solid + 1] - first
    edges = solids.edge_start[solid + 1] - begin
    if number < vertices:
        return "vertex", solids.vertices[[first + number]]
    if number < vertices + edges:
        return "edge", solids.vertices[solids.edges[begin + number - vertices]]
    face = solids.face_start[solid] + number - vertices - edges
    loop = solids.loop[solids.loop_start[face] : solids.loop_start[face + 1]]
    return "face", solids.vertices[loop]


def unit(x):
    return x / np.linalg.norm(x)


def face_normal(points):
    """By Newell's formula; the points run counter-clockwise seen from outside."""
    arm = points - points[0]
    return unit(np.cross(arm, np.roll(arm, -1, axis=0)).sum(axis=0))


def separation_and_normal(one, other, toward):
    """d of the cores and N out of the other toward the one; ``toward`` says which way N points where that is open."""
    (kind_a, a), (kind_b, b) = one, other
    if kind_b == "face":
        n = face_normal(b)
        return (a[0] - b[0]) @ n, n
    if kind_a == "face":
        n = -face_normal(a)
        return (a[0] - b[0]) @ n, n
    if kind_a == kind_b == "edge":
        n = unit(np.cross(a[1] - a[0], b[1] - b[0]))
        n = n if n @ toward > 0 else -n
        return (a[0] - b[0]) @ n, n
    p, q = a[0], b[0]
    if kind_a == "edge":
        e = unit(a[1] - a[0])
        p = p + ((q - p) @ e) * e
    if kind_b == "edge":
        e = unit(b[1] - b[0])
        q = q + ((p - q) @ e) * e
    n = unit(p - q)
    return ((p - q) @ n, n) if n @ toward > 0 else ((q - p) @ n, -n)
