"""Drawn pairs of each two kinds against python-fcl and coal; of the whole campaign 100,000.

Neither peer is the truth. Where one differs from the library, and on a sample of all pairs,
the slow ways of ``overlap.drawn_shapes`` decide: all separating axes where the cores
overlap, else a bounded least-squares solve. The library has to be there to ``EXACT`` every
time. What the peers were off by, and why, stands beside each test.
"""

import itertools

import numpy as np
import pytest
from campaigns import drawn_of
from overlap.drawn_shapes import DRAW, true_gap

from course.overlap import gap, overlaps
from course.shapes import OBB, Capsule, ConvexHull, HalfSpace, Sphere

pytestmark = [pytest.mark.peers, pytest.mark.long]

COUNT = drawn_of(100_000, 4_000)
#: Pairs of which a peer may be off: one in 10,000, and of few a couple.
MOST_OFF = 2 + 1e-4 * COUNT
#: How many pairs of each two kinds are looked at in the slow way, of all and of those that differ.
SAMPLE = 150
#: What the library has to reach, in sizes of order 1.
EXACT = 1e-9
FCL_KINDS = ("sphere", "capsule", "obb")
COAL_KINDS = ("sphere", "capsule", "obb", "convex_hull", "half_space")


def drawn(kind_a, kind_b):
    """Pairs of which a half overlaps."""
    rng = np.random.default_rng([COAL_KINDS.index(kind_a), COAL_KINDS.index(kind_b)])
    return DRAW[kind_a](rng, COUNT, 0.8), DRAW[kind_b](rng, COUNT, 0.8)


def turned_to(way):
    """Rotations whose third column is along the way, (n, 3, 3): both peers' capsules stand upright."""
    z = way / np.linalg.norm(way, axis=1, keepdims=True)
    x = np.cross(z, np.eye(3)[np.argmin(np.abs(z), axis=1)])
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    return np.stack([x, np.cross(z, x), z], axis=-1)


def poses(shape):
    """Rotations (n, 3, 3) and places (n, 3) of the shapes as a peer has them."""
    n = shape.count
    upright = np.broadcast_to(np.eye(3), (n, 3, 3))
    if isinstance(shape, Sphere):
        return upright, shape.center
    if isinstance(shape, Capsule):
        return turned_to(shape.end - shape.start), 0.5 * (shape.start + shape.end)
    if isinstance(shape, OBB):
        return shape.rotation, shape.center
    return upright, np.zeros((n, 3))


def sizes(shape):
    """What a peer's constructor takes, shape by shape."""
    if isinstance(shape, Sphere):
        return [(r,) for r in shape.radius.tolist()]
    if isinstance(shape, Capsule):
        length = np.linalg.norm(shape.end - shape.start, axis=1)
        return list(zip(shape.radius.tolist(), length.tolist(), strict=True))
    if isinstance(shape, OBB):
        return (2 * shape.half_extents).tolist()
    if isinstance(shape, HalfSpace):
        return list(zip(shape.normal, shape.offset.tolist(), strict=True))
    return [(points,) for points in shape.vertices]


def coal_gaps(a, b):
    import coal

    def hull(points):
        corners = coal.StdVec_Vec3s()
        for point in points:
            corners.append(point)
        return coal.Convex.convexHull(corners, True, "")

    make = {Sphere: coal.Sphere, Capsule: coal.Capsule, OBB: coal.Box,
            ConvexHull: hull, HalfSpace: coal.Halfspace}  # fmt: skip
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    request.gjk_tolerance = request.epa_tolerance = 1e-8
    request.gjk_max_iterations = request.epa_max_iterations = 512
    found, sides = np.empty(a.count), []
    for shape in (a, b):
        solids = [make[type(shape)](*size) for size in sizes(shape)]
        places = [coal.Transform3s(r, t) for r, t in zip(*poses(shape), strict=True)]
        sides += [solids, places]
    for i, (first, at, second, there) in enumerate(zip(*sides, strict=True)):
        result.clear()
        found[i] = coal.distance(first, at, second, there, request, result)
    return found


def fcl_gaps(a, b):
    import fcl

    make = {Sphere: fcl.Sphere, Capsule: fcl.Capsule, OBB: fcl.Box}
    found, sides = np.empty(a.count), []
    for shape in (a, b):
        solids = [make[type(shape)](*size) for size in sizes(shape)]
        places = [fcl.Transform(r, t) for r, t in zip(*poses(shape), strict=True)]
        sides.append(
            [fcl.CollisionObject(*x) for x in zip(solids, places, strict=True)]
        )
    request = fcl.DistanceRequest(enable_signed_distance=True)
    for i, (first, second) in enumerate(zip(*sides, strict=True)):
        found[i] = fcl.distance(first, second, request, fcl.DistanceResult())
    return found


def judged(a, b, mine, theirs, close):
    """Rows where a peer is not close; the library is right in all of these that are looked at, and in a sample."""
    off = np.flatnonzero(~(np.abs(mine - theirs) <= close))
    rng = np.random.default_rng(1)
    some = rng.choice(a.count, SAMPLE, replace=False)
    disputed = off[np.argsort(-np.abs(mine - theirs)[off])][:SAMPLE]  # the worst
    for i in (*some, *disputed):
        assert mine[i] == pytest.approx(true_gap(a[i], b[i]), abs=EXACT)
    return off


@pytest.mark.parametrize(
    "kind_a, kind_b", list(itertools.combinations_with_replacement(COAL_KINDS, 2))[:-1]
)
def test_against_coal(kind_a, kind_b):
    """With its tolerances at 1e-8 coal is as exact as the library, in distance and in depth."""
    pytest.importorskip("coal")
    a, b = drawn(kind_a, kind_b)
    mine = gap(a, b)
    assert 0.1 < np.mean(mine <= 0) < 0.99
    np.testing.assert_array_equal(overlaps(a, b), mine <= 0)
    off = judged(a, b, mine, coal_gaps(a, b), close=1e-7)
    assert off.size <= MOST_OFF


@pytest.mark.parametrize(
    "kind_a, kind_b", list(itertools.combinations_with_replacement(FCL_KINDS, 2))
)
def test_against_python_fcl(kind_a, kind_b):
    """Two boxes agree. Of a round shape FCL asks libccd, whose GJK on the curved surface itself ends
    when its steps are small: where they are apart it says up to 6e-4 too much, a few times in
    100,000 up to 5 percent."""
    pytest.importorskip("fcl")
    a, b = drawn(kind_a, kind_b)
    mine, theirs = gap(a, b), fcl_gaps(a, b)
    off = judged(a, b, mine, theirs, close=1e-6)
    assert np.sum((theirs > 0) != (mine > 0)) <= MOST_OFF
    if kind_a == kind_b == "obb":
        assert off.size <= MOST_OFF
    assert np.mean(np.abs(theirs - mine) > 1e-3) <= 1e-3


def test_depths_of_python_fcl_s_contacts():
    """A fifth of the depths that its collision test gives for two boxes is up to 5 percent too large.

    That test is ODE's, which takes a face for the direction unless the product of two edges
    is better by a factor of 1.05; the least translation is no larger.
    """
    fcl = pytest.importorskip("fcl")
    rng = np.random.default_rng(0)
    a, b = DRAW["obb"](rng, 3000, 0.8), DRAW["obb"](rng, 3000, 0.8)
    mine, sides = gap(a, b), []
    for shape in (a, b):
        solids = [fcl.Box(*size) for size in sizes(shape)]
        places = [fcl.Transform(r, t) for r, t in zip(*poses(shape), strict=True)]
        sides.append(
            [fcl.CollisionObject(*x) for x in zip(solids, places, strict=True)]
        )
    deep = np.flatnonzero(mine < 0)
    share = []
    for i in deep:
        request = fcl.CollisionRequest(num_max_contacts=8, enable_contact=True)
        result = fcl.CollisionResult()
        fcl.collide(sides[0][i], sides[1][i], request, result)
        depth = max(c.penetration_depth for c in result.contacts)
        share.append(depth / -mine[i] - 1)
    assert -1e-9 <= min(share) and 0.03 <= max(share) <= 0.0501
    assert 0.1 < np.mean(np.array(share) > 1e-6) < 0.3
    for i in deep[:SAMPLE]:
        assert mine[i] == pytest.approx(true_gap(a[i], b[i]), abs=EXACT)
