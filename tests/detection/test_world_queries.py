"""Rays, points, the nearest, shapes that move: against closed forms, sampling and every pair by itself."""

import numpy as np
import pytest
from detection.worlds import drawn_world, move_some
from overlap.drawn_shapes import DRAW, depth_inside

from course.detection import CollisionWorld
from course.detection.world.rays import enters
from course.overlap import gap, overlaps, time_of_impact
from course.shapes import AABB, OBB, Capsule, Compound, ConvexHull, HalfSpace, Sphere

STILL = np.eye(3)
SIMPLE = ("sphere", "capsule", "aabb", "obb", "kdop", "convex_hull", "half_space")


@pytest.mark.parametrize("zero", [0.0, -0.0])
@pytest.mark.parametrize("moved", [False, True])
def test_a_ray_that_lies_in_a_face_hits(zero, moved):
    """As reported in public: from (16, 32) by 240 along x, a box from (32, 32) of side 64."""
    world = CollisionWorld()
    handle = world.add(AABB((32.0, 32, 0), (96.0, 96, 64)), body=0)
    if moved:
        world.move(handle, STILL, np.zeros(3))
    found = world.ray((16.0, 32, 32), (240.0, zero, zero), length=240.0)
    assert (found.handle, found.distance, found.inside) == (handle, 16.0, False)
    assert found.point.tolist() == [32, 32, 32] and found.normal.tolist() == [-1, 0, 0]
    back = world.ray((112.0, 96, 32), (-1.0, zero, zero))
    assert back.distance == 16.0 and back.normal.tolist() == [1, 0, 0]
    beside = world.ray((16.0, 32 - 1e-9, 32), (240.0, zero, zero))
    assert beside.handle == -1 and beside.distance == np.inf


def test_a_ray_that_starts_inside_says_so():
    world = CollisionWorld()
    handle = world.add(AABB((32.0, 32, 0), (96.0, 96, 64)), body=0)
    found = world.ray([(64.0, 64, 32), (32, 50, 10)], (1.0, 0, 0))
    assert found.handle.tolist() == [handle, handle] and np.all(found.inside)
    assert found.distance.tolist() == [0, 0] and not np.any(found.normal)
    assert found.point.tolist() == [[64, 64, 32], [32, 50, 10]]


def test_a_ray_that_misses_and_one_too_short_say_so():
    world = CollisionWorld()
    world.add(Sphere((10.0, 0, 0), 1.0), body=0)
    found = world.ray(np.zeros(3), [(1, 0, 0), (1, 0, 0), (-1, 0, 0), (0, 1, 0)], length=[9, 8.9, 99, 99])  # fmt: skip
    assert found.handle.tolist() == [0, -1, -1, -1]
    assert found.distance.tolist() == [9, np.inf, np.inf, np.inf]
    assert np.all(np.isnan(found.point[1:])) and not np.any(found.normal[1:])
    empty = CollisionWorld().ray(np.zeros(3), (1.0, 0, 0))
    assert empty.handle == -1 and empty.distance == np.inf


def test_rays_against_closed_forms():
    """A ball of radius 5 passed at 3: 10 - 4. A rod along z of radius 1: its side, its end, past it."""
    x = np.array([1.0, 0, 0])
    world = CollisionWorld()
    world.add(Sphere((10.0, 3, 0), 5.0), body=0, group=1)
    world.add(Capsule((10.0, 0, 0), (10.0, 0, 4), 1.0), body=1, group=2)
    world.add(HalfSpace(np.array([-0.6, 0, 0.8]), -12.0), body=2, group=4)
    found = world.ray(np.zeros(3), x, mask=1)
    assert found.distance == pytest.approx(6.0, rel=1e-15)
    np.testing.assert_allclose(found.normal, [-0.8, -0.6, 0], atol=1e-15)
    side, end, past = (
        world.ray((0.0, 0, z), x, mask=2) for z in (2.0, 4.6, np.nextafter(5, 6))
    )
    assert side.distance == 9.0 and side.normal.tolist() == [-1, 0, 0]
    assert end.distance == pytest.approx(10 - 0.8, rel=1e-14)
    np.testing.assert_allclose(end.normal, [-0.8, 0, 0.6], atol=1e-14)
    assert past.handle == -1 and world.ray((0, 0, 5.0), x, mask=2).distance == 10.0
    down = world.ray((10.0, 0, 9), (0, 0, -2.0), mask=2)
    assert down.distance == 4.0 and down.normal.tolist() == [0, 0, 1]
    plane = world.ray(np.zeros(3), x, mask=4)
    assert plane.distance == pytest.approx(20.0, rel=1e-15)
    assert plane.normal.tolist() == [-0.6, 0, 0.8]


@pytest.mark.slow
@pytest.mark.parametrize("kind", SIMPLE)
def test_rays_enter_where_sampling_finds_the_surface(kind):
    """Outside before, inside after, by the shape's own definition; misses stay outside all along."""
    rng = np.random.default_rng(SIMPLE.index(kind))
    shape = DRAW[kind](rng, 100)
    p = rng.normal(0, 4, (100, 3))
    middle = 0.0 if kind == "half_space" else shape.bounds().center
    u = middle + rng.normal(0, 0.7, (100, 3)) - p
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    found = enters(shape, p, u)
    assert np.array_equal(found.inside, depth_inside(shape, p) >= 0)
    hit = np.isfinite(found.distance) & ~found.inside
    assert 20 < hit.sum() < 100 - found.inside.sum()
    t, some = found.distance[hit, None], shape[hit]
    at = p[hit] + t * u[hit]
    np.testing.assert_allclose(depth_inside(some, at), 0, atol=1e-9)
    steep = -np.sum(found.normal[hit] * u[hit], axis=1)
    assert np.all(steep >= 0)
    np.testing.assert_allclose(np.linalg.norm(found.normal[hit], axis=1), 1, rtol=1e-12)
    out = depth_inside(some, at + 1e-6 * found.normal[hit])
    np.testing.assert_allclose(out, -1e-6, rtol=1e-4)
    for share in np.linspace(0, 0.999, 8):
        assert np.all(depth_inside(some, p[hit] + share * t * u[hit]) < 1e-12)
    missed = ~hit & ~found.inside
    for s in np.linspace(0, 20, 20):
        assert np.all(depth_inside(shape[missed], p[missed] + s * u[missed]) < 1e-9)


def test_rays_hit_flat_hulls():
    square = ConvexHull([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    world = CollisionWorld()
    world.add(square, body=0)
    origin = [(0.5, 0.5, 3), (0.5, 0.5, -3), (1.5, 0.5, 3)]
    found = world.ray(origin, [(0, 0, -1.0), (0, 0, 1), (0, 0, -1)])
    assert found.distance.tolist() == [3, 3, np.inf]
    assert found.normal.tolist() == [[0, 0, 1], [0, 0, -1], [0, 0, 0]]


@pytest.mark.slow
def test_all_queries_say_what_every_collider_by_itself_says():
    rng = np.random.default_rng(21)
    world, told = drawn_world(rng, count=5)
    move_some(world, told, rng, list(told)[::2], step=1.0)
    p, d = rng.normal(0, 6, (40, 3)), rng.normal(size=(40, 3))
    point = Sphere(p, np.zeros(40))
    shapes = {h: t.standing for h, t in told.items()}
    gaps = {h: gap(point, s) for h, s in shapes.items()}

    held = sorted((int(i), h) for h, g in gaps.items() for i in np.flatnonzero(overlaps(point, shapes[h])))  # fmt: skip
    assert world.containing(p).tolist() == [list(pair) for pair in held] and held

    found = world.nearest(p)
    least = np.min(list(gaps.values()), axis=0)
    np.testing.assert_allclose(found.distance, least, atol=1e-9)
    for k, handle in enumerate(found.handle.tolist()):
        assert gaps[handle][k] == pytest.approx(least[k], abs=1e-9)
    away = np.linalg.norm(found.point - p, axis=1)
    np.testing.assert_allclose(away, np.abs(found.distance), atol=1e-9)

    unit = d / np.linalg.norm(d, axis=1, keepdims=True)
    times = {h: time_of_impact(point, s, unit, np.zeros(3), horizon=np.inf) for h, s in shapes.items()}  # fmt: skip
    rays = world.ray(p, d)
    np.testing.assert_allclose(rays.distance, np.min(list(times.values()), axis=0), atol=1e-8)  # fmt: skip

    ball = Sphere(p, 0.4)
    handle, time = world.sweep(ball, d, horizon=5.0)
    alone = {h: time_of_impact(ball, s, d, np.zeros(3), horizon=5.0) for h, s in shapes.items()}  # fmt: skip
    np.testing.assert_allclose(time, np.min(list(alone.values()), axis=0), atol=1e-9)
    assert np.array_equal(handle < 0, np.isinf(time)) and 5 < np.sum(handle >= 0)


def test_queries_look_at_the_groups_of_their_mask_and_see_what_moves():
    world = CollisionWorld()
    near, far = world.add(Sphere([(2.0, 0, 0), (5, 0, 0)], 1.0), body=[0, 1], group=[1, 2])  # fmt: skip
    x = (1.0, 0, 0)
    assert world.ray(np.zeros(3), x).handle == near
    assert world.ray(np.zeros(3), x, mask=2).handle == far
    assert world.nearest(np.zeros(3), mask=2).handle == far
    assert world.containing((5.0, 0, 0), mask=1).tolist() == []
    assert world.sweep(Sphere(np.zeros(3), 0.5), x, horizon=9.0, mask=2) == (far, 3.5)
    world.move(near, STILL, (0, 5.0, 0))
    assert world.ray(np.zeros(3), x).handle == far
    world.remove(far)
    assert world.ray(np.zeros(3), x).handle == -1
    assert world.nearest(np.zeros(3), mask=2).handle == -1


def test_a_compound_and_a_floor_answer_by_their_handles():
    world = CollisionWorld()
    rod = Compound((Sphere((0, 0, 1.0), 0.2), OBB((0, 0, 2.0), STILL, (0.1, 0.1, 1.0))))
    handle = world.add(rod, body=0)
    floor = world.add(HalfSpace((0, 0, 1.0), 0.0), body=1, fixed=True)
    assert world.ray((0, 0, 9.0), (0, 0, -1.0)).handle == handle
    assert world.ray((1, 0, 9.0), (0, 0, -1.0)).handle == floor
    assert world.containing([(0, 0, 1.0), (0, 0, -1)]).tolist() == [[0, handle], [1, floor]]  # fmt: skip
    assert world.nearest((5.0, 0, 0.5)).handle == floor
    world.remove(handle)
    assert world.nearest((5.0, 0, 1e6)).distance == 1e6


def test_the_tree_of_rays_finds_what_all_colliders_do():
    rng = np.random.default_rng(2)
    center = rng.uniform(0, 10, (2000, 3))
    world = CollisionWorld()
    world.add(Sphere(center, 0.2), body=np.arange(2000))
    p, d = rng.uniform(-2, 12, (100, 3)), rng.normal(size=(100, 3))
    d[::5, 1] = 0.0
    found = world.ray(p, d)
    u = d / np.linalg.norm(d, axis=1, keepdims=True)
    balls = Sphere(np.tile(center, (100, 1)), np.full(200_000, 0.2))
    every = enters(balls, np.repeat(p, 2000, axis=0), np.repeat(u, 2000, axis=0))
    least = every.distance.reshape(100, 2000).min(axis=1)
    np.testing.assert_allclose(found.distance, least, rtol=1e-13)
    assert np.isfinite(found.distance).sum() > 20


@pytest.mark.parametrize(
    "said, wrong",
    [
        ("direction: expected vectors that are not zero", lambda w: w.ray(np.zeros(3), np.zeros(3))),
        ("direction: expected a batch", lambda w: w.ray(np.zeros((2, 3)), np.ones((3, 3)))),
        ("length: expected", lambda w: w.ray(np.zeros(3), np.ones(3), length=-1.0)),
        ("origin: expected finite", lambda w: w.ray([np.nan, 0, 0], np.ones(3))),
        ("mask: expected one whole number", lambda w: w.ray(np.zeros(3), np.ones(3), mask=0.5)),
        ("point: expected", lambda w: w.nearest(np.zeros(2))),
        ("horizon: expected finite", lambda w: w.sweep(Sphere(np.zeros(3), 1.0), np.ones(3), horizon=np.inf)),
    ],
)  # fmt: skip
def test_wrong_questions_are_refused_by_name(said, wrong):
    world = CollisionWorld()
    world.add(Sphere(np.zeros(3), 1.0), body=0)
    with pytest.raises(ValueError, match=said):
        wrong(world)


def test_the_kernels_of_a_world_are_compiled_for_one_type_each():
    """However the arrays come: after ``warm`` nobody waits for the compiler."""
    pytest.importorskip("numba")
    from course.detection.world import coarse_loops, ray_loops

    for module in (coarse_loops, ray_loops):
        module.warm()
    if not hasattr(ray_loops.ray_pairs, "signatures"):
        pytest.skip("the compiler is off")
    rng, world = np.random.default_rng(0), CollisionWorld()
    boxes = OBB(rng.normal(size=(30, 3)), STILL, np.ones(3))
    handles = world.add(boxes, body=np.arange(30))
    world.contacts()
    world.move(handles[:3], STILL, np.zeros(3))
    world.remove(handles[5])
    world.contacts(margin=0.2)
    world.ray(np.zeros(3), (1.0, 0, 0))
    world.ray(*np.asfortranarray(rng.normal(size=(2, 4, 3))), length=3.0)
    world.ray(np.asfortranarray(np.ones((4, 3))), np.asfortranarray(np.ones((4, 3))))
    for kernel in (coarse_loops.boxes_apart, ray_loops.ray_pairs):
        assert len(kernel.signatures) == 1
