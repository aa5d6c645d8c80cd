"""Support, bounds, moved and volume of every kind, against points drawn on the solids and closed forms."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from shapes.drawn_shapes import CONVEX, drawn, rotations, unit

from course.shapes import (
    AABB,
    KDOP,
    OBB,
    Capsule,
    Compound,
    ConvexHull,
    HalfSpace,
    Shape,
    Sphere,
    polytopes,
)

KINDS = (*CONVEX, "compound", "half_space")
BOUNDED = (*CONVEX, "compound")
each = pytest.mark.parametrize("kind", KINDS)
bounded = pytest.mark.parametrize("kind", BOUNDED)
AXES = np.concatenate([np.eye(3), -np.eye(3)])


def points_in(shape, rng, count=400):
    """Points of one solid, many of them on its surface: not made from support."""
    if isinstance(shape, Compound):
        return np.concatenate([points_in(part, rng, count) for part in shape.parts])
    ball = unit(rng.normal(size=(count, 3)))
    if isinstance(shape, Sphere):
        return shape.center + shape.radius * ball
    if isinstance(shape, Capsule):
        along = rng.choice([0, 1, 0.5], size=(count, 1))
        return shape.start + along * (shape.end - shape.start) + shape.radius * ball
    if isinstance(shape, AABB | OBB):
        turn = np.eye(3) if isinstance(shape, AABB) else shape.rotation
        local = rng.choice([-1, 1, 0.3], size=(count, 3)) * shape.half_extents
        return shape.center + local @ turn.T
    if isinstance(shape, ConvexHull):
        weights = rng.dirichlet(np.full(len(shape.vertices), 0.1), size=count)
        return np.concatenate([weights @ shape.vertices, shape.vertices])
    box = shape.bounds()
    points = rng.uniform(box.lower, box.upper, size=(20 * count, 3))
    return points[holds(shape, points)]


def holds(shape, points):
    """Which points (n, 3) lie in one solid, from its definition."""
    if isinstance(shape, Sphere):
        return np.linalg.norm(points - shape.center, axis=1) <= shape.radius
    if isinstance(shape, Capsule):
        axis = shape.end - shape.start
        along = np.clip((points - shape.start) @ axis / (axis @ axis), 0, 1)
        near = shape.start + along[:, None] * axis
        return np.linalg.norm(points - near, axis=1) <= shape.radius
    if isinstance(shape, AABB):
        return ((shape.lower <= points) & (points <= shape.upper)).all(axis=1)
    if isinstance(shape, OBB):
        local = (points - shape.center) @ shape.rotation
        return (np.abs(local) <= shape.half_extents).all(axis=1)
    if isinstance(shape, KDOP):
        along = points @ shape.directions.T
        return ((shape.lower <= along) & (along <= shape.upper)).all(axis=1)
    from scipy.spatial import Delaunay

    return Delaunay(shape.vertices).find_simplex(points) >= 0


def same(one, other, atol=1e-13):
    """Two batches hold the same shapes: kind, batch and arrays."""
    assert type(one) is type(other) and one.batch == other.batch
    if isinstance(one, Compound):
        for a, b in zip(one.parts, other.parts, strict=True):
            same(a, b, atol)
    for name in one.core_axes:
        if name != "forms":
            np.testing.assert_allclose(
                getattr(one, name), getattr(other, name), atol=atol, err_msg=name
            )


@bounded
def test_support_is_the_most_over_points_of_the_solid(kind):
    rng = np.random.default_rng(11)
    shapes, u = drawn(kind, rng, 3), rng.normal(size=(3, 3))
    support = shapes.support(u)
    assert support.shape == (3, 3)
    for i in range(3):
        along = points_in(shapes[i], rng) @ u[i]
        assert along.max() <= support[i] @ u[i] + 1e-12
        assert along.max() > support[i] @ u[i] - 0.5
        box = shapes[i].bounds()
        assert (box.lower - 1e-12 <= support[i]).all()
        assert (support[i] <= box.upper + 1e-12).all()


@pytest.mark.parametrize("kind", CONVEX)
def test_support_lies_in_the_solid(kind):
    rng = np.random.default_rng(12)
    shape = drawn(kind, rng)
    support = shape.support(rng.normal(size=(50, 3)))
    middle = points_in(shape, rng).mean(axis=0)
    assert holds(shape, middle + (1 - 1e-9) * (support - middle)).all()


@bounded
def test_bounds_are_the_supports_along_the_axes(kind):
    rng = np.random.default_rng(13)
    shapes = drawn(kind, rng, 5).moved(rotations(rng, 5), rng.normal(size=(5, 3)))
    box = shapes.bounds()
    assert isinstance(box, AABB) and box.batch == (5,)
    for axis in range(3):
        up = shapes.support(np.eye(3)[axis])[:, axis]
        down = shapes.support(-np.eye(3)[axis])[:, axis]
        np.testing.assert_allclose(box.upper[:, axis], up, atol=1e-13)
        np.testing.assert_allclose(box.lower[:, axis], down, atol=1e-13)


@each
def test_moved_then_asked_is_asked_then_moved(kind):
    """The support of R S + t along R u is R s(u) + t; kinds and volumes stay."""
    rng = np.random.default_rng(14)
    shapes, turn, shift = (
        drawn(kind, rng, 4),
        rotations(rng, 4),
        rng.normal(size=(4, 3)),
    )
    moved = shapes.moved(turn, shift)
    assert moved.kind == {"aabb": "obb"}.get(kind, kind)
    np.testing.assert_allclose(moved.volume(), shapes.volume(), rtol=1e-12)
    if kind == "half_space":
        return
    u = rng.normal(size=(4, 3))
    here = np.einsum("bij,bj->bi", turn, shapes.support(u)) + shift
    there = moved.support(np.einsum("bij,bj->bi", turn, u))
    np.testing.assert_allclose(there, here, atol=1e-12)


@each
def test_two_moves_are_one(kind):
    rng = np.random.default_rng(15)
    shapes = drawn(kind, rng, 2)
    (q, r), (s, t) = rotations(rng, 2), rng.normal(size=(2, 3))
    shapes = shapes.moved(np.eye(3), np.zeros(3))
    same(shapes.moved(r, t).moved(q, s), shapes.moved(q @ r, q @ t + s), atol=1e-12)


@each
def test_a_batch_is_its_shapes_one_by_one(kind):
    """Batches broadcast with the direction and the pose, and are indexed as arrays are."""
    rng = np.random.default_rng(16)
    shapes = drawn(kind, rng, 2, 3)
    assert shapes.batch == (2, 3) and shapes.count == 6
    turn, shift = rotations(rng, 5, 1, 1), rng.normal(size=(3, 3))
    moved = shapes.moved(turn, shift)
    assert moved.batch == (5, 2, 3)
    for i, j in np.ndindex(2, 3):
        same(moved[4, i, j], shapes[i, j].moved(turn[4, 0, 0], shift[j]))
        np.testing.assert_array_equal(shapes.volume()[i, j], shapes[i, j].volume())
        same(shapes.bounds()[i, j], shapes[i, j].bounds())
    one = drawn(kind, rng)
    assert one.batch == () and np.shape(one.volume()) == ()
    assert one.moved(turn, shift).batch == (5, 1, 3)
    if kind != "half_space":
        u = rng.normal(size=(4, 1, 1, 3))
        support = shapes.support(u)
        assert support.shape == (4, 2, 3, 3)
        for k, i, j in np.ndindex(4, 2, 3):
            np.testing.assert_allclose(
                support[k, i, j], shapes[i, j].support(u[k, 0, 0])
            )


@each
@pytest.mark.parametrize(
    "index",
    [1, -1, (1, 2), np.s_[:, 1], np.s_[..., 0], np.s_[None, 1], np.s_[::-1, 1:],
     [1, 0, 1], ([0, 1], [2, 0]), np.array([True, False]), ...],
    ids=str,
)  # fmt: skip
def test_indexing_selects_as_numpy_would(kind, index):
    rng = np.random.default_rng(17)
    shapes = drawn(kind, rng, 2, 3)
    order = np.arange(6).reshape(2, 3)[index]
    flat, picked = shapes.reshaped(6), shapes[index]
    assert picked.batch == order.shape
    for where in np.ndindex(order.shape):
        same(picked[where], flat[int(order[where])])


@each
def test_an_index_too_many_is_an_error(kind):
    with pytest.raises(IndexError):
        drawn(kind, np.random.default_rng(18), 2)[0, 0]


@each
def test_joined_spread_and_reshaped(kind):
    rng = np.random.default_rng(19)
    one, other = drawn(kind, rng, 2), drawn(kind, rng, 3)
    if kind == "kdop":
        other = other.moved(np.eye(3), [1.0, 2, 3])
    joined = type(one).concatenate([one, other])
    assert joined.batch == (5,)
    same(joined[:2], one)
    same(joined[2:], other)
    spread = other.broadcast_to((2, 3))
    same(spread[1], other)
    same(spread.reshaped(3, 2)[1, 0], other[2])
    with pytest.raises(
        ValueError, match=f"{kind}: expected a batch that broadcasts to"
    ):
        other.broadcast_to((2,))
    with pytest.raises(ValueError, match=r"parts\[1\]: expected shapes with one batch"):
        type(one).concatenate([one, one[0]])
    with pytest.raises(ValueError, match="parts: expected at least one"):
        type(one).concatenate([])
    with pytest.raises(ValueError, match=r"parts\[0\]"):
        type(one).concatenate([3])


@each
def test_nobody_can_write_to_a_shape_or_through_it(kind):
    rng = np.random.default_rng(20)
    shapes = drawn(kind, rng, 2)
    for some in (
        shapes,
        shapes[:1],
        shapes.moved(np.eye(3), np.zeros(3)),
        shapes.bounds(),
    ):
        for part in getattr(some, "parts", (some,)):
            for name in part.core_axes:
                with pytest.raises(ValueError, match="read-only"):
                    getattr(part, name)[...] = 0
    turn, shift = np.eye(3), np.zeros(3)
    moved = shapes.moved(turn, shift)
    turn[0, 0], shift[0] = 5, 5
    same(moved, shapes.moved(np.eye(3), np.zeros(3)))


def test_what_is_given_may_change_afterwards():
    center = np.zeros(3)
    sphere = Sphere(center, 1)
    center[0] = 7
    assert sphere.center[0] == 0


@pytest.mark.parametrize("kind", ["sphere", "capsule", "obb", "aabb"])
def test_empty_batches(kind):
    shapes = drawn(kind, np.random.default_rng(21), 3)[:0]
    assert shapes.volume().shape == (0,) and shapes.bounds().batch == (0,)
    assert shapes.support([1.0, 0, 0]).shape == (0, 3)
    assert shapes.moved(np.eye(3), np.zeros(3)).batch == (0,)
    assert len(polytopes(shapes)) == 0


@pytest.mark.parametrize("kind", ["kdop", "convex_hull", "compound"])
def test_empty_batches_of_solids_with_corners(kind):
    shapes = drawn(kind, np.random.default_rng(22), 3)[:0]
    assert shapes.volume().shape == (0,) and shapes.bounds().batch == (0,)
    assert shapes.support([1.0, 0, 0]).shape == (0, 3)
    assert shapes.moved(np.eye(3), np.zeros(3)).batch == (0,)


@pytest.mark.parametrize("kind", CONVEX)
def test_volume_against_drawn_points(kind):
    """The share of the bounding box's points that lie inside, within 5 standard errors."""
    rng = np.random.default_rng(23)
    for shape in (drawn(kind, rng, 2)[i] for i in range(2)):
        box = shape.bounds()
        inside = holds(shape, rng.uniform(box.lower, box.upper, (40_000, 3)))
        share = inside.mean()
        error = np.sqrt(share * (1 - share) / inside.size) * box.volume()
        assert abs(share * box.volume() - shape.volume()) <= 5 * error + 1e-12


def test_known_volumes():
    assert Sphere([1, 2, 3], 3).volume() == pytest.approx(36 * np.pi)
    assert Capsule([0, 0, 0], [0, 0, 2], 1).volume() == pytest.approx(10 / 3 * np.pi)
    assert AABB([0, 0, 0], [1, 2, 3]).volume() == 6
    assert OBB([0, 0, 0], np.eye(3), [1, 2, 3]).volume() == 48
    octahedron = ConvexHull(AXES)
    assert octahedron.volume() == pytest.approx(4 / 3)
    diagonal = np.array([[1, 1, 1], [1, 1, -1], [1, -1, 1], [1, -1, -1]]) / 3**0.5
    # The truncated octahedron of edge sqrt(1/2): 8 sqrt(2) edge^3.
    d = np.concatenate([np.eye(3), diagonal])
    upper = np.array([1, 1, 1, *[1.5 / 3**0.5] * 4])
    assert KDOP(d, -upper, upper).volume() == pytest.approx(8 * 2**0.5 * 0.5**1.5)
    two = Compound((Sphere([0, 0, 0], 1), AABB([5, 5, 5], [6, 7, 8])))
    assert two.volume() == pytest.approx(4 / 3 * np.pi + 6)
    assert HalfSpace([0, 0, 1], 0).volume() == np.inf


@pytest.mark.parametrize(
    "points",
    [[[1, 2, 3]], [[0, 0, 0], [1, 1, 1]], [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]],
    ids=["point", "segment", "square"],
)
def test_flat_hulls_have_volume_0_support_and_bounds(points):
    rng = np.random.default_rng(24)
    hull = ConvexHull(np.array(points, float)).moved(rotations(rng, 6), [7.0, 8, 9])
    assert (hull.volume() == 0).all()
    u = rng.normal(size=(6, 3))
    along = np.einsum("bnj,bj->bn", hull.vertices, u).max(axis=1)
    np.testing.assert_allclose(np.sum(hull.support(u) * u, axis=1), along, atol=1e-12)
    np.testing.assert_array_equal(hull.bounds().upper, hull.vertices.max(axis=1))


@pytest.mark.parametrize("kind", CONVEX)
def test_far_from_the_origin_only_the_input_rounds(kind):
    """At 1e8 a coordinate is rounded by 7e-9; nothing may be much larger than that."""
    rng = np.random.default_rng(25)
    near = drawn(kind, rng, 4)
    away = np.array([1e8, -1e8, 1e8])
    far, u = near.moved(np.eye(3), away), rng.normal(size=(4, 3))
    slack = 1e-9 + 32 * np.finfo(float).eps * 1e8
    np.testing.assert_allclose(far.support(u) - away, near.support(u), atol=slack)
    np.testing.assert_allclose(
        far.bounds().lower - away, near.bounds().lower, atol=slack
    )
    np.testing.assert_allclose(far.volume(), near.volume(), atol=50 * slack)


def test_half_space_moves_with_its_points():
    rng = np.random.default_rng(26)
    wall, turn, shift = drawn("half_space", rng, 3), rotations(rng, 3), np.ones(3)
    on = wall.normal * wall.offset[:, None] + np.cross(wall.normal, [1.0, 2, 3])
    moved = wall.moved(turn, shift)
    there = np.einsum("bij,bj->bi", turn, on) + shift
    np.testing.assert_allclose(np.sum(moved.normal * there, axis=1), moved.offset)
    box = moved.bounds()
    assert (box.lower == -np.inf).all() and (box.upper == np.inf).all()
    assert (box.volume() == np.inf).all() and not box.is_finite
    with pytest.raises(ValueError, match="half_space: expected a bounded shape"):
        wall.support([0, 0, 1])


def test_endless_boxes_have_no_support_and_do_not_turn():
    box = HalfSpace([0, 0, 1], 0).bounds()
    for ask in (
        lambda: box.support([1, 0, 0]),
        lambda: box.moved(np.eye(3), np.zeros(3)),
        lambda: polytopes(box),
        lambda: Compound((box,)),
    ):
        with pytest.raises(ValueError, match="aabb: expected finite boxes"):
            ask()
    assert AABB([0, -np.inf, 0], [0, np.inf, 1]).volume() == 0


UNIT, ORIGIN = np.eye(3), np.zeros(3)
UNLIKE_KDOPS = (
    KDOP(UNIT, [[0] * 3], [[1] * 3]),
    drawn("kdop", np.random.default_rng(1), 1),
)
UNLIKE_COMPOUNDS = (
    Compound((Sphere([ORIGIN], 1),)),
    Compound((AABB([ORIGIN], [ORIGIN]),)),
)


@pytest.mark.parametrize(
    "make, said",
    [
        (lambda: Sphere([0, 0], 1), "center: expected vectors of shape"),
        (lambda: Sphere(ORIGIN, -1), "radius: expected numbers at or above 0; got -1"),
        (lambda: Sphere([0, np.nan, 0], 1), "center: expected finite"),
        (lambda: Sphere(np.zeros((2, 3)), [1, 2, 3]), "radius: expected a batch that"),
        (lambda: Sphere(ORIGIN, "one"), "radius: expected numbers"),
        (lambda: Capsule(ORIGIN, ORIGIN, [-1]), "radius"),
        (lambda: Capsule(ORIGIN, [np.inf, 0, 0], 1), "end: expected finite"),
        (lambda: AABB([0, 1, 0], [1, 0, 1]), r"lower: .*below upper; got 1.0 above upper 0.0 in entry 1"),
        (lambda: AABB([np.inf] * 3, [np.inf] * 3), "lower: expected finite numbers or -inf"),
        (lambda: AABB([-np.inf] * 3, [-np.inf] * 3), "upper: expected finite numbers or inf"),
        (lambda: AABB([np.nan] * 3, UNIT[0]), "lower"),
        (lambda: OBB(ORIGIN, 2 * UNIT, [1, 1, 1]), "rotation: .*orthonormal"),
        (lambda: OBB(ORIGIN, UNIT[::-1], [1, 1, 1]), "rotation: .*determinant"),
        (lambda: OBB(ORIGIN, UNIT, [1, -1, 1]), "half_extents: .*got -1.0 in entry 1"),
        (lambda: KDOP(UNIT[:2], [0, 0], [1, 1]), "directions: expected at least 3"),
        (lambda: KDOP(UNIT[[0, 1, 0]], [0] * 3, [1] * 3), "directions that span space"),
        (lambda: KDOP(2 * UNIT, [0] * 3, [1] * 3), "directions: expected unit vectors"),
        (lambda: KDOP(UNIT, [0, 0], [1] * 3), r"lower: expected one number a direction"),
        (lambda: KDOP(UNIT, [0, 2, 0], [1] * 3), "lower: .*got 2.0 above upper 1.0"),
        (lambda: ConvexHull(np.zeros(3)), "vertices: expected at least 1 vertex"),
        (lambda: ConvexHull(np.zeros((0, 3))), "vertices: expected at least 1 vertex"),
        (lambda: ConvexHull([[0, 0, np.inf]]), "vertices: expected finite"),
        (lambda: Compound(()), "parts: expected at least one"),
        (lambda: Compound(Sphere(ORIGIN, 1)), "parts: expected a tuple"),
        (lambda: Compound((Sphere(ORIGIN, 1), HalfSpace(UNIT[0], 0))), r"parts\[1\]: .*half_space"),
        (lambda: Compound((Compound((Sphere(ORIGIN, 1),)),)), r"parts\[0\]: .*compound"),
        (lambda: Compound((ORIGIN,)), r"parts\[0\]: .*ndarray"),
        (lambda: Compound((Sphere(np.zeros((2, 3)), 1), Sphere(np.zeros((3, 3)), 1))), r"parts\[1\]: expected a batch"),
        (lambda: HalfSpace([0, 0, 2], 0), "normal: expected unit vectors"),
        (lambda: HalfSpace([0, 0, 1], np.inf), "offset: expected finite"),
        (lambda: Sphere(ORIGIN, 1).support(ORIGIN), "direction: expected vectors that are not zero"),
        (lambda: Sphere(ORIGIN, 1).support([1, 0]), "direction: expected vectors of shape"),
        (lambda: Sphere(np.zeros((2, 3)), 1).support(np.ones((3, 3))), "direction: expected a batch"),
        (lambda: Sphere(ORIGIN, 1).moved(2 * UNIT, ORIGIN), "rotation"),
        (lambda: Sphere(ORIGIN, 1).moved(UNIT, [0, 0]), "translation"),
        (lambda: Sphere(np.zeros((2, 3)), 1).moved(UNIT, np.zeros((3, 3))), "translation: expected a batch"),
        (lambda: KDOP.concatenate(UNLIKE_KDOPS), r"parts\[1\]: expected 3 directions"),
        (lambda: Compound.concatenate(UNLIKE_COMPOUNDS), r"parts\[1\]: expected a compound of sphere"),
    ],
)  # fmt: skip
def test_a_wrong_argument_is_named(make, said):
    with pytest.raises(ValueError, match=said):
        make()


# Properties for whatever numbers come.

numbers = st.floats(-1e3, 1e3).map(lambda x: round(x, 3))
points = arrays(float, st.tuples(st.integers(1, 12), st.just(3)), elements=numbers)
vectors = arrays(float, 3, elements=numbers)
nonzero = vectors.filter(np.any)


@given(points, nonzero)
@settings(max_examples=30, deadline=None)
def test_any_points_have_a_hull(vertices, u):
    """Whatever the points span: the hull's corners are among them and carry every support."""
    hull = ConvexHull(vertices)
    solids = polytopes(hull)
    size = np.abs(vertices).max() + 1e-12
    along = vertices @ u / np.abs(u).max()
    kept = solids.vertices @ u / np.abs(u).max()
    assert along.max() == pytest.approx(kept.max(), abs=1e-9 * size)
    assert hull.support(u) @ u / np.abs(u).max() == pytest.approx(
        along.max(), abs=1e-9 * size
    )
    height = vertices @ solids.normals.T - solids.offsets
    assert (height <= 1e-9 * size).all()
    assert 0 <= hull.volume() <= hull.bounds().volume() * (1 + 1e-12)


@given(vectors, vectors, st.floats(0, 100), nonzero)
@settings(max_examples=30, deadline=None)
def test_a_capsule_is_the_hull_of_its_end_spheres(start, end, radius, u):
    capsule = Capsule(start, end, radius)
    ends = [Sphere(p, radius).support(u) @ u for p in (start, end)]
    assert capsule.support(u) @ u == pytest.approx(max(ends), rel=1e-12, abs=1e-9)


def test_every_kind_is_a_shape_with_its_own_name():
    found = {drawn(kind, np.random.default_rng(27), 1).kind for kind in KINDS}
    assert found == set(KINDS)
    assert issubclass(AABB, Shape)
