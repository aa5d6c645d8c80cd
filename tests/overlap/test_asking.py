"""The questions asked of any two shapes: batches, order, errors, and what must hold for every pair of kinds."""

import itertools
from dataclasses import fields

import numpy as np
import pytest
from campaigns import drawn_of
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from overlap.drawn_shapes import DRAW, depth_inside, true_gap, turns

from course.overlap import contacts, gap, overlaps
from course.overlap.asking import nearest_points
from course.overlap.pairs import KINDS
from course.shapes import AABB, OBB, Capsule, Compound, ConvexHull, HalfSpace, Sphere

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

ALL = [*KINDS, "compound"]
EVERY = list(itertools.product(ALL, ALL))
every_pair = pytest.mark.parametrize("kind_a, kind_b", EVERY)
in_one_order = pytest.mark.parametrize(
    "kind_a, kind_b", list(itertools.combinations_with_replacement(ALL, 2))
)
#: What a pair of order 1 may be off by: 1e-9 of the size is asked for.
EXACT = 1e-10


def drawn_pair(kind_a, kind_b, count=24, seed=0, spread=0.9):
    rng = np.random.default_rng([seed, ALL.index(kind_a), ALL.index(kind_b)])
    a, b = DRAW[kind_a](rng, count, spread), DRAW[kind_b](rng, count, spread)
    if kind_a == kind_b == "half_space":  # two thirds face each other
        normal = np.where(np.arange(count)[:, None] % 3, -b.normal, a.normal)
        a = HalfSpace(normal, a.offset)
    return a, b


@every_pair
@pytest.mark.long
def test_verdict_gap_and_contacts_agree(kind_a, kind_b):
    a, b = drawn_pair(kind_a, kind_b)
    d, hit = gap(a, b), overlaps(a, b)
    assert d.shape == hit.shape == (24,) and hit.dtype == bool and not np.isnan(d).any()
    if "half_space" not in (kind_a, kind_b) or kind_a != kind_b:
        assert 0 < hit.sum() < 24
    np.testing.assert_array_equal(hit, d <= 0)  # none of these touches
    found = contacts(a, b, margin=0.1)
    if kind_a == kind_b == "half_space":
        assert len(found) == 0
        return
    assert set(found.pair) == set(np.flatnonzero(d <= 0.1))
    for i in np.unique(found.pair):
        mine = found[found.pair == i]
        assert mine.separation.min() == pytest.approx(d[i], abs=EXACT)
        assert mine.separation.max() <= 0.1 + EXACT
    assert np.all(np.diff(found.pair) >= 0)


@every_pair
def test_swapping_turns_the_answer_round(kind_a, kind_b):
    a, b = drawn_pair(kind_a, kind_b)
    np.testing.assert_allclose(gap(a, b), gap(b, a), atol=EXACT)
    np.testing.assert_array_equal(overlaps(a, b), overlaps(b, a))
    one, other = contacts(a, b, margin=0.1), contacts(b, a, margin=0.1)
    assert one.pair.tolist() == other.pair.tolist()
    first, second = in_order(one, 1), in_order(other, -1)
    np.testing.assert_allclose(first, second, atol=1e-7)
    # Sunk as deep as it is round, a capsule's contact counts as carried by B, which B is.
    words, shallow = {"face_a": "face_b", "face_b": "face_a"}, -0.05
    mine = [words.get(w, w) for w in one.feature[one.separation > shallow]]
    assert sorted(mine) == sorted(other.feature[other.separation > shallow])


def in_order(found, side):
    """Points, normals and separations, in an order that does not depend on which body is A."""
    rows = np.column_stack(
        [found.pair, found.point, side * found.normal, found.separation]
    )
    return rows[np.lexsort(np.round(rows[:, :4], 6).T[::-1])]


@in_one_order
def test_moving_both_moves_the_answer(kind_a, kind_b):
    a, b = drawn_pair(kind_a, kind_b)
    d, found = gap(a, b), contacts(a, b, margin=0.1)
    rng = np.random.default_rng(3)
    turn, shift = turns(rng, 1)[0], rng.normal(0, 5, 3)
    moved = a.moved(turn, shift), b.moved(turn, shift)
    np.testing.assert_allclose(gap(*moved), d, atol=EXACT)
    again = contacts(*moved, margin=0.1)
    assert sorted(again.pair) == sorted(found.pair)
    np.testing.assert_allclose(sums(again), sums(found), atol=1e-7)


def sums(found):
    """The sum of the separations of each pair that has contacts."""
    return [found.separation[found.pair == i].sum() for i in np.unique(found.pair)]


@in_one_order
def test_nearest_points_are_on_the_surfaces(kind_a, kind_b):
    """And A moved by -gap N touches."""
    a, b = drawn_pair(kind_a, kind_b)
    if kind_a == kind_b == "half_space":
        with pytest.raises(ValueError, match="face each other"):
            nearest_points(a, b)
        return
    found = nearest_points(a, b)
    np.testing.assert_allclose(found.gap, gap(a, b), atol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(found.normal, axis=1), 1, rtol=1e-13)
    np.testing.assert_allclose(
        found.point_a - found.point_b, found.gap[:, None] * found.normal, atol=1e-9
    )
    for shape, point in (a, found.point_a), (b, found.point_b):
        if shape.kind != "compound":
            np.testing.assert_allclose(depth_inside(shape, point), 0, atol=1e-9)
    if "compound" not in (kind_a, kind_b):
        for i in range(0, 24, 4):
            moved = a[i].moved(np.eye(3), -found.gap[i] * found.normal[i])
            assert gap(moved, b[i]) == pytest.approx(0, abs=1e-9)


@in_one_order
def test_batches_broadcast(kind_a, kind_b):
    a, b = drawn_pair(kind_a, kind_b, count=3)
    crossed = gap(a[:, None], b)
    assert crossed.shape == (3, 3) and overlaps(a[:, None], b).shape == (3, 3)
    np.testing.assert_allclose(np.diagonal(crossed), gap(a, b), atol=1e-12)
    assert crossed[1, 2] == pytest.approx(gap(a[1], b[2]), abs=1e-12)
    assert np.ndim(gap(a[1], b[2])) == 0
    found = contacts(
        a[:, None], b, margin=50.0, body_a=[[5], [6], [7]], body_b=[1, 2, 3]
    )
    assert set(found.pair) == set(np.flatnonzero(crossed.ravel() > -np.inf)) - (
        set(range(9)) if kind_a == kind_b == "half_space" else set()
    )
    np.testing.assert_array_equal(found.body_a, 5 + found.pair // 3)
    np.testing.assert_array_equal(found.body_b, 1 + found.pair % 3)
    empty = a[:0]
    assert gap(empty, b[0]).shape == (0,) and len(contacts(empty, b[0])) == 0


def test_errors_name_the_argument():
    ball = Sphere(np.zeros((2, 3)), 1.0)
    for ask in overlaps, gap, contacts, nearest_points:
        with pytest.raises(TypeError, match="^a: expected a shape; got list"):
            ask([0, 0, 0], ball)
        with pytest.raises(TypeError, match="^b: expected a shape; got float"):
            ask(ball, 1.0)
        with pytest.raises(
            ValueError, match="^b: expected a batch that broadcasts with a"
        ):
            ask(ball, Sphere(np.zeros((3, 3)), 1.0))
        with pytest.raises(ValueError, match="^b: expected coordinates up to 1e.50"):
            ask(ball, Sphere([1e51, 0, 0], 1.0))
        with pytest.raises(ValueError, match="^a: expected coordinates up to 1e.50"):
            ask(AABB([-np.inf] * 3, [np.inf] * 3), ball)
    for margin in (np.nan, "wide", [1, 2]):
        with pytest.raises(ValueError, match="^margin: "):
            contacts(ball, ball, margin=margin)
    for limit in (0, 1.5, "two"):
        with pytest.raises(ValueError, match="^limit: "):
            contacts(ball, ball, limit=limit)
    with pytest.raises(ValueError, match="^body_a: expected ints that broadcast"):
        contacts(ball, ball, body_a=[1, 2, 3])
    with pytest.raises(ValueError, match="^body_b: "):
        contacts(ball, ball, body_a=1)


def test_a_shape_of_an_unknown_kind_is_refused():
    class Torus(Sphere):
        kind = "torus"

    with pytest.raises(ValueError, match="^a: expected a shape of a kind among sphere"):
        gap(Torus([0, 0, 0], 1.0), Sphere([0, 0, 0], 1.0))


def test_two_unit_spheres_on_one_centre():
    """A public report: depth 2, any unit normal."""
    ball = Sphere([3, 4, 5], 1.0)
    assert gap(ball, ball) == -2.0 and overlaps(ball, ball)
    found = contacts(ball, ball)
    assert found.separation.tolist() == [-2.0]
    assert np.linalg.norm(found.normal[0]) == 1.0


def test_a_capsule_above_a_box():
    """FCL's test_fcl_capsule_box_1: radius 2, length 4, box (1, 2, 4): gaps .5, 2, 5.5."""
    box = AABB([-0.5, -1, -2], [0.5, 1, 2])
    upright = Capsule([3, 0, -2], [3, 0, 2], 2.0)
    assert gap(upright, box) == pytest.approx(0.5, abs=1e-14)
    above = Capsule([0, 0, 6], [0, 0, 10], 2.0)
    assert gap(above, box) == pytest.approx(2.0, abs=1e-14)
    leaning = Capsule([8, 0, 2], [8, 0, -2], 2.0)
    assert gap(box, leaning) == pytest.approx(5.5, abs=1e-14)


def test_the_depth_of_a_compound_is_that_of_its_parts():
    """Slabs [0, 2] and [1, 3], probe [1.2, 1.8]: the parts say .8, the union 1.8."""
    wide = np.array([[0.0, -9, -9], [0, 9, 9]])
    ends = (0, 2), (1, 3)
    slabs = Compound(
        tuple(AABB(wide[0] + [x, 0, 0], wide[1] + [y, 0, 0]) for x, y in ends)
    )
    probe = AABB([1.2, -0.1, -0.1], [1.8, 0.1, 0.1])
    assert gap(probe, slabs) == pytest.approx(-0.8)
    assert gap(slabs, probe.moved(np.eye(3), [5, 0, 0])) == pytest.approx(3.2)


def test_parts_of_compounds_are_told_in_the_keys():
    """A dumbbell and a ball, each in contact with both parts of another: all keys differ."""
    bell = Compound(
        (Sphere([0, 0, 0], 1.0), Sphere([4, 0, 0], 1.0), Sphere([50, 0, 0], 1.0))
    )
    found = contacts(bell, bell.moved(np.eye(3), [0, 0, 1.5]))
    assert len(found) == 3 and len({tuple(k) for k in found.key.tolist()}) == 3
    np.testing.assert_allclose(found.separation, -0.5)


@given(
    kinds=st.sampled_from([e for e in EVERY if e != ("half_space", "half_space")]),
    seed=st.integers(0, 2**32 - 1),
    log_scale=st.floats(-6, 6),
    spread=st.sampled_from([0.0, 0.01, 0.5, 2.0]),
)
@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
def test_scaling_scales_the_answer(kinds, seed, log_scale, spread):
    a, b = drawn_pair(*kinds, count=2, seed=seed, spread=spread)
    scale = 10.0**log_scale
    d = gap(a, b)
    assert np.all(np.isfinite(d))
    np.testing.assert_allclose(
        gap(scaled(a, scale), scaled(b, scale)) / scale, d, atol=EXACT
    )
    np.testing.assert_array_equal(overlaps(a, b), d <= 0)
    np.testing.assert_allclose(gap(b, a), d, atol=EXACT)


def scaled(shape, s):
    if isinstance(shape, Compound):
        return Compound(tuple(scaled(part, s) for part in shape.parts))
    same = {"rotation", "normal", "directions"}
    names = [f.name for f in fields(shape) if f.init]
    return type(shape)(*((1 if n in same else s) * getattr(shape, n) for n in names))


CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))


@pytest.mark.parametrize("angle", [0.0, *10.0 ** np.arange(-16.0, -5.0)])
def test_touching_faces_and_edges_turned_by_next_to_nothing(angle):
    """A unit cube on another, on its side, on an edge: the gap is 0 but for angle and rounding."""
    c, s = np.cos(angle), np.sin(angle)
    axis = int(-np.log10(angle + 1e-17)) % 3
    turn = np.roll(np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]), axis, (0, 1))
    below = OBB([0, 0, 0], np.eye(3), [0.5] * 3)
    hull = ConvexHull(0.5 * CORNERS)
    for shift in ([0, 0, 1], [0.3, 0.2, 1], [1, 1, 0.3], [1, 1, 1], [0.25, 1, 1]):
        for other in (below.moved(turn, shift), hull.moved(turn, shift)):
            for base in (below, hull):
                d = gap(base, other)
                assert abs(d) <= angle + 1e-13
                found = contacts(base, other, margin=1e-5)
                assert len(found) >= 1
                # Of features that tie a face decides, and leans by the angle.
                assert found.separation.min() == pytest.approx(d, abs=angle + 1e-12)


@pytest.mark.slow
def test_degenerate_shapes_have_an_answer():
    """Points, segments, flat and needle-like hulls, coplanar points, far away, tiny and huge: no NaN."""
    rng = np.random.default_rng(9)
    flat = rng.normal(size=(6, 3)) * [1, 1, 0]
    shapes = [
        Sphere([0, 0, 0], 0.0),
        Capsule([0, 0, 0], [0, 0, 0], 0.0),
        Capsule([0, 0, 0], [0, 0, 0], 1.0),
        Capsule([-1, 0, 0], [1, 0, 0], 0.0),
        AABB([0, 0, 0], [0, 0, 0]),
        AABB([-1, 0, 0], [1, 0, 0]),
        AABB([-1, -1, 0], [1, 1, 0]),
        OBB([0, 0, 0], np.eye(3), [1e-6, 1e6, 0]),
        ConvexHull(flat),
        ConvexHull(flat * [1, 0, 0]),
        ConvexHull(flat * 0),
        ConvexHull(rng.normal(size=(8, 3)) * [1e6, 1, 1e-6]),
        ConvexHull(rng.normal(size=(8, 3)) * [1, 1, 1e-9]),
        ConvexHull(np.repeat(flat[:1], 5, axis=0)),
        Sphere([0, 0, 0], 1e6),
        Sphere([0, 0, 0], 1e-6),
        Compound((Sphere([0, 0, 0], 0.0), Capsule([0, 0, 0], [0, 0, 0], 0.0))),
    ]
    for shift in (np.zeros(3), np.array([0, 0, 1.0]), np.full(3, 1e8)):
        for a, b in itertools.combinations_with_replacement(shapes, 2):
            moved = b.moved(np.eye(3), shift)
            d = gap(a, moved)
            assert np.isfinite(d) and d == pytest.approx(
                gap(moved, a), rel=1e-9, abs=1e-7
            )
            assert overlaps(a, moved) in (d <= 1e-9, d <= 0, d <= -1e-9)
            found = contacts(a, moved, margin=1e-3)
            assert np.isfinite(found.point).all() and np.isfinite(found.normal).all()
            assert (len(found) > 0) == (d <= 1e-3)


def test_crossing_coplanar_polygons_and_segments_have_no_gap():
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0.0]])
    tilted = square @ turns(np.random.default_rng(1), 1)[0].T
    for shape in square, tilted:
        other = ConvexHull(shape + 0.5 * (shape[1] - shape[0]))
        assert gap(ConvexHull(shape), other) == pytest.approx(0, abs=1e-15)
    assert (
        gap(Capsule([-1, 0, 0], [1, 0, 0], 0), Capsule([0, -1, 0], [0, 1, 0], 0)) == 0
    )
    assert gap(ConvexHull(square[:2]), ConvexHull(square[::2])) == pytest.approx(
        0, abs=1e-15
    )


def test_two_hulls_of_the_opengjk_example():
    """3.653650 apart, as its documentation says; the second is the first seen in a mirror at the origin."""
    first = np.array([
        [0.0, 5.5, 0.0], [2.3, 1.0, -2.0], [8.1, 4.0, 2.4], [4.3, 5.0, 2.2], [2.5, 1.0, 2.3],
        [7.1, 1.0, 2.4], [1.0, 1.5, 0.3], [3.3, 0.5, 0.3], [6.0, 1.4, 0.2],
    ])  # fmt: skip
    assert gap(ConvexHull(first), ConvexHull(-first)) == pytest.approx(
        3.653650, abs=5e-7
    )


def test_two_public_reports_of_boxes_that_broke_a_library():
    """FCL issues 493 (touching to 1.1e-16, normal the second column) and 399 (overlapping by 3.381e-5)."""
    turn = np.array([
        [0.96193976625564348026, 0.15401279915737359216, 0.22572537250328919556],
        [-0.19134171618254486313, 0.96936494951283913579, 0.15401279915737359216],
        [-0.19509032201612822033, -0.19134171618254486313, 0.96193976625564348026],
    ])  # fmt: skip
    way = [0.0770063995786869349, 0.48468247475641951239, -0.0956708580912724038]
    near = nearest_points(OBB(way, turn, [0.25] * 3), OBB([0, 0, 0], turn, [0.25] * 3))
    assert abs(near.gap) <= 4e-16
    np.testing.assert_allclose(near.normal, turn[:, 1], atol=1e-9)

    def about_z(x, y):
        return np.array([[*x, 0], [*y, 0], [0, 0, 1]])

    first = OBB(
        [0.29526406526565551758, -0.013230856508016586304, 0],
        about_z((-0.099432387353076273628, 0.99504432079443971837),
                (-0.99504432079443971837, -0.099432387353076273628)),
        np.array([0.23768037557601928711, 0.15702305734157562256, 0.25]) / 2,
    )  # fmt: skip
    second = OBB(
        [0.22759585694545214629, 0.14974093549228112421, 0],
        about_z((0.99506598442099225554, 0.099215354901756730444),
                (-0.099215354901756730444, 0.99506598442099225554)),
        np.array([0.010000000000000000208, 0.78165709972381591797, 0.25]) / 2,
    )  # fmt: skip
    near = nearest_points(first, second)
    assert near.gap == pytest.approx(-3.3810644e-5, abs=5e-13) and overlaps(
        first, second
    )
    np.testing.assert_allclose(near.normal, [0.995066, -0.0992154, 0], atol=1e-6)


def lattice():
    """Shapes whose corners and radii are whole or half: they touch, line up and degenerate all the time."""
    spot = st.tuples(*[st.integers(-2, 2)] * 3).map(lambda x: np.array(x, dtype=float))
    radius = st.sampled_from([0.0, 0.5, 1.0])
    turn = st.sampled_from([np.eye(3), np.eye(3)[[1, 2, 0]], turns(np.random.default_rng(7), 1)[0]])  # fmt: skip
    half = st.tuples(*[st.sampled_from([0.0, 0.5, 1.0])] * 3).map(np.array)
    return st.one_of(
        st.builds(Sphere, spot, radius),
        st.builds(Capsule, spot, spot, radius),
        st.builds(lambda x, y: AABB(np.minimum(x, y), np.maximum(x, y)), spot, spot),
        st.builds(OBB, spot, turn, half),
        st.builds(ConvexHull, st.lists(spot, min_size=1, max_size=8).map(np.array)),
    )


def check_pair(a, b):
    """What must hold for every pair, touching or degenerate."""
    d, near, found = gap(a, b), nearest_points(a, b), contacts(a, b)
    assert d == pytest.approx(true_gap(a, b), abs=1e-7)
    assert d == pytest.approx(gap(b, a), abs=1e-12)
    if abs(d) > 1e-12:
        assert overlaps(a, b) == overlaps(b, a) == (d <= 0)
        assert (len(found) > 0) == (d <= 0)
    assert np.linalg.norm(near.normal) == pytest.approx(1, abs=1e-12)
    np.testing.assert_allclose(near.point_a - near.point_b, d * near.normal, atol=1e-9)
    moved = a.moved(np.eye(3), -d * near.normal)
    assert gap(moved, b) == pytest.approx(0, abs=1e-9)
    if len(found):
        assert found.separation.min() == pytest.approx(d, abs=1e-9)


@given(a=lattice(), b=lattice())
@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
def test_shapes_on_a_lattice(a, b):
    check_pair(a, b)


@pytest.mark.long
@given(a=lattice(), b=lattice())
@settings(
    max_examples=drawn_of(5000, 300),
    deadline=None,
    suppress_health_check=list(HealthCheck),
)
def test_many_shapes_on_a_lattice(a, b):
    check_pair(a, b)
