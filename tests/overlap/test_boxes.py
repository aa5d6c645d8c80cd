"""Upright boxes and spheres against boxes: closed cases, public test figures, brute force."""

import itertools

import numpy as np
import pytest
from overlap.drawn_shapes import (
    boxes,
    distance_by_least_squares,
    spheres,
    turns,
    upright_boxes,
)
from overlap.test_capsules import check_witnesses

from course.overlap import boxes_overlap, sphere_box_gap
from course.overlap.boxes import (
    closest_sphere_box,
    closest_sphere_upright_box,
    closest_upright_boxes,
)
from course.shapes import AABB, OBB, Sphere


def test_touching_boxes_overlap():
    """libccd's box-box test: boxes (1,2,1) and (2,1,2), the first at x = -5 + .1 i; 35 and 65 touch to rounding."""
    x = -5 + 0.1 * np.arange(100)
    center = np.stack([x, 0 * x, 0 * x], axis=1)
    half_a, half_b = np.array([0.5, 1, 0.5]), np.array([1, 0.5, 1])
    hit = boxes_overlap(center - half_a, center + half_a, -half_b, half_b)
    assert set(np.flatnonzero(hit)) - {35, 65} == set(range(36, 65))
    # In numbers without rounding touching is exact, at a face, an edge, a corner.
    for other in ([1, 0, 0], [1, 1, 0], [1, 1, 1]):
        low = np.array(other, dtype=float)
        assert boxes_overlap([0, 0, 0], [1, 1, 1], low, low + 1)
        assert not boxes_overlap([0, 0, 0], [1, 1, 1], low + 1e-15, low + 1)


def test_boxes_without_end():
    """As the bounds of half spaces are."""
    everything = np.full(3, np.inf)
    assert boxes_overlap(-everything, everything, [0, 0, 0], [1, 1, 1])
    assert boxes_overlap(-everything, everything, -everything, everything)
    upper = [np.inf, np.inf, 0.0]
    assert not boxes_overlap(-everything, upper, [0, 0, 0.5], [1, 1, 1])


@pytest.mark.parametrize("function", [boxes_overlap, sphere_box_gap])
def test_a_wrong_argument_is_named(function):
    names = {
        boxes_overlap: ["lower_a", "upper_a", "lower_b", "upper_b"],
        sphere_box_gap: ["center", "radius", "lower", "upper"],
    }[function]
    good = [1.0 if name == "radius" else np.zeros(3) for name in names]
    for i, name in enumerate(names):
        for bad in ([np.nan] * 3, np.zeros(2)) if name != "radius" else (-1.0, np.nan):
            with pytest.raises(ValueError, match=f"^{name}: "):
                function(*good[:i], bad, *good[i + 1 :])
    with pytest.raises(ValueError, match="lower"):
        function(*good[:2], [1, 1, 1], [0, 0, 0])


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.slow
def test_drawn_upright_boxes(seed):
    """Apart: bounded least squares. Overlapping: the least of the six ways along the axes."""
    rng = np.random.default_rng(seed)
    a, b = upright_boxes(rng, 400, 1.5), upright_boxes(rng, 400, 1.5)
    found = closest_upright_boxes(a, b)
    check_witnesses(found, a, b)
    assert 50 < (found.gap > 0).sum() < 350
    np.testing.assert_array_equal(
        boxes_overlap(a.lower, a.upper, b.lower, b.upper), found.gap <= 0
    )
    for i in range(400):
        if found.gap[i] <= 0:
            ways = np.concatenate([b.upper[i] - a.lower[i], a.upper[i] - b.lower[i]])
            assert found.gap[i] == -ways.min()
        elif i % 4 == 0:
            truth = distance_by_least_squares(a[i], b[i])
            assert found.gap[i] == pytest.approx(truth, abs=1e-12)
    # The least translation parts them, and 1 part in 1e6 less of it does not.
    deep = np.flatnonzero(found.gap < 0)
    for share, parted in ((1 + 1e-6, True), (1 - 1e-6, False)):
        shift = share * -found.gap[deep, None] * found.normal[deep]
        again = boxes_overlap(a.lower[deep] + shift, a.upper[deep] + shift, b.lower[deep], b.upper[deep])  # fmt: skip
        assert np.all(again != parted)


def test_a_box_inside_another_leaves_by_the_nearest_side():
    for sign, axis in itertools.product((1, -1), range(3)):
        low = np.full(3, 4.0)
        low[axis] = 1.0 if sign < 0 else 8.0
        found = closest_upright_boxes(AABB(low, low + 1), AABB([0, 0, 0], [10, 10, 10]))
        assert found.gap == -2.0
        assert found.normal.tolist() == (sign * np.eye(3)[axis]).tolist()


def brute_sphere_box(center, radius, half):
    """By the definition: a box is six planes; outside the nearest of its points by bounded least squares."""
    inset = (half - np.abs(center)).min()
    if inset >= 0:
        return -(inset + radius)
    box, ball = OBB(np.zeros(3), np.eye(3), half), Sphere(center, 0)
    return distance_by_least_squares(ball, box) - radius


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.slow
def test_drawn_spheres_and_boxes(seed):
    rng = np.random.default_rng(seed)
    a, b = spheres(rng, 200, 1.5), boxes(rng, 200, 0.3)
    found = closest_sphere_box(a, b)
    check_witnesses(found, a, b)
    for i in range(200):
        own = b.rotation[i].T @ (a.center[i] - b.center[i])
        truth = brute_sphere_box(own, a.radius[i], b.half_extents[i])
        assert found.gap[i] == pytest.approx(truth, abs=1e-12)


@pytest.mark.parametrize("seed", [3, 4])
def test_spheres_and_upright_boxes_are_those_of_boxes_that_are_not_turned(seed):
    rng = np.random.default_rng(seed)
    a, b = spheres(rng, 200, 1.0), upright_boxes(rng, 200, 0.5)
    found = closest_sphere_upright_box(a, b)
    check_witnesses(found, a, b)
    turned = OBB(b.center, np.broadcast_to(np.eye(3), (200, 3, 3)), b.half_extents)
    other = closest_sphere_box(a, turned)
    np.testing.assert_allclose(found.gap, other.gap, atol=1e-14)
    np.testing.assert_allclose(found.normal, other.normal, atol=1e-13)
    np.testing.assert_allclose(
        sphere_box_gap(a.center, a.radius, b.lower, b.upper), found.gap
    )


def test_centre_inside_the_box():
    """depth = inset + r (FCL's test_sphere_box); N out of the nearest face."""
    found = closest_sphere_box(
        Sphere([0.2, -0.7, 1.9], 0.5), OBB([0, 0, 0], np.eye(3), [1, 1, 2])
    )
    assert found.gap == pytest.approx(-0.6, abs=1e-15)
    assert found.normal.tolist() == [0, 0, 1]
    assert found.point_b.tolist() == [0.2, -0.7, 2]
    middle = closest_sphere_box(Sphere([0, 0, 0], 0.5), OBB([0, 0, 0], np.eye(3), [1, 2, 3]))  # fmt: skip
    assert middle.gap == -1.5 and abs(middle.normal).tolist() == [1, 0, 0]
    on_face = sphere_box_gap([1, 0, 0], 0.25, [-1, -1, -1], [1, 1, 1])
    assert on_face == -0.25


def test_a_public_report_of_a_box_10_2_10_beside_a_unit_sphere():
    """3 apart, witness points (0, 1, 0) and (0, 4, 0)."""
    found = closest_sphere_box(
        Sphere([0, 0, 0], 1), OBB([0, 5, 3], np.eye(3), [5, 1, 5])
    )
    assert found.gap == 3 and found.normal.tolist() == [0, -1, 0]
    assert found.point_a.tolist() == [0, 1, 0] and found.point_b.tolist() == [0, 4, 0]


def test_the_size_of_a_box_does_not_change_the_gap_above_it():
    """A public report: a ball of .5166 above boxes of half extent 5, 50, 500."""
    for turn in (np.eye(3), turns(np.random.default_rng(2), 1)[0]):
        gaps = []
        for half in (5.0, 50.0, 500.0):
            box = OBB(-half * turn[:, 2], turn, [half] * 3)
            ball = Sphere(turn @ [0.3, -0.2, 0.5166 + 0.125], 0.5166)
            gaps.append(float(closest_sphere_box(ball, box).gap))
        np.testing.assert_allclose(gaps, 0.125, atol=1e-12)


def test_flat_boxes():
    """A rectangle, a segment and a point are boxes too."""
    for half, depth in (([1, 2, 0], 0.5), ([0, 2, 0], 0.5), ([0, 0, 0], 0.5)):
        found = closest_sphere_box(
            Sphere([0, 0, 0], 0.5), OBB([0, 0, 0], np.eye(3), half)
        )
        assert found.gap == -depth
        flat = AABB(-np.array(half, float), half)
        assert closest_upright_boxes(flat, flat).gap == 0
        beside = closest_upright_boxes(AABB([2, 3, 4], [2, 3, 4]), flat)
        truth = np.linalg.norm(np.maximum(np.array([2, 3, 4]) - half, 0))
        assert beside.gap == pytest.approx(truth)


def test_far_from_the_origin_only_the_input_is_rounded():
    """1e8 away, with sizes of order 1, in numbers that have no rounding: exact."""
    far = np.array([1e8, -1e8, 1e8])
    ball, box = Sphere(far + [0, 0, 2.5], 0.5), AABB(far - 1, far + 1)
    assert closest_sphere_upright_box(ball, box).gap == 1.0
    assert closest_upright_boxes(AABB(far + 2, far + 3), box).gap == np.sqrt(3.0)
