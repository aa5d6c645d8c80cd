"""The exercise ``edge_normals``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_05_separating_axis.shared import polygons
from course.exercises.slips import slip

_TURNED = "np.stack([edges[..., 1], -edges[..., 0]], axis=-1)"


def _several(
    rng: np.random.Generator, shape: tuple[int, ...], corners: int
) -> dict[str, np.ndarray]:
    count = int(np.prod(shape))
    drawn = polygons(rng, corners, count) + rng.normal(size=(count, 1, 2)).round(2)
    return {"vertices": drawn.reshape(*shape, corners, 2)}


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    return [
        Case("a triangle", {"vertices": np.array([[0.0, 0.0], [4.0, 0.0], [0.0, 3.0]])}),
        Case("a triangle, drawn", _several(rng, (), 3)),
        Case("a pentagon", _several(rng, (), 5)),
        Case("a thin triangle", {"vertices": polygons(rng, 3, 1)[0] * [3.0, 0.01]}, "edge"),
        Case("three triangles", _several(rng, (3,), 3), "batch"),
        Case("five quadrangles", _several(rng, (5,), 4), "batch"),
        Case("a 2 by 4 batch", _several(rng, (2, 4), 6), "batch"),
    ]  # fmt: skip


EDGE_NORMALS = Exercise(
    name="edge_normals",
    rows=(6, 10),
    points=1,
    minutes=7,
    task="Return the outward unit normals of a polygon's edges, the first for the edge from vertex 0 to vertex 1.",
    arguments=(
        Value("vertices", "(..., n, 2)", "m", "of a convex polygon, counter-clockwise"),
    ),
    results=(Value("normals", "(..., n, 2)", "", "unit vectors"),),
    reference=formulas.edge_normals,
    cases=_cases,
    properties=(
        Property(
            "unit length",
            lambda given, answer: np.linalg.norm(answer, axis=-1) - 1.0,
            "They are not all of length 1.",
        ),
    ),
    mistakes=(
        Mistake(
            "edges",
            slip(formulas.edge_normals, _TURNED, "edges"),
            "These run along the edges. A normal stands across: turn each edge by 90 degrees, (x, y) to (y, -x).",
        ),
        Mistake(
            "inward",
            slip(
                formulas.edge_normals,
                _TURNED,
                "np.stack([-edges[..., 1], edges[..., 0]], axis=-1)",
            ),
            "They point into the polygon. Counter-clockwise, the inside lies to the left of each edge, so the outward "
            "normal is a quarter turn to the right.",
        ),
        Mistake(
            "mirrored",
            slip(formulas.edge_normals, "-edges[..., 0]", "edges[..., 0]"),
            "You swap x and y without a sign: that mirrors the edge, it does not turn it. The dot product of edge and "
            "normal must be 0.",
        ),
        Mistake(
            "not of unit length",
            slip(
                formulas.edge_normals,
                "normals / np.linalg.norm(normals, axis=-1, keepdims=True)",
                "normals",
            ),
            "The directions are right, the lengths are those of the edges: divide each by its length, or the gaps "
            "along them are no metres.",
        ),
        Mistake(
            "one length for all",
            slip(
                formulas.edge_normals,
                "np.linalg.norm(normals, axis=-1, keepdims=True)",
                "np.linalg.norm(normals)",
            ),
            "You divide all normals by one number, the root of all squares together. Each is divided by its own "
            "length: norm(..., axis=-1, keepdims=True).",
        ),
        Mistake(
            "one edge late",
            slip(
                formulas.edge_normals,
                "np.roll(vertices, -1, axis=-2) - vertices",
                "vertices - np.roll(vertices, 1, axis=-2)",
            ),
            "All normals are there, but the first belongs to the edge that ends at vertex 0. Asked is the one that "
            "begins there: the next vertex minus this one.",
        ),
        Mistake(
            "backward",
            slip(formulas.edge_normals, "np.roll(vertices, -1", "np.roll(vertices, 1"),
            "Rolling by 1 brings the vertex *before* to each place, so you go round clockwise and the normals point "
            "inward. The next vertex comes with np.roll(vertices, -1, axis=-2).",
        ),
        Mistake(
            "rolled without an axis",
            slip(formulas.edge_normals, "-1, axis=-2", "-1"),
            "np.roll without axis takes all numbers as one long row, so each x comes to the place of a y. The "
            "vertices are counted on the axis before the last: np.roll(vertices, -1, axis=-2).",
        ),
        Mistake(
            "rolled along x and y",
            slip(formulas.edge_normals, "-1, axis=-2", "-1, axis=-1"),
            "With axis=-1 the roll exchanges x and y of each vertex. The vertices are counted on the axis before the "
            "last: np.roll(vertices, -1, axis=-2).",
        ),
        Mistake(
            "closing edge forgotten",
            slip(
                formulas.edge_normals,
                "np.roll(vertices, -1, axis=-2) - vertices",
                "np.diff(vertices, axis=-2)",
            ),
            "One normal is missing: the edge from the last vertex back to vertex 0 belongs to the polygon too.",
        ),
        Mistake(
            "batch axis",
            slip(formulas.edge_normals, "-1, axis=-2", "-1, axis=0"),
            "Right for one polygon, not for a batch: axis 0 is then the number of the polygon. The vertices are "
            "counted on the axis before the last, axis=-2.",
        ),
    ),  # fmt: skip
    hints=(
        "An edge is the next vertex minus this one. np.roll(vertices, -1, axis=-2) has the next vertex at every place, "
        "and vertex 0 after the last.",
        "A quarter turn to the right takes (x, y) to (y, -x). Then divide by the length: "
        "np.linalg.norm(..., axis=-1, keepdims=True).",
        "edges = np.roll(vertices, -1, axis=-2) - ____\n"
        "normals = np.stack([edges[..., 1], ____], axis=-1)\n"
        "return normals / np.linalg.norm(normals, axis=-1, keepdims=____)",
    ),
)
