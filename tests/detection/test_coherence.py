"""What a world remembers changes no contact, saves work, and does not grow."""

import tracemalloc

import numpy as np
import pytest
from detection.worlds import drawn_world, move_some, rows_of

from course.detection import CollisionWorld
from course.shapes import AABB, OBB, ConvexHull, HalfSpace, Sphere

STILL = np.eye(3)


def fresh(told):
    """A world that has just been filled with what stands, under the same handles."""
    world = CollisionWorld()
    for handle in range(max(told) + 1):
        if handle not in told:
            world.remove(world.add(Sphere(np.zeros(3), 1.0), body=0))
            continue
        t = told[handle]
        at = world.add(t.shape, body=t.body, fixed=t.fixed, group=t.group, mask=t.mask)
        assert at == handle
        if t.pose is not None:
            world.move(at, *t.pose)
    return world


@pytest.mark.slow
def test_coherent_frames_say_what_a_fresh_world_says():
    """Twelve frames of a few small and large moves and removals, exactly and in the same order."""
    rng = np.random.default_rng(11)
    world, told = drawn_world(rng, count=2)
    world.contacts()
    for frame in range(12):
        some = rng.choice(list(told), 4, replace=False).tolist()
        move_some(world, told, rng, some, 0.01, angle=0.01)
        if frame % 3 == 0:
            move_some(world, told, rng, some[:1], 1.0)
        if frame % 5 == 4:
            world.remove(some[0])
            del told[some[0]]
        margin = 0.1 if frame % 7 == 6 else 0.0
        found, anew = world.contacts(margin=margin), fresh(told).contacts(margin=margin)
        assert rows_of(found) == rows_of(anew)
        assert np.array_equal(found.pair, anew.pair)
        for name in ("curvature_a", "edge_b"):
            one, other = (getattr(c, name) for c in (found, anew))
            kind = found.feature == ("edges" if name == "edge_b" else "curved")
            if np.any(kind):
                np.testing.assert_allclose(one[kind], other[kind], atol=1e-9)
        assert world.counters.boxes.saved > 0 or margin or frame % 7 == 0


def chain(counters):
    """Each phase tests what the one before did not dismiss, but for planes and what has no axis."""
    c = counters
    assert c.oriented.tested == c.spheres.tested - c.spheres.dismissed
    assert c.spheres.tested <= c.boxes.tested - c.boxes.dismissed
    assert c.axes.tested <= c.oriented.tested - c.oriented.dismissed
    planes = c.boxes.tested - c.boxes.dismissed - c.spheres.tested
    left = c.oriented.tested - c.oriented.dismissed - c.axes.dismissed
    assert c.narrow.tested == left + planes
    assert c.boxes.tested + c.boxes.saved == c.pairs


def test_the_counters_tell_what_was_done_and_what_was_saved():
    rng = np.random.default_rng(5)
    world = CollisionWorld()
    handles = world.add(Sphere(rng.uniform(0, 6, (200, 3)), 0.5), body=np.arange(200))
    world.contacts()
    first = world.counters
    chain(first)
    assert first.broad.tested == 200 and first.boxes.saved == 0 and first.calls == 1
    assert first.narrow.tested == first.contacts > 50  # of spheres, spheres are exact
    world.contacts()
    again = world.counters
    assert (again.broad.saved, again.boxes.saved) == (200, first.pairs)
    assert again.boxes.tested == again.narrow.tested == again.calls == 0
    assert again.contacts == first.contacts
    world.move(handles[:2], STILL, (0.01, 0, 0))
    world.contacts()
    moved = world.counters
    chain(moved)
    assert moved.broad.tested == 0 and 0 < moved.boxes.tested < 0.1 * first.pairs
    world.move(handles[0], STILL, (3.0, 0, 0))
    world.contacts()
    assert world.counters.broad.tested == 1 and world.counters.broad.saved == 199
    assert "dismissed" in str(world.counters) and "200" not in str(moved).split("\n")[2]


def test_pairs_that_may_not_touch_are_dismissed_by_the_broad_phase():
    world = CollisionWorld()
    world.add(Sphere(np.zeros((3, 3)), 1.0), body=[0, 1, 2], fixed=[True, True, False])
    world.contacts()
    assert world.counters.broad.dismissed == 1 and world.counters.pairs == 2


def test_the_last_separating_axis_dismisses_a_pair_before_its_shapes_are_asked():
    """Two tetrahedra back to back: their boxes are one in the other, a plane is between them."""
    corner = ConvexHull([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    world = CollisionWorld()
    world.add(corner, body=0)
    other = world.add(ConvexHull([[1, 1, 1], [0, 1, 1], [1, 0, 1], [1, 1, 0.0]]), body=1)  # fmt: skip
    assert len(world.contacts()) == 0
    assert (world.counters.axes.tested, world.counters.narrow.tested) == (0, 1)
    world.move(other, STILL, (0.01, 0, 0))
    assert len(world.contacts()) == 0
    assert (world.counters.axes.dismissed, world.counters.narrow.tested) == (1, 0)
    world.move(other, STILL, (-0.5, -0.5, -0.5))
    assert len(world.contacts()) > 0
    assert (world.counters.axes.dismissed, world.counters.narrow.tested) == (0, 1)


def test_keys_stay_while_the_same_features_touch():
    world = CollisionWorld()
    box = world.add(OBB(np.zeros(3), STILL, (1.0, 1, 1)), body=0)
    world.add(AABB([[-9, -9, -1.0], [9, -9, -1]], [[9, 9, 0.0], [12, 9, 3]]), body=[1, 2], fixed=True)  # fmt: skip
    world.add(HalfSpace((0, 0, 1.0), -0.5), body=3, fixed=True)
    keys = []
    for x in np.linspace(0, 2, 20):
        world.move(box, STILL, (x, 0.1 * x, 1.0 - 1e-3))
        keys.append(sorted(world.contacts().key.tolist()))
    assert len(keys[0]) == 4 and all(key == keys[0] for key in keys)
    assert {(a, b) for a, b, _, _ in keys[0]} == {(0, 1)}


@pytest.mark.slow
def test_a_hundred_frames_need_no_more_memory_than_ten():
    rng = np.random.default_rng(3)
    world = CollisionWorld()
    place = rng.uniform(0, 2, (16, 3))
    handles = world.add(OBB(np.zeros((16, 3)), STILL, (0.3, 0.3, 0.3)), body=np.arange(16))  # fmt: skip
    world.move(handles, STILL, place)

    def frame(k):
        some = rng.choice(16, 3, replace=False)
        world.move(handles[some], STILL, place[some] + rng.normal(0, 0.05, (3, 3)))
        world.contacts()
        if k % 10 == 0:
            gone = world.add(Sphere(rng.uniform(0, 2, 3), 0.3), body=99)
            world.ray(np.zeros(3), np.ones(3))
            world.remove(gone)

    for k in range(11):
        frame(k)
    tracemalloc.start()
    frame(0)
    before = tracemalloc.get_traced_memory()[0]
    for k in range(100):
        frame(k)
    after = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    assert after - before < 100_000
