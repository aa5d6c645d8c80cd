"""The exercise ``hulls_overlap``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.arrays import Array
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_05_separating_axis.shared import (
    BOX_KINDS,
    KINDS,
    POOL,
    Gaps,
    Pairs,
    taken,
    turns,
)
from course.exercises.slips import slip

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


NAMES = ("vertices_a", "normals_a", "edges_a", "vertices_b", "normals_b", "edges_b")


def _polytopes(
    rng: np.random.Generator, form: Any, center: Array
) -> tuple[Array, Array, Array]:
    """Vertices, face normals, edges, each direction once, of a stretched and turned form."""
    points, faces, edges = (np.array(part) for part in form)
    stretched = points * rng.uniform(0.4, 1.2, (POOL, 1, 3))
    turned = stretched @ np.swapaxes(turns(rng, POOL), -1, -2)
    vertices = np.round(turned + center[:, None], 3)
    corner = vertices[:, faces]
    normals = np.cross(
        corner[:, :, 1] - corner[:, :, 0], corner[:, :, 2] - corner[:, :, 0]
    )
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    return vertices, normals, vertices[:, edges[:, 1]] - vertices[:, edges[:, 0]]


def _drawn(first: Any, second: Any) -> Callable[[np.random.Generator], Pairs]:
    def drawn(rng: np.random.Generator) -> Pairs:
        center, way = rng.normal(size=(2, POOL, 3))
        way *= rng.uniform(0.4, 2.0, (POOL, 1)) / np.linalg.norm(
            way, axis=-1, keepdims=True
        )
        parts = *_polytopes(rng, first, center), *_polytopes(rng, second, center + way)
        return dict(zip(NAMES, parts, strict=True))

    return drawn


def _gaps(pairs: Pairs) -> Gaps:
    """Greatest gap on each family of axes [m]; products of length below 1e-6 are left out."""
    a, b = pairs["edges_a"], pairs["edges_b"]
    products = np.cross(a[:, :, None], b[:, None]).reshape(POOL, -1, 3)
    length = np.linalg.norm(products, axis=-1, keepdims=True)
    products = products / np.maximum(length, 1e-6)
    families = {"A": pairs["normals_a"], "B": pairs["normals_b"], "edges": products}
    x, y = pairs["vertices_a"], pairs["vertices_b"]
    return {
        name: formulas.shadow_gap(*formulas.project(x, n), *formulas.project(y, n)).max(axis=-1)
        for name, n in families.items()
    }  # fmt: skip


def _pair(
    rng: np.random.Generator, kind: str, first: Any = _TETRAHEDRON, second: Any = _PRISM
) -> Pairs:
    return taken(rng, _drawn(first, second), _gaps, [(KINDS | BOX_KINDS)[kind]])


def _touching() -> Pairs:
    """Two upright prisms, one on top of the other."""
    triangle = np.array([[0.0, 0, 0], [2, 0, 0], [0, 1, 0]])
    prism = np.concatenate([triangle, triangle + [0, 0, 1]])
    slope = np.array([1.0, 2.0, 0.0]) / np.sqrt(5)
    normals = np.array([[0, 0, -1], [0, 0, 1], [0, -1, 0], [-1, 0, 0], slope])
    edges = np.array([[2.0, 0, 0], [-2, 1, 0], [0, -1, 0], [0, 0, 1]])
    parts = prism, normals, edges, prism + [0.5, 0, 1], normals, edges
    return dict(zip(NAMES, parts, strict=True))


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    other = _PYRAMID, _TETRAHEDRON
    return [
        Case("a tetrahedron and a prism, overlapping", _pair(rng, "overlap")),
        Case("apart, and only a face of A shows it", _pair(rng, "seen by A only")),
        Case("apart, and only a face of B shows it", _pair(rng, "seen by B only")),
        Case("apart, and only two edges show it", _pair(rng, "seen by edges only")),
        Case("a pyramid and a tetrahedron, only edges", _pair(rng, "seen by edges only", *other)),
        Case("a pyramid and a tetrahedron, only a face of A", _pair(rng, "seen by A only", *other)),
        Case("a pyramid and a tetrahedron, only a face of B", _pair(rng, "seen by B only", *other)),
        Case("a pyramid and a tetrahedron, overlapping", _pair(rng, "overlap", *other)),
        Case("two prisms, one on top of the other", _touching(), "edge"),
        *(Case(f"near touching, {k}", _pair(rng, "near", _PRISM, _PYRAMID)) for k in range(4)),
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
            slip(
                formulas.hulls_overlap,
                "[normals_a, normals_b, products]",
                "[normals_a, normals_b]",
            ),
            "You find what the faces show and no more. Two edges can pass each other where no face shows it: the "
            "products of A's edges with B's are axes too, not of the normals and not the edges themselves.",
        ),
        Mistake(
            "edges only",
            slip(
                formulas.hulls_overlap, "[normals_a, normals_b, products]", "[products]"
            ),
            "You try the products of the edges only. The faces' normals are axes too.",
        ),
        Mistake(
            "faces of A missing",
            slip(
                formulas.hulls_overlap,
                "[normals_a, normals_b, products]",
                "[normals_b, products]",
            ),
            "The normals of A's faces are missing among your axes.",
        ),
        Mistake(
            "faces of B missing",
            slip(
                formulas.hulls_overlap,
                "[normals_a, normals_b, products]",
                "[normals_a, products]",
            ),
            "The normals of B's faces are missing among your axes.",
        ),
        Mistake(
            "one axis is enough",
            slip(formulas.hulls_overlap, "np.all", "np.any"),
            "You say that they overlap as soon as their shadows do on *one* axis. They must on all of them.",
        ),
        Mistake(
            "the other way round",
            slip(
                formulas.hulls_overlap,
                "np.all(shadow_gap(*shadow_a, *shadow_b) <= 0)",
                "np.any(shadow_gap(*shadow_a, *shadow_b) > 0)",
            ),
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
