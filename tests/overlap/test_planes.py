"""Half spaces against every kind, by all vertices or the centre, and against each other."""

import numpy as np
import pytest
from overlap.drawn_shapes import DRAW, depth_inside, half_spaces

from course.overlap.planes import closest_half_spaces, closest_to_half_space
from course.shapes import Capsule, HalfSpace, Sphere, polytopes

BOUNDED = ["sphere", "capsule", "aabb", "obb", "kdop", "convex_hull"]


@pytest.mark.parametrize("kind", BOUNDED)
@pytest.mark.slow
def test_drawn_shapes_above_planes(kind):
    """The lowest vertex of the core, less the radius."""
    rng = np.random.default_rng(BOUNDED.index(kind))
    a, b = DRAW[kind](rng, 60), half_spaces(rng, 60)
    found, solids = closest_to_half_space(a, b), polytopes(a)
    for i in range(60):
        core = solids.vertices[slice(*solids.vertex_start[i : i + 2])]
        truth = (core @ b.normal[i]).min() - b.offset[i] - solids.radius[i]
        assert found.gap[i] == pytest.approx(truth, abs=1e-13)
    np.testing.assert_array_equal(found.normal, b.normal)
    np.testing.assert_allclose(
        found.point_a - found.point_b, found.gap[:, None] * found.normal, atol=1e-12
    )
    np.testing.assert_allclose(depth_inside(a, found.point_a), 0, atol=1e-12)
    np.testing.assert_allclose(depth_inside(b, found.point_b), 0, atol=1e-12)


def test_half_spaces_that_face_each_other():
    """Solid below z = 1 and above z = 3: 2 apart; above z = .5: half a metre of both."""
    floor = HalfSpace([0, 0, 1], 1.0)
    ceiling = HalfSpace([[0, 0, -1], [0, 0, -1]], [-3.0, -0.5])
    found = closest_half_spaces(ceiling, floor)
    assert (
        found.gap.tolist() == [2.0, -0.5] and found.normal.tolist() == [[0, 0, 1]] * 2
    )
    assert found.point_a[:, 2].tolist() == [3.0, 0.5]
    assert closest_half_spaces(floor, ceiling).gap.tolist() == [2.0, -0.5]


def test_all_other_half_spaces_have_no_gap():
    """Parallel ones lie in each other, and planes that lean meet somewhere."""
    up = HalfSpace([0, 0, 1], 0.0)
    lean = np.array([0, 1e-6, -1.0]) / np.linalg.norm([0, 1e-6, -1.0])
    for normal in ([0, 0, 1], [1, 0, 0], lean):
        assert closest_half_spaces(HalfSpace(normal, -100.0), up).gap == -np.inf
    # Opposite but for rounding: turned together.
    tilted = np.array([1.0, 2.0, 3.0]) / np.sqrt(14.0)
    near = -tilted * (1 + 1e-15)
    assert closest_half_spaces(HalfSpace(near, -5.0), HalfSpace(tilted, 1.0)).gap == 4.0


def test_a_capsule_stands_or_leans_on_its_lower_end():
    floor = HalfSpace([0, 0, 1], 0.0)
    found = closest_to_half_space(Capsule([0, 0, 3], [1, 0, 5], 0.5), floor)
    assert found.gap == 2.5 and found.point_a.tolist() == [0, 0, 2.5]
    assert closest_to_half_space(Sphere([4, 5, -1], 0.25), floor).gap == -1.25
