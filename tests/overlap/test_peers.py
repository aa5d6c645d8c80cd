"""100,000 drawn pairs of each two kinds against python-fcl and coal.

Neither peer is the truth. Where one is further than ``CLOSE`` from the library, and on a
sample of all pairs, the slow ways of ``overlap.drawn_shapes`` decide: all separating axes
where the cores overlap, else a bounded least-squares solve. The library has to be there to
``EXACT`` every time. What the peers were off by, and why, stands beside each test.
"""

import itertools

import numpy as np
import pytest
from overlap.drawn_shapes import DRAW, true_gap

from course.overlap import gap, overlaps
from course.shapes import OBB, Capsule, ConvexHull, HalfSpace, Sphere

pytestmark = [pytest.mark.peers, pytest.mark.long]

COUNT = 100_000
#: How many pairs of each two kinds are looked at in the slow way, of all and of those that differ.
SAMPLE = 150
#: What peers are asked for, and what the library has to reach, in sizes of order 1.
CLOSE, EXACT = 1e-6, 1e-9
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


def judged(a, b, mine, theirs):
    """Rows where a peer differs; the library is right in all of these that are looked at, and in a sample."""
    off = np.flatnonzero(np.abs(mine - theirs) > CLOSE)
    rng = np.random.default_rng(1)
    some = rng.choice(a.count, SAMPLE, replace=False)
    disputed = rng.choice(off, min(SAMPLE, off.size), replace=False)
    for i in (*some, *disputed):
        assert mine[i] == pytest.approx(true_gap(a[i], b[i]), abs=EXACT)
    return off


@pytest.mark.parametrize(
    "kind_a, kind_b", list(itertools.combinations_with_replacement(COAL_KINDS, 2))[:-1]
)
def test_against_coal(kind_a, kind_b):
    pytest.importorskip("coal")
    a, b = drawn(kind_a, kind_b)
    mine = gap(a, b)
    assert 0.1 < np.mean(overlaps(a, b)) < 0.99
    np.testing.assert_array_equal(overlaps(a, b), mine <= 0)
    off = judged(a, b, mine, coal_gaps(a, b))
    assert off.size <= 0.01 * COUNT


@pytest.mark.parametrize(
    "kind_a, kind_b", list(itertools.combinations_with_replacement(FCL_KINDS, 2))
)
def test_against_python_fcl(kind_a, kind_b):
    pytest.importorskip("fcl")
    a, b = drawn(kind_a, kind_b)
    mine, theirs = gap(a, b), fcl_gaps(a, b)
    off = judged(a, b, mine, theirs)
    assert np.sum(mine[off] > 0) <= 0.001 * COUNT
    # A distance that is none is no depth: the verdict is compared instead.
    assert np.mean((theirs > 0) != (mine > 0)) <= 1e-4
