"""The 15 axes of two boxes: the readable form, the loop, and the gap that other code finds."""

import numpy as np
import pytest
from campaigns import drawn_of
from polytope_truths import drawn
from scipy.spatial.transform import Rotation

from course.overlap.convex.closest import closest_points, least_translation
from course.overlap.convex.separating_axis import (
    APART,
    BAND,
    OVERLAPPING,
    UNSURE,
    box_axes,
    box_pairs_told,
    box_separation,
)
from course.overlap.oriented_boxes import oriented_boxes_overlap
from course.shapes import OBB, polytopes

EYE = np.eye(3)


def arrays(boxes):
    return boxes.center, boxes.rotation, boxes.half_extents


def test_the_axes_of_two_boxes():
    """Three and three normals, and nine products of length 1; none of parallel edges."""
    turn = Rotation.from_euler("z", 30, degrees=True).as_matrix()
    axes = box_axes(EYE, turn)
    assert axes.shape == (15, 3)
    np.testing.assert_array_equal(axes[:3], EYE)
    np.testing.assert_array_equal(axes[3:6], turn.T)
    lengths = np.linalg.norm(axes, axis=1)
    assert lengths[14] == 0  # z x z
    np.testing.assert_allclose(np.delete(lengths, 14), 1, atol=1e-15)
    np.testing.assert_allclose(axes[6], [0, 0, 1], atol=1e-15)  # x x (x turned about z)


def test_two_cubes_edge_to_edge():
    """Turned by 45 degrees about x and about y the edges cross: sqrt 2 - z/2 from each centre; by hand."""
    a = Rotation.from_euler("x", 45, degrees=True).as_matrix()
    b = Rotation.from_euler("y", 45, degrees=True).as_matrix()
    half = np.ones(3)
    for z in (2.5, 3.0):
        s, normal = box_separation(np.array([0, 0, z]), a, half, np.zeros(3), b, half)
        assert s == pytest.approx(z - 2 * np.sqrt(2), abs=1e-15)
        np.testing.assert_allclose(normal, [0, 0, 1], atol=1e-15)


def test_separation_is_the_least_translation():
    """Of overlapping boxes it is the gap; of others it is no more than their distance. A batch broadcasts."""
    rng = np.random.default_rng(1)
    a, b = drawn("boxes", 40, rng), drawn("boxes", 40, rng)
    rows = [x[:, None] for x in arrays(a)]
    s, normal = box_separation(*rows, *arrays(b))
    i, j = np.indices((40, 40))
    found = closest_points(polytopes(a), polytopes(b), i, j)
    deep = found.gap <= 0
    assert 400 < deep.sum() < 1200
    np.testing.assert_array_equal(s <= 0, deep)
    np.testing.assert_allclose(s[deep], found.gap[deep], atol=1e-14)
    assert np.all(s[~deep] <= found.gap[~deep] + 1e-14)
    np.testing.assert_allclose(normal[deep], found.normal[deep], atol=1e-9)
    other, axis = least_translation(polytopes(a), polytopes(b), i, j)
    np.testing.assert_allclose(other, s, atol=1e-14)
    np.testing.assert_allclose(np.abs(np.sum(axis * normal, axis=-1)), 1, atol=1e-9)


@pytest.mark.parametrize("kind", ["boxes", "tilted boxes"])
def test_the_loop_says_what_the_axes_say(kind):
    rng = np.random.default_rng(2)
    a, b = (drawn(kind, 2000, rng) for _ in range(2))
    s, _ = box_separation(*arrays(a), *arrays(b))
    told = box_pairs_told(*arrays(a), *arrays(b))
    size = np.abs(a.center - b.center).sum(axis=1) + (a.half_extents + b.half_extents).sum(axis=1)  # fmt: skip
    assert np.all(s[told == APART] > 0) and np.all(s[told == OVERLAPPING] < 0)
    near = told == UNSURE
    assert np.all(np.abs(s[near]) <= 2 * BAND * size[near])
    assert near.any() == (kind == "tilted boxes")
    np.testing.assert_array_equal(
        oriented_boxes_overlap(a, b),
        closest_points(polytopes(a), polytopes(b), range(2000), range(2000)).gap <= 0,
    )


@pytest.mark.parametrize("tilt", [0, 1e-16, 1e-15, 1e-12, 1e-8])
def test_a_hair_of_a_turn_parts_no_boxes(tilt):
    """Without an epsilon the textbook's form calls a quarter of overlapping pairs apart at 1e-16."""
    rng = np.random.default_rng(3)
    turn = Rotation.from_rotvec(tilt * rng.normal(size=(1000, 3))).as_matrix()
    half = rng.uniform(0.5, 1, (2, 1000, 3))
    offset = rng.uniform(-0.9, 0.9, (1000, 3)) * half.sum(axis=0)
    a, b = (
        OBB(offset, turn, half[0]),
        OBB(np.zeros((1000, 3)), np.broadcast_to(EYE, (1000, 3, 3)), half[1]),
    )
    assert oriented_boxes_overlap(a, b).all()
    # Apart along one axis by a tenth of the sum of extents.
    far = offset.copy()
    far[:, 0] = 1.1 * half.sum(axis=0)[:, 0]
    assert not oriented_boxes_overlap(OBB(far, turn, half[0]), b).any()


def test_touching_boxes_overlap():
    """Solids are closed. Cubes of side 2 at a distance of 2 and a little more or less."""
    offsets = 2 + np.array([-1e-9, -1e-12, 0, 1e-12, 1e-9])
    a = OBB(offsets[:, None] * EYE[1], np.broadcast_to(EYE, (5, 3, 3)), np.ones((5, 3)))
    b = OBB(np.zeros(3), EYE, np.ones(3))
    assert oriented_boxes_overlap(a, b).tolist() == [True, True, True, False, False]
    assert oriented_boxes_overlap(b, a).tolist() == [True, True, True, False, False]


def test_boxes_along_a_line():
    """libccd's boxbox: (1,2,1) from x = -5 in steps of .1 against (2,1,2): overlap from 35 to 65, which touch."""
    x = (np.arange(101) - 50) / 10
    a = OBB(
        x[:, None] * EYE[0],
        np.broadcast_to(EYE, (101, 3, 3)),
        np.broadcast_to([0.5, 1, 0.5], (101, 3)),
    )
    b = OBB(np.zeros(3), EYE, np.array([1, 0.5, 1]))
    assert np.flatnonzero(oriented_boxes_overlap(a, b)).tolist() == list(range(35, 66))


def test_flat_boxes_and_batches():
    square = OBB(
        np.zeros((3, 1, 3)),
        np.broadcast_to(EYE, (3, 1, 3, 3)),
        np.broadcast_to([1, 1, 0.0], (3, 1, 3)),
    )
    post = OBB(
        np.array([[0.5, 0, 0], [3, 0, 0]]),
        np.broadcast_to(EYE, (2, 3, 3)),
        np.broadcast_to([0, 0, 1.0], (2, 3)),
    )
    assert oriented_boxes_overlap(square, post).tolist() == [[True, False]] * 3
    with pytest.raises(ValueError, match="batch"):
        oriented_boxes_overlap(square.reshaped(3), post)


@pytest.mark.long
def test_a_campaign_of_boxes():
    """100,000 pairs in a whole campaign, half of them nearly parallel: verdict, separation and gap agree."""
    rng = np.random.default_rng(5)
    for kind in ("boxes", "tilted boxes"):
        count = drawn_of(50_000, 2_000)
        a, b = drawn(kind, count, rng), drawn(kind, count, rng)
        s, _ = box_separation(*arrays(a), *arrays(b))
        i = np.arange(count)
        gap = closest_points(polytopes(a), polytopes(b), i, i).gap
        np.testing.assert_array_equal(oriented_boxes_overlap(a, b), gap <= 0)
        deep = gap <= 0
        np.testing.assert_allclose(s[deep], gap[deep], atol=1e-13)
        assert np.all(s[~deep] > -1e-13)


@pytest.mark.peers
def test_verdicts_of_python_fcl():
    """Every verdict agrees on 2,000 pairs in general position."""
    fcl = pytest.importorskip("fcl")
    rng = np.random.default_rng(6)
    a, b = drawn("boxes", 2000, rng), drawn("boxes", 2000, rng)

    def fcl_box(boxes, k):
        pose = fcl.Transform(boxes.rotation[k], boxes.center[k])
        return fcl.CollisionObject(fcl.Box(*(2 * boxes.half_extents[k])), pose)

    theirs = [
        bool(
            fcl.collide(
                fcl_box(a, k),
                fcl_box(b, k),
                fcl.CollisionRequest(),
                fcl.CollisionResult(),
            )
        )
        for k in range(2000)
    ]
    np.testing.assert_array_equal(oriented_boxes_overlap(a, b), theirs)
