"""The questions asked of any two shapes: batches, order, errors, and what must hold for every pair of kinds."""

import itertools

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from overlap.drawn_shapes import DRAW, depth_inside, turns

from course.overlap import contacts, gap, overlaps
from course.overlap.asking import nearest_points
from course.overlap.pairs import KINDS, TABLE
from course.shapes import AABB, OBB, Capsule, Compound, ConvexHull, HalfSpace, Sphere

ALL = [*KINDS, "compound"]
EVERY = list(itertools.product(ALL, ALL))
every_pair = pytest.mark.parametrize("kind_a, kind_b", EVERY)
#: What a pair of order 1 may be off by: 1e-9 of the size is asked for.
EXACT = 1e-10


def drawn_pair(kind_a, kind_b, count=24, seed=0, spread=0.9):
    rng = np.random.default_rng([seed, ALL.index(kind_a), ALL.index(kind_b)])
    a, b = DRAW[kind_a](rng, count, spread), DRAW[kind_b](rng, count, spread)
    if kind_a == kind_b == "half_space":  # two thirds face each other
        normal = np.where(np.arange(count)[:, None] % 3, -b.normal, a.normal)
        a = HalfSpace(normal, a.offset)
    return a, b


def test_every_pair_of_kinds_has_a_row():
    assert set(TABLE) == set(itertools.combinations_with_replacement(KINDS, 2))


@every_pair
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
    words = {"face_a": "face_b", "face_b": "face_a"}
    assert sorted(words.get(w, w) for w in one.feature) == sorted(other.feature)


def in_order(found, side):
    """Points, normals and separations, in an order that does not depend on which body is A."""
    rows = np.column_stack([found.pair, found.point, side * found.normal, found.separation])
    return rows[np.lexsort(np.round(rows[:, :4], 6).T[::-1])]


@every_pair
def test_moving_both_moves_the_answer(kind_a, kind_b):
    a, b = drawn_pair(kind_a, kind_b)
    d, found = gap(a, b), contacts(a, b, margin=0.1)
    rng = np.random.default_rng(3)
    turn, shift = turns(rng, 1)[0], rng.normal(0, 5, 3)
    moved = a.moved(turn, shift), b.moved(turn, shift)
    np.testing.assert_allclose(gap(*moved), d, atol=EXACT)
    again = contacts(*moved, margin=0.1)
    assert sorted(again.pair) == sorted(found.pair)
    whole = lambda c: np.array([c.separation[c.pair == i].sum() for i in np.unique(c.pair)])  # noqa: E731
    np.testing.assert_allclose(whole(again), whole(found), atol=1e-7)


@every_pair
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


@every_pair
def test_batches_broadcast(kind_a, kind_b):
    a, b = drawn_pair(kind_a, kind_b, count=3)
    crossed = gap(a[:, None], b)
    assert crossed.shape == (3, 3) and overlaps(a[:, None], b).shape == (3, 3)
    np.testing.assert_allclose(np.diagonal(crossed), gap(a, b), atol=1e-12)
    assert crossed[1, 2] == pytest.approx(gap(a[1], b[2]), abs=1e-12)
    assert np.ndim(gap(a[1], b[2])) == 0
    found = contacts(a[:, None], b, margin=50.0, body_a=[[5], [6], [7]], body_b=[1, 2, 3])
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
        with pytest.raises(ValueError, match="^b: expected a batch that broadcasts with a"):
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
    slabs = Compound((AABB(wide[0] + [0, 0, 0], wide[1] + [2, 0, 0]), AABB(wide[0] + [1, 0, 0], wide[1] + [3, 0, 0])))  # fmt: skip
    probe = AABB([1.2, -0.1, -0.1], [1.8, 0.1, 0.1])
    assert gap(probe, slabs) == pytest.approx(-0.8)
    assert gap(slabs, probe.moved(np.eye(3), [5, 0, 0])) == pytest.approx(3.2)


def test_parts_of_compounds_are_told_in_the_keys():
    """A dumbbell and a ball, each in contact with both parts of another: all keys differ."""
    bell = Compound((Sphere([0, 0, 0], 1.0), Sphere([4, 0, 0], 1.0), Sphere([50, 0, 0], 1.0)))
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
    same = {"rotation", "normal", "directions", "forms"}
    names = [n for n in shape.core_axes if n != "forms"]
    return type(shape)(*((1 if n in same else s) * getattr(shape, n) for n in names))


CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))


@pytest.mark.parametrize("angle", [0.0, *10.0 ** np.arange(-16.0, -5.0)])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_touching_faces_and_edges_turned_by_next_to_nothing(angle, axis):
    """A unit cube on another, on its side, on an edge: the gap is 0 but for angle and rounding."""
    c, s = np.cos(angle), np.sin(angle)
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
                assert found.separation.min() == pytest.approx(d, abs=1e-12)


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
        for a, b in itertools.product(shapes, shapes):
            moved = b.moved(np.eye(3), shift)
            d = gap(a, moved)
            assert np.isfinite(d) and d == pytest.approx(gap(moved, a), rel=1e-9, abs=1e-7)
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
    assert gap(Capsule([-1, 0, 0], [1, 0, 0], 0), Capsule([0, -1, 0], [0, 1, 0], 0)) == 0
    assert gap(ConvexHull(square[:2]), ConvexHull(square[::2])) == pytest.approx(0, abs=1e-15)
