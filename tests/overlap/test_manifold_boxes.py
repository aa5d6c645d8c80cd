"""The loop for boxes finds what the loops for all polytopes find."""

import numpy as np
import pytest

from course import rotations
from course.overlap.manifold.box_patches import EDGE_AT, LOOP
from course.overlap.manifold.box_points import _by_nearest_points, box_contact_points
from course.shapes import OBB
from course.shapes.box_topology import BOXES


def drawn_turns(rng, n):
    q = rng.normal(size=(n, 4))
    return rotations.to_matrix(q / np.linalg.norm(q, axis=1, keepdims=True))


def drawn_boxes(kind, n, rng):
    """n pairs: any, face to face, tilted by little, edge over edge, far from the origin."""
    half = rng.uniform(0.2, 0.6, (2, n, 3))
    if kind in ("any", "far"):
        away = 1e6 if kind == "far" else 0.0
        a = OBB(rng.uniform(-0.9, 0.9, (n, 3)) + away, drawn_turns(rng, n), half[0])
        return a, OBB(np.full((n, 3), away), drawn_turns(rng, n), half[1])
    base, turn = drawn_turns(rng, n), np.zeros((n, 3))
    turn[:, 2] = (
        rng.integers(0, 4, n) * np.pi / 4 if kind == "aligned" else rng.uniform(0, 7, n)
    )
    lean = (
        rng.normal(size=(n, 3))
        * 10.0 ** rng.uniform(-10, -2, (n, 1))
        * (kind == "tilted")
    )
    across = rotations.to_matrix(rotations.from_rotation_vector(turn))
    tilt = rotations.to_matrix(rotations.from_rotation_vector(lean))
    at = np.column_stack(
        [rng.uniform(-0.8, 0.8, (n, 2)), half[0, :, 2] + half[1, :, 2] - 1e-3]
    )
    if kind == "aligned":
        at[:, :2] = rng.integers(-1, 2, (n, 2)) * (half[0] + half[1])[:, :2] * 0.5
    a = OBB(np.einsum("kij,kj->ki", base, at), base @ tilt @ across, half[0])
    return a, OBB(np.zeros((n, 3)), base, half[1])


@pytest.mark.parametrize("limit", [None, 4])
@pytest.mark.parametrize("kind", ["any", "far", "aligned", "turned", "tilted"])
def test_the_loop_for_boxes_finds_the_same(kind, limit):
    rng = np.random.default_rng(4)
    a, b = drawn_boxes(kind, 500, rng)
    one = box_contact_points(a, b, margin=1e-4, limit=limit)
    other = _by_nearest_points(a, b, np.arange(500), 1e-4, limit)
    rounding = 1e-9 if kind == "far" else 1e-13
    for name in ("pair", "feature_a", "feature_b", "label"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name))
    np.testing.assert_allclose(one.numbers, other.numbers, atol=rounding, rtol=1e-9)
    assert np.unique(one.pair).size > 150


def test_numbers_of_corners_edges_and_faces_are_those_of_the_shape():
    box = BOXES[7]
    assert box.loop.reshape(6, 4).tolist() == LOOP.tolist()
    for corner in range(8):
        for axis, bit in enumerate((4, 2, 1)):
            ends = {corner, corner ^ bit}
            assert set(box.edges[EDGE_AT[corner, axis]].tolist()) == ends


def test_boxes_without_thickness_have_contacts_too():
    half = np.array([[0.5, 0.5, 0.0], [0.5, 0.5, 0.5]])
    a = OBB(np.array([[0, 0, 0.5], [0, 0, 1.0]]), np.stack([np.eye(3)] * 2), half)
    b = OBB(np.zeros((2, 3)), np.stack([np.eye(3)] * 2), np.full((2, 3), 0.5))
    assert box_contact_points(a, b, margin=1e-9).pair.tolist() == [0] * 4 + [1] * 4
