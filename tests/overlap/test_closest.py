"""Gap, normal and witness points of rounded polytopes, against closed forms, bounds that prove them, and peers."""

import numpy as np
import pytest
from campaigns import drawn_of
from hypothesis import given, settings
from hypothesis import strategies as st
from polytope_truths import KINDS, drawn, errors
from scipy.spatial.transform import Rotation

from course.overlap.convex.closest import closest_points, least_translation
from course.shapes import (  # fmt: skip
    AABB,
    KDOP,
    OBB,
    Capsule,
    ConvexHull,
    Polytopes,
    Sphere,
    polytopes,
)

EYE = np.eye(3)


def closest(a, b):
    """Of two single shapes."""
    return closest_points(polytopes(a), polytopes(b), [0], [0])[0]


def box(center, size, turn=EYE):
    return OBB(np.array(center, float), np.array(turn), np.array(size) / 2)


def segment(start, end, radius=0.0):
    return Capsule(np.array(start, float), np.array(end, float), np.array(radius))


def swap(solids, i, j):
    """The pairs i, j of two batches as one batch, and the other way round."""
    both = Polytopes.concatenate(solids)
    return both, np.asarray(i), np.asarray(j) + len(solids[0])


# Closed forms.


def test_a_box_over_a_ball():
    """Numbers of a published bug report, worked out again: 5 - 1 - 1 = 3 apart, straight up."""
    found = closest(box((0, 5, 3), (10, 2, 10)), Sphere(np.zeros(3), np.array(1.0)))
    assert found.gap == 3
    np.testing.assert_array_equal(found.normal, [0, 1, 0])
    np.testing.assert_allclose(found.point_a, [0, 4, 0], atol=1e-15)
    np.testing.assert_allclose(found.point_b, [0, 1, 0], atol=1e-15)


def test_a_turned_box_beside_a_cylinder():
    """Of a published bug report: the box begins at x = .8 - .195, the cylinder's vertex is at x = .4 + .18."""
    quarter = Rotation.from_euler("z", 90, degrees=True).as_matrix()
    wall = box((0.8, -0.385, 0.735), (0.05, 0.39, 1.47), quarter)
    angle = 2 * np.pi * np.arange(16) / 16
    rim = np.stack([0.18 * np.cos(angle), 0.18 * np.sin(angle), 0 * angle], axis=1)
    rim += (0.4, -0.4, 0.93)
    post = ConvexHull(np.concatenate([rim + (0, 0, 0.09), rim - (0, 0, 0.09)]))
    found = closest(wall, post)
    assert found.gap == pytest.approx(0.025, abs=1e-15)
    np.testing.assert_allclose(found.normal, [1, 0, 0], atol=1e-15)


def test_two_segments():
    """(0,0,0)-(2,0,0) and (1,1,0)-(1,3,0) are 1 apart, either first."""
    p, q = segment((0, 0, 0), (2, 0, 0)), segment((1, 1, 0), (1, 3, 0))
    for a, b, up in ((p, q, -1), (q, p, 1)):
        found = closest(a, b)
        assert found.gap == 1
        np.testing.assert_array_equal(found.normal, [0, up, 0])
    # Capsules of radii .75 and .5 about them: .25 deep.
    found = closest(segment((0, 0, 0), (2, 0, 0), 0.75), segment((1, 1, 0), (1, 3, 0), 0.5))  # fmt: skip
    assert found.gap == -0.25
    np.testing.assert_array_equal(found.point_a, [1, 0.75, 0])
    np.testing.assert_array_equal(found.point_b, [1, 0.5, 0])


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("gap", [-0.1, 0.0, 0.1])
def test_cubes_along_an_axis(axis, gap):
    """Of side 2, centres 2 + gap apart: that gap along the axis, a unit normal also when touching."""
    found = closest(box((2 + gap) * EYE[axis], (2, 2, 2)), box((0, 0, 0), (2, 2, 2)))
    assert found.gap == pytest.approx(gap, abs=1e-15)
    np.testing.assert_allclose(found.normal, EYE[axis], atol=1e-15)
    assert (found.point_a - found.point_b) @ found.normal == pytest.approx(gap, abs=1e-15)  # fmt: skip


@pytest.mark.parametrize("half", [5.0, 50.0, 500.0])
def test_a_large_floor_changes_nothing(half):
    """A ball of radius .5166 at height 1 above boxes whose top is at 0."""
    floor = box((0, 0, -half), (2 * half, 2 * half, 2 * half))
    found = closest(Sphere(np.array([0.3, 0.2, 1.0]), np.array(0.5166)), floor)
    assert found.gap == pytest.approx(1 - 0.5166, abs=1e-12)
    np.testing.assert_allclose(found.point_b, [0.3, 0.2, 0], atol=1e-12 * half)


def test_hulls_of_opengjk():
    """The example of openGJK (M. Montanari, N. Petrinic, SoftwareX 7, 2018) is 3.653650 apart."""
    a = [[0, 5.5, 0], [2.3, 1, -2], [8.1, 4, 2.4], [4.3, 5, 2.2], [2.5, 1, 2.3],
         [7.1, 1, 2.4], [1, 1.5, 0.3], [3.3, 0.5, 0.3], [6, 1.4, 0.2]]  # fmt: skip
    b = [[0, -5.5, 0], [-2.3, -1, 2], [-8.1, -4, -2.4], [-4.3, -5, -2.2], [-2.5, -1, -2.3],
         [-7.1, -1, -2.4], [-1, -1.5, -0.3], [-3.3, -0.5, -0.3], [-6, -1.4, -0.2]]  # fmt: skip
    found = closest(ConvexHull(np.array(a)), ConvexHull(np.array(b)))
    assert found.gap == pytest.approx(3.653650, abs=1e-6)


R_493 = np.array(
    [[0.96193976625564348026, 0.15401279915737359216, 0.22572537250328919556],
     [-0.19134171618254486313, 0.96936494951283913579, 0.15401279915737359216],
     [-0.19509032201612822033, -0.19134171618254486313, 0.96193976625564348026]]
)  # fmt: skip


def test_touching_cubes_of_a_bug_report():
    """FCL's issue 493: the offset is one side along the second axis to 1e-16."""
    offset = [0.0770063995786869349, 0.48468247475641951239, -0.0956708580912724038]
    size = (0.5, 0.5, 0.5)
    found = closest(box(offset, size, R_493), box((0, 0, 0), size, R_493))
    assert abs(found.gap) < 4e-16
    np.testing.assert_allclose(found.normal, R_493[:, 1], atol=1e-12)


def test_crossing_slabs_of_a_bug_report():
    """FCL's issue 399, boxes turned about z: 3.3810644e-5 deep along (.995066, -.0992154, 0)."""
    turns = np.zeros((2, 3, 3)) + np.diag([0.0, 0, 1])
    turns[0, :2, :2] = [[-0.099432387353076273628, 0.99504432079443971837],
                        [-0.99504432079443971837, -0.099432387353076273628]]  # fmt: skip
    turns[1, :2, :2] = [[0.99506598442099225554, 0.099215354901756730444],
                        [-0.099215354901756730444, 0.99506598442099225554]]  # fmt: skip
    first = box((0.29526406526565551758, -0.013230856508016586304, 0.2),
                (0.23768037557601928711, 0.15702305734157562256, 0.25), turns[0])  # fmt: skip
    second = box((0.22759585694545214629, 0.14974093549228112421, 0.2),
                 (0.010000000000000000208, 0.78165709972381591797, 0.25), turns[1])  # fmt: skip
    found = closest(first, second)
    assert found.gap == pytest.approx(-3.3810644e-5, abs=1e-12)
    np.testing.assert_allclose(found.normal, turns[1][:, 0], atol=1e-12)


# Bounds that prove the answer, for every pair of kinds.


@pytest.mark.parametrize("kind_a", KINDS)
@pytest.mark.parametrize("kind_b", KINDS)
def test_every_pair_of_kinds(kind_a, kind_b):
    campaign(kind_a, kind_b, 6, seed=1)


@pytest.mark.long
@pytest.mark.parametrize("kind_a", KINDS)
@pytest.mark.parametrize("kind_b", KINDS)
def test_a_campaign_of_every_pair_of_kinds(kind_a, kind_b):
    """Of the whole campaign 100,000 pairs in all."""
    for seed in range(drawn_of(8, 1)):
        campaign(kind_a, kind_b, 104, seed)


def campaign(kind_a, kind_b, count, seed):
    rng = np.random.default_rng([seed, KINDS.index(kind_a), KINDS.index(kind_b)])
    m = max(3, count // 8)
    a, b = polytopes(drawn(kind_a, m, rng)), polytopes(drawn(kind_b, m, rng))
    i, j = rng.integers(0, m, (2, count))
    found = closest_points(a, b, i, j)
    assert errors(found, a, b, i, j).max() <= 1
    back = closest_points(b, a, j, i)
    np.testing.assert_allclose(back.gap, found.gap, rtol=0, atol=1e-11)


def test_kdops():
    """A 26-DOP of a ball's directions against boxes."""
    rng = np.random.default_rng(2)
    half = [[x, y, z] for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)][:13]
    axes = np.array(half) / np.linalg.norm(half, axis=1)[:, None]
    places = rng.uniform(-1.5, 1.5, (10, 1, 3))
    middle = np.sum(places * axes, axis=-1)
    reach = rng.uniform(0.7, 1, middle.shape)
    a = polytopes(KDOP(np.broadcast_to(axes, (10, 13, 3)), middle - reach, middle + reach))  # fmt: skip
    b = polytopes(drawn("boxes", 10, rng))
    i, j = np.indices((10, 10)).reshape(2, -1)
    found = closest_points(a, b, i, j)
    assert 20 < (found.gap < 0).sum() < 80
    assert errors(found, a, b, i, j).max() <= 1


# What must not change the answer.


@settings(max_examples=25, deadline=None)
@given(
    seed=st.integers(0, 10**6),
    kinds=st.tuples(*[st.sampled_from(["boxes", "hulls", "flat hulls", "segments"])] * 2),
)  # fmt: skip
def test_a_turn_a_shift_a_scale_and_an_exchange_change_nothing(seed, kinds):
    rng = np.random.default_rng(seed)
    shapes = [drawn(kind, 1, rng) for kind in kinds]
    before = closest(*(s[0] for s in shapes))
    turn = Rotation.from_quat(rng.normal(size=4)).as_matrix()
    shift = rng.normal(size=3)
    after = closest(*(s[0].moved(turn, shift) for s in shapes))
    back = closest(*(s[0] for s in shapes[::-1]))
    assert after.gap == pytest.approx(before.gap, abs=1e-13)
    assert back.gap == pytest.approx(before.gap, abs=1e-13)
    np.testing.assert_allclose(after.normal, turn @ before.normal, atol=1e-9)
    np.testing.assert_allclose(back.normal, -before.normal, atol=1e-9)


@pytest.mark.parametrize("scale", [1e-6, 1e6, 1e-100, 1e100])
@pytest.mark.slow
def test_scale(scale):
    rng = np.random.default_rng(3)
    v = rng.normal(size=(2, 20, 8, 3))
    v[1] += rng.uniform(-3, 3, (20, 1, 3))
    i = np.arange(20)
    one = closest_points(polytopes(ConvexHull(v[0])), polytopes(ConvexHull(v[1])), i, i)
    v = v * scale
    two = closest_points(polytopes(ConvexHull(v[0])), polytopes(ConvexHull(v[1])), i, i)
    np.testing.assert_allclose(two.gap / scale, one.gap, atol=1e-14)
    np.testing.assert_allclose(two.normal, one.normal, atol=1e-12)


def test_far_from_the_origin():
    """At 1e8 coordinates are rounded to 1.5e-8: nothing more is lost."""
    rng = np.random.default_rng(4)
    a, b = drawn("hulls", 30, rng), drawn("boxes", 30, rng)
    far = np.array([1e8, -1e8, 1e8])
    i = np.arange(30)
    here = closest_points(polytopes(a), polytopes(b), i, i)
    pair = polytopes(a.moved(EYE, far)), polytopes(b.moved(EYE, far))
    there = closest_points(*pair, i, i)
    np.testing.assert_allclose(there.gap, here.gap, atol=32 * 2.2e-16 * 1e8)
    assert errors(there, *pair, i, i).max() <= 1


def test_tiny_on_huge():
    """A cube of 1e-6 on one of 1e6: the gap is a difference of rounded coordinates, exact here."""
    big = AABB(np.array([-(2.0**19)] * 3), np.array([2.0**19, 2.0**19, 0]))
    for gap in (2.0**-30, 0.0, -(2.0**-30)):
        low = np.array([3.0, 5.0, gap])
        found = closest(AABB(low, low + 2.0**-20), big)
        assert found.gap == pytest.approx(gap, abs=32 * 2.2e-16 * 2.0**19)
        np.testing.assert_allclose(found.normal, [0, 0, 1], atol=1e-9)
        assert np.all(np.abs(found.point_a - low) <= 2.0**-20 + 1e-9)


# Degenerate input.


@pytest.mark.parametrize(
    "a, b, gap, across",
    [
        (segment((-1, 0, 0), (1, 0, 0)), segment((0, -1, 0), (0, 1, 0)), 0, (0, 0, 1)),
        (segment((0, 0, 0), (1, 0, 0)), segment((0.5, 0, 0), (2, 0, 0)), 0, None),
        (segment((0, 0, 0), (1, 0, 0)), segment((1, 0, 0), (2, 0, 0)), 0, None),
        (segment((1, 1, 1), (1, 1, 1), 2), Sphere(np.ones(3), np.array(3.0)), -5, None),
        (Sphere(np.zeros(3), np.array(0.0)), Sphere(np.zeros(3), np.array(0.0)), 0, None),
        (segment((0, 0, -1), (0, 0, 1)), box((0, 0, 0), (2, 2, 0)), -1, None),
        (box((0, 0, 0), (2, 2, 0)), box((1, 1, 0), (2, 2, 0)), 0, (0, 0, 1)),
        (box((0, 0, 0), (2, 2, 0)), box((3, 0, 0), (2, 2, 0)), 1, (1, 0, 0)),
        (box((0, 0, 0), (2, 2, 2)), box((0, 0, 0), (2, 2, 2)), -2, None),
        (box((0, 0, 0), (2, 2, 2)), Sphere(np.zeros(3), np.array(1.0)), -2, None),
        (segment((-3, 0, 0.9), (3, 0, 0.9)), box((0, 0, 0), (2, 2, 2)), -0.1, (0, 0, 1)),
    ],
)  # fmt: skip
def test_degenerate_pairs(a, b, gap, across):
    """Worked out by hand; where the direction is not unique any unit vector is right, the same one every time."""
    if across == (0, 0, 1) and gap == 0 and a.kind == b.kind == "capsule":
        assert abs(closest(a, b).normal[2]) == 1
    for first, second in ((a, b), (b, a)):
        found, again = closest(first, second), closest(first, second)
        assert found.gap == pytest.approx(gap, abs=1e-15)
        assert np.linalg.norm(found.normal) == pytest.approx(1, abs=1e-15)
        np.testing.assert_array_equal(found.normal, again.normal)
        if across is not None:
            np.testing.assert_allclose(np.abs(found.normal), across, atol=1e-15)


@pytest.mark.parametrize("tilt", [0, *10.0 ** np.arange(-16, -5)])
@pytest.mark.parametrize("gap", [-0.1, 0, 1e-9, 0.1])
@pytest.mark.slow
def test_nearly_parallel_boxes(tilt, gap):
    """Turned by a hair about a diagonal axis: the least separation of 26 corners by hand is that of the faces."""
    axis = np.array([1.0, 2.0, 3.0]) / np.sqrt(14)
    turn = Rotation.from_rotvec(tilt * axis).as_matrix()
    pair = box((0.3, 0.2, 2 + gap), (2, 2, 2), turn), box((0, 0, 0), (2, 2, 2))
    for first, second, sign in ((*pair, 1), (*pair[::-1], -1)):
        found = closest(first, second)
        # The face is tilted by less than 2 tilt: so much its lowest corner goes down.
        assert found.gap == pytest.approx(gap, abs=2 * tilt + 1e-15)
        np.testing.assert_allclose(found.normal, [0, 0, sign], atol=4 * tilt + 1e-9 + 1e-7 * (gap == 1e-9))  # fmt: skip
        one = [polytopes(s) for s in (first, second)]
        assert errors(found[None], *one, [0], [0]).max() <= 1


def test_many_vertices():
    """Hulls of 80 points on a sphere, which have no room in EPA's polytope."""
    rng = np.random.default_rng(6)
    v = rng.normal(size=(2, 4, 80, 3))
    v /= np.linalg.norm(v, axis=-1)[..., None]
    v[1, :, :, 0] += np.array([0.0, 1.9, 1.99, 3])[:, None]
    a, b = (polytopes(ConvexHull(x)) for x in v)
    found = closest_points(a, b, np.arange(4), np.arange(4))
    assert errors(found, a, b, range(4), range(4)).max() <= 1


# Depth by separating axes alone.


@pytest.mark.parametrize(
    "kinds",
    [
        ("hulls", "hulls"),
        ("boxes", "hulls"),
        ("lattice hulls", "lattice boxes"),
        ("needles", "boxes"),
    ],
)
def test_epa_and_separating_axes_agree(kinds):
    rng = np.random.default_rng(7)
    a, b = (polytopes(drawn(kind, 12, rng)) for kind in kinds)
    i, j = np.indices((12, 12)).reshape(2, -1)
    found = closest_points(a, b, i, j)
    s, normal = least_translation(a, b, i, j)
    deep = found.gap < 0
    assert deep.sum() > 10
    np.testing.assert_allclose(s[deep], found.gap[deep], atol=1e-13)
    apart = ~deep
    assert np.all(s[apart] <= found.gap[apart] + 1e-13)
    np.testing.assert_allclose(np.linalg.norm(normal, axis=1), 1, atol=1e-15)


def test_radii_make_a_depth_larger():
    a, b = segment((0, 0, -1), (0, 0, 1), 0.25), box((0, 0, 0), (2, 4, 6))
    s, normal = least_translation(polytopes(a), polytopes(b), [[0]], [[0]])
    assert s.shape == (1, 1) and s[0, 0] == -1.25 and abs(normal[0, 0, 0]) == 1


# Arguments.


def test_batches_keep_their_shape():
    solids = polytopes(AABB(np.zeros((4, 3)), np.ones((4, 3))))
    found = closest_points(solids, solids, np.zeros((2, 3), int), np.ones((2, 3), int))
    assert found.gap.shape == (2, 3) and found.point_b.shape == (2, 3, 3)
    assert closest_points(solids, solids, [], []).normal.shape == (0, 3)


def test_wrong_numbers_are_refused():
    solids = polytopes(AABB(np.zeros((4, 3)), np.ones((4, 3))))
    with pytest.raises(
        ValueError, match="j: expected whole numbers from 0 to 3; got 4"
    ):
        closest_points(solids, solids, [0], [4])
    with pytest.raises(ValueError, match="j: expected the shape of i"):
        least_translation(solids, solids, [0], [0, 1])
