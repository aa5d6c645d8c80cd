"""The exercise ``hulls_overlap``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_05_separating_axis.shared import CLEAR, turn
from course.exercises.slips import slip

_PRODUCTS = "np.cross(edges_a[:, None], edges_b[None]).reshape(-1, 3)"
#: Vertices, faces as loops of them, and edges, of a tetrahedron, a prism and a pyramid.
_TETRAHEDRON = (
    [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]],
    [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)],
    [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)],
)
_PRISM = (
    [[1, 0, -1], [-0.6, 0.8, -1], [-0.5, -0.9, -1], [1, 0, 1], [-0.6, 0.8, 1], [-0.5, -0.9, 1]],
    [(0, 1, 2), (3, 4, 5), (0, 1, 4), (1, 2, 5), (2, 0, 3)],
    [(0, 1), (1, 2), (2, 0), (0, 3)],
)  # fmt: skip
_PYRAMID = (
    [[1, 1, -0.5], [-1, 1, -0.5], [-1, -1, -0.5], [1, -1, -0.5], [0.2, 0.1, 1.2]],
    [(0, 1, 2), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
    [(0, 1), (1, 2), (0, 4), (1, 4), (2, 4), (3, 4)],
)


def _polytope(rng: np.random.Generator, form: Any, center: Array) -> tuple[Array, Array, Array]:
    """Vertices, face normals, edge directions, each direction once, of a stretched and turned form."""
    points, faces, edges = form
    stretch = rng.uniform(0.4, 1.2, 3)
    vertices = np.round((np.array(points) * stretch) @ turn(rng).T + center, 3)
    normals = np.array([np.cross(vertices[b] - vertices[a], vertices[c] - vertices[a]) for a, b, c in faces])
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    return vertices, normals, np.array([vertices[b] - vertices[a] for a, b in edges])


def _gaps(a: tuple[Array, ...], b: tuple[Array, ...]) -> dict[str, float]:
    """Greatest gap on each family of axes [m]; products of length below 1e-6 are left out."""
    products = np.cross(a[2][:, None], b[2][None]).reshape(-1, 3)
    length = np.linalg.norm(products, axis=-1)
    products = products[length > 1e-6] / length[length > 1e-6, None]
    families = {"A": a[1], "B": b[1], "edges": products}
    shadows = {k: (formulas.project(a[0], n), formulas.project(b[0], n)) for k, n in families.items()}
    return {k: float(formulas.shadow_gap(*s, *t).max()) for k, (s, t) in shadows.items()}


def _pair(rng: np.random.Generator, wanted: Callable[[dict[str, float]], bool], forms: Any = (_TETRAHEDRON, _PRISM)) -> dict[str, Array]:
    while True:
        way = rng.normal(size=3)
        center = rng.normal(size=3)
        a = _polytope(rng, forms[0], center)
        b = _polytope(rng, forms[1], center + rng.uniform(0.4, 2.0) * way / np.linalg.norm(way))
        gaps = _gaps(a, b)
        if abs(max(gaps.values())) > CLEAR and wanted(gaps):
            return _arguments(a, b)


def _arguments(a: tuple[Array, ...], b: tuple[Array, ...]) -> dict[str, Array]:
    names = ("vertices_a", "normals_a", "edges_a", "vertices_b", "normals_b", "edges_b")
    return dict(zip(names, (*a, *b), strict=True))


def _touching() -> dict[str, Array]:
    """Two upright prisms, one on top of the other."""
    triangle = np.array([[0.0, 0, 0], [2, 0, 0], [0, 1, 0]])
    prism = np.concatenate([triangle, triangle + [0, 0, 1]])
    slope = np.array([1.0, 2.0, 0.0]) / np.sqrt(5)
    normals = np.array([[0, 0, -1], [0, 0, 1], [0, -1, 0], [-1, 0, 0], slope])
    edges = np.array([[2.0, 0, 0], [-2, 1, 0], [0, -1, 0], [0, 0, 1]])
    return _arguments((prism, normals, edges), (prism + [0.5, 0, 1], normals, edges))


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    only = {
        name: (lambda g, name=name: g[name] > CLEAR and max(v for k, v in g.items() if k != name) < -CLEAR)
        for name in ("A", "B", "edges")
    }  # fmt: skip
    other = (_PYRAMID, _TETRAHEDRON)
    return [
        Case("a tetrahedron and a prism, overlapping", _pair(rng, lambda g: -0.3 < max(g.values()) < 0)),
        Case("apart, and only a face of A shows it", _pair(rng, only["A"])),
        Case("apart, and only a face of B shows it", _pair(rng, only["B"])),
        Case("apart, and only two edges show it", _pair(rng, only["edges"])),
        Case("a pyramid and a tetrahedron, only edges", _pair(rng, only["edges"], other)),
        Case("a pyramid and a tetrahedron, only a face of A", _pair(rng, only["A"], other)),
        Case("a pyramid and a tetrahedron, only a face of B", _pair(rng, only["B"], other)),
        Case("a pyramid and a tetrahedron, overlapping", _pair(rng, lambda g: -0.3 < max(g.values()) < 0, other)),
        Case("two prisms, one on top of the other", _touching(), "edge"),
        *(Case(f"near touching, {k}", _pair(rng, lambda g: abs(max(g.values())) < 0.3, (_PRISM, _PYRAMID))) for k in range(8)),
    ]  # fmt: skip


HULLS_OVERLAP = Exercise(
    name="hulls_overlap",
    rows=(6, 10),
    points=3,
    minutes=8,
    level="stretch",
    task="Return whether two convex polytopes overlap, given the vertices, face normals and edges of each.",
    arguments=(
        Value("vertices_a", "(n, 3)", "m", "A's vertices"),
        Value("normals_a", "(f, 3)", "", "unit normals of A's faces"),
        Value("edges_a", "(e, 3)", "m", "A's edges as vectors, each direction once"),
        Value("vertices_b", "(m, 3)", "m", "B's vertices"),
        Value("normals_b", "(g, 3)", "", "unit normals of B's faces"),
        Value("edges_b", "(h, 3)", "m", "B's edges as vectors, each direction once"),
    ),
    results=(Value("overlap", "scalar", "", "whether they overlap", dtype="bool"),),
    reference=formulas.hulls_overlap,
    cases=_cases,
    mistakes=(
        Mistake(
            "faces only",
            slip(formulas.hulls_overlap, "[normals_a, normals_b, products]", "[normals_a, normals_b]"),
            "You try the faces only. Two edges can pass each other where no face shows it: the products of the edges "
            "are axes too.",
        ),
        Mistake(
            "edges only",
            slip(formulas.hulls_overlap, "[normals_a, normals_b, products]", "[products]"),
            "You try the products of the edges only. The faces' normals are axes too.",
        ),
        Mistake(
            "faces of A missing",
            slip(formulas.hulls_overlap, "[normals_a, normals_b, products]", "[normals_b, products]"),
            "The normals of A's faces are missing among your axes.",
        ),
        Mistake(
            "faces of B missing",
            slip(formulas.hulls_overlap, "[normals_a, normals_b, products]", "[normals_a, products]"),
            "The normals of B's faces are missing among your axes.",
        ),
        Mistake(
            "products of faces",
            slip(formulas.hulls_overlap, _PRODUCTS, "np.cross(normals_a[:, None], normals_b[None]).reshape(-1, 3)"),
            "You multiply the faces' normals. For boxes these are the edges' directions, for other shapes they are "
            "not: take every edge of A with every edge of B.",
        ),
        Mistake(
            "one axis is enough",
            slip(formulas.hulls_overlap, "np.all", "np.any"),
            "You say that they overlap as soon as their shadows do on *one* axis. They must on all of them.",
        ),
        Mistake(
            "the other way round",
            slip(formulas.hulls_overlap, "np.all(shadow_gap(*shadow_a, *shadow_b) <= 0)",
                 "np.any(shadow_gap(*shadow_a, *shadow_b) > 0)"),
            "Your answer is reversed: it is True for pairs that are apart.",
        ),
        Mistake(
            "touching left out",
            slip(formulas.hulls_overlap, "<= 0", "< 0"),
            "Right but for pairs that touch or have parallel edges: their product is the zero vector, on which every "
            "gap is 0. A gap of 0 counts as overlapping.",
        ),
    ),  # fmt: skip
    hints=(
        "The same three families of axes as for boxes: faces of A, faces of B, an edge of A with an edge of B.",
        "np.cross(edges_a[:, None], edges_b[None]) has shape (e, h, 3): make it (e h, 3) with reshape. Then go on as "
        "in polygons_overlap.",
        "products = np.cross(edges_a[:, None], edges_b[None]).reshape(-1, 3)\n"
        "axes = np.concatenate([normals_a, ____, ____])\n"
        "shadow_a, shadow_b = project(vertices_a, axes), project(____, axes)\n"
        "return np.all(shadow_gap(*shadow_a, *shadow_b) ____ 0)",
    ),
)
