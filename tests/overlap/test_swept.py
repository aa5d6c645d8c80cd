"""Swept tests: the readable form of each against the compiled one and against another way."""

import numpy as np
import pytest
from overlap.drawn_shapes import boxes, capsules, spheres, upright_boxes
from overlap.moving_shapes import STILL, drawn_pair, gaps, stays_above
from scipy.spatial.transform import Rotation

from course.formulas import lesson_06_moving_objects as lesson
from course.overlap import time_of_impact
from course.overlap.moving import swept, swept_polytopes
from course.shapes import AABB, OBB, Capsule, ConvexHull, Sphere

NEVER = np.inf


def hits(time):
    return (time > 0) & (time < np.inf)


def test_boxes_by_15_axes_as_one_expression_and_in_a_loop():
    rng = np.random.default_rng(1)
    a, b, v, w = drawn_pair("obb", "obb", rng, 500)
    one = swept.swept_boxes(a, b, v - w, np.float64(4.0))
    loop = swept_polytopes.swept_boxes(a, b, v - w, np.float64(4.0))
    assert hits(one).sum() > 200 and np.isinf(one).sum() > 20
    np.testing.assert_allclose(loop, one, rtol=1e-11)


@pytest.mark.slow
def test_boxes_as_polytopes_and_as_hulls():
    rng = np.random.default_rng(2)
    a, b, v, w = drawn_pair("aabb", "obb", rng, 200)
    boxed = time_of_impact(a, b, v, w, horizon=4.0)
    found = swept_polytopes.swept_convex(a, b, v - w, np.float64(4.0))
    np.testing.assert_allclose(found, boxed, rtol=1e-10)
    signs = np.array(np.meshgrid(*[[-1, 1]] * 3)).reshape(3, -1).T
    corners = b.center[:, None] + (signs * b.half_extents[:, None]) @ np.swapaxes(b.rotation, 1, 2)  # fmt: skip
    hulls = time_of_impact(a, ConvexHull(corners), v, w, horizon=4.0)
    np.testing.assert_allclose(hulls, boxed, rtol=1e-9)
    assert hits(boxed).sum() > 80


def test_upright_boxes_by_slabs_and_as_oriented_ones():
    rng = np.random.default_rng(3)
    a, b, v, w = drawn_pair("aabb", "aabb", rng, 300)
    turned = b.moved(np.eye(3), STILL)
    found = time_of_impact(a, b, v, w, horizon=4.0)
    np.testing.assert_allclose(time_of_impact(a, turned, v, w, horizon=4.0), found, rtol=1e-12)  # fmt: skip
    assert hits(found).sum() > 100


def test_a_ray_against_a_minkowski_sum_is_the_closed_form_of_spheres():
    """Spheres, and capsules without length, as rounded polytopes."""
    rng = np.random.default_rng(4)
    a, b, v, w = drawn_pair("sphere", "sphere", rng, 300)
    found = time_of_impact(a, b, v, w, horizon=4.0)
    assert hits(found).sum() > 60 and np.isinf(found).sum() > 60
    as_points = swept_polytopes.swept_convex(a, b, v - w, np.float64(4.0))
    np.testing.assert_allclose(as_points, found, rtol=1e-9)
    pills = Capsule(b.center, b.center, b.radius)
    np.testing.assert_allclose(time_of_impact(a, pills, v, w, horizon=4.0), found, rtol=1e-9)  # fmt: skip


def test_a_point_against_a_capsule_is_a_quadratic():
    """Across the axis: |m + v t| = r in the plane across it; along it: the cap's sphere."""
    pill = Capsule((0, 0, -2.0), (0, 0, 2.0), 0.5)
    point = Sphere((-3.0, 0.3, 1.0), 0.0)
    found = time_of_impact(point, pill, (1.0, 0, 0.25), STILL, horizon=9.0)
    assert found == pytest.approx(3 - np.sqrt(0.25 - 0.09), rel=1e-13)
    found = time_of_impact(point, pill, (1.0, 0, 0.9), STILL, horizon=9.0)
    cap = Sphere((0, 0, 2.0), 0.5)
    assert found == time_of_impact(point, cap, (1.0, 0, 0.9), STILL, horizon=9.0)


def test_a_sphere_meets_a_box_at_its_face_its_edge_and_its_corner():
    box = AABB(-np.ones(3), np.ones(3))
    for start, nearest in (
        ((-4.0, 0.5, 0.5), (-1, 0.5, 0.5)),
        ((-4.0, 1.3, 0.5), (-1, 1, 0.5)),
        ((-4.0, 1.2, 1.2), (-1, 1, 1)),
    ):
        ball, start = Sphere(start, 0.5), np.array(start)
        off = np.linalg.norm((start - nearest)[1:])
        expected = 3 - np.sqrt(0.25 - off**2)
        found = time_of_impact(ball, box, (1.0, 0, 0), STILL, horizon=9.0)
        assert found == pytest.approx(expected, rel=1e-13)
    missing = Sphere((-4.0, 1.4, 1.4), 0.5)
    assert time_of_impact(missing, box, (1.0, 0, 0), STILL, horizon=9.0) == NEVER


def test_flat_solids_in_one_plane_or_line():
    """Segments that end on each other, a point over a triangle, triangles in one plane."""
    x = np.array([1.0, 0, 0])
    rod, other = Capsule(STILL, x, 0.0), Capsule(4 * x, 6 * x, 0.0)
    assert time_of_impact(rod, other, x, STILL, horizon=9.0) == 3.0
    assert time_of_impact(rod, other, (0, 1.0, 0), STILL, horizon=9.0) == NEVER
    beside = Capsule(4 * x + (0, 1e-6, 0), 6 * x, 0.0)
    assert time_of_impact(rod, beside, x, STILL, horizon=2.9) == NEVER
    triangle = ConvexHull(np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0.0)]))
    below = Sphere(((0.5, 0.5, -1), (1.5, 1.5, -1), (-0.1, 0.5, -1)), 0.0)
    found = time_of_impact(below, triangle, (0, 0, 2.0), STILL, horizon=9.0)
    assert found.tolist() == [0.5, NEVER, NEVER]
    second = ConvexHull(np.array([(5, 0, 0), (7, 0, 0), (7, 2, 0.0)]))
    assert time_of_impact(triangle, second, x, STILL, horizon=9.0) == 3.0
    assert time_of_impact(triangle, second, x + (0, 2, 0), STILL, horizon=9.0) == NEVER
    assert time_of_impact(Sphere(STILL, 0.0), Sphere(x, 0.0), x, STILL, horizon=9.0) == 1.0  # fmt: skip
    assert time_of_impact(Sphere(STILL, 0.0), Sphere(x, 0.0), (1, 0.1, 0), STILL, horizon=9.0) == NEVER  # fmt: skip


@pytest.mark.parametrize("angle", [0.0, 1e-16, 1e-12, 1e-8, 1e-4])
def test_nearly_parallel_edges_do_no_harm(angle):
    """Two long thin boxes along one axis, but for an angle: the gap of 1 closes at speed 1."""
    turn = np.array([[1, -angle, 0], [angle, 1, 0], [0, 0, 1.0]])
    turn /= np.linalg.norm(turn, axis=0)
    thin = (5.0, 0.1, 0.1)
    a, b = OBB(STILL, np.eye(3), thin), OBB((0, 0, 1.2), turn, thin)
    found = time_of_impact(a, b, (0, 0, 1.0), STILL, horizon=9.0)
    assert found == pytest.approx(1.0, abs=1e-12)
    half, up = 5 * turn[:, 0], np.array([0, 0, 1.2])
    rods = Capsule((-5.0, 0, 0), (5.0, 0, 0), 0.1), Capsule(up - half, up + half, 0.1)
    found = time_of_impact(*rods, (0, 0, 1.0), STILL, horizon=9.0)
    assert found == pytest.approx(1.0, abs=1e-12)


def test_the_library_is_the_formulas_of_the_lesson():
    rng = np.random.default_rng(7)
    n = 200
    a, b = spheres(rng, n), spheres(rng, n)
    v, w = rng.normal(size=(2, n, 3))
    found = lesson.swept_spheres_time(a.center, a.radius, v, b.center, b.radius, w, 3.0)
    np.testing.assert_allclose(
        time_of_impact(a, b, v, w, horizon=3.0), found, rtol=1e-9
    )
    a, b = upright_boxes(rng, n), upright_boxes(rng, n)
    found = lesson.swept_boxes_time(a.lower, a.upper, v, b.lower, b.upper, w, 3.0)
    np.testing.assert_allclose(
        time_of_impact(a, b, v, w, horizon=3.0), found, rtol=1e-12
    )
    rod, ball = Capsule(STILL, (1.5, 0.2, 0.5), 0.0), Sphere((0.1, 1.0, 0.3), 0.25)
    spin = np.array([0.1, 0.2, 2.0])
    found = lesson.conservative_advancement(
        rod.start, rod.end, spin, ball.center, 0.25, 9.0, 1e-9
    )
    exact = time_of_impact(rod, ball, STILL, STILL, horizon=9.0, spin_a=spin, pivot_a=STILL)  # fmt: skip
    assert 0 < found <= exact < np.inf and exact == pytest.approx(found, abs=1e-6)


@pytest.mark.peers
@pytest.mark.parametrize("turning", [0.0, 1.0])
@pytest.mark.parametrize("draw", [boxes, capsules, spheres])
def test_python_fcl_finds_the_same_times(draw, turning):
    """Its conservative advancement, for the motion from one place to another in a unit of time.

    It stops 1e-5 before the impact. It reports none for a fifth of the boxes that meet, and
    for as good as all pairs where something was compiled in this process before its first
    call; and another time for one turning capsule in twenty. For these the gap decides.
    """
    fcl = pytest.importorskip("fcl")
    rng, n = np.random.default_rng(8), 80
    a, b = draw(rng, n, 4.0), draw(rng, n, 4.0)
    v = (b.bounds().center - a.bounds().center) * 0.9 + rng.normal(0, 0.3, (n, 3))
    spin = turning * rng.normal(size=(n, 3))
    pivot = a.bounds().center
    mine = time_of_impact(a, b, v, STILL, horizon=1.0, spin_a=spin, pivot_a=pivot, tolerance=1e-6)  # fmt: skip
    theirs = np.array([_time_by_fcl(fcl, a[i], b[i], v[i], spin[i]) for i in range(n)])
    found = hits(theirs)
    assert 15 < hits(mine).sum()
    with np.errstate(invalid="ignore"):
        same = np.abs(mine - theirs) <= 2e-4
    assert np.sum(same & found) >= 0.9 * found.sum()
    for i in np.flatnonzero(hits(mine) & ~same):
        motion, still = (v[i], spin[i], pivot[i]), (STILL,) * 3
        later = mine[i] + np.array([0, 1e-4, 1e-3, 1e-2])
        gap = gaps(a[i], b[i], motion, still, later)
        assert abs(gap[0]) <= 1e-9 and gap.min() < -1e-9
        assert stays_above(-1e-6, a[i], b[i], motion, still, mine[i] * (1 - 1e-9))
    assert not np.any(found & ~hits(mine))


def _time_by_fcl(fcl, a, b, velocity, spin):
    objects, ends = [], []
    turn = Rotation.from_rotvec(spin).as_matrix()
    for shape, way, end in (a, velocity, turn), (b, STILL, np.eye(3)):
        geometry, (axes, place) = _in_fcl(fcl, shape)
        objects.append(fcl.CollisionObject(geometry, fcl.Transform(axes, place)))
        ends.append(fcl.Transform(end @ axes, place + way))
    request = fcl.ContinuousCollisionRequest(
        num_max_iterations=100,
        toc_err=1e-5,
        ccd_motion_type=fcl.CCDMotionType.CCDM_LINEAR,
        ccd_solver_type=fcl.CCDSolverType.CCDC_CONSERVATIVE_ADVANCEMENT,
    )
    result = fcl.ContinuousCollisionResult()
    found = fcl.continuousCollide(objects[0], ends[0], objects[1], ends[1], request, result)  # fmt: skip
    return found if result.is_collide else np.inf


def _in_fcl(fcl, shape):
    """Geometry and start (rotation, place) of a shape in python-fcl."""
    if isinstance(shape, Sphere):
        return fcl.Sphere(float(shape.radius)), (np.eye(3), shape.center)
    if isinstance(shape, OBB):
        return fcl.Box(*(2 * shape.half_extents)), (shape.rotation, shape.center)
    way = shape.end - shape.start
    length = np.linalg.norm(way)
    axis = way / length
    side = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    side /= np.linalg.norm(side)
    turn = np.stack([side, np.cross(axis, side), axis], axis=1)
    geometry = fcl.Capsule(float(shape.radius), length)
    return geometry, (turn, 0.5 * (shape.start + shape.end))


def test_loops_take_the_same_for_sliding():
    from course.overlap.moving import swept_loops

    assert swept_loops.SLIDING == swept.SLIDING
