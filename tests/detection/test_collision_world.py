"""A world of colliders says what every pair, asked by itself, says; bad use changes nothing."""

import numpy as np
import pytest
from detection.worlds import Told, drawn_world, expected_rows, move_some, rows_of
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule
from overlap.drawn_shapes import DRAW

from course.detection import CollisionWorld
from course.shapes import AABB, OBB, Capsule, Compound, HalfSpace, Sphere

STILL = np.eye(3)


def assert_same(world, told, margin=0.0):
    found = world.contacts(margin=margin)
    expected = expected_rows(told, margin)
    mine = sorted(rows_of(found))
    assert [row[:7] for row in mine] == [row[:7] for row in expected]
    if mine:
        numbers = [np.array([row[7:] for row in rows]) for rows in (mine, expected)]
        np.testing.assert_allclose(*numbers, atol=2e-9)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("margin", [0.0, 0.3, -0.1])
def test_all_kinds_touch_where_every_pair_by_itself_does(margin):
    rng = np.random.default_rng(1)
    world, told = drawn_world(rng, count=2)
    assert len(assert_same(world, told, margin)) > 12
    handles = rng.permutation(list(told))[:10].tolist()
    move_some(world, told, rng, handles)
    assert_same(world, told, margin)


def test_contacts_are_in_the_order_of_the_handles_and_count_their_pairs():
    world, _ = drawn_world(np.random.default_rng(4), count=3)
    found = world.contacts()
    order = np.lexsort((found.key[:, 1], found.key[:, 0]))
    assert np.array_equal(order, np.arange(len(found)))
    assert np.all(found.key[:, 0] < found.key[:, 1])
    assert set(np.diff(found.pair).tolist()) == {0, 1} and found.pair[0] == 0


def test_none_can_be_added_moved_and_removed():
    world = CollisionWorld()
    none = world.add(Sphere(np.zeros((0, 3)), 1.0), body=0)
    assert none.shape == (0,) and len(world) == 0
    world.add(HalfSpace((0, 0, 1.0), 0.0), body=0)
    world.move(none, STILL, np.zeros(3))
    world.remove(none)
    assert len(world) == 1 and len(world.contacts()) == 0
    world.remove(world.handles)
    assert len(world) == len(world.contacts()) == 0


def test_an_empty_world_and_one_collider_have_no_contacts():
    world = CollisionWorld()
    assert len(world.contacts()) == len(world) == 0
    world.add(Sphere(np.zeros(3), 1.0), body=0)
    assert len(world.contacts(margin=10.0)) == 0 and len(world) == 1


def test_handles_have_the_batch_of_the_shapes_and_are_never_given_again():
    world = CollisionWorld()
    one = world.add(Sphere(np.zeros(3), 1.0), body=0)
    grid = world.add(Sphere(np.zeros((2, 3, 3)), 1.0), body=np.arange(3))
    assert one.shape == () and grid.tolist() == [[1, 2, 3], [4, 5, 6]]
    world.remove(grid)
    assert world.add(Sphere(np.zeros((1, 3)), 1.0), body=5).tolist() == [7]
    assert world.handles.tolist() == [0, 7]


def test_one_body_never_touches_itself_and_fixed_bodies_not_each_other():
    world = CollisionWorld()
    ball = Sphere(np.zeros((2, 3)), 1.0)
    world.add(ball, body=3)
    assert len(world.contacts()) == 0
    world.add(ball, body=[4, 5], fixed=True)
    found = world.contacts()
    assert sorted(zip(found.body_a.tolist(), found.body_b.tolist(), strict=True)) == [
        (3, 4), (3, 4), (3, 5), (3, 5)]  # fmt: skip


@pytest.mark.parametrize(
    "group, mask, touch",
    [
        ((1, 1), (-1, -1), True),
        ((1, 2), (2, 1), True),
        ((1, 2), (2, 2), False),  # the second does not want the first
        ((1, 2), (1, 1), False),
        ((3, 4), (4, 2), True),  # in two groups
        ((1, 1), (0, -1), False),
    ],
)
def test_groups_and_masks_say_who_may_touch_whom(group, mask, touch):
    world = CollisionWorld()
    world.add(Sphere(np.zeros((2, 3)), 1.0), body=[0, 1], group=group, mask=mask)
    assert len(world.contacts()) == touch


def test_a_compound_is_one_collider_and_its_parts_are_said_in_the_keys():
    dumbbell = Compound((Sphere((-1.0, 0, 0), 0.5), Sphere((1.0, 0, 0), 0.5)))
    world = CollisionWorld()
    world.add(dumbbell, body=0)
    world.add(HalfSpace((0, 0, 1.0), -0.5), body=1, fixed=True)
    assert len(world) == 2
    found = world.contacts()
    assert found.key.tolist() == [[0, 1, 0, 0], [0, 1, 2**40, 0]]
    world.move(0, STILL, (0, 0, 1.0))
    assert len(world.contacts()) == 0
    world.move(0, [[0, 0, -1], [0, 1, 0], [1, 0, 0]], (0, 0, 1.0))
    assert world.contacts().key.tolist() == [[0, 1, 0, 0]]


def test_moving_is_from_where_it_was_given_and_no_rounding_adds_up():
    world = CollisionWorld()
    world.add(OBB(np.zeros(3), STILL, (1.0, 1, 1)), body=0)
    world.add(HalfSpace((0, 0, 1.0), 0.0), body=1)
    for k in range(100):
        world.move(0, STILL, (0.1 * k, 0.1 * k, 0.7))
    world.move(0, STILL, (0, 0, 1.0))
    assert world.contacts().separation.tolist() == [0.0] * 4


def test_boxes_that_share_a_face_touch_before_they_are_moved_and_after():
    """As AABBs, whose bounds are compared as they are: [.1, .3] and [.3, .7] touch exactly."""
    world = CollisionWorld()
    low, high = [[0.1, 0, 0], [0.3, 0, 0]], [[0.3, 1, 1], [0.7, 1, 1]]
    handles = world.add(AABB(low, high), body=[0, 1])
    found = world.contacts()
    assert len(found) == 4 and np.all(found.separation == 0)
    world.move(handles, STILL, np.zeros(3))
    after = world.contacts(margin=1e-12)
    assert sorted(after.key.tolist()) == sorted(found.key.tolist())


def test_a_half_space_that_moves_finds_whom_it_reaches():
    world = CollisionWorld()
    world.add(Sphere([[0, 0, 1.0], [9, 0, 3.0]], 0.5), body=[0, 1])
    floor = world.add(HalfSpace((0, 0, 1.0), 0.0), body=2)
    assert len(world.contacts()) == 0
    world.move(floor, STILL, (0, 0, 0.7))
    assert world.contacts().body_a.tolist() == [0]
    world.move(floor, STILL, (0, 0, 2.7))
    assert world.contacts().body_a.tolist() == [0, 1]
    world.move(floor, STILL, (0, 0, -9.0))
    assert len(world.contacts()) == 0


BALL = Sphere(np.zeros(3), 1.0)


def test_a_wide_margin_reaches_a_half_space():
    """A ball .9 above a floor, within a margin of 1 but not of .8, in any order of margins."""
    world = CollisionWorld()
    world.add(Sphere((0, 0, 1.4), 0.5), body=0)
    world.add(HalfSpace((0, 0, 1.0), 0.0), body=1)
    found = [len(world.contacts(margin=m)) for m in (1.0, 0.8, 1.0, 0.0, 0.95)]
    assert found == [1, 0, 1, 0, 1]


WRONG = {
    "unknown": ("handles: expected handles of colliders.*; got 99 in entry 1",
                lambda w: w.move([0, 99], STILL, np.zeros(3))),
    "removed twice": ("handles: expected handles of colliders.*; got 2",
                lambda w: w.remove(2)),
    "one twice": ("handles: expected each handle once; got 1 in entry 2",
                lambda w: w.remove([0, 1, 1])),
    "negative": ("handles: expected whole numbers",
                lambda w: w.remove([-1])),
    "NaN": (r"translation: expected finite.*got nan in entry \(1, 0\)",
                lambda w: w.move([0, 1], STILL, [[0, 0, 0], [np.nan, 0, 0]])),
    "far": ("translation: expected coordinates up to 1e",
                lambda w: w.move([0, 1], STILL, [[0, 0, 0], [1e60, 0, 0]])),
    "a plane far": (
        "translation: expected coordinates up to 1e",
        lambda w: w.move(w.handles[-1], STILL, [0, 0, 1e60]),
    ),
    "no rotation": ("rotation: expected rotation",
                lambda w: w.move(0, 2 * STILL, np.zeros(3))),
    "more poses": ("handles: expected as many as poses",
                lambda w: w.move(0, STILL, np.zeros((2, 3)))),
    "fewer poses": ("translation: expected a batch",
                lambda w: w.move([0, 1], STILL, np.zeros((3, 3)))),
    "body": ("body: expected whole numbers",
                lambda w: w.add(BALL, body=-1)),
    "bodies": ("body: expected what broadcasts",
                lambda w: w.add(BALL, body=[1, 2])),
    "fixed": ("fixed: expected True or False",
                lambda w: w.add(BALL, body=1, fixed=2)),
    "group": ("group: expected at least one bit",
                lambda w: w.add(BALL, body=1, group=0)),
    "mask": ("mask: expected whole numbers",
                lambda w: w.add(BALL, body=1, mask=1.5)),
    "endless": ("shapes: expected finite boxes, or half spaces",
                lambda w: w.add(AABB(np.zeros(3), [1, 1, np.inf]), body=1)),
    "too far": ("shapes: expected coordinates up to",
                lambda w: w.add(Sphere([1e60, 0, 0], 1.0), body=1)),
    "margin": ("margin: expected",
                lambda w: w.contacts(margin=np.nan)),
}  # fmt: skip


@pytest.mark.parametrize("said, wrong", WRONG.values(), ids=WRONG)
def test_bad_use_is_refused_by_name_and_changes_nothing(said, wrong):
    world = CollisionWorld()
    world.add(Sphere([[0, 0, 0], [1.5, 0, 0], [1, 1, 0.0]], 1.0), body=[0, 1, 2])
    world.remove(2)
    world.add(HalfSpace((0, 0, 1.0), -5.0), body=3)
    before, counters, handles = rows_of(world.contacts()), world.counters, world.handles
    with pytest.raises(ValueError, match=said):
        wrong(world)
    assert world.counters == counters and np.array_equal(world.handles, handles)
    assert rows_of(world.contacts()) == before and len(before) == 1
    assert world.counters.boxes.tested == 0  # not even a pair was touched
    assert world.add(Sphere(np.zeros(3), 1.0), body=7) == 4


def test_what_is_no_shape_is_refused():
    with pytest.raises(TypeError, match="shapes: expected a shape; got list"):
        CollisionWorld().add([1.0], body=0)


def test_inputs_are_not_written_and_contacts_cannot_be():
    world, rng = CollisionWorld(), np.random.default_rng(0)
    handles = world.add(Sphere(rng.normal(size=(9, 3)), 1.0), body=np.arange(9))
    shift = rng.normal(size=(9, 3))
    before = shift.copy()
    world.move(handles, STILL, shift)
    assert np.array_equal(shift, before)
    shift[:] = np.nan  # the caller's own, from now on
    found = world.contacts()
    assert len(found) and np.all(np.isfinite(found.point))
    with pytest.raises(ValueError, match="read-only"):
        found.separation[0] = 0.0


KINDS = ("sphere", "capsule", "aabb", "obb", "convex_hull", "half_space", "compound")


class Steps(RuleBasedStateMachine):
    """Any order of steps, against a dict of what is there."""

    def __init__(self):
        super().__init__()
        self.world, self.told, self.gone = CollisionWorld(), {}, []

    @rule(kind=st.sampled_from(KINDS), seed=st.integers(0, 99), body=st.integers(0, 3),
          fixed=st.booleans(), group=st.sampled_from([1, 2, 3]), mask=st.sampled_from([-1, 1, 2]))  # fmt: skip
    def add(self, kind, seed, body, fixed, group, mask):
        if len(self.told) > 7:
            return
        shapes = DRAW[kind](np.random.default_rng(seed), 2, 1.0)
        said = {"fixed": fixed, "group": group, "mask": mask}
        for k, handle in enumerate(self.world.add(shapes, body=body, **said).tolist()):
            self.told[handle] = Told(shapes[k], body, **said)

    @rule(data=st.data(), seed=st.integers(0, 99))
    def move(self, data, seed):
        if self.told:
            some = data.draw(st.lists(st.sampled_from(sorted(self.told)), unique=True))
            move_some(self.world, self.told, np.random.default_rng(seed), some)

    @rule(data=st.data())
    def remove(self, data):
        if self.told:
            handle = data.draw(st.sampled_from(sorted(self.told)))
            self.world.remove(handle)
            del self.told[handle]
            self.gone.append(handle)

    @rule(margin=st.sampled_from([0.0, 0.2]))
    def ask(self, margin):
        assert_same(self.world, self.told, margin)

    @rule()
    def refuse(self):
        for handle in self.gone[-1:]:
            with pytest.raises(ValueError, match="handles"):
                self.world.remove([*self.told, handle])

    @invariant()
    def the_handles_are_those_that_are_there(self):
        assert self.world.handles.tolist() == sorted(self.told)


TestSteps = pytest.mark.slow(Steps.TestCase)
TestSteps.settings = settings(max_examples=20, stateful_step_count=12, deadline=None)


def test_a_bridge_of_capsules_hangs_together():
    """Capsules end to end, all of one group that does not ask for its own: only the floor is touched."""
    world = CollisionWorld()
    x = np.arange(20.0)[:, None] * (1, 0, 0)
    world.add(Capsule(x, x + (1, 0, 0), 0.1), body=np.arange(20), group=2, mask=1)
    world.add(HalfSpace((0, 0, 1.0), -0.1), body=20, fixed=True)
    found = world.contacts()
    assert len(found) == 40 and np.all(found.body_b == 20)
