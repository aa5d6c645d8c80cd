"""The stage's solids: closed surfaces, right sizes, colours; what does not fit is refused by name."""

from __future__ import annotations

import numpy as np
import pytest

from course.workbook import stage


def volume(vertices, triangles):
    """By the divergence theorem; positive where the triangles are anticlockwise from outside."""
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    return float(np.sum(np.cross(a, b) * c) / 6)


def edges_match(triangles, vertices):
    """Whether each edge is run through once in each direction; corners at one place count as one."""
    _, same = np.unique(vertices.round(9), axis=0, return_inverse=True)
    corners = same.ravel()[triangles]
    corners = corners[
        [len(set(t)) == 3 for t in corners]
    ]  # at a pole, triangles shrink to an edge
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    there, back = sorted(map(tuple, edges)), sorted(map(tuple, edges[:, ::-1]))
    return there == back


@pytest.mark.parametrize(
    ("solid", "expected", "tolerance"),
    [
        (stage.box([0.5, 1.0, 1.5]), 6.0, 1e-12),
        (
            stage.box([0.5, 1.0, 1.5], center=[1, 2, 3], rotation=np.eye(3)[[1, 2, 0]]),
            6.0,
            1e-12,
        ),
        (
            stage.ball(2.0, center=[1, 0, 0]),
            4 / 3 * np.pi * 8,
            0.03,
        ),  # what 24 by 12 facets cut off
        (
            stage.capsule([0, 1, 0], [0, 4, 0], 0.5),
            np.pi * 0.25 * 3 + 4 / 3 * np.pi / 8,
            0.03,
        ),
        (stage.capsule([1, 1, 1], [1, 1, 1], 0.5), 4 / 3 * np.pi / 8, 0.03),
    ],
)
def test_solids_are_closed_and_face_outward(solid, expected, tolerance):
    assert volume(solid.vertices, solid.triangles) == pytest.approx(
        expected, rel=tolerance
    )
    assert edges_match(solid.triangles, solid.vertices)


def test_a_capsule_lies_about_its_segment():
    solid = stage.capsule([1.0, 2.0, 3.0], [1.0, 2.0, 7.0], 0.5)
    assert solid.vertices.min(axis=0) == pytest.approx([0.5, 1.5, 2.5])
    assert solid.vertices.max(axis=0) == pytest.approx([1.5, 2.5, 7.5])
    slanted = stage.capsule([0, 0, 0], [3.0, 4.0, 0.0], 0.1).vertices
    along = np.clip(slanted @ [0.6, 0.8, 0.0], 0.0, 5.0)
    assert np.linalg.norm(
        slanted - along[:, None] * [0.6, 0.8, 0.0], axis=-1
    ) == pytest.approx(0.1)


def test_three_colours_paint_the_pairs_of_faces():
    solid = stage.box([1.0, 2.0, 3.0], color=("blue", "orange", "sky"))
    for axis, name in enumerate(("blue", "orange", "sky")):
        own = solid.vertices[[c == name for c in solid.colors]]
        assert np.all(np.abs(own[:, axis]) == axis + 1.0) and len(own) == 8


def test_joined_solids_keep_their_triangles():
    one, two = (
        stage.box([1, 1, 1]),
        stage.ball(0.5, center=[0, 0, 3], color="green"),
    )
    both = stage.joined(one, two, what="lamp")
    assert volume(both.vertices, both.triangles) == pytest.approx(
        volume(one.vertices, one.triangles) + volume(two.vertices, two.triangles)
    )
    assert (
        both.what == "lamp"
        and set(both.colors) == {"blue", "green"}
        and both.reach == pytest.approx(3.5)
    )


def test_what_has_edges_keeps_them_beside_what_is_round():
    """Joined to a ball, a mesh with shared corners has corners of its own for each face."""
    tetrahedron = stage.mesh(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
        [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    )
    both = stage.joined(tetrahedron, stage.ball(0.2, center=[2, 0, 0]))
    assert both.smooth and len(both.vertices) == 12 + len(stage.ball(0.2).vertices)
    assert not stage.joined(tetrahedron, tetrahedron).smooth
    assert volume(both.vertices[:12], both.triangles[:4]) == pytest.approx(1 / 6)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: stage.box([1, 1]), "half_extents"),
        (lambda: stage.box([1, 1, 0]), "half_extents: expected positive"),
        (
            lambda: stage.box([1, 1, 1], color=("blue", "sky")),
            "color: expected one name or three",
        ),
        (lambda: stage.box([1, 1, 1], color="pink"), "colors: expected one of"),
        (lambda: stage.ball(-1.0), "radius: expected positive"),
        (lambda: stage.capsule([0, 0], [1, 1, 1], 1.0), "start"),
        (
            lambda: stage.mesh(np.zeros((3, 3)), [[0, 1, 3]]),
            "triangles: expected whole numbers from 0 to 2",
        ),
        (
            lambda: stage.mesh(np.zeros((3, 3)), [[0, 1]]),
            r"triangles: expected shape \(f, 3\)",
        ),
        (lambda: stage.joined(), "solids: expected at least one"),
    ],
)
def test_solids_refuse_what_does_not_fit(make, message):
    with pytest.raises(ValueError, match=message):
        make()
